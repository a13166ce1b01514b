#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

#include "core/stitch/image_plane.h"

namespace rangezip {

/// A directed edge that the triangulation of the seam must keep, by vertex numbers.
using SeamSegment = std::array<std::uint32_t, 2>;

/// Removes the segments without length and those that touch an earlier kept one elsewhere than in
/// a common vertex. Exact. Candidates come from buckets of about a pixel, so the cost is
/// O(segments) where these are short.
/// @param segments in the order of their rights
/// @param first_optional the segments before this one are kept unseen
/// @param points of all vertices
/// @return how many were removed
std::size_t drop_conflicting_segments(std::vector<SeamSegment>& segments,
                                      std::size_t first_optional,
                                      std::span<const GridPoint> points);

}  // namespace rangezip

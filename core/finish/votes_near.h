#pragma once

#include <cstddef>
#include <span>
#include <vector>

#include "core/base/geometry.h"
#include "core/finish/seen_points.h"

namespace rangezip {

/// From where the points around a place are seen.
struct VotesNear {
  Vec3 sum{0.0};          ///< of the votes, each up to 127 long
  std::size_t count = 0;  ///< of points that have one

  /// Whether these points look to a side, clearly: the mean vote has a cosine of more than 0.25
  /// with it, and a length of 0.05 of a full vote.
  [[nodiscard]] bool look_toward(const Vec3& unit) const;
};

/// The votes of the points within `radius` of each place (those of polygons have none).
/// O(places + points).
[[nodiscard]] std::vector<VotesNear> votes_near(std::span<const Vec3> places,
                                                const SeenPoints& seen, double radius);

}  // namespace rangezip

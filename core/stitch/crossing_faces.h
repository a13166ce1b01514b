#pragma once

#include <cstdint>
#include <span>
#include <utility>
#include <vector>

namespace rangezip {

/// What a face belongs to, in the order in which one goes if it crosses another.
enum class FaceOrigin : std::uint8_t {
  seam,  ///< between patch and old surface, also old surface that was cut or turned
  patch,
  old,  ///< as it was
};

/// A pair of faces (lower number first; {i, i}: one without area), as self_intersections() tells.
using FacePair = std::pair<std::uint32_t, std::uint32_t>;

/// Faces without which none of the pairs is left. Of two faces that of the earlier origin goes, of
/// the same origin the one in more pairs, then the later one. Ascending.
/// @param origins one per face
/// @pre no pair is of two old faces
[[nodiscard]] std::vector<std::uint32_t> choose_crossing_faces(std::span<const FacePair> pairs,
                                                               std::span<const FaceOrigin> origins);

}  // namespace rangezip

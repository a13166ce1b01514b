#pragma once

#include <cstddef>
#include <cstdint>
#include <span>
#include <unordered_map>
#include <vector>

#include "core/base/cubes.h"
#include "core/base/geometry.h"
#include "core/finish/seen_points.h"
#include "core/mesh/triangle_mesh.h"

namespace rangezip {

/// From where the points around a place are seen.
struct VotesNear {
  Vec3 sum{0.0};          ///< of the votes, each up to 127 long
  std::size_t count = 0;  ///< of points that have one

  /// Whether these points look to a side, clearly: the mean vote has a cosine of more than 0.25
  /// with it, and a length of 0.05 of a full vote.
  [[nodiscard]] bool look_toward(const Vec3& unit) const;
};

/// The votes of the points around places, for looking at them there (those of polygons have none).
class VoteGrid {
 public:
  /// Keeps the points within two times `radius` of the places, and some farther ones.
  /// O(places + points).
  /// @param radius model units, positive
  VoteGrid(const SeenPoints& seen, std::span<const Vec3> places, double radius);

  /// Of the points within the radius, as far as they are kept.
  [[nodiscard]] VotesNear around(const Vec3& place) const;

  /// Whether the points around a face's centroid look out of its back: it faces the wrong way.
  [[nodiscard]] bool look_out_of_back(const std::vector<Vec3>& positions,
                                      const Triangle& face) const;

 private:
  SeenPoints seen_;
  double radius_;
  std::unordered_map<Cube, std::vector<std::uint32_t>, CubeHash> points_in_;
};

}  // namespace rangezip

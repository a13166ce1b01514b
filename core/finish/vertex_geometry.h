#pragma once

#include <cstdint>
#include <vector>

#include "core/base/geometry.h"
#include "core/base/parallel.h"
#include "core/finish/corner_table.h"
#include "core/finish/triangle_shape.h"

namespace rangezip {

/// Twice the area vector of a face.
[[nodiscard]] inline Vec3 face_area_vector(const CornerTable& table,
                                           const std::vector<Vec3>& positions, std::uint32_t face) {
  const Triangle t = table.triangle(face);
  return area_vector(positions[t[0]], positions[t[1]], positions[t[2]]);
}

/// The mean of the normals around a vertex by their faces' areas, unit length; (0, 0, 1) where the
/// faces have no area or there are none.
[[nodiscard]] inline Vec3 vertex_normal(const CornerTable& table,
                                        const std::vector<Vec3>& positions, std::uint32_t vertex) {
  Vec3 sum{0.0};
  table.for_each_corner(vertex,
                        [&](std::uint32_t c) { sum += face_area_vector(table, positions, c / 3); });
  return unit_or_z(sum);
}

/// The values, one a vertex, each moved by `share` of the way to the mean of its neighbours'.
[[nodiscard]] inline std::vector<double> smoothed(const CornerTable& table,
                                                  const std::vector<double>& values, double share) {
  constexpr std::size_t kPerBlock = 4096;
  std::vector<double> smooth = values;
  parallel_for(values.size(), kPerBlock, [&](std::size_t begin, std::size_t end) {
    for (auto v = static_cast<std::uint32_t>(begin); v < end; ++v) {
      double sum = 0.0;
      int count = 0;
      table.for_each_neighbor(v, [&](std::uint32_t w) {
        sum += values[w];
        ++count;
      });
      if (count > 0) smooth[v] = (1.0 - share) * values[v] + share * sum / count;
    }
  });
  return smooth;
}

/// Whether a vertex may move to `target` with no face around it turning by more than 60 degrees;
/// slivers have no direction to keep.
[[nodiscard]] inline bool turns_no_face(const CornerTable& table,
                                        const std::vector<Vec3>& positions, std::uint32_t vertex,
                                        const Vec3& target) {
  constexpr double kMaxTurn = 0.5;  // cosine
  constexpr double kSliver = 0.1;   // sine of the smallest angle
  bool ok = true;
  table.for_each_corner(vertex, [&](std::uint32_t c) {
    if (!ok) return;
    const Vec3 &at = positions[vertex], &p = positions[table.head(c)],
               &q = positions[table.apex(c)];
    ok = has_cosine(area_vector(at, p, q), area_vector(target, p, q), kMaxTurn) ||
         sine_of_smallest_angle(at, p, q) <= kSliver;
  });
  return ok;
}

}  // namespace rangezip

#include "core/io/raw_geometry.h"

#include <limits>

#include "core/io/split_polygon.h"

namespace rangezip {

void PositionList::add_unusable() {
  ++nonfinite_;
  constexpr double kNan = std::numeric_limits<double>::quiet_NaN();
  if (is_exact_) {
    exact_.emplace_back(kNan);
  } else {
    local_.emplace_back(Vec3{kNan});
  }
}

SplitPolygons split_polygons(const RawGeometry& geometry) {
  SplitPolygons split;
  split.triangles.reserve(geometry.polygon_sizes.size());
  std::vector<Vec3> positions;
  std::span<const std::uint32_t> rest = geometry.corners;
  for (const std::uint32_t size : geometry.polygon_sizes) {
    const auto polygon = rest.first(size);
    rest = rest.subspan(size);
    positions.clear();
    bool is_finite = true;
    for (const std::uint32_t corner : polygon) {
      is_finite = is_finite && geometry.positions.is_finite(corner);
      positions.push_back(geometry.positions[corner]);
    }
    if (!is_finite) {
      ++split.nonfinite;
      continue;
    }
    const std::size_t before = split.triangles.size();
    split_polygon(polygon, positions, split.triangles);
    if (split.triangles.size() == before) ++split.degenerate;
  }
  return split;
}

}  // namespace rangezip

#include "core/io/raw_geometry.h"

#include <algorithm>
#include <limits>

#include "core/io/split_polygon.h"

namespace rangezip {

namespace {

/// Box around all positions, unusable if one of them is: NaN stays NaN.
Box bounds_of(std::span<const Vec3> positions) {
  // Six plain numbers, which the compiler keeps in registers.
  double x0 = positions[0].x, y0 = positions[0].y, z0 = positions[0].z;
  double x1 = x0, y1 = y0, z1 = z0;
  double sum = 0.0;  // NaN or infinite if a coordinate is
  for (const Vec3& p : positions) {
    sum += p.x * 0.0 + p.y * 0.0 + p.z * 0.0;
    x0 = std::min(x0, p.x);
    y0 = std::min(y0, p.y);
    z0 = std::min(z0, p.z);
    x1 = std::max(x1, p.x);
    y1 = std::max(y1, p.y);
    z1 = std::max(z1, p.z);
  }
  return {{x0 + sum, y0, z0}, {x1, y1, z1}};
}

}  // namespace

void PositionList::add_unusable() {
  ++nonfinite_;
  constexpr double kNan = std::numeric_limits<double>::quiet_NaN();
  if (is_exact_) {
    exact_.emplace_back(kNan);
  } else {
    local_.emplace_back(Vec3{kNan});
  }
}

void PositionList::add(std::span<const Vec3> block) {
  if (block.empty()) return;
  const Box bounds = bounds_of(block);
  if (!is_usable(bounds.lower) || !is_usable(bounds.upper)) {
    for (const Vec3& p : block)
      add(p);
    return;
  }
  bounds_.add(bounds);
  local_origin_.add(block);
  if (is_exact_) {
    exact_.insert(exact_.end(), block.begin(), block.end());
    return;
  }
  const std::size_t before = local_.size();
  local_.resize(before + block.size());
  const Vec3 origin = origin_;
  std::transform(block.begin(), block.end(), local_.begin() + static_cast<std::ptrdiff_t>(before),
                 [&origin](const Vec3& p) { return Vec3f(p - origin); });
}

SplitPolygons split_polygons(const RawGeometry& geometry, const Progress& progress) {
  constexpr std::size_t kBlock = 65536;  // polygons between two looks at the stop token
  SplitPolygons split;
  split.triangles.reserve(geometry.polygon_sizes.size());
  std::vector<Vec3> positions;
  std::span<const std::uint32_t> rest = geometry.corners;
  for (std::size_t i = 0; i < geometry.polygon_sizes.size(); ++i) {
    if (i % kBlock == 0) progress.check_stop();
    const std::uint32_t size = geometry.polygon_sizes[i];
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
    split_polygon(polygon, positions, split.triangles, progress);
    if (split.triangles.size() == before) ++split.degenerate;
  }
  return split;
}

}  // namespace rangezip

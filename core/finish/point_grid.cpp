#include "core/finish/point_grid.h"

#include <cmath>

#include "core/base/parallel.h"

namespace rangezip {
namespace {

/// Bounds the memory of the grid: cells for each point, and for a start.
constexpr std::size_t kCellsPerPoint = 4;
constexpr std::size_t kFreeCells = 4096;
constexpr std::size_t kPointsPerBlock = 1024;

bool contains(const Box& box, const Vec3& p) {
  return box.lower.x <= p.x && p.x <= box.upper.x && box.lower.y <= p.y && p.y <= box.upper.y &&
         box.lower.z <= p.z && p.z <= box.upper.z;
}

}  // namespace

PointGrid::PointGrid(std::span<const Vec3> points, const Box& region, double cell)
    : origin_(region.lower) {
  std::size_t inside = 0;
  for (const Vec3& p : points)
    inside += contains(region, p) ? 1 : 0;
  if (inside == 0) return;
  const Vec3 size = region.upper - region.lower;
  for (;;) {
    double cells = 1.0;
    for (int axis = 0; axis < 3; ++axis)
      cells *= std::floor(size[axis] / cell) + 1.0;
    if (cells <= static_cast<double>(kCellsPerPoint * inside + kFreeCells)) break;
    constexpr double kGrowth = 1.25;
    cell *= kGrowth;
  }
  cells_per_unit_ = 1.0 / cell;
  for (int axis = 0; axis < 3; ++axis) {
    dims_[static_cast<std::size_t>(axis)] =
        static_cast<std::size_t>(size[axis] * cells_per_unit_) + 1;
  }
  const auto cell_of = [&](const Vec3& p) {
    std::array<std::size_t, 3> at{};
    for (int axis = 0; axis < 3; ++axis) {
      const auto a = static_cast<std::size_t>(axis);
      at[a] = std::min(static_cast<std::size_t>((p[axis] - origin_[axis]) * cells_per_unit_),
                       dims_[a] - 1);
    }
    return (at[2] * dims_[1] + at[1]) * dims_[0] + at[0];
  };
  starts_.assign(dims_[0] * dims_[1] * dims_[2] + 1, 0);
  for (const Vec3& p : points) {
    if (contains(region, p)) ++starts_[cell_of(p) + 1];
  }
  for (std::size_t c = 1; c < starts_.size(); ++c)
    starts_[c] += starts_[c - 1];
  positions_.resize(inside);
  for (const Vec3& p : points) {
    if (contains(region, p)) positions_[starts_[cell_of(p)]++] = Vec3f(p - origin_);
  }
  // Filling moved every start to the next one's place.
  std::copy_backward(starts_.begin(), starts_.end() - 1, starts_.end());
  starts_.front() = 0;
}

void PointGrid::note_facings(const std::function<Vec3(const Vec3&)>& facing_at) {
  facings_.assign(positions_.size(), Facing{});
  parallel_for(positions_.size(), kPointsPerBlock, [&](std::size_t begin, std::size_t end) {
    for (std::size_t i = begin; i < end; ++i) {
      const Vec3 facing = facing_at(origin_ + Vec3(positions_[i]));
      for (int axis = 0; axis < 3; ++axis) {
        facings_[i][static_cast<std::size_t>(axis)] =
            static_cast<std::int8_t>(std::lround(kFacingSteps * facing[axis]));
      }
    }
  });
  count_known_facings();
}

void PointGrid::count_known_facings() {
  known_facings_.assign(starts_.size(), 0);
  for (std::size_t cell = 0; cell + 1 < starts_.size(); ++cell) {
    std::uint32_t known = known_facings_[cell];
    for (std::size_t i = starts_[cell]; i < starts_[cell + 1]; ++i)
      known += facings_[i] == Facing{} ? 0 : 1;
    known_facings_[cell + 1] = known;
  }
}

PointGrid PointGrid::thinned(int parts) const {
  constexpr std::size_t kSides = 2;
  struct Part {
    Vec3 sum{0.0};
    std::uint32_t count = 0;
    Facing facing{};
  };
  PointGrid thin;
  thin.origin_ = origin_;
  thin.cells_per_unit_ = cells_per_unit_;
  thin.dims_ = dims_;
  thin.starts_.assign(starts_.size(), 0);
  const auto along = static_cast<std::size_t>(parts);
  std::vector<Part> inside(kSides * along * along * along);
  const auto part_of = [&](const Vec3f& p) {
    std::size_t part = 0;
    for (int axis = 2; axis >= 0; --axis) {
      const double place = p[axis] * cells_per_unit_;
      const auto at = static_cast<std::size_t>((place - std::floor(place)) * parts);
      part = part * along + std::min(at, along - 1);
    }
    return part;
  };
  for (std::size_t cell = 0; cell + 1 < starts_.size(); ++cell) {
    for (std::size_t i = starts_[cell]; i < starts_[cell + 1]; ++i) {
      const Facing facing = facings_.empty() ? Facing{} : facings_[i];
      const std::size_t first = kSides * part_of(positions_[i]);
      const bool is_other = faces_away(inside[first].facing, vector_of(facing) / kFacingSteps);
      Part& part = inside[first + (is_other ? 1 : 0)];
      if (part.facing == Facing{}) part.facing = facing;
      part.sum += Vec3(positions_[i]);
      ++part.count;
    }
    for (Part& part : inside) {
      if (part.count == 0) continue;
      thin.positions_.emplace_back(part.sum / static_cast<double>(part.count));
      thin.counts_.push_back(part.count);
      if (!facings_.empty()) thin.facings_.push_back(part.facing);
      part = {};
    }
    thin.starts_[cell + 1] = static_cast<std::uint32_t>(thin.positions_.size());
  }
  if (!facings_.empty()) thin.count_known_facings();
  return thin;
}

std::vector<Vec3> PointGrid::points(std::size_t most) const {
  if (most == 0) return {};
  const std::size_t step = std::max<std::size_t>(1, (positions_.size() + most - 1) / most);
  std::vector<Vec3> points;
  points.reserve(positions_.size() / step + 1);
  for (std::size_t i = 0; i < positions_.size(); i += step)
    points.push_back(origin_ + Vec3(positions_[i]));
  return points;
}

}  // namespace rangezip

#pragma once

#include <algorithm>
#include <array>
#include <cstddef>

#include "core/base/geometry.h"

namespace rangezip {

/// The cells of a grid that a box meets.
struct CellRange {
  std::array<int, 3> lower{};
  std::array<int, 3> upper{};  ///< inclusive

  [[nodiscard]] std::size_t count() const {
    std::size_t n = 1;
    for (std::size_t axis = 0; axis < 3; ++axis) {
      n *= static_cast<std::size_t>(upper[axis] - lower[axis] + 1);
    }
    return n;
  }
};

/// Cubic cells over a box, numbered row by row and layer by layer. Places and boxes asked for must
/// not reach below its lower corner; what is beyond the upper one counts to the last cells.
class CellGrid {
 public:
  /// @param cell side wanted; it grows until there are no more than `max_cells`
  CellGrid(const Box& bounds, double cell, std::size_t max_cells) : lower_(bounds.lower) {
    const Vec3 size = bounds.upper - bounds.lower;
    const double largest = std::max({size.x, size.y, size.z});
    // A cell of at least a 1000th of the box keeps the count of cells in range for the loop below.
    constexpr double kMaxCellsPerAxis = 1000.0;
    cell = std::max(cell, largest / kMaxCellsPerAxis);
    if (!(cell > 0.0)) cell = 1.0;
    for (;;) {
      std::size_t cells = 1;
      for (int axis = 0; axis < 3; ++axis) {
        dims_[static_cast<std::size_t>(axis)] = static_cast<int>(size[axis] / cell) + 1;
        cells *= static_cast<std::size_t>(dims_[static_cast<std::size_t>(axis)]);
      }
      if (cells <= max_cells || cells <= 1) break;
      constexpr double kGrowth = 1.25;
      cell *= kGrowth;
    }
    cell_ = cell;
    per_unit_ = 1.0 / cell;
  }

  [[nodiscard]] double cell() const { return cell_; }

  [[nodiscard]] std::size_t cell_count() const {
    return static_cast<std::size_t>(dims_[0]) * static_cast<std::size_t>(dims_[1]) *
           static_cast<std::size_t>(dims_[2]);
  }
  [[nodiscard]] CellRange range_of(const Box& box) const {
    CellRange range;
    for (int axis = 0; axis < 3; ++axis) {
      const auto a = static_cast<std::size_t>(axis);
      range.lower[a] = coordinate(box.lower[axis], axis);
      range.upper[a] = coordinate(box.upper[axis], axis);
    }
    return range;
  }
  [[nodiscard]] std::size_t index_of(const Vec3& p) const {
    return index(coordinate(p.x, 0), coordinate(p.y, 1), coordinate(p.z, 2));
  }
  [[nodiscard]] int layers() const { return dims_[2]; }
  /// Visits the cells of a range in the layers from `lowest` to `highest`.
  template <class Visit>
  void for_each_cell(const CellRange& range, int lowest, int highest, Visit visit) const {
    for (int z = std::max(lowest, range.lower[2]); z <= std::min(highest, range.upper[2]); ++z) {
      for (int y = range.lower[1]; y <= range.upper[1]; ++y) {
        const std::size_t row = index(0, y, z);
        for (int x = range.lower[0]; x <= range.upper[0]; ++x) {
          visit(row + static_cast<std::size_t>(x));
        }
      }
    }
  }

 private:
  [[nodiscard]] int coordinate(double value, int axis) const {
    const double scaled = (value - lower_[axis]) * per_unit_;
    return std::min(static_cast<int>(scaled), dims_[static_cast<std::size_t>(axis)] - 1);
  }
  [[nodiscard]] std::size_t index(int x, int y, int z) const {
    return (static_cast<std::size_t>(z) * static_cast<std::size_t>(dims_[1]) +
            static_cast<std::size_t>(y)) *
               static_cast<std::size_t>(dims_[0]) +
           static_cast<std::size_t>(x);
  }

  Vec3 lower_;
  double cell_ = 1.0;  ///< side
  double per_unit_ = 1.0;
  std::array<int, 3> dims_{1, 1, 1};
};

}  // namespace rangezip

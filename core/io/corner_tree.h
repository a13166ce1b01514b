#pragma once

#include <cstddef>
#include <optional>
#include <span>
#include <vector>

#include "core/base/geometry.h"

namespace rangezip {

/// Positive where a, b, c turn left.
[[nodiscard]] inline double turn(const Vec2& a, const Vec2& b, const Vec2& c) noexcept {
  return (b.x - a.x) * (c.y - a.y) - (b.y - a.y) * (c.x - a.x);
}

/// The corners of a polygon in the plane, of which one after the other is taken away, for asking
/// whether one lies in a triangle: boxes around the halves of halves of them.
class CornerTree {
 public:
  /// @param places finite; they must outlive the tree. O(n log n)
  explicit CornerTree(std::span<const Vec2> places);

  void remove(std::size_t corner);

  /// A corner that has not been removed inside the triangle abc or on its border, and is at none of
  /// the places a, b, c. Inside is what turn() says, with its rounding: the same as if all were
  /// looked at. About O(log n + r) for r corners close to the triangle's sides; O(n) at worst.
  /// @pre abc turn left
  [[nodiscard]] std::optional<std::size_t> find_inside(const Vec2& a, const Vec2& b,
                                                       const Vec2& c) const;

 private:
  struct Node {
    Vec2 lower{0.0};
    Vec2 upper{0.0};
    std::size_t left_over = 0;  ///< corners not removed
  };

  void build(std::size_t node, std::size_t begin, std::size_t end);
  [[nodiscard]] std::optional<std::size_t> find_below(std::size_t node,
                                                      std::span<const Vec2, 3> triangle) const;

  std::span<const Vec2> places_;
  std::vector<std::size_t> corners_;  ///< leaf by leaf
  std::vector<bool> is_removed_;
  std::vector<std::size_t> leaf_of_;
  std::vector<std::size_t> starts_;  ///< of the leaves, in `corners_`, and the end
  std::vector<Node> nodes_;          ///< those below node i are 2 i + 1 and 2 i + 2; leaves last
};

}  // namespace rangezip

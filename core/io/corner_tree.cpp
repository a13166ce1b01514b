#include "core/io/corner_tree.h"

#include <algorithm>
#include <array>
#include <bit>
#include <cmath>
#include <limits>
#include <numeric>

namespace rangezip {
namespace {

constexpr std::size_t kCornersPerLeaf = 8;

/// Whether turn(a, b, p) comes out negative for every place p of a box, rounding included.
bool lies_right_of(const Vec2& a, const Vec2& b, const Vec2& lower, const Vec2& upper) {
  const Vec2 side = b - a;
  // Leftmost as seen along the side: there the turn is greatest.
  const Vec2 place{side.y > 0.0 ? lower.x : upper.x, side.x > 0.0 ? upper.y : lower.y};
  const Vec2 reach = glm::max(glm::abs(lower - a), glm::abs(upper - a));
  // Twice what the differences, products and their difference can be wrong by, here and there.
  constexpr double kRoundings = 16.0 * std::numeric_limits<double>::epsilon();
  const double error = kRoundings * (std::abs(side.x) * reach.y + std::abs(side.y) * reach.x) +
                       std::numeric_limits<double>::min();
  return turn(a, b, place) + error < 0.0;
}

}  // namespace

CornerTree::CornerTree(std::span<const Vec2> places)
    : places_(places),
      corners_(places.size()),
      is_removed_(places.size()),
      leaf_of_(places.size()) {
  std::iota(corners_.begin(), corners_.end(), std::size_t{0});
  const std::size_t leaves = std::bit_ceil(
      std::max<std::size_t>(1, (places.size() + kCornersPerLeaf - 1) / kCornersPerLeaf));
  nodes_.resize(2 * leaves - 1);
  build(0, 0, places.size());
  starts_.push_back(places.size());
}

void CornerTree::build(std::size_t node, std::size_t begin, std::size_t end) {
  Node& built = nodes_[node];
  built.left_over = end - begin;
  if (begin < end) built.lower = built.upper = places_[corners_[begin]];
  for (std::size_t i = begin; i < end; ++i) {
    built.lower = glm::min(built.lower, places_[corners_[i]]);
    built.upper = glm::max(built.upper, places_[corners_[i]]);
  }
  const std::size_t inner_nodes = nodes_.size() / 2;
  if (node >= inner_nodes) {
    for (std::size_t i = begin; i < end; ++i)
      leaf_of_[corners_[i]] = node;
    starts_.push_back(begin);
    return;
  }
  const Vec2 size = built.upper - built.lower;
  const int axis = size.y > size.x ? 1 : 0;
  const std::size_t middle = begin + (end - begin) / 2;
  const auto at = [&](std::size_t i) { return corners_.begin() + static_cast<std::ptrdiff_t>(i); };
  std::nth_element(at(begin), at(middle), at(end), [&](std::size_t i, std::size_t j) {
    return places_[i][axis] < places_[j][axis];
  });
  build(2 * node + 1, begin, middle);
  build(2 * node + 2, middle, end);
}

void CornerTree::remove(std::size_t corner) {
  is_removed_[corner] = true;
  for (std::size_t node = leaf_of_[corner];; node = (node - 1) / 2) {
    --nodes_[node].left_over;
    if (node == 0) return;
  }
}

std::optional<std::size_t> CornerTree::find_inside(const Vec2& a, const Vec2& b,
                                                   const Vec2& c) const {
  const std::array<Vec2, 3> triangle{a, b, c};
  return find_below(0, triangle);
}

std::optional<std::size_t> CornerTree::find_below(std::size_t node,
                                                  std::span<const Vec2, 3> triangle) const {
  const Vec2 &a = triangle[0], &b = triangle[1], &c = triangle[2];
  const Node& here = nodes_[node];
  if (here.left_over == 0 || lies_right_of(a, b, here.lower, here.upper) ||
      lies_right_of(b, c, here.lower, here.upper) || lies_right_of(c, a, here.lower, here.upper)) {
    return std::nullopt;
  }
  const std::size_t inner_nodes = nodes_.size() / 2;
  if (node < inner_nodes) {
    const auto found = find_below(2 * node + 1, triangle);
    return found ? found : find_below(2 * node + 2, triangle);
  }
  const std::size_t leaf = node - inner_nodes;
  for (std::size_t i = starts_[leaf]; i < starts_[leaf + 1]; ++i) {
    const Vec2& p = places_[corners_[i]];
    if (is_removed_[corners_[i]] || p == a || p == b || p == c) continue;
    if (turn(a, b, p) >= 0.0 && turn(b, c, p) >= 0.0 && turn(c, a, p) >= 0.0) return corners_[i];
  }
  return std::nullopt;
}

}  // namespace rangezip

#pragma once

#include <algorithm>
#include <array>
#include <cstdint>
#include <random>
#include <vector>

#include "core/stitch/predicates.h"

namespace rangezip::test {

using Segment = std::array<std::uint32_t, 2>;

struct PointSet {
  std::vector<GridPoint> points;  ///< distinct
  std::vector<Segment> segments;  ///< touch each other at most in common end points
};

inline void remove_duplicates(std::vector<GridPoint>& points) {
  std::vector<GridPoint> distinct;
  for (const GridPoint& p : points) {
    if (std::find(distinct.begin(), distinct.end(), p) == distinct.end()) distinct.push_back(p);
  }
  points = std::move(distinct);
}

/// As many random segments between the points as touch neither another one nor a third point.
inline void add_segments(PointSet& set, std::size_t wanted, std::mt19937& random) {
  const auto count = static_cast<std::uint32_t>(set.points.size());
  for (std::size_t tries = 0; tries < 20 * wanted && set.segments.size() < wanted; ++tries) {
    const Segment candidate{static_cast<std::uint32_t>(random() % count),
                            static_cast<std::uint32_t>(random() % count)};
    if (candidate[0] == candidate[1]) continue;
    const GridPoint& a = set.points[candidate[0]];
    const GridPoint& b = set.points[candidate[1]];
    bool is_free = true;
    for (std::uint32_t i = 0; i < count && is_free; ++i) {
      if (i == candidate[0] || i == candidate[1]) continue;
      is_free = orientation(a, b, set.points[i]) != 0 || !is_between(a, b, set.points[i]);
    }
    for (const Segment& other : set.segments) {
      const bool is_same = (other[0] == candidate[0] && other[1] == candidate[1]) ||
                           (other[0] == candidate[1] && other[1] == candidate[0]);
      if (is_same) is_free = false;
      const bool is_joined = other[0] == candidate[0] || other[0] == candidate[1] ||
                             other[1] == candidate[0] || other[1] == candidate[1];
      if (!is_free) break;
      // Joined ones cannot overlap: the far end of the shorter would lie on the longer.
      if (!is_joined) is_free = !segments_touch(a, b, set.points[other[0]], set.points[other[1]]);
    }
    if (is_free) set.segments.push_back(candidate);
  }
}

/// Random points in a square of `side` grid steps.
inline PointSet random_points(unsigned seed, std::size_t count, std::int64_t side,
                              std::size_t segments) {
  std::mt19937 random(seed);
  PointSet set;
  for (std::size_t i = 0; i < count; ++i) {
    const std::int64_t x = random() % static_cast<std::uint32_t>(side);
    const std::int64_t y = random() % static_cast<std::uint32_t>(side);
    set.points.push_back({x - side / 2, y - side / 2});
  }
  remove_duplicates(set.points);
  add_segments(set, segments, random);
  return set;
}

}  // namespace rangezip::test

#include "core/stitch/constrained_delaunay.h"

#include <algorithm>
#include <catch2/catch.hpp>
#include <map>
#include <set>

#include "tests/core/stitch/point_sets.h"

using namespace rangezip;
using test::PointSet;
using test::Segment;

namespace {

/// Twice the area of the convex hull (Andrew's chain).
std::int64_t hull_area(std::vector<GridPoint> points) {
  std::sort(points.begin(), points.end(), [](const GridPoint& a, const GridPoint& b) {
    return a.x != b.x ? a.x < b.x : a.y < b.y;
  });
  std::vector<GridPoint> hull;
  for (int side = 0; side < 2; ++side) {
    const std::size_t base = hull.size();
    for (const GridPoint& p : points) {
      while (hull.size() >= base + 2 && orientation(hull[hull.size() - 2], hull.back(), p) <= 0) {
        hull.pop_back();
      }
      hull.push_back(p);
    }
    hull.pop_back();
    std::reverse(points.begin(), points.end());
  }
  std::int64_t area = 0;
  for (std::size_t i = 1; i + 1 < hull.size(); ++i) {
    area += orientation(hull[0], hull[i], hull[i + 1]);
  }
  return area;
}

/// Everything that makes a set of triangles the constrained Delaunay triangulation of the set:
/// it fills the hull, has the segments, and is locally Delaunay across all other edges.
void check_is_constrained_delaunay(const PointSet& set, const std::vector<Triangle>& triangles) {
  const auto& p = set.points;
  std::map<Segment, std::uint32_t> apex_of;
  std::int64_t area = 0;
  for (const Triangle& t : triangles) {
    const std::int64_t twice = orientation(p[t[0]], p[t[1]], p[t[2]]);
    REQUIRE(twice > 0);
    area += twice;
    for (std::size_t k = 0; k < 3; ++k) {
      REQUIRE(apex_of.insert({{t[k], t[(k + 1) % 3]}, t[(k + 2) % 3]}).second);
    }
  }
  CHECK(area == hull_area(p));
  std::set<Segment> fixed;
  for (const Segment& s : set.segments) {
    fixed.insert(s);
    fixed.insert({s[1], s[0]});
    CHECK(apex_of.count(s) + apex_of.count({s[1], s[0]}) > 0);
  }
  std::size_t violations = 0;
  for (const auto& [edge, apex] : apex_of) {
    const auto across = apex_of.find({edge[1], edge[0]});
    if (across == apex_of.end() || fixed.count(edge) != 0) continue;
    if (in_circle(p[edge[0]], p[edge[1]], p[apex], p[across->second])) ++violations;
  }
  CHECK(violations == 0);
}

void check_set(const PointSet& set) {
  const ConstrainedDelaunay result = triangulate_constrained(set.points, set.segments);
  CHECK(result.skipped_segments == 0);
  check_is_constrained_delaunay(set, result.triangles);
  CHECK(triangulate_constrained(set.points, set.segments).triangles == result.triangles);
}

}  // namespace

TEST_CASE("triangulate_constrained fills the hull, Delaunay between segments", "[stitch]") {
  for (unsigned seed = 0; seed < 60; ++seed) {
    CAPTURE(seed);
    check_set(test::random_points(seed, 3 + seed * 5, kGridLimit, seed));
  }
}

TEST_CASE("triangulate_constrained works on lattices where all is collinear and co-circular",
          "[stitch]") {
  for (unsigned seed = 0; seed < 60; ++seed) {
    CAPTURE(seed);
    check_set(test::random_points(seed, 10 + 4 * seed, 4 + seed / 4, seed));
  }
}

TEST_CASE("triangulate_constrained takes points on one circle", "[stitch]") {
  PointSet set;
  // The 12 lattice points at distance 25 from the origin.
  for (std::int64_t x = -25; x <= 25; ++x) {
    for (std::int64_t y = -25; y <= 25; ++y) {
      if (x * x + y * y == 625) set.points.push_back({x, y});
    }
  }
  set.segments = {{0, 7}};
  check_set(set);
  CHECK(triangulate_constrained(set.points, set.segments).triangles.size() ==
        set.points.size() - 2);
}

TEST_CASE("triangulate_constrained has no triangles for collinear points", "[stitch]") {
  const std::vector<GridPoint> points{{0, 0}, {2, 2}, {9, 9}, {-4, -4}};
  const std::vector<Segment> segments{{0, 1}, {3, 2}};
  CHECK(triangulate_constrained(points, segments).triangles.empty());
  CHECK(triangulate_constrained({}, {}).triangles.empty());
}

TEST_CASE("a segment over other points becomes a chain of edges", "[stitch]") {
  PointSet set{{{0, 0}, {10, 0}, {20, 0}, {30, 0}, {5, 9}, {15, -9}, {25, 9}, {16, 8}}, {{0, 3}}};
  const ConstrainedDelaunay result = triangulate_constrained(set.points, set.segments);
  CHECK(result.skipped_segments == 0);
  set.segments = {{0, 1}, {1, 2}, {2, 3}};
  check_is_constrained_delaunay(set, result.triangles);
}

TEST_CASE("of two segments that cross the first one stays", "[stitch]") {
  PointSet set{{{0, 0}, {10, 10}, {0, 10}, {10, 0}, {5, 20}}, {{0, 1}, {2, 3}}};
  const ConstrainedDelaunay result = triangulate_constrained(set.points, set.segments);
  CHECK(result.skipped_segments == 1);
  set.segments.pop_back();
  check_is_constrained_delaunay(set, result.triangles);
}

TEST_CASE("the outlines of a grid of pixels are kept", "[stitch]") {
  // Squares of whole pixels, as the boundary of a patch makes them: long collinear runs.
  PointSet set;
  const auto add_square = [&](std::int64_t first, std::int64_t last) {
    const auto base = static_cast<std::uint32_t>(set.points.size());
    const std::int64_t n = last - first;
    for (std::int64_t k = 0; k < 4 * n; ++k) {
      const std::int64_t i = k % n;
      const std::array<GridPoint, 4> sides{
          GridPoint{first + i, first}, {last, first + i}, {last - i, last}, {first, last - i}};
      const GridPoint& p = sides[static_cast<std::size_t>(k / n)];
      set.points.push_back({p.x * kGridStep, p.y * kGridStep});
      const auto here = base + static_cast<std::uint32_t>(k);
      set.segments.push_back({here, k + 1 < 4 * n ? here + 1 : base});
    }
  };
  add_square(0, 100);
  add_square(10, 90);
  check_set(set);
}

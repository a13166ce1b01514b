#include "core/reconstruct/papered_holes.h"

#include <algorithm>
#include <catch2/catch.hpp>
#include <cmath>
#include <cstdint>
#include <vector>

#include "tests/core/finish/shapes.h"
#include "tests/support/shapes.h"

namespace rangezip {
namespace {

constexpr double kStep = 0.4;  // of the points; h is 1
constexpr double kRim = 2.0;   // half the width of the hole

/// The points of a wide plate in z = 0 with a square hole in its middle, and of the hole's wall of
/// that depth below it.
std::vector<Vec3> plate_with_hole(double depth) {
  std::vector<Vec3> points;
  for (double x = -12.0; x <= 12.0; x += kStep) {
    for (double y = -12.0; y <= 12.0; y += kStep) {
      if (std::max(std::abs(x), std::abs(y)) >= kRim) points.emplace_back(x, y, 0.0);
    }
  }
  for (double z = 0.5 * kStep; z <= depth; z += kStep) {
    for (double t = -kRim; t < kRim; t += kStep) {
      points.emplace_back(t, -kRim, -z);
      points.emplace_back(kRim, t, -z);
      points.emplace_back(-t, kRim, -z);
      points.emplace_back(-kRim, -t, -z);
    }
  }
  return points;
}

/// The plate without its hole, in squares of side 1.
TriangleMesh closed_plate() {
  return shapes::square_sheet(22);
}

}  // namespace

TEST_CASE("faces over a hole whose wall is left out are found, with all the hole",
          "[reconstruct]") {
  const PaperedHoles holes =
      find_papered_holes(plate_with_hole(3.0), closed_plate(), {.pixel_size = 1.0});
  REQUIRE(holes.places.size() == 1);
  CHECK(glm::length(holes.places[0].center) < 0.5);
  CHECK(holes.places[0].contains({kRim, 0.0, 0.0}));
  CHECK_FALSE(holes.places[0].contains({3.0 * kRim, 0.0, 0.0}));
  CHECK_FALSE(holes.points.empty());
}

TEST_CASE("holes are left to fronts if enough of each component stays", "[reconstruct]") {
  const std::vector<Vec3> points = plate_with_hole(1.0);
  const auto holes = find_holes_for_fronts(points, closed_plate(), 1.0);
  REQUIRE(holes);
  CHECK(holes->places.size() == 1);

  TriangleMesh cover = shapes::square_sheet(22);  // of the hole and hardly more, in small faces
  for (Vec3& p : cover.positions)
    p *= 0.5;
  std::erase_if(cover.triangles, [&](const Triangle& face) {
    return glm::length(centroid_of(cover.positions, face)) > 1.6 * kRim;
  });
  REQUIRE(cover.triangles.size() > 100);
  REQUIRE(find_papered_holes(points, cover, of_sparse_points(1.0)).places.size() == 1);
  CHECK_FALSE(find_holes_for_fronts(points, cover, 1.0));
  TriangleMesh other = closed_plate();
  for (Vec3& p : other.positions)
    p.z += 50.0;
  testing::append(cover, other);
  CHECK_FALSE(find_holes_for_fronts(points, cover, 1.0));  // whatever is beside it
}

TEST_CASE("a wall is as many points as are asked for, as far from the mesh", "[reconstruct]") {
  constexpr double kDepth = 3.0;
  const std::vector<Vec3> points = plate_with_hole(kDepth);
  const auto found = [&](const PaperedHoleOptions& options) {
    return find_papered_holes(points, closed_plate(), options).places.size();
  };
  const auto wall = static_cast<std::size_t>(
      std::count_if(points.begin(), points.end(), [](const Vec3& p) { return p.z < 0.0; }));
  CHECK(found(of_sparse_points(1.0)) == 1);
  CHECK(found({.pixel_size = 1.0, .off_mesh = 1.0}) == 1);
  CHECK(found({.pixel_size = 1.0, .off_mesh = kDepth}) == 0);
  CHECK(found({.pixel_size = 1.0, .min_wall = wall / 3}) == 1);
  CHECK(found({.pixel_size = 1.0, .min_wall = wall}) == 0);
}

TEST_CASE("a gap in the points without a wall behind it is no hole", "[reconstruct]") {
  CHECK(
      find_papered_holes(plate_with_hole(0.0), closed_plate(), {.pixel_size = 1.0}).places.empty());
}

TEST_CASE("a wall of noise is none", "[reconstruct]") {
  std::vector<Vec3> points = plate_with_hole(3.0);
  for (std::size_t i = 0; i < points.size(); ++i) {
    // In turn inwards and outwards, of the four points of a wall beside each other.
    const double scale = i / 4 % 2 == 0 ? 0.85 : 1.15;
    if (points[i].z < 0.0) points[i] *= Vec3(scale, scale, 1.0);
  }
  CHECK(find_papered_holes(points, closed_plate(), {.pixel_size = 1.0}).places.empty());
}

TEST_CASE("without points or faces there are no papered holes", "[reconstruct]") {
  CHECK(find_papered_holes({}, closed_plate(), {.pixel_size = 1.0}).places.empty());
  CHECK(find_papered_holes(plate_with_hole(3.0), {}, {.pixel_size = 1.0}).places.empty());
}

}  // namespace rangezip

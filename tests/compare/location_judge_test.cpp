#include "compare/location_judge.h"

#include <catch2/catch.hpp>
#include <limits>
#include <vector>

#include "core/base/error.h"
#include "tests/compare/cubes.h"

using namespace rangezip;
using namespace rangezip::compare;

namespace {

/// A point above the inside of triangle 2 i of strip(): right of the diagonal of square i.
Vec3 above_square(std::uint32_t i) {
  return {i + 0.75, 0.25, 0.5};
}

}  // namespace

TEST_CASE("the face below a point over a plane agrees and loses nothing") {
  const TriangleMesh mesh = test::strip(8);
  std::vector<Vec3> points;
  std::vector<PrimitiveId> faces;
  for (std::uint32_t i = 0; i < 8; ++i) {
    points.push_back(above_square(i));
    faces.push_back(2 * i);
  }
  const LocationVerdict verdict = judge_location(mesh, points, faces);
  CHECK(verdict.points == 8);
  CHECK(verdict.agreeing == 8);
  CHECK(verdict.agreement() == 1.0);
  CHECK(verdict.max_loss == 0.0);
}

TEST_CASE("a face one square too far loses the distance to it") {
  const TriangleMesh mesh = test::strip(8);
  const std::vector<Vec3> points{above_square(3), above_square(3)};
  // Square 5 begins at x = 5, the point stands at (3.75, 0.25, 0.5); of its two triangles the left
  // one (number 11) has the whole edge x = 5.
  const std::vector<PrimitiveId> faces{6, 11};
  const double far = std::sqrt(1.25 * 1.25 + 0.5 * 0.5);

  const LocationVerdict verdict = judge_location(mesh, points, faces);
  CHECK(verdict.agreeing == 1);
  CHECK(verdict.agreement() == 0.5);
  CHECK(verdict.max_loss == Approx(far - 0.5).epsilon(1e-12));
  CHECK(verdict.mean_loss == Approx(0.5 * (far - 0.5)).epsilon(1e-12));
}

TEST_CASE("either face at a shared edge is right") {
  const TriangleMesh mesh = test::strip(4);
  const std::vector<Vec3> points{{2.0, 0.5, 0.3}, {2.0, 0.5, 0.3}};
  const LocationVerdict verdict = judge_location(mesh, points, std::vector<PrimitiveId>{2, 5});
  CHECK(verdict.agreeing == 2);
}

TEST_CASE("points without a face are counted apart and cost nothing") {
  const TriangleMesh mesh = test::strip(4);
  const std::vector<Vec3> points{above_square(0), above_square(1)};
  const LocationVerdict verdict =
      judge_location(mesh, points, std::vector<PrimitiveId>{kNoPrimitive, 2});
  CHECK(verdict.unlocated == 1);
  CHECK(verdict.agreement() == 1.0);
  CHECK(verdict.mean_loss == 0.0);
}

TEST_CASE("location of another length, faces out of range and points at infinity are refused") {
  const TriangleMesh mesh = test::strip(2);
  const std::vector<Vec3> points{above_square(0)};
  CHECK_THROWS_AS(judge_location(mesh, points, {}), InvalidArgument);
  CHECK_THROWS_AS(judge_location(mesh, points, std::vector<PrimitiveId>{4}), InvalidArgument);
  const std::vector<Vec3> infinite{{std::numeric_limits<double>::infinity(), 0.0, 0.0}};
  CHECK_THROWS_AS(judge_location(mesh, infinite, std::vector<PrimitiveId>{0}), InvalidArgument);
}

#include "compare/location_judge.h"

#include <catch2/catch.hpp>
#include <cmath>
#include <limits>
#include <vector>

#include "core/base/error.h"
#include "tests/compare/cubes.h"
#include "tests/support/images.h"

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

TEST_CASE("a point without a face is missed where one that is seen lies in its line of sight") {
  const TriangleMesh mesh = test::strip(4);
  TriangleMesh turned = mesh;
  for (Triangle& face : turned.triangles)
    std::swap(face[1], face[2]);
  const View view = images::parallel_view({64, 64});
  // Half a unit above two squares, far beside the strip, and one that was located.
  const std::vector<Vec3> points{
      above_square(0), above_square(1), {9.0, 9.0, 0.5}, above_square(2)};
  const std::vector<PrimitiveId> faces{kNoPrimitive, kNoPrimitive, kNoPrimitive, 4};
  CHECK(count_missed(mesh, view, points, faces, 0.6) == 2);
  CHECK(count_missed(mesh, view, points, faces, 0.4) == 0);
  CHECK(count_missed(turned, view, points, faces, 0.6) == 0);
  // The strip ends at y = 0: a line of sight there may pass it.
  const std::vector<Vec3> at_end{{1.75, 0.01, 0.5}, {1.75, 0.03, 0.5}};
  CHECK(count_missed(mesh, view, at_end, std::vector(2, kNoPrimitive), 0.6) == 1);
}

TEST_CASE("missed points spoil the verdict like wrong ones") {
  LocationVerdict verdict{.points = 10, .unlocated = 4, .agreeing = 6};
  CHECK(verdict.acceptance() == 1.0);
  verdict.missed = 2;
  CHECK(verdict.acceptance() == 0.75);
}

TEST_CASE("a face that is little farther than the nearest one is close, not right") {
  const TriangleMesh mesh = test::strip(8);
  const std::vector<Vec3> points{above_square(3)};
  const std::vector<PrimitiveId> faces{11};
  const double loss = std::sqrt(1.25 * 1.25 + 0.5 * 0.5) - 0.5;
  const LocationVerdict strict = judge_location(mesh, points, faces, 0.99 * loss);
  CHECK(strict.close == 0);
  CHECK(strict.acceptance() == 0.0);
  REQUIRE(strict.wrong.size() == 1);
  CHECK(strict.wrong[0].given == 11);
  CHECK(strict.wrong[0].nearest == 6);
  const LocationVerdict lenient = judge_location(mesh, points, faces, 1.01 * loss);
  CHECK(lenient.agreement() == 0.0);
  CHECK(lenient.acceptance() == 1.0);
}

TEST_CASE("in sight the face in the line counts, not the nearest one") {
  // Seen along z; the second point lies above an upright wall at x = 1.5 and beside it.
  TriangleMesh mesh = test::strip(4);
  const auto first = static_cast<std::uint32_t>(mesh.positions.size());
  mesh.positions.insert(mesh.positions.end(), {{1.5, 0.0, 0.1}, {1.5, 1.0, 0.1}, {1.6, 0.5, 1.0}});
  mesh.triangles.push_back({first, first + 1, first + 2});
  const View view = images::parallel_view({64, 64});
  const std::vector<Vec3> points{{0.75, 0.25, 0.5}, {1.75, 0.25, 0.5}};
  const LocationVerdict right =
      judge_location_in_sight(mesh, view, points, std::vector<PrimitiveId>{0, 2});
  CHECK(right.agreeing == 2);
  CHECK(judge_location(mesh, points, std::vector<PrimitiveId>{0, 2}).agreeing == 1);
  // The corner (2, 0, 0) of a face of the next square is 0.25 beside the line in x and in y.
  const LocationVerdict wrong =
      judge_location_in_sight(mesh, view, points, std::vector<PrimitiveId>{0, 4}, 0.2);
  CHECK(wrong.agreeing == 1);
  CHECK(wrong.close == 0);
  CHECK(wrong.max_loss == Approx(std::sqrt(0.125)));
}

TEST_CASE("location of another length, faces out of range and points at infinity are refused") {
  const TriangleMesh mesh = test::strip(2);
  const std::vector<Vec3> points{above_square(0)};
  CHECK_THROWS_AS(judge_location(mesh, points, {}), InvalidArgument);
  CHECK_THROWS_AS(judge_location(mesh, points, std::vector<PrimitiveId>{4}), InvalidArgument);
  const std::vector<Vec3> infinite{{std::numeric_limits<double>::infinity(), 0.0, 0.0}};
  CHECK_THROWS_AS(judge_location(mesh, infinite, std::vector<PrimitiveId>{0}), InvalidArgument);
}

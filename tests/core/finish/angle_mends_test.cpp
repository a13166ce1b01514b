#include "core/finish/angle_mends.h"

#include <algorithm>
#include <catch2/catch.hpp>
#include <cmath>
#include <vector>

#include "core/finish/triangle_shape.h"
#include "tests/core/finish/shapes.h"

namespace rangezip {
namespace {

constexpr double kWay = 0.3;
constexpr double kFourteenDegrees = 0.244;

/// The square [-1, 1]^2 at z = 0, facing up, in squares of side 1/4.
TriangleMesh sheet() {
  TriangleMesh mesh = testing::cube(8);
  testing::cut_where(mesh, [](const Vec3& p) { return p.z < 1.0; });
  for (Vec3& p : mesh.positions)
    p.z = 0.0;
  return mesh;
}

std::uint32_t vertex_at(const TriangleMesh& mesh, const Vec3& place) {
  const auto found = std::find_if(mesh.positions.begin(), mesh.positions.end(),
                                  [&](const Vec3& p) { return glm::length(p - place) < 1e-9; });
  REQUIRE(found != mesh.positions.end());
  return static_cast<std::uint32_t>(found - mesh.positions.begin());
}

/// A new vertex in the face that the edge from a to b has, in front of the edge's middle.
void split_beside(TriangleMesh& mesh, const Vec3& a, const Vec3& b, double distance) {
  CornerTable table(mesh.triangles, mesh.positions.size());
  const std::uint32_t start = vertex_at(mesh, a), end = vertex_at(mesh, b);
  for (std::uint32_t c = 0; c < table.corner_count(); ++c) {
    if (table.vertex(c) != start || table.head(c) != end) continue;
    const Vec3 middle = 0.5 * (a + b);
    const Vec3 inward = glm::normalize(mesh.positions[table.apex(c)] - middle);
    table.split(c / 3);
    mesh.positions.push_back(middle + distance * inward);
    mesh.triangles = table.triangles();
    return;
  }
  FAIL("no such edge");
}

std::vector<AngleMend> mends_of_worst(const TriangleMesh& mesh) {
  const auto angle = [&](const Triangle& t) {
    return sine_of_smallest_angle(mesh.positions[t[0]], mesh.positions[t[1]], mesh.positions[t[2]]);
  };
  const auto worst =
      std::min_element(mesh.triangles.begin(), mesh.triangles.end(),
                       [&](const Triangle& s, const Triangle& t) { return angle(s) < angle(t); });
  const CornerTable table(mesh.triangles, mesh.positions.size());
  return angle_mends(static_cast<std::uint32_t>(worst - mesh.triangles.begin()), mesh.positions,
                     table, {.max_border_way = kWay});
}

TriangleMesh with(TriangleMesh mesh, const AngleMend& mend) {
  std::vector<std::uint8_t> goes(mesh.triangles.size(), 0);
  for (const std::uint32_t f : mend.gone)
    goes[f] = 1;
  remove_triangles(mesh.triangles, goes);
  mesh.triangles.insert(mesh.triangles.end(), mend.faces.begin(), mend.faces.end());
  if (mend.vertex != CornerTable::kNone) mesh.positions[mend.vertex] = mend.place;
  return mesh;
}

double area_of(const TriangleMesh& mesh) {
  double sum = 0.0;
  for (const Triangle& t : mesh.triangles)
    sum += 0.5 * area_vector(mesh.positions[t[0]], mesh.positions[t[1]], mesh.positions[t[2]]).z;
  return sum;
}

/// The best mend leaves no small angle, and of a flat sheet as much as there was.
void require_best_mends(const TriangleMesh& mesh) {
  REQUIRE(testing::smallest_angle(mesh) < 0.1);
  const std::vector<AngleMend> mends = mends_of_worst(mesh);
  REQUIRE(!mends.empty());
  const TriangleMesh mended = with(mesh, mends.front());
  REQUIRE(testing::smallest_angle(mended) > kFourteenDegrees);
  REQUIRE(area_of(mended) == Approx(area_of(mesh)));
}

TEST_CASE("of a face without a small angle there is nothing to mend") {
  REQUIRE(mends_of_worst(sheet()).empty());
}

TEST_CASE("a flat face inside goes, and the sheet stays whole") {
  TriangleMesh mesh = sheet();
  split_beside(mesh, Vec3(0.25, 0.0, 0.0), Vec3(0.5, 0.0, 0.0), 0.004);
  require_best_mends(mesh);
}

TEST_CASE("a flat face whose longest edge is one of the border goes, and the sheet stays whole") {
  TriangleMesh mesh = sheet();
  split_beside(mesh, Vec3(0.0, -1.0, 0.0), Vec3(0.25, -1.0, 0.0), 0.004);
  require_best_mends(mesh);
}

TEST_CASE("a needle on a short edge of the border goes, and the sheet stays whole") {
  TriangleMesh mesh = sheet();
  mesh.positions[vertex_at(mesh, Vec3(0.25, -1.0, 0.0))].x = 0.01;
  require_best_mends(mesh);
}

TEST_CASE("mends keep faces from turning over and the border's vertices near their places") {
  TriangleMesh mesh = sheet();
  mesh.positions[vertex_at(mesh, Vec3(1.0, -1.0, 0.0))] = Vec3(0.76, -0.99, 0.0);
  const CornerTable table(mesh.triangles, mesh.positions.size());
  const std::vector<AngleMend> mends = mends_of_worst(mesh);
  REQUIRE(mends.size() > 3);
  for (const AngleMend& mend : mends) {
    const TriangleMesh mended = with(mesh, mend);
    for (const Triangle& t : mended.triangles)
      REQUIRE(
          area_vector(mended.positions[t[0]], mended.positions[t[1]], mended.positions[t[2]]).z >
          0.0);
    if (mend.vertex == CornerTable::kNone || !table.is_boundary(mend.vertex)) continue;
    REQUIRE(glm::length(mend.place - mesh.positions[mend.vertex]) < 1.001 * kWay);
  }
}

}  // namespace
}  // namespace rangezip

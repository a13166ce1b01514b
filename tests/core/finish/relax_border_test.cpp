#include "core/finish/relax_border.h"

#include <algorithm>
#include <catch2/catch.hpp>
#include <cmath>
#include <cstdint>
#include <map>
#include <random>
#include <utility>

#include "core/finish/triangle_shape.h"
#include "core/mesh/mesh_report.h"
#include "core/mesh/self_intersection.h"
#include "tests/core/finish/shapes.h"

namespace rangezip {
namespace {

using testing::uniform;

constexpr int kN = 16;
constexpr double kH = 2.0 / kN;
const Box kRegion{Vec3(-2.0), Vec3(2.0)};
const FitWindow kFit{.window = {.radius = 2.0 * kH, .height = 1.2 * kH}};

/// A square sheet of the saddle z = level + xy / 4, with inner vertices that slid on it.
void add_sheet(TriangleMesh& mesh, double level, std::mt19937_64& engine) {
  const auto first = static_cast<std::uint32_t>(mesh.positions.size());
  for (int i = 0; i <= kN; ++i) {
    for (int j = 0; j <= kN; ++j) {
      const bool is_inner = i > 0 && i < kN && j > 0 && j < kN;
      const double slide = is_inner ? 0.35 * kH : 0.0;
      const double x = kH * i - 1.0 + slide * uniform(engine, -1, 1);
      const double y = kH * j - 1.0 + slide * uniform(engine, -1, 1);
      mesh.positions.emplace_back(x, y, level + 0.25 * x * y);
    }
  }
  for (std::uint32_t i = 0; i < kN; ++i) {
    for (std::uint32_t j = 0; j < kN; ++j) {
      const std::uint32_t a = first + i * (kN + 1) + j, b = a + kN + 1;
      mesh.triangles.push_back({a, b, b + 1});
      mesh.triangles.push_back({a, b + 1, a + 1});
    }
  }
}

std::vector<Vec3> saddle_points(double level, double slope) {
  std::mt19937_64 engine(3);
  std::vector<Vec3> points;
  for (int i = 0; i < 20'000; ++i) {
    const double x = uniform(engine, -1, 1), y = uniform(engine, -1, 1);
    points.emplace_back(x, y, level + slope * x + 0.25 * x * y);
  }
  return points;
}

/// Mean sine of the smallest angles of the faces whose middle is within 2 h of the border.
double mean_angle_at_border(const TriangleMesh& mesh) {
  double sum = 0.0;
  int count = 0;
  for (const Triangle& t : mesh.triangles) {
    const Vec3 middle = (mesh.positions[t[0]] + mesh.positions[t[1]] + mesh.positions[t[2]]) / 3.0;
    if (std::max(std::abs(middle.x), std::abs(middle.y)) < 1.0 - 2.0 * kH) continue;
    sum += sine_of_smallest_angle(mesh.positions[t[0]], mesh.positions[t[1]], mesh.positions[t[2]]);
    ++count;
  }
  return sum / count;
}

std::map<std::pair<std::uint32_t, std::uint32_t>, int> faces_of_edges(const TriangleMesh& mesh) {
  std::map<std::pair<std::uint32_t, std::uint32_t>, int> count;
  for (const Triangle& t : mesh.triangles) {
    for (std::size_t i = 0; i < 3; ++i)
      ++count[std::minmax(t[i], t[(i + 1) % 3])];
  }
  return count;
}

}  // namespace

TEST_CASE("angles along the border get better on the surface, and the border stays") {
  const int seed = GENERATE(range(1, 6));
  CAPTURE(seed);
  std::mt19937_64 engine(static_cast<std::uint64_t>(seed));
  TriangleMesh mesh;
  add_sheet(mesh, 0.0, engine);
  const TriangleMesh before = mesh;
  const PointGrid cloud(saddle_points(0.0, 0.0), kRegion, 0.7 * kH);
  REQUIRE(relax_border(mesh, cloud, kFit));
  REQUIRE(mean_angle_at_border(mesh) > mean_angle_at_border(before) + 0.05);
  for (const Vec3& p : mesh.positions)
    REQUIRE(std::abs(p.z - 0.25 * p.x * p.y) < 1e-3 * kH);
  const auto edges_after = faces_of_edges(mesh);
  for (const auto& [edge, count] : faces_of_edges(before)) {
    if (count != 1) continue;
    REQUIRE(edges_after.at(edge) == 1);
    REQUIRE(mesh.positions[edge.first] == before.positions[edge.first]);
    REQUIRE(mesh.positions[edge.second] == before.positions[edge.second]);
  }
  REQUIRE(self_intersections(mesh).empty());
}

TEST_CASE("what is far from the border does not move, nor anything of a closed mesh") {
  std::mt19937_64 engine(1);
  TriangleMesh sheet;
  add_sheet(sheet, 0.0, engine);
  const TriangleMesh before = sheet;
  const PointGrid cloud(saddle_points(0.0, 0.0), kRegion, 0.7 * kH);
  relax_border(sheet, cloud, kFit);
  for (std::size_t v = 0; v < sheet.positions.size(); ++v) {
    const Vec3& p = before.positions[v];
    if (std::max(std::abs(p.x), std::abs(p.y)) < 1.0 - 4.0 * kH) REQUIRE(sheet.positions[v] == p);
  }
  TriangleMesh ball = testing::sphere(kN);
  const TriangleMesh ball_before = ball;
  REQUIRE_FALSE(relax_border(ball, cloud, kFit));
  REQUIRE(ball.positions == ball_before.positions);
  REQUIRE(ball.triangles == ball_before.triangles);
}

TEST_CASE("vertices on a crease that reaches the border stay on it") {
  std::mt19937_64 engine(4);
  TriangleMesh mesh;
  add_sheet(mesh, 0.0, engine);
  constexpr double kSlope = 0.32;  // either way: two planes 36 degrees apart
  const auto on_roof = [&](const Vec3& p) { return Vec3(p.x, p.y, -kSlope * std::abs(p.x)); };
  for (Vec3& p : mesh.positions) {
    if (std::abs(p.x) < 0.36 * kH) p.x = 0.0;
    p = on_roof(p);
  }
  const TriangleMesh before = mesh;
  std::vector<Vec3> points = saddle_points(0.0, 0.0);
  for (Vec3& p : points)
    p = on_roof(p);
  relax_border(mesh, PointGrid(points, kRegion, 0.7 * kH), kFit);
  int on_crease = 0;
  for (std::size_t v = 0; v < mesh.positions.size(); ++v) {
    if (before.positions[v].x != 0.0) continue;
    REQUIRE(mesh.positions[v] == before.positions[v]);
    ++on_crease;
  }
  REQUIRE(on_crease == kN + 1);
}

TEST_CASE("sheets that one tilted surface would pull through each other do not cross") {
  TriangleMesh mesh;
  for (const double level : {0.0, 0.1 * kH}) {
    std::mt19937_64 engine(2);
    add_sheet(mesh, level, engine);
  }
  REQUIRE(self_intersections(mesh).empty());
  const double angle_before = mean_angle_at_border(mesh);
  const PointGrid cloud(saddle_points(0.0, 0.02), kRegion, 0.7 * kH);
  REQUIRE(relax_border(mesh, cloud, kFit));
  REQUIRE(mean_angle_at_border(mesh) > angle_before);
  REQUIRE(self_intersections(mesh).empty());
  REQUIRE(report_mesh(mesh).is_manifold());
}

}  // namespace rangezip

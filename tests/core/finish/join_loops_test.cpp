#include "core/finish/join_loops.h"

#include <algorithm>
#include <catch2/catch.hpp>
#include <cmath>
#include <numbers>
#include <random>
#include <vector>

#include "core/finish/clean_topology.h"
#include "core/mesh/mesh_report.h"
#include "core/mesh/self_intersection.h"
#include "tests/core/finish/shapes.h"

namespace rangezip {
namespace {

using testing::uniform;

constexpr double kAxisRadius = 1.0;
constexpr double kTubeRadius = 0.4;
constexpr int kAround = 96;
constexpr int kAcross = 40;
constexpr double kSide = 2.0 * std::numbers::pi * kAxisRadius / kAround;  ///< of the triangles

Vec3 on_torus(double around, double across) {
  const double r = kAxisRadius + kTubeRadius * std::cos(across);
  return {r * std::cos(around), r * std::sin(around), kTubeRadius * std::sin(across)};
}

/// A torus whose tube is cut through where `around` lies within `gap` / 2 of 0, model units.
/// @param n_around, n_across how many vertices
TriangleMesh cut_torus(double gap, int n_around = kAround, int n_across = kAcross) {
  TriangleMesh mesh;
  constexpr double kTurn = 2.0 * std::numbers::pi;
  for (int i = 0; i < n_around; ++i) {
    for (int k = 0; k < n_across; ++k)
      mesh.positions.push_back(on_torus((i + 0.5) * kTurn / n_around, k * kTurn / n_across));
  }
  const auto vertex = [&](int i, int k) {
    return static_cast<std::uint32_t>((i % n_around) * n_across + k % n_across);
  };
  for (int i = 0; i < n_around; ++i) {
    for (int k = 0; k < n_across; ++k) {
      mesh.triangles.push_back({vertex(i, k), vertex(i + 1, k), vertex(i + 1, k + 1)});
      mesh.triangles.push_back({vertex(i, k), vertex(i + 1, k + 1), vertex(i, k + 1)});
    }
  }
  std::erase_if(mesh.triangles, [&](const Triangle& t) {
    const Vec3 middle = (mesh.positions[t[0]] + mesh.positions[t[1]] + mesh.positions[t[2]]) / 3.0;
    return middle.x > 0.0 && std::abs(middle.y) < 0.5 * gap;
  });
  remove_unused_vertices(mesh);
  return mesh;
}

/// Points of the torus, fewer than one in `kSide`^2 / 4; none where the tube is cut if `has_gap`.
std::vector<Vec3> torus_points(std::uint64_t seed, bool has_gap, double gap) {
  std::mt19937_64 engine(seed);
  std::vector<Vec3> points;
  for (int i = 0; i < 40'000; ++i) {
    const double u = uniform(engine, 0.0, 6.2832), v = uniform(engine, 0.0, 6.2832);
    const Vec3 p = on_torus(u, v);
    if (!(has_gap && p.x > 0.0 && std::abs(p.y) < 0.5 * gap)) points.push_back(p);
  }
  return points;
}

PointGrid grid_of(const std::vector<Vec3>& points) {
  return {points, {Vec3(-2.0), Vec3(2.0)}, 0.7 * kSide};
}

TEST_CASE("a ring-shaped gap in a tube is closed by a strip, which makes the handle whole") {
  const auto [gap, seed] = GENERATE(
      table<double, std::uint64_t>({{1.0 * kSide, 1U}, {2.0 * kSide, 2U}, {2.5 * kSide, 3U}}));
  CAPTURE(gap, seed);
  TriangleMesh mesh = cut_torus(gap);
  REQUIRE(report_mesh(mesh).boundary_loops == 2);
  REQUIRE(join_loops(mesh, pieces_of(mesh), grid_of(torus_points(seed, false, gap)), kSide).pairs ==
          1);
  const MeshReport report = report_mesh(mesh);
  REQUIRE(report.is_manifold());
  REQUIRE(report.boundary_edges == 0);
  REQUIRE(report.euler == 0);
  REQUIRE(self_intersections(mesh).empty());
}

/// A face across the gap, beside its middle, that the tube would have to lead through. @return its
/// first vertex
std::uint32_t add_obstacle(TriangleMesh& mesh, double gap) {
  constexpr double kRadius = 2.4 * kTubeRadius;
  const auto first = static_cast<std::uint32_t>(mesh.positions.size());
  for (const double angle : {0.0, 2.0 / 3.0 * std::numbers::pi, 4.0 / 3.0 * std::numbers::pi})
    mesh.positions.emplace_back(kAxisRadius + kRadius * std::cos(angle), 0.38 * gap,
                                kRadius * std::sin(angle));
  mesh.triangles.push_back({first, first + 1, first + 2});
  return first;
}

TEST_CASE("a strip that something crosses is not made, and its loops are named") {
  const double gap = 2.0 * kSide;
  TriangleMesh mesh = cut_torus(gap);
  const std::uint32_t first = add_obstacle(mesh, gap);
  const TriangleMesh before = mesh;
  const JoinedLoops joined =
      join_loops(mesh, pieces_of(mesh), grid_of(torus_points(6, false, gap)), kSide);
  REQUIRE(joined.pairs == 0);
  REQUIRE(mesh == before);
  const auto hindered = std::count(joined.is_hindered.begin(), joined.is_hindered.end(), 1);
  REQUIRE(static_cast<std::size_t>(hindered) == report_mesh(mesh).boundary_edges - 3);
  REQUIRE(joined.is_hindered[first] == 0);
}

TEST_CASE("of a strip that something small crosses the rest is made, and joins the loops") {
  const double gap = 2.0 * kSide;
  TriangleMesh mesh = cut_torus(gap);
  const auto first = static_cast<std::uint32_t>(mesh.positions.size());
  for (const double across : {-0.5, 0.5, 0.0})  // a shred through the wall
    mesh.positions.emplace_back(kAxisRadius + (1.0 + 0.2 * across) * kTubeRadius, 0.1 * across,
                                across == 0.0 ? 0.1 : 0.0);
  mesh.triangles.push_back({first, first + 1, first + 2});
  const std::size_t edges = report_mesh(mesh).boundary_edges;
  REQUIRE(join_loops(mesh, pieces_of(mesh), grid_of(torus_points(8, false, gap)), kSide).pairs ==
          1);
  CHECK(self_intersections(mesh).empty());
  clean_topology(mesh);
  const MeshReport report = report_mesh(mesh);
  CHECK(report.is_manifold());
  CHECK(report.components == 2);  // the shred is one
  CHECK(report.boundary_edges < edges / 2);
}

TEST_CASE("where a tube is 2 h wide, loops that cannot be joined are named if it is a hole") {
  constexpr double kPixel = kTubeRadius;  // all of the tube is within a pixel of its axis
  const bool is_hole = GENERATE(true, false);
  CAPTURE(is_hole);
  constexpr double kGap = 1.5 * kPixel;
  TriangleMesh mesh = cut_torus(kGap, 20, 8);
  for (Triangle& t : mesh.triangles) {
    if (is_hole) std::swap(t[1], t[2]);  // what looks inwards is the wall of a hole
  }
  add_obstacle(mesh, kGap);
  const JoinedLoops joined =
      join_loops(mesh, pieces_of(mesh), grid_of(torus_points(7, false, 0.0)), kPixel);
  REQUIRE(joined.pairs == 0);
  const auto hindered = std::count(joined.is_hindered.begin(), joined.is_hindered.end(), 1);
  CHECK((hindered > 0) == is_hole);
}

TEST_CASE("a gap with points of the cloud on neither side of its middle stays") {
  const double gap = 2.8 * kSide;
  TriangleMesh mesh = cut_torus(gap);
  const TriangleMesh before = mesh;
  REQUIRE(join_loops(mesh, pieces_of(mesh), grid_of(torus_points(4, true, gap)), kSide).pairs == 0);
  REQUIRE(mesh == before);
}

TEST_CASE("holes beside each other in one sheet are not joined, whatever points lie between them") {
  TriangleMesh mesh = cut_torus(0.0);
  const std::vector<Vec3> cloud = torus_points(5, false, 0.0);
  const double distance = 3.5 * kSide;
  std::erase_if(mesh.triangles, [&](const Triangle& t) {
    const Vec3& p = mesh.positions[t[0]];
    const Vec3 top(0.0, kAxisRadius, kTubeRadius), beside = top + Vec3(distance, 0.0, 0.0);
    return std::min(glm::length(p - top), glm::length(p - beside)) < 1.3 * kSide;
  });
  remove_unused_vertices(mesh);
  REQUIRE(report_mesh(mesh).boundary_loops == 2);
  const TriangleMesh before = mesh;
  REQUIRE(join_loops(mesh, pieces_of(mesh), grid_of(cloud), kSide).pairs == 0);
  REQUIRE(mesh == before);
}

TEST_CASE("holes opposite to each other in a thin plate are not joined through it") {
  constexpr int kN = 32;
  TriangleMesh mesh = testing::cube(kN);
  for (Vec3& p : mesh.positions)
    p.z *= 0.03;
  testing::cut_where(mesh, [](const Vec3& p) { return std::hypot(p.x, p.y) < 0.3; });
  const TriangleMesh before = mesh;
  REQUIRE(join_loops(mesh, pieces_of(mesh), PointGrid({}, Box{}, 1.0), 2.0 / kN).pairs == 0);
  REQUIRE(mesh == before);
}

TEST_CASE("holes opposite to each other in the walls of a narrow gap are not joined across it") {
  // Twenty-five pairs; the gap is 2 h wide and the points 0.75 h apart, so that one in a wall is
  // nearly as close to the middle of the gap as 1.3 spacings.
  constexpr int kN = 40;
  constexpr double kHalf = 0.5 * kN, kSpacing = 0.75;
  const auto seed = static_cast<std::uint64_t>(Catch::rngSeed());
  const bool are_gaps_known = GENERATE(true, false);
  CAPTURE(seed, are_gaps_known);
  std::mt19937_64 engine(seed);
  TriangleMesh mesh = testing::cube(kN);
  for (Vec3& p : mesh.positions)
    p *= Vec3(kHalf, kHalf, 1.0);
  testing::cut_where(mesh, [](const Vec3& p) {
    const auto off = [](double t) { return std::abs(t - 7.0 * std::round(t / 7.0)); };
    return std::max(std::abs(p.x), std::abs(p.y)) < 17.0 && std::hypot(off(p.x), off(p.y)) < 1.2;
  });
  for (Triangle& t : mesh.triangles)  // the air is inside
    std::swap(t[1], t[2]);
  std::vector<Vec3> points;
  for (double i = 0.0; i < 2.0 * kN * kN / (kSpacing * kSpacing); i += 1.0) {
    points.push_back({uniform(engine, -kHalf, kHalf), uniform(engine, -kHalf, kHalf),
                      engine() % 2 == 0 ? -1.0 : 1.0});
  }
  REQUIRE(report_mesh(mesh).boundary_loops == 50);
  const PointGrid cloud(points, {Vec3(-kHalf - 2.0), Vec3(kHalf + 2.0)}, 0.7);
  CHECK(join_loops(mesh, pieces_of(mesh), cloud, 1.0, are_gaps_known).pairs == 0);
}

}  // namespace
}  // namespace rangezip

#include "core/finish/bridge_loops.h"

#include <algorithm>
#include <catch2/catch.hpp>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <random>
#include <utility>
#include <vector>

#include "core/finish/finish.h"
#include "core/mesh/mesh_report.h"
#include "core/mesh/self_intersection.h"
#include "tests/core/finish/shapes.h"
#include "tests/support/shapes.h"

namespace rangezip {
namespace {

/// Two square sheets of n x n pixels side by side along x, their rims `gap` apart and the second
/// one so much higher; turned over, it looks down.
TriangleMesh two_sheets(std::uint32_t n, double gap, double height, bool is_turned) {
  TriangleMesh mesh = shapes::square_sheet(n);
  const auto count = static_cast<std::uint32_t>(mesh.positions.size());
  const std::vector<Triangle> faces = mesh.triangles;
  for (std::uint32_t v = 0; v < count; ++v)
    mesh.positions.push_back(mesh.positions[v] + Vec3(n + gap, 0.0, height));
  for (const auto& [a, b, c] : faces) {
    mesh.triangles.push_back(is_turned ? Triangle{count + a, count + c, count + b}
                                       : Triangle{count + a, count + b, count + c});
  }
  return mesh;
}

/// Points of the plane z = 0 around two sheets of n x n.
std::vector<Vec3> plane_points(std::uint32_t n) {
  const double half = 0.5 * n;
  std::vector<Vec3> points;
  for (double x = -half; x <= 2.0 * n + half; x += 0.25) {
    for (double y = -half; y <= half; y += 0.25)
      points.emplace_back(x, y, 0.0);
  }
  return points;
}

TEST_CASE(
    "a crack that opens into the borders of two sheets becomes a loop by a bridge at each end",
    "[finish]") {
  constexpr std::uint32_t kSquares = 40;
  TriangleMesh mesh = two_sheets(kSquares, 2.0, 0.0, false);
  const PointGrid cloud(plane_points(kSquares), Box{Vec3(-100.0), Vec3(200.0)}, 0.7);
  CHECK(bridge_runs(mesh, pieces_of(mesh), cloud, 1.0) == 2);
  const MeshReport report = report_mesh(mesh);
  CHECK(report.is_manifold());
  CHECK(report.components == 1);
  CHECK(report.boundary_loops == 2);
  CHECK(report.euler == 0);  // a sheet with a hole, not with a handle
}

/// A tube bent to an arc of a ring in the plane z = 0, 80 across, from one angle to another one.
TriangleMesh bent_tube(double from, double to) {
  constexpr double kRing = 40.0, kTube = 6.0, kTurn = 2.0 * 3.14159265358979323846;
  constexpr std::uint32_t kAlong = 24, kAround = 36;
  TriangleMesh mesh;
  for (std::uint32_t i = 0; i <= kAlong; ++i) {
    const double along = from + (to - from) * i / kAlong;
    for (std::uint32_t k = 0; k < kAround; ++k) {
      const double around = kTurn * k / kAround, radius = kRing + kTube * std::cos(around);
      mesh.positions.emplace_back(radius * std::cos(along), radius * std::sin(along),
                                  kTube * std::sin(around));
      if (i == 0) continue;
      const std::uint32_t q = i * kAround + k, next_q = i * kAround + (k + 1) % kAround;
      mesh.triangles.push_back({q - kAround, q, next_q});
      mesh.triangles.push_back({q - kAround, next_q, next_q - kAround});
    }
  }
  return mesh;
}

/// The numbers below a count in a random order.
std::vector<std::size_t> shuffled(std::size_t count, std::mt19937_64& engine) {
  std::vector<std::size_t> numbers;
  for (std::size_t i = 0; i < count; ++i) {
    numbers.push_back(i);
    std::swap(numbers[i], numbers[engine() % (i + 1)]);
  }
  return numbers;
}

TEST_CASE("tubes around a ring are bridged over all narrow gaps but one that would close the ring",
          "[finish]") {
  const auto seed = static_cast<std::uint64_t>(Catch::rngSeed());
  const std::size_t wide = GENERATE(0U, 1U, 3U);
  CAPTURE(seed, wide);
  constexpr std::size_t kTubes = 8;
  constexpr double kStep = 2.0 * 3.14159265358979323846 / kTubes, kNarrow = 1.5 / 40.0,
                   kWide = 8.0 / 40.0;
  std::mt19937_64 engine(seed);
  std::vector<double> gaps(kTubes, kNarrow);  // each behind its tube
  const std::vector<std::size_t> places = shuffled(kTubes, engine);
  for (std::size_t i = 0; i < wide; ++i)
    gaps[places[i]] = kWide;
  TriangleMesh mesh;
  for (const std::size_t i : shuffled(kTubes, engine)) {
    const double begin = kStep * static_cast<double>(i);
    testing::append(mesh, bent_tube(begin, begin + kStep - gaps[i]));
  }
  REQUIRE(testing::volume_of(mesh) > 0.0);
  const std::size_t bridges = kTubes - std::max<std::size_t>(wide, 1);
  CHECK(bridge_loops(mesh, pieces_of(mesh), PointGrid({}, Box{}, 1.0), 1.0) == bridges);
  const MeshReport report = report_mesh(mesh);
  CHECK(report.is_manifold());
  CHECK(report.components == kTubes - bridges);
  CHECK(report.boundary_loops == 2 * kTubes - bridges);
}

TEST_CASE("sheets seen from opposite sides, one over the rim of the other, become one",
          "[finish]") {
  constexpr std::uint32_t kSquares = 40;
  const TriangleMesh mesh = two_sheets(kSquares, -0.5, 0.1, true);
  FinishOptions options;
  options.method = GENERATE(FinishMethod::fast, FinishMethod::full);
  options.pixel_size = 1.0;
  const FinishResult result = finish(mesh, {plane_points(kSquares)}, options);
  REQUIRE_NOTHROW(check_mesh(result.mesh));
  REQUIRE(self_intersections(result.mesh).empty());
  CHECK(result.report.turned_pieces == 1);
  const MeshReport report = report_mesh(result.mesh);
  REQUIRE(report.is_manifold());
  REQUIRE(report.degenerate_faces == 0);
  REQUIRE(report.vertices == result.mesh.positions.size());
  CHECK(report.components == 1);
  CHECK(report.boundary_loops == 1);
  CHECK(report.euler == 1);
}

TEST_CASE("two bodies side by side are not bridged where the cloud shows air between them") {
  // Two squares, 2.5 pixels apart, with points on both and none between.
  constexpr double kGap = 2.5;
  TriangleMesh mesh = two_sheets(12, kGap, 0.0, false);
  std::vector<Vec3> points = plane_points(12);
  const Box region{Vec3(-8.0), Vec3(24.0)};
  TriangleMesh joined = mesh;
  CHECK(bridge_loops(joined, pieces_of(joined), PointGrid(points, region, 0.7), 1.0) == 1);
  std::erase_if(points, [&](const Vec3& p) { return p.x > 6.0 && p.x < 6.0 + kGap; });
  CHECK(bridge_loops(mesh, pieces_of(mesh), PointGrid(points, region, 0.7), 1.0) == 0);
}

TEST_CASE("beside narrow gaps points on one side of a crack show no surface in it", "[finish]") {
  constexpr double kGap = 1.4;
  TriangleMesh mesh = two_sheets(12, kGap, 0.0, false);
  const std::vector<Vec3> both = plane_points(12);
  std::vector<Vec3> one_side = both;
  std::erase_if(one_side, [](const Vec3& p) { return p.x > 6.0; });
  const Box region{Vec3(-8.0), Vec3(24.0)};
  const auto bridges = [&](const std::vector<Vec3>& points, bool has_narrow_gaps) {
    TriangleMesh joined = mesh;
    return bridge_loops(joined, pieces_of(joined), PointGrid(points, region, 0.7), 1.0,
                        has_narrow_gaps);
  };
  CHECK(bridges(one_side, false) == 1);
  CHECK(bridges(one_side, true) == 0);
  CHECK(bridges(both, true) == 1);
}

TEST_CASE("two walls that face each other two pixels apart are not bridged", "[finish]") {
  // Each has a hole, opposite to the other; points are sparse, and half the gap is 1.35 spacings.
  constexpr double kGap = 2.0, kSpacing = 0.75;
  const auto seed = static_cast<std::uint64_t>(Catch::rngSeed());
  CAPTURE(seed);
  std::mt19937_64 engine(seed);
  TriangleMesh mesh = shapes::square_sheet(24);
  testing::cut_where(mesh, [](const Vec3& p) { return std::hypot(p.x, p.y) < 6.0; });
  const auto count = static_cast<std::uint32_t>(mesh.positions.size());
  const std::vector<Triangle> faces = mesh.triangles;
  for (std::uint32_t v = 0; v < count; ++v)
    mesh.positions.push_back(mesh.positions[v] + Vec3(0.0, 0.0, kGap));
  for (const auto& [a, b, c] : faces)
    mesh.triangles.push_back({count + a, count + c, count + b});
  std::vector<Vec3> points;
  for (double i = 0.0; i < 2.0 * 24.0 * 24.0 / (kSpacing * kSpacing); i += 1.0) {
    points.push_back({testing::uniform(engine, -12.0, 12.0), testing::uniform(engine, -12.0, 12.0),
                      engine() % 2 == 0 ? 0.0 : kGap});
  }
  CHECK(bridge_loops(mesh, pieces_of(mesh), PointGrid(points, Box{Vec3(-14.0), Vec3(14.0)}, 0.7),
                     1.0) == 0);
}

TEST_CASE("two sheets of a blade are joined where one reaches farther out, and of a gap not",
          "[finish]") {
  // A double cone with a rim of 25 degrees, whose upper sheet ends two pixels before the rim.
  constexpr double kRadius = 20.0, kSlope = 0.2217;
  const TriangleSoup blade = shapes::double_cone(kRadius, kSlope, 0.0, 110);
  const auto points = shapes::to_points(shapes::sampled(blade, 12'000, 3));
  const PointGrid cloud(points, Box{Vec3(-22.0), Vec3(22.0)}, 0.7);
  TriangleMesh mesh = shapes::to_mesh(blade);
  testing::cut_where(
      mesh, [](const Vec3& p) { return p.z > 0.0 && std::hypot(p.x, p.y) > kRadius - 1.5; });
  REQUIRE(pieces_of(mesh).loops.size() == 2);
  TriangleMesh gap = mesh;
  for (Triangle& t : gap.triangles)
    std::swap(t[1], t[2]);
  CHECK(bridge_loops(mesh, pieces_of(mesh), cloud, 1.0) == 1);
  CHECK(bridge_loops(gap, pieces_of(gap), cloud, 1.0) == 0);
}

/// A ring, 12 across at the top where its hole is narrowest: a closed profile turned around z.
/// Rows of squares follow each other from the edge of the hole over the top, down outside, and back
/// along the wall of the hole.
/// @param without this row
TriangleMesh ring_with_sharp_hole(std::size_t without) {
  const std::vector<Vec3> corners{{10, 0, 0}, {16, 0, 0}, {16, 0, -6}, {14, 0, -6}, {10, 0, 0}};
  std::vector<Vec3> profile;
  for (std::size_t k = 0; k + 1 < corners.size(); ++k) {
    const auto n = static_cast<int>(std::ceil(glm::distance(corners[k], corners[k + 1])));
    for (int i = 0; i < n; ++i)
      profile.push_back(glm::mix(corners[k], corners[k + 1], static_cast<double>(i) / n));
  }
  constexpr std::uint32_t kAround = 80;
  const auto n = static_cast<std::uint32_t>(profile.size());
  TriangleMesh mesh;
  for (std::uint32_t a = 0; a < kAround; ++a) {
    const double angle = 2.0 * 3.14159265358979323846 * a / kAround;
    for (const Vec3& p : profile)
      mesh.positions.emplace_back(p.x * std::cos(angle), p.x * std::sin(angle), p.z);
    for (std::uint32_t i = 0; i < n; ++i) {
      if (i == without) continue;
      const std::uint32_t p = a * n + i, q = a * n + (i + 1) % n;
      const std::uint32_t next_p = (p + n) % (kAround * n), next_q = (q + n) % (kAround * n);
      mesh.triangles.push_back({p, q, next_q});
      mesh.triangles.push_back({p, next_q, next_p});
    }
  }
  return mesh;
}

TEST_CASE("the two sides of a sharp edge all around a hole are joined, those of a gap are not",
          "[finish]") {
  constexpr std::size_t kFirst = 0, kOutside = 8, kLast = 21;  // beside the edge: first and last
  REQUIRE(report_mesh(ring_with_sharp_hole(100)).euler == 0);
  REQUIRE(testing::volume_of(ring_with_sharp_hole(100)) > 0.0);
  const PointGrid no_points({}, Box{}, 1.0);
  const auto bridges = [&](TriangleMesh mesh) {
    REQUIRE(pieces_of(mesh).loops.size() == 2);
    const std::size_t count = bridge_loops(mesh, pieces_of(mesh), no_points, 1.0);
    CHECK(pieces_of(mesh).loops.size() == 2 - count);
    return count;
  };
  CHECK(bridges(ring_with_sharp_hole(kFirst)) == 1);
  CHECK(bridges(ring_with_sharp_hole(kLast)) == 1);
  CHECK(bridges(ring_with_sharp_hole(kOutside)) == 0);  // between two smooth sheets
  TriangleMesh turned = ring_with_sharp_hole(kLast);    // the walls of a slit, which is air
  for (Triangle& t : turned.triangles)
    std::swap(t[1], t[2]);
  CHECK(bridges(turned) == 0);
}

}  // namespace
}  // namespace rangezip

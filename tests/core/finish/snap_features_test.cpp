#include "core/finish/snap_features.h"

#include <algorithm>
#include <array>
#include <catch2/catch.hpp>
#include <cmath>
#include <random>

#include "core/finish/fit_window.h"
#include "core/mesh/mesh_report.h"
#include "tests/core/finish/shapes.h"

namespace rangezip {
namespace {

using testing::uniform;

constexpr int kN = 28;
constexpr double kH = 2.0 / kN;

/// The point of the cube [-1, 1]^3 with edges rounded by `radius` that belongs to a point of the
/// sharp one.
Vec3 rounded(const Vec3& p, double radius) {
  const Vec3 core = glm::clamp(p, Vec3(radius - 1.0), Vec3(1.0 - radius));
  return core + radius * glm::normalize(p - core);
}

/// A turn that no axis of a lattice survives: a rational rotation matrix.
Vec3 turned(const Vec3& p) {
  const Mat3 turn(Vec3(2, 3, 6) / 7.0, Vec3(-6, -2, 3) / 7.0, Vec3(3, -6, 2) / 7.0);
  return turn * p;
}
Vec3 turned_back(const Vec3& p) {
  return {glm::dot(p, turned({1, 0, 0})), glm::dot(p, turned({0, 1, 0})),
          glm::dot(p, turned({0, 0, 1}))};
}

/// Points on all sides, 2.2 a pixel each way, with noise.
std::vector<Vec3> cube_points(double radius, double noise, std::uint64_t seed) {
  std::mt19937_64 engine(seed);
  const double spacing = kH / 2.2;
  std::vector<Vec3> points(static_cast<std::size_t>(24.0 / (spacing * spacing)));
  for (Vec3& p : points) {
    p = {uniform(engine, -1, 1), uniform(engine, -1, 1), uniform(engine, -1, 1)};
    p[static_cast<int>(engine() % 3)] = engine() % 2 == 0 ? 1.0 : -1.0;
    if (radius > 0.0) p = rounded(p, radius);
    p = turned(p) +
        noise * Vec3{uniform(engine, -1, 1), uniform(engine, -1, 1), uniform(engine, -1, 1)};
  }
  return points;
}

/// The cube as a scan of it would be: no vertex on an edge, edges rounded off.
TriangleMesh scanned_cube(double radius) {
  TriangleMesh mesh = testing::cube(kN);
  std::mt19937_64 engine(9);
  for (Vec3& p : mesh.positions) {
    p += 0.2 * kH * Vec3{uniform(engine, -1, 1), uniform(engine, -1, 1), uniform(engine, -1, 1)};
    p = turned(rounded(p, std::max(radius, 0.5 * kH)));
  }
  return mesh;
}

SnapOptions options_for(const TriangleMesh& mesh, const PointGrid& cloud) {
  return {kH, choose_fit_window(mesh, cloud, kH)};
}

const Box kRegion{Vec3(-2.5), Vec3(2.5)};

double distance_to_cube(const Vec3& p) {
  const Vec3 q = glm::abs(turned_back(p));
  return std::abs(std::max({q.x, q.y, q.z}) - 1.0);
}

TEST_CASE("snap_features restores the edges and corners of a cube") {
  const PointGrid cloud(cube_points(0.0, 0.0, 1), kRegion, 0.7 * kH);
  TriangleMesh mesh = scanned_cube(0.0);
  const double volume_before = testing::volume_of(mesh);
  REQUIRE(8.0 - volume_before > 0.01);  // the edges rounded off, and chords of the rest
  const SnapReport report = snap_features(mesh, cloud, options_for(mesh, cloud));
  remove_unused_vertices(mesh);
  REQUIRE(report_mesh(mesh).is_manifold());
  REQUIRE(report_mesh(mesh).euler == 2);
  // About one vertex a pixel of edge and more: 24 / h.
  REQUIRE(static_cast<double>(report.snapped_vertices) > 24.0 / kH / 2.0);
  REQUIRE(std::abs(8.0 - testing::volume_of(mesh)) < 0.1 * (8.0 - volume_before));
  std::size_t far = 0;
  for (const Vec3& p : mesh.positions)
    far += distance_to_cube(p) > 0.02 * kH ? 1 : 0;
  REQUIRE(far < mesh.positions.size() / 100);
  for (int corner = 0; corner < 8; ++corner) {
    const Vec3 c = turned(Vec3(corner & 1 ? 1 : -1, corner & 2 ? 1 : -1, corner & 4 ? 1 : -1));
    double nearest = 1e9;
    for (const Vec3& p : mesh.positions)
      nearest = std::min(nearest, glm::length(p - c));
    CAPTURE(corner);
    REQUIRE(nearest < 0.05 * kH);
  }
}

TEST_CASE("edges sharper than a right angle are restored all along", "[finish]") {
  // A cube, sheared so that two of its edges along y have this angle.
  const double degrees = GENERATE(30.0, 45.0, 60.0);
  CAPTURE(degrees);
  const double slope = 1.0 / std::tan(degrees * 3.14159265358979323846 / 180.0);
  const auto sheared = [&](const Vec3& p) {
    const Vec3 q = turned_back(p);
    return turned(Vec3(q.x + slope * q.z, q.y, q.z));
  };
  std::vector<Vec3> points = cube_points(0.0, 0.0, 1);
  for (Vec3& p : points)
    p = sheared(p);
  TriangleMesh mesh = scanned_cube(1.5 * kH);
  for (Vec3& p : mesh.positions)
    p = sheared(p);
  const Box region{Vec3(-5.0), Vec3(5.0)};
  const PointGrid cloud(points, region, 0.7 * kH);
  snap_features(mesh, cloud, options_for(mesh, cloud));
  remove_unused_vertices(mesh);
  REQUIRE(report_mesh(mesh).is_manifold());
  int places = 0, reached = 0;
  for (double y = -0.9; y < 0.9; y += 0.8 * kH) {
    for (const double end : {-1.0, 1.0}) {
      const Vec3 place = turned(Vec3(end * (1.0 + slope), y, end));
      ++places;
      reached += std::any_of(mesh.positions.begin(), mesh.positions.end(), [&](const Vec3& p) {
        const Vec3 d = turned_back(p - place);
        return std::hypot(d.x, d.z) < 0.05 * kH && std::abs(d.y) < 0.8 * kH;
      });
    }
  }
  CHECK(reached >= 0.9 * places);
}

TEST_CASE("vertices that are to stay do, and the edges between them") {
  const PointGrid cloud(cube_points(0.0, 0.0, 1), kRegion, 0.7 * kH);
  const TriangleMesh before = scanned_cube(0.0);
  TriangleMesh mesh = before;
  SnapOptions options = options_for(mesh, cloud);
  const double kept_below = GENERATE(0.0, 5.0);  // half of the cube, and all of it
  CAPTURE(kept_below);
  const auto stays = [&](const Vec3& p) { return turned_back(p).z < kept_below; };
  for (const Vec3& p : before.positions)
    options.is_kept.push_back(stays(p) ? 1 : 0);
  const SnapReport report = snap_features(mesh, cloud, options);
  REQUIRE((report.snapped_vertices == 0) == (kept_below > 1.0));
  for (std::size_t v = 0; v < before.positions.size(); ++v) {
    if (options.is_kept[v] != 0) REQUIRE(mesh.positions[v] == before.positions[v]);
  }
  const auto kept_faces = [&](const TriangleMesh& of) {
    std::vector<Triangle> faces;
    for (const Triangle& t : of.triangles) {
      if (std::all_of(t.begin(), t.end(), [&](std::uint32_t v) {
            return v < options.is_kept.size() && options.is_kept[v] != 0;
          }))
        faces.push_back(t);
    }
    return faces;
  };
  REQUIRE(kept_faces(mesh) == kept_faces(before));
}

TEST_CASE("a little noise does not keep edges from being found") {
  const PointGrid cloud(cube_points(0.0, 0.05 * kH, 2), kRegion, 0.7 * kH);
  TriangleMesh mesh = scanned_cube(0.0);
  const double volume_before = testing::volume_of(mesh);
  snap_features(mesh, cloud, options_for(mesh, cloud));
  REQUIRE(std::abs(8.0 - testing::volume_of(mesh)) < 0.3 * (8.0 - volume_before));
}

TEST_CASE("rounded edges are left alone") {
  const double radius = GENERATE(2.0, 4.0) * kH;
  CAPTURE(radius);
  const PointGrid cloud(cube_points(radius, 0.0, 3), kRegion, 0.7 * kH);
  TriangleMesh mesh = scanned_cube(radius);
  const std::size_t count = mesh.positions.size();
  const SnapReport report = snap_features(mesh, cloud, options_for(mesh, cloud));
  REQUIRE(report.snapped_vertices < count / 100);  // places that look sharp by chance
}

TEST_CASE("vertices where the cloud has a gap beside an edge come back to the side") {
  const double from_edge = GENERATE(0.6, 0.8) * kH;
  const double gap_radius = GENERATE(0.7, 0.9, 1.1, 1.3) * kH;
  CAPTURE(from_edge / kH, gap_radius / kH);
  const Vec3 gap = turned({0.0, 1.0, 1.0 - from_edge});
  std::vector<Vec3> points = cube_points(0.0, 0.0, 5);
  std::erase_if(points, [&](const Vec3& p) { return glm::distance(p, gap) < gap_radius; });
  const PointGrid cloud(points, kRegion, 0.7 * kH);
  TriangleMesh mesh = scanned_cube(0.0);
  int displaced = 0;
  for (Vec3& p : mesh.positions) {
    if (glm::distance(p, gap) >= 0.8 * kH) continue;
    p += turned({0.0, kH, 0.0});
    ++displaced;
  }
  REQUIRE(displaced > 0);
  snap_features(mesh, cloud, options_for(mesh, cloud));
  remove_unused_vertices(mesh);
  for (const Vec3& p : mesh.positions) {
    if (glm::distance(p, gap) > 2.0 * kH) continue;
    REQUIRE(distance_to_cube(p) < 0.2 * kH);
  }
}

/// A drum around the x-axis: a round of flat facets between planes x = +-1.
constexpr int kFacets = 18;
constexpr double kPi = 3.14159265358979323846;
double height_over_drum(const Vec3& p) {
  const double apothem = std::cos(kPi / kFacets);
  double most = std::abs(p.x) - 1.0;
  for (int i = 0; i < kFacets; ++i) {
    const double angle = 2.0 * kPi * i / kFacets;
    most = std::max(most, p.y * std::cos(angle) + p.z * std::sin(angle) - apothem);
  }
  return most;
}
/// Onto the drum, along a ray from the middle.
Vec3 on_drum(const Vec3& direction) {
  double least = 0.0, most = 3.0;
  for (int step = 0; step < 60; ++step) {
    const double middle = 0.5 * (least + most);
    (height_over_drum(middle * direction) < 0.0 ? least : most) = middle;
  }
  return least * direction;
}

TEST_CASE("no vertex leaves the facets of a drum, and its rims get sharp") {
  const double h = GENERATE(0.1, 0.12, 0.13, 0.14, 0.15);
  const int seed = GENERATE(range(0, 8));
  CAPTURE(h, seed);
  std::mt19937_64 engine(static_cast<std::uint64_t>(seed));
  const double spacing = h / 2.2;
  std::vector<Vec3> points(static_cast<std::size_t>(6.0 * kPi / (spacing * spacing)));
  for (Vec3& p : points)
    p = turned(on_drum(testing::direction(engine)));
  const PointGrid cloud(points, kRegion, 0.7 * h);
  TriangleMesh mesh = testing::sphere(static_cast<int>(2.0 / h));
  for (Vec3& p : mesh.positions) {
    // A scan rounds the rims off.
    Vec3 q = on_drum(p);
    q.x = std::clamp(q.x, -1.0 + 0.4 * h, 1.0 - 0.4 * h);
    p = turned(q);
  }
  const SnapReport report = snap_features(mesh, cloud, {h, choose_fit_window(mesh, cloud, h)});
  remove_unused_vertices(mesh);
  REQUIRE(report_mesh(mesh).is_manifold());
  REQUIRE(static_cast<double>(report.snapped_vertices) > 0.8 * 4.0 * kPi / h);  // of two rims
  double highest = -1.0;
  for (const Vec3& p : mesh.positions)
    highest = std::max(highest, height_over_drum(turned_back(p)));
  REQUIRE(highest < 0.25 * h);  // two facets are taken for one side where points are few
}

/// A rib along the y-axis on a floor, so many pixels wide and high; its edges are so far from the
/// middle of its profile, along it.
constexpr double kRib = 2.5;
constexpr std::array kEdgesOfRib{-1.5 * kRib, -0.5 * kRib, 0.5 * kRib, 1.5 * kRib};
constexpr double kEndOfProfile = 4.0 * kRib;
constexpr int kRibLength = 30;
Vec3 on_rib(double along, double y) {
  const double from_edge = std::abs(along) - 0.5 * kRib;
  const double x = 0.5 * kRib + std::min(from_edge, std::max(0.0, from_edge - kRib));
  return turned({std::copysign(x, along), y, kRib - std::clamp(from_edge, 0.0, kRib)});
}
double distance_to_rib(const Vec3& p) {
  const Vec3 q = turned_back(p);
  const double beyond = std::abs(q.x) - 0.5 * kRib;
  const double to_top = std::hypot(std::max(0.0, beyond), q.z - kRib);
  const double to_wall = std::hypot(beyond, q.z - std::clamp(q.z, 0.0, kRib));
  const double to_floor = std::hypot(std::min(0.0, beyond), q.z);
  return std::min({to_top, to_wall, to_floor});
}

/// Rows of vertices along the profile, three on each side of the rib and none on an edge: so all
/// edges are cut off.
TriangleMesh scanned_rib() {
  constexpr int kColumns = 25;
  constexpr double kStep = kRib / 3.0;
  TriangleMesh mesh;
  for (int row = 0; row * kStep <= kRibLength; ++row) {
    for (int column = 0; column < kColumns; ++column)
      mesh.positions.push_back(on_rib((column - kColumns / 2) * kStep, row * kStep));
  }
  for (std::uint32_t v = 0; v + kColumns < mesh.positions.size(); ++v) {
    if (v % kColumns + 1 == kColumns) continue;
    mesh.triangles.push_back({v, v + 1, v + kColumns});
    mesh.triangles.push_back({v + 1, v + kColumns + 1, v + kColumns});
  }
  return mesh;
}

TEST_CASE("edges two and a half pixels apart get sharp") {
  const std::uint64_t seed = GENERATE(1U, 2U, 3U);
  CAPTURE(seed);
  std::mt19937_64 engine(seed);
  std::vector<Vec3> points(static_cast<std::size_t>(2.0 * kEndOfProfile * kRibLength * 2.2 * 2.2));
  for (Vec3& p : points) {
    const double along = uniform(engine, -kEndOfProfile, kEndOfProfile);
    p = on_rib(along, uniform(engine, 0.0, kRibLength));
  }
  const PointGrid cloud(points, Box{Vec3(-40.0), Vec3(40.0)}, 0.7);
  TriangleMesh mesh = scanned_rib();
  snap_features(mesh, cloud, {1.0, {{1.3, 1.0}, 0.0, {}}});
  remove_unused_vertices(mesh);
  REQUIRE(report_mesh(mesh).is_manifold());
  for (const double edge : kEdgesOfRib) {
    const auto is_on_edge = [&](const Vec3& p) {
      const Vec3 to_edge = turned_back(p - on_rib(edge, 0.0));
      return std::hypot(to_edge.x, to_edge.z) < 0.02;
    };
    CAPTURE(edge);
    REQUIRE(std::count_if(mesh.positions.begin(), mesh.positions.end(), is_on_edge) >
            4 * kRibLength / 5);
  }
  for (const Vec3& p : mesh.positions)
    REQUIRE(distance_to_rib(p) < 0.3);
}

TEST_CASE("a sphere has no features, whatever the noise") {
  constexpr double kPixel = 0.06;
  const double noise = GENERATE(0.0, 0.1, 0.3, 0.6) * kPixel;
  CAPTURE(noise);
  std::mt19937_64 engine(4);
  const PointGrid cloud(testing::sphere_points(kPixel / 2.2, noise, engine), kRegion, 0.7 * kPixel);
  TriangleMesh mesh = testing::sphere(24);
  const FitWindow fit = choose_fit_window(mesh, cloud, kPixel);
  const std::size_t count = mesh.positions.size();
  REQUIRE(snap_features(mesh, cloud, {kPixel, fit}).snapped_vertices <= count / 1000);
}

TEST_CASE("without a cloud nothing is snapped") {
  TriangleMesh mesh = testing::cube(8);
  REQUIRE(snap_features(mesh, PointGrid({}, kRegion, 0.1), {0.25, {}}).snapped_vertices == 0);
  REQUIRE(mesh == testing::cube(8));
}

}  // namespace
}  // namespace rangezip

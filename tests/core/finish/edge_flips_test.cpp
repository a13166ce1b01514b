#include "core/finish/edge_flips.h"

#include <catch2/catch.hpp>
#include <cmath>
#include <random>

#include "core/finish/edge_lengths.h"
#include "core/mesh/mesh_report.h"
#include "tests/core/finish/shapes.h"

namespace rangezip {
namespace {

/// A sheet over the unit square, n x n cells, each cut along one diagonal at random; z = height(x,
/// y).
template <class Height>
TriangleMesh sheet(int n, const Height& height, std::uint64_t seed) {
  std::mt19937_64 engine(seed);
  TriangleMesh mesh;
  for (int y = 0; y <= n; ++y) {
    for (int x = 0; x <= n; ++x) {
      const double u = static_cast<double>(x) / n, v = static_cast<double>(y) / n;
      mesh.positions.emplace_back(u, v, height(u, v));
    }
  }
  const auto at = [&](int x, int y) { return static_cast<std::uint32_t>(y * (n + 1) + x); };
  for (int y = 0; y < n; ++y) {
    for (int x = 0; x < n; ++x) {
      const std::uint32_t a = at(x, y), b = at(x + 1, y), c = at(x + 1, y + 1), d = at(x, y + 1);
      if (engine() % 2 == 0) {
        mesh.triangles.push_back({a, b, c});
        mesh.triangles.push_back({a, c, d});
      } else {
        mesh.triangles.push_back({a, b, d});
        mesh.triangles.push_back({b, c, d});
      }
    }
  }
  return mesh;
}

int irregularity(const CornerTable& table) {
  int sum = 0;
  for (std::uint32_t v = 0; v < table.vertex_count(); ++v) {
    if (table.is_boundary(v)) continue;
    int valence = 0;
    table.for_each_neighbor(v, [&](std::uint32_t) { ++valence; });
    sum += (valence - 6) * (valence - 6);
  }
  return sum;
}

TEST_CASE("flip_for_valence makes vertices regular and keeps the surface") {
  const TriangleMesh mesh = sheet(
      20, [](double, double) { return 0.0; }, 1);
  CornerTable table(mesh.triangles, mesh.positions.size());
  const int before = irregularity(table);
  REQUIRE(flip_for_valence(table, mesh.positions) > 0);
  REQUIRE(irregularity(table) < before / 2);
  double area = 0.0;
  for (const Triangle& t : table.triangles())
    area += 0.5 * area_vector(mesh.positions[t[0]], mesh.positions[t[1]], mesh.positions[t[2]]).z;
  REQUIRE(area == Approx(1.0));  // no face is folded over
}

TEST_CASE("flip_for_angles lets no smallest angle shrink") {
  TriangleMesh mesh = sheet(
      20, [](double, double) { return 0.0; }, 2);
  std::mt19937_64 engine(3);
  for (Vec3& p : mesh.positions)
    p += 0.015 * Vec3{testing::uniform(engine, -1, 1), testing::uniform(engine, -1, 1), 0.0};
  const double before = testing::smallest_angle(mesh);
  CornerTable table(mesh.triangles, mesh.positions.size());
  REQUIRE(flip_for_angles(table, mesh.positions) > 0);
  mesh.triangles = table.triangles();
  REQUIRE(testing::smallest_angle(mesh) >= before);
}

TEST_CASE("flip_for_normals brings faces nearer to the normals") {
  // Waves along one diagonal of the cells: the other diagonal lies in their ridges.
  const auto wave = [](double x, double y) { return 0.05 * std::sin(12.0 * (x + y)); };
  const TriangleMesh mesh = sheet(24, wave, 4);
  std::vector<Vec3> normals;
  for (const Vec3& p : mesh.positions) {
    const double slope = 0.6 * std::cos(12.0 * (p.x + p.y));
    normals.push_back(glm::normalize(Vec3(-slope, -slope, 1.0)));
  }
  const auto deviation = [&](const std::vector<Triangle>& triangles) {
    double sum = 0.0;
    for (const Triangle& t : triangles) {
      const Vec3 n = glm::normalize(
          area_vector(mesh.positions[t[0]], mesh.positions[t[1]], mesh.positions[t[2]]));
      for (const std::uint32_t v : t)
        sum += glm::length(n - normals[v]);
    }
    return sum;
  };
  CornerTable table(mesh.triangles, mesh.positions.size());
  const double before = deviation(table.triangles());
  REQUIRE(flip_for_normals(table, mesh.positions, normals) > 0);
  REQUIRE(deviation(table.triangles()) < before);
  SECTION("but not where normals are missing") {
    CornerTable other(mesh.triangles, mesh.positions.size());
    const std::vector<Vec3> none(mesh.positions.size(), Vec3{0.0});
    REQUIRE(flip_for_normals(other, mesh.positions, none) == 0);
  }
}

TEST_CASE("edges are as long everywhere on a sphere, and shorter where more is bent") {
  const TriangleMesh mesh = testing::sphere(16);
  const CornerTable table(mesh.triangles, mesh.positions.size());
  std::vector<SurfaceFit> fits(mesh.positions.size());
  for (SurfaceFit& fit : fits) {
    fit.is_found = true;
    fit.bending = Mat3(-1.0);
  }
  for (const double length : relative_edge_lengths(table, mesh.positions, fits, 0.1))
    REQUIRE(length == Approx(1.0));
  for (std::size_t v = 0; v < fits.size(); ++v)
    fits[v].bending *= mesh.positions[v].z > 0.0 ? 8.0 : 1.0;
  const std::vector<double> lengths = relative_edge_lengths(table, mesh.positions, fits, 0.1);
  double density = 0.0, area = 0.0;
  for (const Triangle& t : mesh.triangles) {
    const double a =
        glm::length(area_vector(mesh.positions[t[0]], mesh.positions[t[1]], mesh.positions[t[2]]));
    area += a;
    for (const std::uint32_t v : t)
      density += a / (3.0 * lengths[v] * lengths[v]);
  }
  REQUIRE(density == Approx(area).epsilon(0.01));  // as many triangles as with length 1
  for (std::size_t v = 0; v < fits.size(); ++v) {
    if (mesh.positions[v].z > 0.7) REQUIRE(lengths[v] < 0.85);
    if (mesh.positions[v].z < -0.7) REQUIRE(lengths[v] > 1.15);
  }
}

}  // namespace
}  // namespace rangezip

#include "core/finish/point_sides.h"

#include <catch2/catch.hpp>
#include <cmath>
#include <random>
#include <vector>

#include "core/finish/surface_fit.h"
#include "tests/core/finish/shapes.h"

namespace rangezip {
namespace {

using testing::uniform;

constexpr double kH = 1.0;
constexpr double kSlope = 0.2217;  // tan 12.5 degrees: a blade of 25 degrees, its edge along y

/// The upper side (sign 1) or the lower (-1), `x` behind the edge.
Vec3 on_blade(double x, double y, double sign) {
  return {x, y, sign * kSlope * x};
}

/// Rows of triangles, facing outwards, on both sides from the edge to x = 12.
TriangleMesh blade() {
  TriangleMesh mesh;
  constexpr int kRows = 13;
  const auto add_side = [&](double sign) {
    const auto base = static_cast<std::uint32_t>(mesh.positions.size());
    for (int y = 0; y < kRows; ++y) {
      for (int x = 0; x < kRows; ++x)
        mesh.positions.push_back(on_blade(x, y, sign));
    }
    for (std::uint32_t y = 0; y + 1 < kRows; ++y) {
      for (std::uint32_t x = 0; x + 1 < kRows; ++x) {
        const std::uint32_t a = base + kRows * y + x, b = a + 1, c = a + kRows, d = c + 1;
        if (sign > 0.0) {
          mesh.triangles.insert(mesh.triangles.end(), {{a, b, d}, {a, d, c}});
        } else {
          mesh.triangles.insert(mesh.triangles.end(), {{b, a, d}, {d, a, c}});
        }
      }
    }
  };
  add_side(1.0);
  add_side(-1.0);
  return mesh;
}

TEST_CASE("next to the edge of a blade, fits to one side are on that side once sides are told") {
  std::mt19937_64 engine(11);
  std::vector<Vec3> points;
  for (int i = 0; i < 4000; ++i) {
    const double x = uniform(engine, 0, 12), y = uniform(engine, 0, 12);
    points.push_back(on_blade(x, y, i % 2 == 0 ? 1 : -1));
  }
  const Box region{Vec3(-2.0, -2.0, -6.0), Vec3(14.0, 14.0, 6.0)};
  PointGrid cloud(points, region, 0.7 * kH);
  const Vec3 normal = glm::normalize(Vec3{-kSlope, 0.0, 1.0});
  const SurfaceWindow window{.radius = 1.5 * kH, .height = 1.2 * kH};
  const auto worst_height = [&] {
    double worst = 0.0;
    for (double y = 2.0; y <= 10.0; y += 0.5) {
      const SurfaceFit fit = fit_surface(cloud, on_blade(0.8, y, 1.0), normal, window);
      REQUIRE(fit.is_found);
      worst = std::max(worst, std::abs(fit.height));
    }
    return worst;
  };
  CHECK(worst_height() > 0.1 * kH);  // both sides at once
  tell_sides(cloud, blade(), kH);
  CHECK(worst_height() < 1e-5 * kH);  // positions are floats
}

TEST_CASE("where a surface faces one way no point has a side") {
  std::mt19937_64 engine(12);
  const TriangleMesh mesh = testing::sphere(40);
  const std::vector<Vec3> points = testing::sphere_points(0.05, 0.0, engine);
  PointGrid cloud(points, {Vec3(-1.5), Vec3(1.5)}, 0.05);
  tell_sides(cloud, mesh, 0.04);
  for (int i = 0; i < 100; ++i) {
    std::size_t count = 0;
    cloud.for_each_counted_near(Vec3(0.0), 1.5, testing::direction(engine),
                                [&](const Vec3&, double) { ++count; });
    REQUIRE(count == points.size());
  }
}

}  // namespace
}  // namespace rangezip

#include "core/finish/sharpen.h"

#include <catch2/catch.hpp>
#include <cmath>
#include <cstdint>
#include <vector>

#include "core/mesh/coverage.h"
#include "core/mesh/mesh_report.h"
#include "core/mesh/self_intersection.h"
#include "tests/support/shapes.h"

namespace rangezip {
namespace {

constexpr double kH = 1.0;
constexpr double kRadius = 20.0;
constexpr double kSlope = 0.2217;  // a rim of 25 degrees
constexpr int kSegments = 110;

TEST_CASE("a blade whose rim is cut off gets an even rim where its sides meet") {
  const std::uint64_t seed = GENERATE(1U, 2U, 3U);
  CAPTURE(seed);
  const TriangleSoup whole = shapes::double_cone(kRadius, kSlope, 0.0, kSegments);
  const auto count = static_cast<std::size_t>(5.0 * shapes::area_of(whole));
  const std::vector<Vec3> points = shapes::to_points(shapes::sampled(whole, count, seed));
  const PointGrid cloud(points, Box{Vec3(-2.0 * kRadius), Vec3(2.0 * kRadius)}, 0.7 * kH);
  TriangleMesh mesh = shapes::to_mesh(shapes::double_cone(kRadius, kSlope, 2.0, kSegments));
  const std::size_t before = points_off(points, mesh, 0.25 * kH).size();
  REQUIRE(before > 1000);

  const SnapOptions snapping{.pixel_size = kH,
                             .fit = choose_fit_window(mesh, cloud, kH),
                             .sizes = {},
                             .edge = 1.1 * kH,
                             .is_kept = {}};
  FinishReport report;
  sharpen(mesh, cloud, snapping, {.pixel_size = kH}, report, {});
  CHECK(report.split_edges + report.rim_moves > kSegments);
  CHECK(points_off(points, mesh, 0.25 * kH).size() < before / 10);
  std::size_t on_rim = 0;
  for (const Vec3& p : mesh.positions) {
    const double across = std::hypot(p.x, p.y);
    CHECK(across < kRadius + 0.1 * kH);
    on_rim += std::abs(across - kRadius) < 0.1 * kH && std::abs(p.z) < 0.05 * kH ? 1 : 0;
  }
  CHECK(on_rim > kSegments / 2);
  CHECK(report_mesh(mesh).is_manifold());
  CHECK(report_mesh(mesh).euler == 2);
  CHECK(self_intersections(mesh).empty());
}

}  // namespace
}  // namespace rangezip

#include <catch2/catch.hpp>
#include <cmath>

#include "core/mask/correspondence.h"
#include "tests/core/stitch/hand_scans.h"
#include "tests/support/scans.h"

/// Whole bodies from many directions: what must hold after every single stitch, and at the end.
using namespace rangezip;
using namespace rangezip::test;

namespace {

/// Scans the scene as an automatic run does and stitches what is better or new.
Scan scan_from(const Scene& scene, const Vec3& direction, double pixel_size,
               const TriangleMesh& mesh) {
  ScanRequest request = scans::plain_request(scene, direction, pixel_size);
  request.quality = QualityMaskOptions{};
  request.clean_mask = CleanMaskOptions{};
  request.triangulate.min_component = 40;
  return scans::run(scene, request, mesh);
}

/// Pixels of the scan that lie on a face of the mesh.
std::size_t covered_pixels(const Scan& scan, const TriangleMesh& mesh) {
  CpuRasterizer rasterizer;
  const Correspondence found =
      find_correspondence(rasterizer, scan.image, scan.slopes, mesh, {.band = 1.5});
  std::size_t covered = 0;
  for (const PrimitiveId face : found.face.pixels())
    covered += face != kNoPrimitive ? 1 : 0;
  return covered;
}

std::vector<Vec3> cube_directions() {
  std::vector<Vec3> directions;
  for (int x = -1; x <= 1; ++x) {
    for (int y = -1; y <= 1; ++y) {
      for (int z = -1; z <= 1; ++z) {
        if (x != 0 || y != 0 || z != 0) directions.emplace_back(x, y, z);
      }
    }
  }
  return directions;
}

Vec3 random_direction(shapes::Random& random) {
  for (;;) {
    const Vec3 d{random.between(-1.0, 1.0), random.between(-1.0, 1.0), random.between(-1.0, 1.0)};
    const double square = glm::dot(d, d);
    if (square > 0.01 && square < 1.0) return d;
  }
}

StitchMethod any_method() {
  return GENERATE(StitchMethod::clear_and_fill, StitchMethod::zipper);
}

}  // namespace

TEST_CASE("26 views of a body give one surface of its genus with small holes at most", "[stitch]") {
  const StitchMethod method = any_method();
  struct Body {
    TriangleSoup soup;
    std::ptrdiff_t euler;
  };
  const Body body = GENERATE(Body{shapes::sphere(), 2}, Body{shapes::torus(), 0});
  const Scene scene = scans::scene_of(body.soup);
  const double pixel = 0.04;
  TriangleMesh mesh;
  for (const Vec3& direction : cube_directions()) {
    const Scan scan = scan_from(scene, direction, pixel, mesh);
    mesh = stitch(std::move(mesh), scan, {.method = method}).mesh;
    check_mesh(mesh);
  }
  const MeshReport report = report_mesh(mesh);
  CHECK(report.components == 1);
  CHECK(report.euler == body.euler - static_cast<std::ptrdiff_t>(report.boundary_loops));
  CHECK(report.longest_loop < 10.0 * pixel);
  // A chord of length e sags by e^2 / 8 of the curvature: a mesh of edges up to 1.5 sqrt(2)
  // pixels has less area than the body by no more than a part in 1 / (1.5 sqrt(2) pixel / 0.4)^2.
  const double truth = shapes::area_of(body.soup);
  CHECK(area_of(mesh) > 0.97 * truth);
  CHECK(area_of(mesh) < 1.01 * truth);
}

TEST_CASE("a hundred random views leave a manifold mesh that covers what it did", "[stitch]") {
  const StitchMethod method = any_method();
  const Scene scene = scans::scene_of(shapes::torus());
  const double pixel = 0.05;
  shapes::Random random(7);
  TriangleMesh mesh;
  std::size_t lost = 0;
  std::size_t seen = 0;
  for (int view = 0; view < 100; ++view) {
    CAPTURE(view);
    const Scan scan = scan_from(scene, random_direction(random), pixel, mesh);
    const std::size_t before = covered_pixels(scan, mesh);
    mesh = stitch(std::move(mesh), scan, {.method = method}).mesh;
    REQUIRE_NOTHROW(check_mesh(mesh));
    const std::size_t after = covered_pixels(scan, mesh);
    lost += after < before ? before - after : 0;
    seen += before;
    CHECK(report_mesh(mesh).components == 1);
  }
  CAPTURE(lost, seen);
  CHECK(lost * 2000 <= seen);
}

TEST_CASE("a seam between two views has next to no slivers", "[stitch]") {
  const Scene scene = scans::scene_of(shapes::sphere(1.0, 128));
  for (const double angle : {0.4, 0.8, 1.2, 1.5}) {
    CAPTURE(angle);
    TriangleMesh mesh;
    for (const Vec3& direction : {Vec3{0, 0, 1}, Vec3{std::sin(angle), 0.1, std::cos(angle)}}) {
      const Scan scan = scan_from(scene, direction, 0.015, mesh);
      mesh = stitch(std::move(mesh), scan, {}).mesh;
    }
    check_mesh(mesh);
    CHECK(sliver_share(mesh) < 0.001);
  }
}

TEST_CASE("a perspective scan is stitched as a parallel one is", "[stitch]") {
  const StitchMethod method = any_method();
  const Scene scene = scans::scene_of(shapes::sphere());
  const Scan first = scan_from(scene, {0, 0, 1}, 0.03, {});
  TriangleMesh mesh = stitch({}, first, {.method = method}).mesh;
  ScanRequest request = scans::plain_request(scene, {1, 0, 1}, 0.03);
  request.camera = fit_depth_planes(
      look_at({2.0, 0.3, 2.0}, {0, 0, 0}, {0, 1, 0}, Perspective{.fov_y = 0.9}), scene.bounds());
  request.extent = {100, 100};
  request.quality = QualityMaskOptions{};
  const Scan second = scans::run(scene, request, mesh);
  REQUIRE(second.patch.mesh.triangles.size() > 1000);
  mesh = stitch(std::move(mesh), second, {.method = method}).mesh;
  check_mesh(mesh);
  const MeshReport report = report_mesh(mesh);
  CHECK(report.components == 1);
  CHECK(report.euler == 2 - static_cast<std::ptrdiff_t>(report.boundary_loops));
}

#include "core/scan/scan.h"

#include <catch2/catch.hpp>

#include "core/base/error.h"
#include "core/base/parallel.h"
#include "core/mesh/mesh_report.h"
#include "tests/support/images.h"
#include "tests/support/scans.h"

namespace rangezip {
namespace {

/// The square [-1, 1]^2 at z = slope . (x, y).
TriangleSoup tilted_square(const glm::dvec2& slope) {
  TriangleSoup soup;
  for (const glm::dvec2 p :
       {glm::dvec2{-1, -1}, glm::dvec2{1, -1}, glm::dvec2{1, 1}, glm::dvec2{-1, 1}}) {
    soup.positions.emplace_back(p.x, p.y, glm::dot(slope, p));
  }
  shapes::add_quad(soup, 0, 1, 2, 3);
  return soup;
}

void check_patch(const Scan& scan) {
  CHECK_NOTHROW(check_mesh(scan.patch.mesh));
  REQUIRE(scan.patch.pixels.size() == scan.patch.mesh.positions.size());
  REQUIRE(scan.patch.mesh.sources.size() == scan.patch.mesh.positions.size());
  CHECK(scan.report.patch_faces == scan.patch.mesh.triangles.size());
  CHECK(scan.report.active == images::count_of(scan.active));
  CHECK(scan.report.samples == images::sample_count(scan.image));
}

TEST_CASE("a scanned plane is that plane, wherever it lies", "[scan]") {
  const glm::dvec2 slope{0.25, -0.5};
  const double size = 0.03125;
  for (const Vec3 place : {Vec3{0, 0, 0}, Vec3{636763, 851298, 415}}) {
    CAPTURE(place.x);
    const Scene scene = scans::scene_of(tilted_square(slope), shapes::translation(place));
    const Scan scanned = scans::run(scene, scans::plain_request(scene, {0, 0, 1}, size));
    check_patch(scanned);
    const MeshReport report = report_mesh(scanned.patch.mesh);
    CHECK(report.euler == 1);
    CHECK(report.components == 1);
    for (const Vec3& world : scanned.patch.mesh.positions) {
      const Vec3 p = world - place;
      // World coordinates of 2^20 round by 2^-33 and pass some ten operations.
      REQUIRE(std::abs(p.z - glm::dot(slope, glm::dvec2(p))) < 1e-8);
    }
    // 64 x 64 pixel centres lie on the square, give or take the row on its border.
    CHECK(std::abs(static_cast<double>(report.vertices) - 64.0 * 64.0) <= 2.0 * 64.0 + 1.0);
  }
}

TEST_CASE("a scanned cloud on a sphere is a cap of that sphere", "[scan]") {
  PointCloud cloud;
  shapes::Random random(4);
  for (int i = 0; i < 120'000; ++i)
    cloud.positions.emplace_back(random.direction());
  const Scene scene = scans::scene_of(std::move(cloud));
  const double size = 0.02;
  for (const Vec3 direction : {Vec3{0, 0, 1}, Vec3{1, -2, 0.5}}) {
    const Scan scanned = scans::run(scene, scans::cloud_request(scene, direction, size));
    check_patch(scanned);
    const MeshReport report = report_mesh(scanned.patch.mesh);
    CHECK(report.components == 1);
    const Vec3 toward = glm::normalize(direction);
    double error = 0.0;
    std::size_t count = 0;
    for (const Vec3& p : scanned.patch.mesh.positions) {
      if (glm::dot(p, toward) < 0.7) continue;
      error += std::abs(glm::length(p) - 1.0);
      ++count;
    }
    // Seven eighths of a disc of radius sqrt(1 - 0.7^2) = 0.714 at least.
    CHECK(count > 3500);
    // A plane over a tent on a sphere is off by h / 6 R of a pixel, here 0.003; the points are few
    // (some six a pixel), so the spread is larger. The nearest point alone is off by 0.25.
    CHECK(error / static_cast<double>(count) < 0.02 * size);
    for (const Triangle& t : scanned.patch.mesh.triangles) {
      const auto& p = scanned.patch.mesh.positions;
      REQUIRE(glm::dot(area_vector(p[t[0]], p[t[1]], p[t[2]]), toward) > 0.0);
    }
  }
}

TEST_CASE("a central projection scans the same sphere", "[scan]") {
  const Scene scene = scans::scene_of(shapes::sphere(1.0, 200));
  ScanRequest request = scans::plain_request(scene, {0, 0, 1}, 0.02);
  request.camera = fit_depth_planes(
      look_at({1, 2, 3}, {0, 0, 0}, {0, 1, 0}, Perspective{.fov_y = 0.6}), scene.bounds());
  request.extent = {180, 160};
  const Scan scanned = scans::run(scene, request);
  check_patch(scanned);
  CHECK(scanned.patch.mesh.positions.size() > 8000);
  for (const Vec3& p : scanned.patch.mesh.positions) {
    // Facets of a sphere of 200 rings are inside by at most 1 - cos(pi / 200) twice over.
    REQUIRE(glm::length(p) < 1.0 + 1e-6);
    REQUIRE(glm::length(p) > 1.0 - 3e-4);
  }
}

TEST_CASE("the same view does not replace what it saw before as larger triangles", "[scan]") {
  const Scene scene = scans::scene_of(shapes::sphere(1.0, 100));
  ScanRequest request = scans::plain_request(scene, {1, 2, 3}, 0.005);
  request.quality = QualityMaskOptions{};
  const Scan full = scans::run(scene, request);
  request.decimate = DecimateOptions{.tolerance = 0.1};
  const Scan first = scans::run(scene, request);
  check_patch(first);
  CHECK(first.patch.cells == full.patch.cells);
  CHECK(first.report.patch_faces < full.report.patch_faces / 2);
  CHECK(scans::run(scene, request, first.patch.mesh).report.active < first.report.active / 50);
  TriangleMesh forgetful = first.patch.mesh;
  forgetful.sources.clear();
  CHECK(scans::run(scene, request, forgetful).report.active > first.report.active / 5);
}

TEST_CASE("the same view twice replaces nothing", "[scan]") {
  const Scene scene = scans::scene_of(shapes::sphere(1.0, 100));
  ScanRequest request = scans::plain_request(scene, {1, 2, 3}, 0.02);
  request.quality = QualityMaskOptions{};
  request.clean_mask = {.erosions = 1, .dilations = 2};
  const Scan first = scans::run(scene, request);
  CHECK(first.report.matched == 0);
  CHECK(first.patch.mesh.triangles.size() > 10'000);
  const Scan second = scans::run(scene, request, first.patch.mesh);
  check_patch(second);
  // All but the samples at the outline, which the first patch could not hold either.
  CHECK(20 * second.report.matched > 19 * first.report.active);
  CHECK(second.report.patch_faces < first.report.patch_faces / 50);
}

TEST_CASE("a finer scan replaces, a coarser one does not", "[scan]") {
  const Scene scene = scans::scene_of(tilted_square({0, 0}));
  ScanRequest coarse = scans::plain_request(scene, {0, 0, 1}, 0.1);
  ScanRequest fine = scans::plain_request(scene, {0, 0, 1}, 0.04);
  coarse.quality = fine.quality = QualityMaskOptions{};
  const TriangleMesh coarse_mesh = scans::run(scene, coarse).patch.mesh;
  const TriangleMesh fine_mesh = scans::run(scene, fine).patch.mesh;
  CHECK(scans::run(scene, fine, coarse_mesh).patch.mesh.triangles == fine_mesh.triangles);
  const Scan rejected = scans::run(scene, coarse, fine_mesh);
  CHECK(rejected.report.patch_faces == 0);
  CHECK(rejected.report.active == 0);
}

TEST_CASE("the region of interest bounds the patch, dilated or not", "[scan]") {
  const Scene scene = scans::scene_of(tilted_square({0, 0}));
  ScanRequest request = scans::plain_request(scene, {0, 0, 1}, 0.04);
  request.region = {{10.25, 12.25}, {40.75, 12.25}, {25.5, 44.0}};
  for (const CleanMaskOptions clean :
       {CleanMaskOptions{.erosions = 0, .dilations = 0}, CleanMaskOptions{1, 2}}) {
    request.clean_mask = clean;
    const Scan scanned = scans::run(scene, request);
    const Mask lasso = mask_from_lasso(request.extent, request.region);
    CHECK(scanned.patch.pixels.size() > 400);
    for (const Pixel p : scanned.patch.pixels)
      REQUIRE(lasso[p] == 1);
  }
}

TEST_CASE("a fill view adds only what the mesh does not have", "[scan]") {
  const Scene scene = scans::scene_of(tilted_square({0, 0}));
  ScanRequest request = scans::plain_request(scene, {0, 0, 1}, 0.04);
  const double middle = 0.5 * request.extent.width;
  request.region = {{0, 0}, {middle, 0}, {middle, 100}, {0, 100}};
  const TriangleMesh left = scans::run(scene, request).patch.mesh;
  const Box known = bounds_of(left);

  ScanRequest fill = scans::plain_request(scene, {0, 0, 1}, 0.043);
  fill.unmatched_only = true;
  const Scan filled = scans::run(scene, fill, left);
  check_patch(filled);
  CHECK(filled.patch.mesh.positions.size() > 1000);
  for (const Vec3& p : filled.patch.mesh.positions) {
    const double snap = 0.043 / 256.0;  // of the drawn corners of `left`
    const bool is_inside = p.x > known.lower.x + snap && p.x < known.upper.x - snap &&
                           p.y > known.lower.y + snap && p.y < known.upper.y - snap;
    REQUIRE_FALSE(is_inside);
  }
}

TEST_CASE("the inside of a known sheet is not scanned again", "[scan]") {
  const Scene scene = scans::scene_of(tilted_square({0, 0}));
  const TriangleMesh front =
      scans::run(scene, scans::plain_request(scene, {0, 0, 1}, 0.04)).patch.mesh;
  const Scan behind = scans::run(scene, scans::plain_request(scene, {0, 0, -1}, 0.04), front);
  CHECK(images::count_of(behind.correspondence.from_behind) > 2000);
  CHECK(behind.report.patch_faces < 20);
}

TEST_CASE("votes take the samples that show an inside", "[scan]") {
  const Scene scene = scans::scene_of(shapes::sampled(tilted_square({0, 0}), 20'000));
  const ScanRequest request = scans::cloud_request(scene, {0, 0, 1}, 0.04);
  const std::vector<std::int8_t> away(20'000, -5);
  const Scan inside = scans::run(scene, request, {}, away);
  CHECK(inside.report.inside > 2000);
  CHECK(inside.report.patch_faces == 0);
  const std::vector<std::int8_t> toward(20'000, 5);
  CHECK(scans::run(scene, request, {}, toward).report.inside == 0);
}

TEST_CASE("vertices know the point that won their pixel", "[scan]") {
  const PointCloud cloud = shapes::sampled(tilted_square({0.2, 0.1}), 9'000);
  const Scene scene = scans::scene_of(cloud);
  const Scan scanned = scans::run(scene, scans::cloud_request(scene, {0, 0, 1}, 0.04));
  check_patch(scanned);
  std::size_t made = 0;
  for (std::size_t v = 0; v < scanned.patch.pixels.size(); ++v) {
    const Vec3& p = scanned.patch.mesh.positions[v];
    const VertexSource source = scanned.patch.mesh.sources[v];
    CHECK(source.view == VertexSource::kNoView);
    if (source.primitive == kNoPrimitive) {
      ++made;
      REQUIRE(scanned.filled[scanned.patch.pixels[v]] == 1);
      continue;
    }
    const Vec3f& point = cloud.positions[source.primitive];
    REQUIRE(std::abs(p.x - point.x) <= 0.0201);  // half a pixel and a snap of 1/512
    REQUIRE(std::abs(p.y - point.y) <= 0.0201);
  }
  CHECK(made > 0);
  CHECK(made <= scanned.report.filled);
}

TEST_CASE("the passes of the paper run in its order and are counted", "[scan]") {
  // A closed sphere, sparse enough to look through onto its back.
  const Scene scene = scans::scene_of(shapes::sampled(shapes::sphere(1.0, 60), 12'000));
  ScanRequest request = scans::plain_request(scene, {0, 0, 1}, 0.04);
  const Scan raw = scans::run(scene, request);
  request.back_side = BackSideOptions{};
  request.fill_holes = FillHolesOptions{};
  request.median = MedianFilterOptions{};
  request.steep_cells = SteepCellsOptions{.min_cosine = 0.5};
  const Scan clean = scans::run(scene, request);
  check_patch(clean);
  CHECK(clean.report.back_side > 0);
  CHECK(clean.report.filled > 0);
  CHECK(clean.report.steep > 0);
  CHECK(clean.report.samples == raw.report.samples - clean.report.back_side + clean.report.filled);
  for (int y = 0; y < request.extent.height; ++y) {
    for (int x = 0; x < request.extent.width; ++x) {
      if (clean.active[{x, y}] == 1) REQUIRE(clean.image.has_sample({x, y}));
    }
  }
}

TEST_CASE("a scan is the same with one thread and with more", "[scan]") {
  const Scene scene = scans::scene_of(shapes::sampled(shapes::torus(), 60'000));
  ScanRequest request = scans::cloud_request(scene, {1, 2, 3}, 0.02);
  request.quality = QualityMaskOptions{};
  const TriangleMesh mesh =
      scans::run(scene, scans::cloud_request(scene, {2, 1, 3}, 0.02)).patch.mesh;
  const auto scan_with = [&](int threads) {
    Scan result{.image = RangeImage(View(request.camera, request.extent))};
    run_with_threads(threads, [&] { result = scans::run(scene, request, mesh); });
    return result;
  };
  const Scan one = scan_with(1);
  const Scan two = scan_with(2);
  CHECK(one.image == two.image);
  CHECK(one.slopes == two.slopes);
  CHECK(one.active == two.active);
  CHECK(one.patch.mesh == two.patch.mesh);
  CHECK(one.patch.mesh.triangles.size() > 1000);
}

TEST_CASE("a scan reports its progress and can be stopped", "[scan]") {
  const Scene scene = scans::scene_of(tilted_square({0, 0}));
  const ScanRequest request = scans::plain_request(scene, {0, 0, 1}, 0.1);
  CpuRasterizer rasterizer;
  double last = -1.0;
  std::stop_source stop;
  Progress progress{.report =
                        [&](std::string_view, double share) {
                          CHECK(share > last);
                          last = share;
                        },
                    .stop = stop.get_token()};
  CHECK_NOTHROW(scan(rasterizer, scene, {}, request, {}, progress));
  CHECK(last == 1.0);
  progress.report = [&](std::string_view, double share) {
    if (share > 0.4) stop.request_stop();
  };
  CHECK_THROWS_AS(scan(rasterizer, scene, {}, request, {}, progress), Cancelled);
}

TEST_CASE("a scan refuses requests that break a rule of a pass", "[scan]") {
  const Scene scene = scans::scene_of(tilted_square({0, 0}));
  const ScanRequest good = scans::plain_request(scene, {0, 0, 1}, 0.1);
  ScanRequest bad = good;
  bad.region = {{0, 0}, {5, 5}};
  CHECK_THROWS_AS(scans::run(scene, bad), InvalidArgument);
  bad = good;
  bad.median = MedianFilterOptions{.radius = 0};
  CHECK_THROWS_AS(scans::run(scene, bad), InvalidArgument);
  bad = good;
  bad.extent = {0, 0};
  CHECK_THROWS_AS(scans::run(scene, bad), InvalidArgument);
  bad = good;
  bad.clean_mask.erosions = -1;
  CHECK_THROWS_AS(scans::run(scene, bad), InvalidArgument);
}

TEST_CASE("a scan of nothing is empty", "[scan]") {
  const Scene scene = scans::scene_of(tilted_square({0, 0}));
  ScanRequest request = scans::plain_request(scene, {0, 0, 1}, 0.1);
  const Scan nothing = scans::run(Scene{}, request);
  CHECK(nothing.report.samples == 0);
  CHECK(nothing.patch.mesh.empty());
}

}  // namespace
}  // namespace rangezip

// Whole runs on bodies whose right answer is known.
#include "core/reconstruct/reconstruct.h"

#include <catch2/catch.hpp>

#include "core/base/error.h"
#include "core/session/session.h"
#include "raster_cpu/cpu_rasterizer.h"
#include "tests/support/shapes.h"

using namespace rangezip;

namespace {

Scene scene_of(PointCloud cloud, const Mat4& placement = Mat4{1.0}) {
  Scene scene;
  scene.add(std::make_shared<const PointCloud>(std::move(cloud)), placement);
  return scene;
}

Scene scene_of(TriangleSoup soup) {
  Scene scene;
  scene.add(std::make_shared<const TriangleSoup>(std::move(soup)));
  return scene;
}

ReconstructResult run(const Scene& scene, const ReconstructOptions& options = {}) {
  CpuRasterizer rasterizer;
  return reconstruct(scene, rasterizer, options);
}

/// What holds for every result: oriented, manifold, free of self-intersections.
void check_clean(const ReconstructResult& result) {
  CHECK_NOTHROW(check_mesh(result.mesh));
  CHECK(result.report.mesh.is_manifold());
  CHECK(result.report.self_intersections == 0);
}

/// Largest distance of a vertex from the unit sphere.
double distance_from_unit_sphere(const TriangleMesh& mesh) {
  double worst = 0.0;
  for (const Vec3& p : mesh.positions)
    worst = std::max(worst, std::abs(glm::length(p) - 1.0));
  return worst;
}

double signed_volume(const TriangleMesh& mesh) {
  double six_volumes = 0.0;
  for (const Triangle& t : mesh.triangles) {
    six_volumes +=
        glm::dot(mesh.positions[t[0]], glm::cross(mesh.positions[t[1]], mesh.positions[t[2]]));
  }
  return six_volumes / 6.0;
}

constexpr double kPi = std::numbers::pi;

}  // namespace

TEST_CASE("a sampled sphere becomes one closed sphere, outside out", "[reconstruct]") {
  const ReconstructResult result = run(scene_of(shapes::sampled(shapes::sphere(), 30'000)));
  check_clean(result);
  CHECK(result.report.mesh.components == 1);
  CHECK(result.report.mesh.boundary_edges == 0);
  CHECK(result.report.mesh.euler == 2);
  CHECK(result.report.coverage.share > 0.999);
  // No vertex leaves the sheet of its pixel: where random points leave a gap of a pixel, a fit is
  // an extrapolation, but never by more than a pixel side.
  CHECK(distance_from_unit_sphere(result.mesh) < 1.0 * result.report.pixel_size);
  CHECK(signed_volume(result.mesh) == Approx(4.0 / 3.0 * kPi).epsilon(0.01));
}

TEST_CASE("a sampled torus keeps its hole", "[reconstruct]") {
  const ReconstructResult result = run(scene_of(shapes::sampled(shapes::torus(), 40'000)));
  check_clean(result);
  CHECK(result.report.mesh.components == 1);
  CHECK(result.report.mesh.boundary_edges == 0);
  CHECK(result.report.mesh.euler == 0);
  CHECK(signed_volume(result.mesh) == Approx(2.0 * kPi * kPi * 0.16).epsilon(0.01));
}

TEST_CASE("a torus of contours is closed between them and keeps its hole", "[reconstruct]") {
  // Slices 0.06 apart, and 0.22 at most on the surface, where it is level; a point in every 0.01.
  const ReconstructResult result =
      run(scene_of(shapes::sliced_torus(1.0, 0.4, 0.06, 0.01), shapes::tilt()));
  check_clean(result);
  CHECK(result.report.mesh.components == 1);
  CHECK(result.report.mesh.boundary_edges == 0);
  CHECK(result.report.mesh.euler == 0);
  CHECK(signed_volume(result.mesh) == Approx(2.0 * kPi * kPi * 0.16).epsilon(0.01));
}

TEST_CASE("two bodies far apart become two closed components", "[reconstruct]") {
  const ReconstructResult result = run(scene_of(shapes::sampled(shapes::two_spheres(1.0), 40'000)));
  check_clean(result);
  CHECK(result.report.mesh.components == 2);
  CHECK(result.report.mesh.boundary_edges == 0);
  CHECK(result.report.mesh.euler == 4);
}

TEST_CASE("a hilly terrain becomes one open sheet that faces up", "[reconstruct]") {
  PointCloud cloud;
  shapes::Random random(5);
  for (int i = 0; i < 30'000; ++i) {
    const double x = random.between(-1.0, 1.0);
    const double y = random.between(-1.0, 1.0);
    cloud.positions.emplace_back(x, y, 0.15 * std::sin(4.0 * x) * std::cos(3.0 * y));
  }
  const ReconstructResult result = run(scene_of(std::move(cloud)));
  check_clean(result);
  CHECK(result.report.mesh.components == 1);
  CHECK(result.report.mesh.boundary_loops == 1);
  CHECK(result.report.mesh.euler == 1);
  CHECK(result.report.coverage.share > 0.99);
  for (const Triangle& t : result.mesh.triangles) {
    REQUIRE(area_vector(result.mesh.positions[t[0]], result.mesh.positions[t[1]],
                        result.mesh.positions[t[2]])
                .z > 0.0);
  }
}

TEST_CASE("polygons are scanned as they are: a washer stays closed, of genus 1 and exact",
          "[reconstruct]") {
  const ReconstructResult result =
      run(scene_of(shapes::moved(shapes::washer(), shapes::tilt())), {.triangles = 30'000});
  check_clean(result);
  CHECK(result.report.mesh.components == 1);
  CHECK(result.report.mesh.boundary_edges == 0);
  CHECK(result.report.mesh.euler == 0);
  // 96 segments: the polygon's area, not the circle's.
  const double segment = std::sin(2.0 * kPi / 96) * 96 / 2;
  CHECK(signed_volume(result.mesh) == Approx(0.5 * segment * (1.0 - 0.16)).epsilon(0.005));
}

TEST_CASE("the mesh does not depend on the number of threads", "[reconstruct]") {
  const Scene scene = scene_of(shapes::sampled(shapes::torus(), 15'000));
  const ReconstructResult one = run(scene, {.threads = 1});
  const ReconstructResult two = run(scene, {.threads = 2});
  const ReconstructResult five = run(scene, {.threads = 5});
  CHECK(one.mesh == two.mesh);
  CHECK(one.mesh == five.mesh);
}

TEST_CASE("replaying the recorded commands gives the same mesh", "[reconstruct]") {
  const Scene scene = scene_of(shapes::sampled(shapes::sphere(), 10'000));
  const ReconstructResult result = run(scene);
  CpuRasterizer rasterizer;
  Session session(scene);
  for (const Command& command : result.commands)
    session.apply(command, rasterizer);
  CHECK(*session.mesh() == result.mesh);
}

TEST_CASE("a cloud far from the origin gives the moved mesh", "[reconstruct]") {
  const PointCloud cloud = shapes::sampled(shapes::torus(), 15'000);
  const Vec3 offset{636'763.0, 851'298.0, 415.0};
  const ReconstructResult here = run(scene_of(cloud));
  const ReconstructResult there = run(scene_of(cloud, shapes::translation(offset)));
  REQUIRE(here.mesh.triangles == there.mesh.triangles);
  const double size = bounds_of(here.mesh).diagonal();
  for (std::size_t i = 0; i < here.mesh.positions.size(); ++i) {
    REQUIRE(glm::length(here.mesh.positions[i] + offset - there.mesh.positions[i]) < 1e-6 * size);
  }
}

TEST_CASE("the paper's own method closes a sphere as well", "[reconstruct]") {
  const ReconstructResult result = run(scene_of(shapes::sampled(shapes::sphere(), 30'000)),
                                       {.method = ReconstructMethod::paper});
  check_clean(result);
  CHECK(result.report.mesh.components == 1);
  CHECK(result.report.coverage.share > 0.99);
  // The nearest sample of a pixel lies up to a pixel side in front of the surface.
  CHECK(distance_from_unit_sphere(result.mesh) < 1.5 * result.report.pixel_size);
}

TEST_CASE("a target count of triangles sets the resolution", "[reconstruct]") {
  const Scene scene = scene_of(shapes::sampled(shapes::sphere(), 60'000));
  const ReconstructResult coarse = run(scene, {.triangles = 4'000});
  const ReconstructResult fine = run(scene, {.triangles = 12'000});
  CHECK(static_cast<double>(coarse.report.mesh.faces) == Approx(4'000).epsilon(0.25));
  CHECK(static_cast<double>(fine.report.mesh.faces) == Approx(12'000).epsilon(0.25));
}

TEST_CASE("reconstruct refuses what cannot be meshed", "[reconstruct]") {
  CHECK_THROWS_AS(run(Scene{}), InvalidArgument);
  const Scene scene = scene_of(shapes::sampled(shapes::sphere(), 2'000));
  CHECK_THROWS_AS(run(scene, {.pixel_size = 0.0}), InvalidArgument);
  CHECK_THROWS_AS(run(scene, {.triangles = 0}), InvalidArgument);
  CHECK_THROWS_AS(run(scene, {.views = 0}), InvalidArgument);
  CHECK_THROWS_AS(run(scene, {.threads = -1}), InvalidArgument);
  const PointCloud two{.positions = {{0, 0, 0}, {1, 0, 0}, {0, 0, 0}}};
  CHECK_THROWS_AS(run(scene_of(two)), InvalidArgument);
}

TEST_CASE("a run can be cancelled and says how far it is", "[reconstruct]") {
  const Scene scene = scene_of(shapes::sampled(shapes::sphere(), 5'000));
  CpuRasterizer rasterizer;
  std::stop_source source;
  double last = 0.0;
  const Progress progress{.report =
                              [&](std::string_view, double share) {
                                CHECK(share >= last - 1e-12);
                                last = share;
                                if (share > 0.2) source.request_stop();
                              },
                          .stop = source.get_token()};
  CHECK_THROWS_AS(reconstruct(scene, rasterizer, {}, progress), Cancelled);
  CHECK(last < 0.6);
}

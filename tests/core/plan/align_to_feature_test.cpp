#include "core/plan/align_to_feature.h"

#include <algorithm>
#include <catch2/catch.hpp>
#include <cmath>
#include <vector>

#include "core/scan/scan.h"
#include "tests/support/scans.h"
#include "tests/support/shapes.h"

namespace rangezip {
namespace {

/// Two walls that meet in the segment from -end to end: what is seen of a box from
/// over one of its edges.
struct Ridge {
  Vec3 end;
  Vec3 left, right;

  [[nodiscard]] Scene scene() const {
    TriangleSoup walls;
    for (const Vec3& p : {-end, end, end + left, left - end, end + right, right - end})
      walls.positions.emplace_back(p);
    walls.triangles = {{0, 1, 2}, {0, 2, 3}, {1, 0, 5}, {1, 5, 4}};
    return scans::scene_of(walls);
  }
};

Ridge random_ridge(shapes::Random& random, double width) {
  const double angle = random.between(0.0, 3.0);
  const Vec3 along{std::cos(angle), std::sin(angle), random.between(-0.2, 0.2)};
  const Vec3 side = glm::normalize(glm::cross(along, Vec3{0.0, 0.0, 1.0}));
  const Vec3 down{0.0, 0.0, -1.0};
  return {.end = 1.3 * along,
          .left = width * (random.between(0.5, 1.5) * down - side),
          .right = width * (random.between(0.5, 1.5) * down + side)};
}

/// How far the segment is from the line through the centres of a row or column, pixels.
double distance_from_centres(const View& view, const Ridge& ridge) {
  const Vec3 a = view.window_from_world(-0.9 * ridge.end);
  const Vec3 b = view.window_from_world(0.9 * ridge.end);
  const int axis = std::abs(a.x - b.x) < std::abs(a.y - b.y) ? 0 : 1;
  const double centre = std::floor(a[axis]) + 0.5;
  return std::max(std::abs(a[axis] - centre), std::abs(b[axis] - centre));
}

TEST_CASE("after alignment pixel centres lie on the ridge", "[align]") {
  for (std::uint64_t seed = 1; seed <= 30; ++seed) {
    CAPTURE(seed);
    shapes::Random random(seed);
    const Ridge ridge = random_ridge(random, 1.4);
    const Scene scene = ridge.scene();
    ScanRequest request = scans::plain_request(scene, {0.1, -0.2, 1.0}, 0.021);
    if (seed % 3 == 0) {  // as large in a central projection
      request.camera = fit_depth_planes(
          look_at({0.7, -1.2, 8.0}, {0.0, 0.0, -0.5}, {0.0, 1.0, 0.0}, Perspective{.fov_y = 0.7}),
          scene.bounds());
      request.extent = {240, 240};
    }
    const Scan before = scans::run(scene, request);
    const auto aligned = align_to_feature(before.image);
    REQUIRE(aligned.has_value());
    const View view(aligned->camera, aligned->extent);
    REQUIRE(distance_from_centres(view, ridge) < 0.02);
    REQUIRE(view.pixel_size(8.0) == Approx(before.image.view().pixel_size(8.0)).epsilon(1e-12));

    // Nothing of the object is lost, and the ridge has vertices along a row or column.
    request.camera = aligned->camera;
    request.extent = aligned->extent;
    const Scan after = scans::run(scene, request);
    CHECK(static_cast<double>(after.report.samples) ==
          Approx(static_cast<double>(before.report.samples)).epsilon(0.02));
    std::size_t on_ridge = 0;
    for (const Vec3& p : after.patch.mesh.positions) {
      const Vec3 along = ridge.end / glm::dot(ridge.end, ridge.end);
      on_ridge += glm::length(p - glm::dot(p, along) * ridge.end) < 0.002 ? 1 : 0;
    }
    CHECK(on_ridge > 80);
  }
}

/// The 95 % quantile of the angle between faces and the walls that they stand for, degrees.
double normal_error_p95(const TriangleMesh& mesh, const Ridge& ridge) {
  const Vec3 left = glm::normalize(glm::cross(ridge.end, ridge.left));
  const Vec3 right = glm::normalize(glm::cross(ridge.right, ridge.end));
  std::vector<double> errors;
  for (const Triangle& t : mesh.triangles) {
    const Vec3& a = mesh.positions[t[0]];
    const Vec3 normal = glm::normalize(area_vector(a, mesh.positions[t[1]], mesh.positions[t[2]]));
    const Vec3 middle = (a + mesh.positions[t[1]] + mesh.positions[t[2]]) / 3.0;
    const bool is_left = std::abs(glm::dot(middle, left)) < std::abs(glm::dot(middle, right));
    const double cosine = std::clamp(glm::dot(normal, is_left ? left : right), -1.0, 1.0);
    errors.push_back(std::acos(cosine) * 180.0 / std::acos(-1.0));
  }
  const auto rank = static_cast<std::ptrdiff_t>(0.95 * static_cast<double>(errors.size()));
  std::nth_element(errors.begin(), errors.begin() + rank, errors.end());
  return errors[static_cast<std::size_t>(rank)];
}

TEST_CASE("alignment takes the alias artifacts away from a ridge", "[align]") {
  shapes::Random random(7);
  const Ridge ridge = random_ridge(random, 0.5);
  const Scene scene = ridge.scene();
  ScanRequest request = scans::plain_request(scene, {0.1, -0.2, 1.0}, 0.05);
  const Scan before = scans::run(scene, request);
  const auto aligned = align_to_feature(before.image);
  REQUIRE(aligned.has_value());
  request.camera = aligned->camera;
  request.extent = aligned->extent;
  const double error = normal_error_p95(before.patch.mesh, ridge);
  CHECK(error > 3.0);
  CHECK(normal_error_p95(scans::run(scene, request).patch.mesh, ridge) < error / 3.0);
}

TEST_CASE("without a feature there is nothing to align with", "[align]") {
  const Scene scene = scans::scene_of(shapes::sphere(1.0, 60));
  const ScanRequest request = scans::plain_request(scene, {0.1, -0.2, 1.0}, 0.02);
  CHECK_FALSE(align_to_feature(scans::run(scene, request).image).has_value());
}

}  // namespace
}  // namespace rangezip

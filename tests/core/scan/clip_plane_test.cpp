// What only clip planes reach [Kobbelt, Botsch 2000, Fig. 10]: the inside of an open box, the wall
// of a deep concavity, and that of a through hole, each as polygons and as a cloud.
#include <catch2/catch.hpp>

#include "tests/support/images.h"
#include "tests/support/scans.h"

namespace rangezip {
namespace {

constexpr double kPixelSize = 0.02;
const Plane kCutAtMiddle{.normal = {0, -1, 0}, .offset = 0.0};  ///< only y <= 0 stays

/// Looks along -y at the scene, which is cut open or not, and calls check(x, z, y) for each vertex
/// of the patch that lies in the window |x| < half_width, lower < z < upper. Returns their number.
template <class F>
int for_each_vertex(const Scene& scene, bool cut, double half_width, double lower, double upper,
                    const F& check) {
  ScanRequest request = scene.point_count() > 0
                            ? scans::cloud_request(scene, {0, 1, 0}, kPixelSize)
                            : scans::plain_request(scene, {0, 1, 0}, kPixelSize);
  if (cut) request.camera.clip_planes.push_back(kCutAtMiddle);
  const Scan scanned = scans::run(scene, request);
  int count = 0;
  for (const Vec3& p : scanned.patch.mesh.positions) {
    if (std::abs(p.x) >= half_width || p.z <= lower || p.z >= upper) continue;
    check(p.x, p.z, p.y);
    ++count;
  }
  return count;
}

std::vector<Scene> polygons_and_cloud(const TriangleSoup& soup) {
  return {scans::scene_of(soup), scans::scene_of(shapes::sampled(soup, 400'000))};
}

/// Pixels of the window, less a tenth for what the cloud may miss.
int least_count(double width, double height) {
  return static_cast<int>(0.9 * width * height / (kPixelSize * kPixelSize));
}

TEST_CASE("a clip plane opens the view onto the far wall of an open box", "[scan]") {
  TriangleSoup box = shapes::cube();
  // The faces of z = 1, the open top.
  std::erase_if(box.triangles, [&](const Triangle& t) {
    return box.positions[t[0]].z + box.positions[t[1]].z + box.positions[t[2]].z == 3.0F;
  });
  REQUIRE(box.triangles.size() == 10);
  for (const Scene& scene : polygons_and_cloud(box)) {
    CAPTURE(scene.point_count());
    const auto near_wall = [](double, double, double y) { REQUIRE(std::abs(y - 1.0) < 0.005); };
    const auto far_wall = [](double, double, double y) { REQUIRE(std::abs(y + 1.0) < 0.005); };
    CHECK(for_each_vertex(scene, false, 0.9, -0.9, 0.9, near_wall) > least_count(1.8, 1.8));
    CHECK(for_each_vertex(scene, true, 0.9, -0.9, 0.9, far_wall) > least_count(1.8, 1.8));
  }
}

TEST_CASE("a clip plane opens the view onto the wall of a deep concavity", "[scan]") {
  // A pocket of radius 0.3, 1.5 deep.
  for (const Scene& scene : polygons_and_cloud(shapes::pocket(1.5, 0.3))) {
    CAPTURE(scene.point_count());
    const auto outside = [](double x, double, double y) {
      REQUIRE(std::abs(y - std::sqrt(1.0 - x * x)) < 0.01);
    };
    const auto wall = [](double x, double, double y) {
      REQUIRE(std::abs(y + std::sqrt(0.09 - x * x)) < 0.01);
    };
    CHECK(for_each_vertex(scene, false, 0.2, -1.4, -0.1, outside) > least_count(0.4, 1.3));
    CHECK(for_each_vertex(scene, true, 0.2, -1.4, -0.1, wall) > least_count(0.4, 1.3));
  }
}

TEST_CASE("a clip plane opens the view onto the wall of a through hole", "[scan]") {
  // A disc of radius 1 and height 0.5 with a hole of radius 0.4.
  for (const Scene& scene : polygons_and_cloud(shapes::washer(1.0, 0.4, 0.5))) {
    CAPTURE(scene.point_count());
    const auto outside = [](double x, double, double y) {
      REQUIRE(std::abs(y - std::sqrt(1.0 - x * x)) < 0.01);
    };
    const auto wall = [](double x, double, double y) {
      REQUIRE(std::abs(y + std::sqrt(0.16 - x * x)) < 0.01);
    };
    CHECK(for_each_vertex(scene, false, 0.3, 0.05, 0.45, outside) > least_count(0.6, 0.4));
    CHECK(for_each_vertex(scene, true, 0.3, 0.05, 0.45, wall) > least_count(0.6, 0.4));
  }
}

}  // namespace
}  // namespace rangezip

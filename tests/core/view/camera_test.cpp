#include "core/view/camera.h"

#include <limits>

#include <catch2/catch.hpp>

#include "core/base/error.h"
#include "core/view/view.h"
#include "tests/support/shapes.h"

namespace rangezip {
namespace {

std::vector<Vec3> corners_of(const Box& box) {
  std::vector<Vec3> corners;
  for (const double x : {box.lower.x, box.upper.x}) {
    for (const double y : {box.lower.y, box.upper.y}) {
      for (const double z : {box.lower.z, box.upper.z})
        corners.emplace_back(x, y, z);
    }
  }
  return corners;
}

TEST_CASE("look_at puts the target on the line of sight and up upwards", "[view]") {
  const Vec3 eye{1, 2, 3};
  const Vec3 target{-2, 0.5, 1};
  const Vec3 up{0.2, 1, 0.1};
  const Camera camera = look_at(eye, target, up);
  const Vec3 seen(camera.eye_from_world * Vec4(target, 1.0));
  CHECK(glm::length(seen - Vec3{0, 0, -glm::length(target - eye)}) < 1e-14);
  CHECK(glm::length(Vec3(camera.eye_from_world * Vec4(eye, 1.0))) < 1e-14);
  const Vec3 seen_up(camera.eye_from_world * Vec4(up, 0.0));
  CHECK(std::abs(seen_up.x) < 1e-15);
  CHECK(seen_up.y > 0.0);
}

TEST_CASE("look_at refuses a line of sight that is none", "[view]") {
  CHECK_THROWS_AS(look_at({1, 2, 3}, {1, 2, 3}, {0, 1, 0}), InvalidArgument);
  CHECK_THROWS_AS(look_at({0, 2, 0}, {0, 0, 0}, {0, 1, 0}), InvalidArgument);
  CHECK_THROWS_AS(look_at({0, 2, 0}, {0, 0, 0}, {0, 0, 0}), InvalidArgument);
  const double nan = std::numeric_limits<double>::quiet_NaN();
  CHECK_THROWS_AS(look_at({nan, 2, 0}, {0, 0, 0}, {1, 0, 0}), InvalidArgument);
}

TEST_CASE("fit_depth_planes holds the box between them, with little to spare", "[view]") {
  for (std::uint64_t seed = 1; seed <= 100; ++seed) {
    CAPTURE(seed);
    shapes::Random random(seed);
    const Vec3 place = seed % 3 == 0 ? Vec3{636763, 851298, 415} : Vec3{0.0};
    Box box;
    for (int i = 0; i < 3; ++i)
      box.add(place + random.direction());
    const Vec3 eye = place + 5.0 * random.direction();
    Camera camera = look_at(eye, place, {0.1, 1, 0.2});
    if (seed % 2 == 0) camera.lens = Perspective{};
    camera = fit_depth_planes(camera, box);
    double nearest = std::numeric_limits<double>::infinity();
    double farthest = -nearest;
    for (const Vec3& corner : corners_of(box)) {
      const double depth = -(camera.eye_from_world * Vec4(corner, 1.0)).z;
      nearest = std::min(nearest, depth);
      farthest = std::max(farthest, depth);
    }
    REQUIRE(camera.near_depth < nearest);
    REQUIRE(camera.far_depth > farthest);
    // The margin: 1/256 on each side, and 1e-9 of depths up to 2^21 far from the origin.
    const double tightness = (camera.far_depth - camera.near_depth) / (farthest - nearest);
    REQUIRE(tightness < 1.0 + 2.0 / 256.0 + 0.01);
  }
}

TEST_CASE("fit_depth_planes handles flat boxes and eyes inside of the box", "[view]") {
  Box flat;
  flat.add(Vec3{-1, -1, 0});
  flat.add(Vec3{1, 1, 0});
  const Camera camera = fit_depth_planes(look_at({0, 0, 5}, {0, 0, 0}, {0, 1, 0}), flat);
  CHECK(camera.near_depth < 5.0);
  CHECK(camera.far_depth > 5.0);

  Box around;
  around.add(Vec3{-1, -1, -1});
  around.add(Vec3{1, 1, 1});
  Camera inside = look_at({0, 0, 0}, {0, 0, -1}, {0, 1, 0}, Perspective{});
  inside = fit_depth_planes(inside, around);
  CHECK(inside.near_depth > 0.0);
  CHECK(inside.far_depth > 1.0);
  CHECK_NOTHROW(View(inside, {8, 8}));
  CHECK_THROWS_AS(fit_depth_planes(inside, Box{}), InvalidArgument);
}

TEST_CASE("frame_box shows the whole box with pixels of the asked size", "[view]") {
  for (std::uint64_t seed = 1; seed <= 100; ++seed) {
    CAPTURE(seed);
    shapes::Random random(seed);
    Box box;
    for (int i = 0; i < 3; ++i) {
      const double length = random.between(0.1, 10.0);
      box.add(length * random.direction());
    }
    const double size = random.between(0.01, 0.1);
    const int margin = static_cast<int>(random.bits() % 6);
    const FramedCamera framed = frame_box(box, random.direction(), size, margin);
    const View view(framed.camera, framed.extent);
    REQUIRE(view.pixel_size(1.0) == Approx(size).epsilon(1e-12));
    double least = std::numeric_limits<double>::infinity();
    for (const Vec3& corner : corners_of(box)) {
      const Vec3 window = view.window_from_world(corner);
      REQUIRE(window.z > 0.0);
      REQUIRE(window.z < 1.0);
      least = std::min({least, window.x, window.y, framed.extent.width - window.x,
                        framed.extent.height - window.y});
    }
    REQUIRE(least >= margin);
    REQUIRE(least <= margin + 2.0);  // as small as it can be
  }
}

TEST_CASE("frame_box takes an up vector and has one of its own", "[view]") {
  Box box;
  box.add(Vec3{-1, -1, -1});
  box.add(Vec3{1, 1, 1});
  const FramedCamera along_y = frame_box(box, {0, 1, 0}, 0.1);
  CHECK_NOTHROW(View(along_y.camera, along_y.extent));
  const FramedCamera turned = frame_box(box, {0, 0, 1}, 0.1, 4, Vec3{1, 0, 0});
  const View view(turned.camera, turned.extent);
  CHECK(view.window_from_world({1, 0, 0}).y > view.window_from_world({0, 0, 0}).y + 9.9);
}

TEST_CASE("frame_box refuses what has no picture", "[view]") {
  Box box;
  box.add(Vec3{0, 0, 0});
  box.add(Vec3{1, 1, 1});
  const double inf = std::numeric_limits<double>::infinity();
  CHECK_THROWS_AS(frame_box(box, {0, 0, 1}, 0.0), InvalidArgument);
  CHECK_THROWS_AS(frame_box(box, {0, 0, 1}, inf), InvalidArgument);
  CHECK_THROWS_AS(frame_box(box, {0, 0, 1}, 1e-9), InvalidArgument);
  CHECK_THROWS_AS(frame_box(box, {0, 0, 0}, 0.1), InvalidArgument);
  CHECK_THROWS_AS(frame_box(box, {inf, 0, 0}, 0.1), InvalidArgument);
  CHECK_THROWS_AS(frame_box(Box{}, {0, 0, 1}, 0.1), InvalidArgument);
}

}  // namespace
}  // namespace rangezip

#include "core/view/view.h"

#include <limits>
#include <numbers>

#include <catch2/catch.hpp>

#include "core/base/error.h"
#include "tests/support/shapes.h"

namespace rangezip {
namespace {

/// A camera anywhere, looking at a point near the origin.
Camera random_camera(shapes::Random& random, bool perspective) {
  const double length = random.between(4.0, 6.0);
  const Vec3 eye = length * random.direction();
  const Vec3 target = 0.5 * random.direction();
  Camera camera = look_at(eye, target, random.direction());
  if (perspective) {
    camera.lens = Perspective{.fov_y = random.between(0.2, 2.0)};
  } else {
    camera.lens = Orthographic{.height = random.between(0.5, 5.0)};
  }
  camera.near_depth = random.between(0.5, 1.5);
  camera.far_depth = random.between(8.0, 20.0);
  return camera;
}

TEST_CASE("world to window and back is the identity under both lenses", "[view]") {
  for (std::uint64_t seed = 1; seed <= 200; ++seed) {
    CAPTURE(seed);
    shapes::Random random(seed);
    const View view(random_camera(random, seed % 2 == 0), {640, 480});
    const Vec2 pixel{random.between(0, 640), random.between(0, 480)};
    const double depth = random.between(view.camera().near_depth, view.camera().far_depth);
    const Vec3 point = view.position(pixel, depth);
    const Vec3 window = view.window_from_world(point);
    // Coordinates below 2^10 and some thirty roundings.
    REQUIRE(std::abs(window.x - pixel.x) < 1e-9);
    REQUIRE(std::abs(window.y - pixel.y) < 1e-9);
    REQUIRE(std::abs(view.depth_of(point) - depth) < 1e-11);
    REQUIRE(std::abs(view.depth_from_window_z(window.z) - depth) < 1e-9);
    REQUIRE(std::abs(view.window_z_from_depth(depth) - window.z) < 1e-12);
    REQUIRE(glm::length(view.world_from_window(window) - point) < 1e-9);
  }
}

TEST_CASE("window z runs from 0 at the front plane to 1 at the back plane", "[view]") {
  for (const bool perspective : {false, true}) {
    shapes::Random random(3);
    const View view(random_camera(random, perspective), {64, 64});
    CHECK(view.window_z_from_depth(view.camera().near_depth) == 0.0);
    CHECK(view.window_z_from_depth(view.camera().far_depth) == Approx(1.0).epsilon(1e-14));
    CHECK(view.depth_from_window_z(0.0) == Approx(view.camera().near_depth).epsilon(1e-14));
    CHECK(view.depth_from_window_z(1.0) == Approx(view.camera().far_depth).epsilon(1e-12));
  }
}

TEST_CASE("a pixel un-projects to its centre, the paper's modified inverse", "[view]") {
  // The inverse viewport transform of the paper maps pixel i of w to 2 i / w + 1 / w - 1.
  const double height = 3.0;
  const View view(Camera{.lens = Orthographic{.height = height}}, {8, 6});
  for (int y = 0; y < 6; ++y) {
    for (int x = 0; x < 8; ++x) {
      const double ndc_x = 2.0 * x / 8 + 1.0 / 8 - 1.0;
      const double ndc_y = 2.0 * y / 6 + 1.0 / 6 - 1.0;
      const Vec3 expected{ndc_x * 0.5 * height * 8 / 6, ndc_y * 0.5 * height, -5.0};
      REQUIRE(glm::length(view.position(Pixel{x, y}, 5.0) - expected) < 1e-14);
    }
  }
}

TEST_CASE("pixels are square and have the size that the view says", "[view]") {
  for (const bool perspective : {false, true}) {
    shapes::Random random(9);
    const View view(random_camera(random, perspective), {100, 37});
    for (const double depth : {2.0, 7.0}) {
      const Vec3 here = view.position(Pixel{40, 20}, depth);
      CHECK(glm::length(view.position(Pixel{41, 20}, depth) - here) ==
            Approx(view.pixel_size(depth)).epsilon(1e-12));
      CHECK(glm::length(view.position(Pixel{40, 21}, depth) - here) ==
            Approx(view.pixel_size(depth)).epsilon(1e-12));
    }
    CHECK((view.pixel_size(7.0) > view.pixel_size(2.0)) == perspective);
  }
}

TEST_CASE("the viewer is where the camera stands, or infinitely far", "[view]") {
  const Vec3 eye{3, 4, 5};
  const Vec3 point{0.25, -1, 0.5};
  const Camera central = look_at(eye, {0, 0, 0}, {0, 1, 0}, Perspective{});
  CHECK(glm::length(View(central, {9, 9}).toward_viewer(point) - glm::normalize(eye - point)) <
        1e-14);
  const Camera parallel = look_at(eye, {0, 0, 0}, {0, 1, 0});
  CHECK(glm::length(View(parallel, {9, 9}).toward_viewer(point) - glm::normalize(eye)) < 1e-14);
}

TEST_CASE("a View refuses what is no view", "[view]") {
  const double inf = std::numeric_limits<double>::infinity();
  const double nan = std::numeric_limits<double>::quiet_NaN();
  const Camera good;
  CHECK_NOTHROW(View(good, {1, 1}));
  CHECK_THROWS_AS(View(good, {0, 4}), InvalidArgument);
  CHECK_THROWS_AS(View(good, {4, -1}), InvalidArgument);

  const auto refuses = [](const Camera& camera) {
    CHECK_THROWS_AS(View(camera, {4, 4}), InvalidArgument);
  };
  refuses({.near_depth = 2.0, .far_depth = 2.0});
  refuses({.near_depth = 2.0, .far_depth = inf});
  refuses({.near_depth = nan});
  for (const double height : {0.0, -1.0, inf, nan})
    refuses({.lens = Orthographic{height}});
  for (const double angle : {0.0, -1.0, std::numbers::pi, nan})
    refuses({.lens = Perspective{angle}});
  refuses({.lens = Perspective{}, .near_depth = 0.0});
  refuses({.clip_planes = {{.normal = {0, nan, 0}, .offset = 0.0}}});
  refuses({.clip_planes = {{.normal = {0, 1, 0}, .offset = inf}}});

  Camera stretched;
  stretched.eye_from_world[0][0] = 1.1;
  refuses(stretched);
  Camera reflected;
  reflected.eye_from_world[0][0] = -1.0;
  refuses(reflected);
  Camera projective;
  projective.eye_from_world[2][3] = 0.5;
  refuses(projective);
  Camera undefined;
  undefined.eye_from_world[3][1] = nan;
  refuses(undefined);
}

}  // namespace
}  // namespace rangezip

#include "core/plan/front_sheet.h"

#include <catch2/catch.hpp>

#include "core/base/error.h"
#include "raster_cpu/cpu_rasterizer.h"
#include "tests/support/shapes.h"

namespace rangezip {
namespace {

constexpr Extent kExtent{9, 7};
constexpr std::uint32_t kFront = 1000;
constexpr std::uint32_t kTolerance = 250;

}  // namespace

TEST_CASE("close_front_sheet moves a pixel that shows the back onto the front") {
  Grid<std::uint32_t> depth(kExtent, kFront);
  depth[{4, 3}] = 90'000;
  depth[{1, 1}] = kFront + kTolerance;  // not more than the tolerance behind
  Grid<std::uint32_t> expected = depth;
  expected[{4, 3}] = kFront;
  close_front_sheet(depth, kTolerance);
  CHECK(depth == expected);
}

TEST_CASE("close_front_sheet keeps a step of depth, lone samples and the empty pixels") {
  Grid<std::uint32_t> depth(kExtent, kFront);
  for (int y = 0; y < kExtent.height; ++y) {
    for (int x = 5; x < kExtent.width; ++x)
      depth[{x, y}] = 50'000;
  }
  Grid<std::uint32_t> step = depth;
  close_front_sheet(depth, kTolerance);
  CHECK(depth == step);

  Grid<std::uint32_t> sparse(kExtent, kNoDepth);
  sparse[{3, 3}] = kFront;
  sparse[{4, 3}] = 50'000;
  sparse[{5, 3}] = kFront;
  sparse[{4, 4}] = kFront;  // three neighbours only
  const Grid<std::uint32_t> before = sparse;
  close_front_sheet(sparse, kTolerance);
  CHECK(sparse == before);
}

TEST_CASE("PointProjector finds the pixel and the depth that the rasterizer draws") {
  auto cloud = std::make_shared<PointCloud>(shapes::sampled(shapes::sphere(), 1));
  CpuRasterizer rasterizer;
  shapes::Random random(2);
  int drawn = 0;
  for (int round = 0; round < 200; ++round) {
    CAPTURE(round);
    const Vec3 direction = random.direction();
    const double length = random.unit();
    const Vec3 point = length * random.direction();
    const Mat4 placement = shapes::translation({50.0, 20.0, -10.0}) * shapes::tilt();
    const Box bounds{Vec3(49.0, 19.0, -11.0), Vec3(51.0, 21.0, -9.0)};
    FramedCamera framed = frame_box(bounds, direction, 0.05);
    const View view(framed.camera, framed.extent);
    const std::vector<Vec3f> positions{Vec3f(point)};
    const std::vector<DrawItem> items{
        DrawPoints{.positions = positions, .world_from_item = placement}};
    const Framebuffer buffer = rasterizer.render(view, items);
    const PointProjector project(view, placement);
    const PointProjector::Place place = project(positions[0]);
    const Vec3 window = view.window_from_world(Vec3(placement * Vec4(Vec3(positions[0]), 1.0)));
    // Points within a rounding step of a pixel's border may fall to either side.
    const double to_border = std::max(std::abs(window.x - std::floor(window.x) - 0.5),
                                      std::abs(window.y - std::floor(window.y) - 0.5));
    if (to_border > 0.49) continue;
    ++drawn;
    REQUIRE(place.pixel < buffer.depth.pixels().size());
    const std::uint32_t depth = buffer.depth.pixels()[place.pixel];
    REQUIRE(depth != kNoDepth);
    CHECK(std::abs(place.depth - static_cast<float>(depth)) <= 1.0F);
    CHECK(depth_units_per_length(view) *
              (view.depth_of(Vec3(placement * Vec4(Vec3(positions[0]), 1.0))) -
               view.camera().near_depth) ==
          Approx(static_cast<double>(depth)).margin(16.0));  // floats of 2^24 units near 64
  }
  CHECK(drawn > 150);
}

TEST_CASE("PointProjector puts points beside the image and NaN outside, and refuses perspective") {
  const Box bounds{Vec3(-1.0), Vec3(1.0)};
  FramedCamera framed = frame_box(bounds, {0, 0, 1}, 0.1);
  const View view(framed.camera, framed.extent);
  const PointProjector project(view, Mat4{1.0});
  CHECK(project({0, 0, 0}).pixel != PointProjector::kOutside);
  CHECK(project({100, 0, 0}).pixel == PointProjector::kOutside);
  CHECK(project({0, -100, 0}).pixel == PointProjector::kOutside);
  CHECK(project({NAN, 0, 0}).pixel == PointProjector::kOutside);
  Camera camera = look_at({0, 0, 5}, {0, 0, 0}, {0, 1, 0}, Perspective{});
  CHECK_THROWS_AS(PointProjector(View(camera, {10, 10}), Mat4{1.0}), InvalidArgument);
}

}  // namespace rangezip

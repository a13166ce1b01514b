// What lies outside of the depth range, the guard range or the clip planes.

#include <catch2/catch.hpp>
#include <cmath>
#include <limits>
#include <map>

#include "tests/core/raster/drawing.h"

namespace rangezip {
namespace {

using drawing::corners_at;
using drawing::draw;
using drawing::for_each_backend;
using drawing::kExtent;
using drawing::kOneFace;
using drawing::pixels_of_ids;
using lattice::px;

constexpr float kNan = std::numeric_limits<float>::quiet_NaN();
constexpr float kInf = std::numeric_limits<float>::infinity();

TEST_CASE("points and fragments outside of the depth range are dropped, one by one") {
  for_each_backend([](Rasterizer& rasterizer) {
    constexpr auto kMax = static_cast<float>(kMaxDepth);
    const std::vector<Vec3f> positions{{px(1.5), px(0.5), -1},
                                       {px(2.5), px(0.5), 0},
                                       {px(3.5), px(0.5), kMax},
                                       {px(4.5), px(0.5), kMax + 1}};
    const Framebuffer points = draw(rasterizer, {lattice::points(kExtent, positions)});
    CHECK(pixels_of_ids(points) == std::map<PrimitiveId, int>{{1, 1}, {2, 1}});
    // A ramp of 2^20 a pixel from -8 pixels of depth: visible for 16 pixels, from the ninth on.
    const float step = 1 << 20;
    const std::vector<Vec3f> ramp =
        corners_at({Vec2{0, 0}, {32, 0}, {0, 32}}, {-8 * step, 24 * step, -8 * step});
    const Framebuffer image = draw(rasterizer, {lattice::triangles(kExtent, ramp, kOneFace)});
    for (int x = 0; x < 31; ++x) {
      CAPTURE(x);
      CHECK((image.id[{x, 0}] == 0) == (x >= 8 && x < 24));
    }
  });
}

TEST_CASE("points that are not finite or out of the guard range are dropped and counted") {
  for_each_backend([](Rasterizer& rasterizer) {
    const std::vector<Vec3f> positions{{kNan, 0, 0},       {0, kInf, 0},         {0, 0, -kInf},
                                       {5e6F, 0, 0},       {0, -5e6F, 0},        {0, 0, 4e7F},
                                       {4194304.0F, 0, 0}, {px(1.5), px(1.5), 3}};
    Framebuffer image;
    const DrawReport report = rasterizer.render(
        lattice::view(kExtent), std::vector<DrawItem>{lattice::points(kExtent, positions)}, image);
    CHECK(report.dropped_points == 6);
    CHECK(report.dropped_triangles == 0);
    CHECK(pixels_of_ids(image) == std::map<PrimitiveId, int>{{7, 1}});
  });
}

TEST_CASE("a triangle with a corner that is not finite is dropped and counted") {
  for_each_backend([](Rasterizer& rasterizer) {
    for (const float bad : {kNan, kInf, -kInf}) {
      for (int axis = 0; axis < 3; ++axis) {
        std::vector<Vec3f> corners = corners_at({Vec2{0, 0}, {9, 0}, {0, 9}}, {5, 5, 5});
        corners[1][axis] = bad;
        Framebuffer image;
        const DrawReport report = rasterizer.render(
            lattice::view(kExtent),
            std::vector<DrawItem>{lattice::triangles(kExtent, corners, kOneFace)}, image);
        CHECK(report.dropped_triangles == 1);
        CHECK(image == make_framebuffer(kExtent));
      }
    }
  });
}

TEST_CASE("a triangle far larger than the guard range has no holes and keeps its id") {
  for_each_backend([](Rasterizer& rasterizer) {
    for (const float reach : {1e7F, 1e9F, 1e12F}) {
      CAPTURE(reach);
      const std::vector<Vec3f> corners{{-reach, -reach, 7}, {reach, -reach, 7}, {0, reach, 7}};
      const Framebuffer image =
          draw(rasterizer, {lattice::triangles(kExtent, corners, kOneFace, 0x8000'0001U)});
      Framebuffer full;
      full.depth = Grid<std::uint32_t>(kExtent, 7);
      full.id = Grid<PrimitiveId>(kExtent, 0x8000'0001U);
      CHECK(image == full);
    }
  });
}

TEST_CASE("neighbours that leave the guard range meet without gap or overlap") {
  for_each_backend([](Rasterizer& rasterizer) {
    // A fan around the middle of the image; some spokes end near, some far away.
    std::vector<Vec3f> positions{{px(24.25), px(20.75), 100}};
    std::vector<Triangle> faces;
    const std::vector<Vec2> ring{{1, 0},  {2, 1},   {1, 3},   {-1, 2},
                                 {-3, 1}, {-2, -1}, {-1, -3}, {2, -2}};
    for (std::uint32_t i = 0; i < ring.size(); ++i) {
      const double length = i % 3 == 0 ? 3e7 : (i % 3 == 1 ? 2e5 : 4e10);
      positions.emplace_back(px(24.25) + ring[i].x * length, px(20.75) + ring[i].y * length, 100);
      faces.push_back({0, i + 1, (i + 1) % static_cast<std::uint32_t>(ring.size()) + 1});
    }
    Grid<int> times_drawn(kExtent, 0);
    for (const Triangle& face : faces) {
      const std::vector<Triangle> one{face};
      const Framebuffer image = draw(rasterizer, {lattice::triangles(kExtent, positions, one)});
      for (std::size_t i = 0; i < times_drawn.pixels().size(); ++i) {
        times_drawn.pixels()[i] += image.id.pixels()[i] == 0 ? 1 : 0;
      }
    }
    CHECK(times_drawn == Grid<int>(kExtent, 1));
  });
}

View perspective_view(std::vector<Plane> clip_planes = {}) {
  Camera camera = look_at({0, 0, 3}, {0, 0, 0}, {0, 1, 0}, Perspective{.fov_y = 1.0});
  camera.near_depth = 1.0;
  camera.far_depth = 5.0;
  camera.clip_planes = std::move(clip_planes);
  return View(camera, kExtent);
}

TEST_CASE("a floor that reaches behind the eye is drawn up to the near plane") {
  for_each_backend([](Rasterizer& rasterizer) {
    // The plane y = -1 from far before the eye (z = 3) to far behind it.
    const std::vector<Vec3f> corners{{-400, -1, -50}, {400, -1, -50}, {0, -1, 60}};
    const std::vector<DrawItem> items{DrawTriangles{.positions = corners, .triangles = kOneFace}};
    const View view = perspective_view();
    const Framebuffer image = rasterizer.render(view, items);
    int seen = 0;
    for (int y = 0; y < kExtent.height; ++y) {
      for (int x = 0; x < kExtent.width; ++x) {
        // Where the ray through the pixel's centre meets the floor: y falls by `drop` per depth.
        const double drop = -(view.position(Pixel{x, y}, 1.0).y);
        const double depth = drop > 0.0 ? 1.0 / drop : 1e9;
        if (std::abs(depth - 1.0) < 1e-3 || std::abs(depth - 5.0) < 1e-3) continue;
        const bool visible = depth > 1.0 && depth < 5.0;
        CHECK((image.id[{x, y}] == 0) == visible);
        if (!visible) continue;
        ++seen;
        // The corners lie hundreds of pixels away; half a subpixel there tilts the plane by less
        // than 1e-3 of the depth range here.
        const double z = image.depth[{x, y}] / 16777216.0;
        CHECK(z == Approx(view.window_z_from_depth(depth)).margin(1e-3));
      }
    }
    CHECK(seen > 300);
  });
}

TEST_CASE("clip planes drop points and cut triangles") {
  for_each_backend([](Rasterizer& rasterizer) {
    // Keeps x >= 0.
    for (const bool perspective : {false, true}) {
      View view = perspective_view({Plane{.normal = {1, 0, 0}, .offset = 0}});
      if (!perspective) {
        Camera camera = view.camera();
        camera.lens = Orthographic{.height = 4.0};
        view = View(camera, kExtent);
      }
      const std::vector<Vec3f> positions{{-0.5F, 0.5F, 0}, {0.5F, 0.5F, 0}, {-0.5F, -0.5F, 0}};
      const std::vector<Vec3f> corners{{-90, -90, -1}, {90, -90, -1}, {0, 90, -1}};
      Framebuffer image;
      const std::vector<DrawItem> items{
          DrawPoints{.positions = positions},
          DrawTriangles{.positions = corners, .triangles = kOneFace, .first_id = 3}};
      const DrawReport report = rasterizer.render(view, items, image);
      CHECK(report.dropped_points == 0);
      CHECK(report.dropped_triangles == 0);
      const int half = kExtent.width * kExtent.height / 2;
      CHECK(pixels_of_ids(image) == std::map<PrimitiveId, int>{{1, 1}, {3, half - 1}});
      for (int y = 0; y < kExtent.height; ++y) {
        for (int x = 0; x < kExtent.width; ++x) {
          CHECK((image.id[{x, y}] != kNoPrimitive) == (x >= kExtent.width / 2));
        }
      }
    }
  });
}

TEST_CASE("clip planes that leave nothing draw nothing") {
  for_each_backend([](Rasterizer& rasterizer) {
    const std::vector<Plane> apart{{.normal = {1, 0, 0}, .offset = -1},
                                   {.normal = {-1, 0, 0}, .offset = -1}};
    const std::vector<Vec3f> corners{{-9, -9, 0}, {9, -9, 0}, {0, 9, 0}};
    const std::vector<DrawItem> items{DrawTriangles{.positions = corners, .triangles = kOneFace}};
    CHECK(rasterizer.render(perspective_view(apart), items) == make_framebuffer(kExtent));
  });
}

}  // namespace
}  // namespace rangezip

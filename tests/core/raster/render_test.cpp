#include <algorithm>
#include <catch2/catch.hpp>
#include <cmath>
#include <limits>
#include <map>

#include "core/base/error.h"
#include "core/base/parallel.h"
#include "core/raster/rasterizer.h"
#include "tests/support/backends.h"
#include "tests/support/lattice.h"
#include "tests/support/raster_scenes.h"

namespace rangezip {
namespace {

using lattice::px;

constexpr Extent kExtent{48, 40};
constexpr float kNan = std::numeric_limits<float>::quiet_NaN();
constexpr float kInf = std::numeric_limits<float>::infinity();

/// Runs `body` with a fresh rasterizer of every backend.
template <class Body>
void for_each_backend(const Body& body) {
  for (const Backend& backend : all_backends()) {
    CAPTURE(backend.name);
    const auto rasterizer = backend.make();
    body(*rasterizer);
  }
}

Framebuffer draw(Rasterizer& rasterizer, const std::vector<DrawItem>& items,
                 Extent extent = kExtent) {
  return rasterizer.render(lattice::view(extent), items);
}

/// Number of pixels that each id won.
std::map<PrimitiveId, int> pixels_of_ids(const Framebuffer& image) {
  std::map<PrimitiveId, int> count;
  for (const PrimitiveId id : image.id.pixels()) {
    if (id != kNoPrimitive) ++count[id];
  }
  return count;
}

TEST_CASE("a point of size one sets the pixel that holds it, and only that one") {
  for_each_backend([](Rasterizer& rasterizer) {
    const std::vector<Vec3f> position{{px(7.25), px(11.75), 1234}};
    const Framebuffer image = draw(rasterizer, {lattice::points(kExtent, position, 5)});
    Framebuffer expected = make_framebuffer(kExtent);
    expected.depth[{7, 11}] = 1234;
    expected.id[{7, 11}] = 5;
    CHECK(image == expected);
  });
}

TEST_CASE("the nearer point wins in either order of drawing") {
  for_each_backend([](Rasterizer& rasterizer) {
    for (const bool near_first : {true, false}) {
      const std::vector<Vec3f> positions{{px(3.5), px(3.5), near_first ? 10.0F : 20.0F},
                                         {px(3.5), px(3.5), near_first ? 20.0F : 10.0F}};
      const Framebuffer image = draw(rasterizer, {lattice::points(kExtent, positions)});
      CHECK(image.depth[{3, 3}] == 10);
      CHECK(image.id[{3, 3}] == (near_first ? 0 : 1));
    }
  });
}

TEST_CASE("of equally near primitives the lower id wins, over kinds and items") {
  for_each_backend([](Rasterizer& rasterizer) {
    const std::vector<Vec3f> positions(3, Vec3f{px(5.5), px(5.5), 77});
    const std::vector<Vec3f> corners{{0, 0, 77}, {px(20), 0, 77}, {0, px(20), 77}};
    const std::vector<Triangle> face{{0, 1, 2}};
    const Framebuffer points_first = draw(
        rasterizer,
        {lattice::points(kExtent, positions, 4), lattice::triangles(kExtent, corners, face, 9)});
    CHECK(points_first.id[{5, 5}] == 4);
    CHECK(points_first.id[{6, 5}] == 9);
    const Framebuffer triangle_first = draw(
        rasterizer,
        {lattice::triangles(kExtent, corners, face, 2), lattice::points(kExtent, positions, 4)});
    CHECK(triangle_first.id[{5, 5}] == 2);
  });
}

TEST_CASE("ids keep all 32 bits") {
  for_each_backend([](Rasterizer& rasterizer) {
    for (const PrimitiveId first : {0x00ff'fffeU, 0x7fff'fffeU, 0xffff'fffcU}) {
      CAPTURE(first);
      const std::vector<Vec3f> positions{
          {px(1.5), px(1.5), 1}, {px(2.5), px(1.5), 1}, {px(3.5), px(1.5), 1}};
      const Framebuffer image = draw(rasterizer, {lattice::points(kExtent, positions, first)});
      for (int i = 0; i < 3; ++i) {
        CHECK(image.id[{1 + i, 1}] == first + static_cast<PrimitiveId>(i));
      }
      const std::vector<Vec3f> corners{{0, 0, 5}, {px(8), 0, 5}, {0, px(8), 5}};
      const std::vector<Triangle> faces(3, Triangle{0, 1, 2});
      const Framebuffer drawn =
          draw(rasterizer, {lattice::triangles(kExtent, corners, faces, first)});
      CHECK(drawn.id[{1, 1}] == first);
    }
  });
}

TEST_CASE("a point of size s covers s x s pixels around its centre") {
  for_each_backend([](Rasterizer& rasterizer) {
    for (const int size : {1, 2, 3, 4, 5, 6, 7, 8, 31}) {
      CAPTURE(size);
      // Odd sizes centre on a pixel's centre, even ones on a corner of pixels.
      const float at = size % 2 == 1 ? px(20.5) : px(20);
      const std::vector<Vec3f> position{{at, at, 9}};
      const Framebuffer image = draw(rasterizer, {lattice::points(kExtent, position, 0, size)});
      const int first = 20 - size / 2;
      for (int y = 0; y < kExtent.height; ++y) {
        for (int x = 0; x < kExtent.width; ++x) {
          const bool inside = x >= first && x < first + size && y >= first && y < first + size;
          CHECK((image.id[{x, y}] == 0) == inside);
        }
      }
    }
  });
}

TEST_CASE("the visible part of a point is drawn though its centre is off screen") {
  for_each_backend([](Rasterizer& rasterizer) {
    const std::vector<Vec3f> positions{{px(-1.5), px(10.5), 9},
                                       {px(kExtent.width + 1.5), px(20.5), 9},
                                       {px(30.5), px(-0.5), 9},
                                       {px(10.5), px(kExtent.height + 1.5), 9}};
    const Framebuffer image = draw(rasterizer, {lattice::points(kExtent, positions, 0, 5)});
    // Around pixel -2 the last of 5 columns is on screen, around pixel -1 the last two rows.
    CHECK(pixels_of_ids(image) == std::map<PrimitiveId, int>{{0, 5}, {1, 5}, {2, 10}, {3, 5}});
  });
}

/// One triangle with its corners in pixels.
std::vector<Vec3f> corners_at(std::array<Vec2, 3> at, std::array<float, 3> z) {
  std::vector<Vec3f> corners;
  for (std::size_t i = 0; i < 3; ++i)
    corners.emplace_back(px(at[i].x), px(at[i].y), z[i]);
  return corners;
}

const std::vector<Triangle> kOneFace{{0, 1, 2}};

TEST_CASE("a triangle owns the pixel centres on its left and lower edges, not the others") {
  for_each_backend([](Rasterizer& rasterizer) {
    // Two halves of a square whose sides run through centres of pixels.
    const std::vector<Vec3f> square{{px(4.5), px(4.5), 1},
                                    {px(12.5), px(4.5), 1},
                                    {px(12.5), px(12.5), 1},
                                    {px(4.5), px(12.5), 1}};
    const std::vector<Triangle> halves{{0, 1, 2}, {0, 2, 3}};
    const Framebuffer image = draw(rasterizer, {lattice::triangles(kExtent, square, halves)});
    for (int y = 0; y < kExtent.height; ++y) {
      for (int x = 0; x < kExtent.width; ++x) {
        const bool inside = x >= 4 && x < 12 && y >= 4 && y < 12;
        CHECK((image.id[{x, y}] != kNoPrimitive) == inside);
      }
    }
    // The diagonal is the left edge of the lower half.
    CHECK(image.id[{6, 6}] == 0);
    CHECK(image.id[{6, 7}] == 1);
  });
}

TEST_CASE("triangles that share edges cover every pixel exactly once") {
  for_each_backend([](Rasterizer& rasterizer) {
    // A grid with corners on centres and borders of pixels, each triangle drawn on its own.
    std::vector<Vec3f> positions;
    std::vector<Triangle> faces;
    constexpr std::uint32_t kSide = 7;
    for (std::uint32_t y = 0; y < kSide; ++y) {
      for (std::uint32_t x = 0; x < kSide; ++x) {
        // The outline is a rectangle, the inside is moved by sixths of a pixel.
        const bool inner = x > 0 && y > 0 && x + 1 < kSide && y + 1 < kSide;
        const double shift = inner ? ((x * 5 + y * 3) % 7) / 6.0 - 0.5 : 0.0;
        positions.emplace_back(px(2.5 + 3.0 * x + shift), px(1.5 + 2.5 * y - shift), 9);
      }
    }
    for (std::uint32_t y = 0; y + 1 < kSide; ++y) {
      for (std::uint32_t x = 0; x + 1 < kSide; ++x) {
        const std::uint32_t a = y * kSide + x;
        faces.push_back({a, a + 1, a + kSide + 1});
        faces.push_back({a, a + kSide + 1, a + kSide});
      }
    }
    Grid<int> times_drawn(kExtent, 0);
    for (const Triangle& face : faces) {
      const std::vector<Triangle> one{face};
      const Framebuffer image = draw(rasterizer, {lattice::triangles(kExtent, positions, one)});
      for (std::size_t i = 0; i < times_drawn.pixels().size(); ++i) {
        times_drawn.pixels()[i] += image.id.pixels()[i] == 0 ? 1 : 0;
      }
    }
    for (int y = 0; y < kExtent.height; ++y) {
      for (int x = 0; x < kExtent.width; ++x) {
        const bool inside = x >= 2 && x < 20 && y >= 1 && y < 16;
        CHECK(times_drawn[{x, y}] == (inside ? 1 : 0));
      }
    }
  });
}

TEST_CASE("the depth of a triangle is its plane at the pixel's centre, rounded down") {
  for_each_backend([](Rasterizer& rasterizer) {
    // depth = 100 + x / 3 with x in pixels from the left edge.
    const std::vector<Vec3f> corners = corners_at({Vec2{0, 0}, {30, 0}, {0, 30}}, {100, 110, 100});
    for (const Triangle& face : {Triangle{0, 1, 2}, {1, 2, 0}, {2, 0, 1}, {0, 2, 1}}) {
      const std::vector<Triangle> faces{face};
      const Framebuffer image = draw(rasterizer, {lattice::triangles(kExtent, corners, faces)});
      for (int y = 0; y < 28; ++y) {
        for (int x = 0; x + y < 28; ++x) {
          const int exact_sixths = 600 + 2 * x + 1;
          CHECK(static_cast<int>(image.depth[{x, y}]) == exact_sixths / 6);
        }
      }
    }
  });
}

TEST_CASE("both windings are drawn, and facing keeps one") {
  for_each_backend([](Rasterizer& rasterizer) {
    const std::vector<Vec3f> corners = corners_at({Vec2{0, 0}, {9, 0}, {0, 9}}, {5, 5, 5});
    const std::vector<Triangle> turned{{0, 2, 1}};
    DrawTriangles front = lattice::triangles(kExtent, corners, kOneFace);
    DrawTriangles back = lattice::triangles(kExtent, corners, turned);
    CHECK(draw(rasterizer, {front}) == draw(rasterizer, {back}));
    CHECK(draw(rasterizer, {front}).id[{1, 1}] == 0);
    const Framebuffer empty = make_framebuffer(kExtent);
    for (const Facing facing : {Facing::front, Facing::back}) {
      front.facing = facing;
      back.facing = facing;
      CHECK((draw(rasterizer, {front}) == empty) == (facing == Facing::back));
      CHECK((draw(rasterizer, {back}) == empty) == (facing == Facing::front));
    }
  });
}

TEST_CASE("a triangle without area draws nothing") {
  for_each_backend([](Rasterizer& rasterizer) {
    const std::vector<Vec3f> corners = corners_at({Vec2{0, 0}, {5, 5}, {10, 10}}, {5, 5, 5});
    CHECK(draw(rasterizer, {lattice::triangles(kExtent, corners, kOneFace)}) ==
          make_framebuffer(kExtent));
  });
}

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

TEST_CASE("render gives an empty image of the view's extent for no items, whatever was before") {
  for_each_backend([](Rasterizer& rasterizer) {
    const std::vector<Vec3f> position{{px(1.5), px(1.5), 3}};
    Framebuffer image = draw(rasterizer, {lattice::points(kExtent, position)});
    const Extent other{5, 3};
    rasterizer.render(lattice::view(other), {}, image);
    CHECK(image == make_framebuffer(other));
  });
}

TEST_CASE("render_in_band keeps the fragments inside of the band, ends included") {
  for_each_backend([](Rasterizer& rasterizer) {
    const std::vector<Vec3f> positions{
        {px(3.5), px(3.5), 10}, {px(3.5), px(3.5), 20}, {px(3.5), px(3.5), 30}};
    const std::vector<DrawItem> items{lattice::points(kExtent, positions)};
    const auto winner = [&](std::int32_t lower, std::int32_t upper) {
      DepthBand band = lattice::whole_band(kExtent);
      band.lower[{3, 3}] = lower;
      band.upper[{3, 3}] = upper;
      Framebuffer image;
      rasterizer.render_in_band(lattice::view(kExtent), items, band, image);
      return image.id[{3, 3}];
    };
    CHECK(winner(10, 30) == 0);
    CHECK(winner(11, 30) == 1);
    CHECK(winner(20, 20) == 1);
    CHECK(winner(21, 1 << 30) == 2);
    CHECK(winner(31, 40) == kNoPrimitive);
    CHECK(winner(20, 19) == kNoPrimitive);
    CHECK(winner(-100, 10) == 0);
  });
}

TEST_CASE("render_in_band with a band that holds everything is render") {
  for_each_backend([](Rasterizer& rasterizer) {
    for (int family = 0; family < kSceneFamilies; ++family) {
      const RasterScene scene = make_raster_scene(static_cast<SceneFamily>(family), 99);
      Framebuffer image;
      rasterizer.render_in_band(scene.view, scene.items, lattice::whole_band(scene.view.extent()),
                                image);
      CHECK(image == rasterizer.render(scene.view, scene.items));
    }
  });
}

TEST_CASE("drawing the items apart and compositing in any order is drawing them together") {
  for_each_backend([](Rasterizer& rasterizer) {
    for (std::uint64_t seed = 1; seed <= 10; ++seed) {
      CAPTURE(seed);
      const RasterScene scene = make_raster_scene(SceneFamily::mixed_and_clipped, seed);
      const Framebuffer together = rasterizer.render(scene.view, scene.items);
      std::vector<std::size_t> order{0, 1, 2};
      do {
        Framebuffer image = make_framebuffer(scene.view.extent());
        for (const std::size_t i : order) {
          composite(image, rasterizer.render(scene.view, std::span(scene.items).subspan(i, 1)));
        }
        REQUIRE(image == together);
      } while (std::next_permutation(order.begin(), order.end()));
    }
  });
}

TEST_CASE("composite refuses framebuffers of different extents") {
  Framebuffer image = make_framebuffer({4, 3});
  CHECK_THROWS_AS(composite(image, make_framebuffer({3, 4})), InvalidArgument);
  Framebuffer ragged = make_framebuffer({4, 3});
  ragged.id.reset({4, 2});
  CHECK_THROWS_AS(composite(image, ragged), InvalidArgument);
  CHECK_THROWS_AS(composite(ragged, image), InvalidArgument);
}

/// A cloud and a mesh large enough to be drawn in parts by several threads.
struct LargeScene {
  std::vector<Vec3f> points;
  std::vector<std::int8_t> votes;
  std::vector<Vec3f> corners;
  std::vector<Triangle> faces;
  std::vector<DrawItem> items;
};

void fill_large_scene(LargeScene& scene, Extent extent) {
  shapes::Random random(5);
  for (int i = 0; i < 300'000; ++i) {
    scene.points.emplace_back(random.between(0, px(extent.width)),
                              random.between(0, px(extent.height)), random.between(0, 5e6));
    scene.votes.push_back(static_cast<std::int8_t>(i % 255 - 127));
  }
  for (std::uint32_t i = 0; i < 100'000; ++i) {
    const double x = random.between(0, px(extent.width));
    const double y = random.between(0, px(extent.height));
    for (int k = 0; k < 3; ++k) {
      scene.corners.emplace_back(x + random.between(-800, 800), y + random.between(-800, 800),
                                 random.between(0, 5e6));
    }
    scene.faces.push_back({3 * i, 3 * i + 1, 3 * i + 2});
  }
  DrawPoints points = lattice::points(extent, scene.points, 0, 2);
  points.votes = scene.votes;
  scene.items = {points, lattice::triangles(extent, scene.corners, scene.faces, 300'000)};
}

TEST_CASE("the number of threads does not show") {
  const Extent extent{200, 150};
  LargeScene scene;
  fill_large_scene(scene, extent);
  const View view = lattice::view(extent);
  const AccumulateWindow window = lattice::whole_window(extent, 2'500'000, 4);
  for_each_backend([&](Rasterizer& rasterizer) {
    Framebuffer image_of_one;
    Grid<PixelMoments> sums_of_one;
    for (const int threads : {1, 2, 3, 7}) {
      CAPTURE(threads);
      Framebuffer image;
      Grid<PixelMoments> sums;
      run_with_threads(threads, [&] {
        rasterizer.render(view, scene.items, image);
        rasterizer.accumulate(view, scene.items, window, sums);
      });
      if (threads == 1) {
        image_of_one = image;
        sums_of_one = sums;
        continue;
      }
      CHECK(image == image_of_one);
      CHECK(sums == sums_of_one);
    }
  });
}

TEST_CASE("info states the shared limits") {
  for_each_backend([](Rasterizer& rasterizer) {
    const RasterizerInfo info = rasterizer.info();
    CHECK_FALSE(info.name.empty());
    CHECK(info.max_extent == Extent{kMaxRasterExtent, kMaxRasterExtent});
    CHECK(info.max_point_size == kMaxPointSize);
    CHECK(info.subpixel_bits == 8);
    CHECK(info.reproducible);
  });
}

}  // namespace
}  // namespace rangezip

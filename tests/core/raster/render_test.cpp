// Which pixels points and triangles cover, at what depth, and which of several wins.

#include <catch2/catch.hpp>
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

}  // namespace
}  // namespace rangezip

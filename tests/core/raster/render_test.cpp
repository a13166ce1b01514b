#include <catch2/catch.hpp>
#include <map>

#include "core/raster/rasterizer.h"
#include "tests/support/backends.h"
#include "tests/support/lattice.h"

namespace rangezip {
namespace {

using lattice::px;

constexpr Extent kExtent{48, 40};

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

}  // namespace
}  // namespace rangezip

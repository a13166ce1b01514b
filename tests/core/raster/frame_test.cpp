// Whole images: bands of depth, images drawn in parts.

#include <algorithm>
#include <catch2/catch.hpp>

#include "core/base/error.h"
#include "tests/core/raster/drawing.h"
#include "tests/support/raster_scenes.h"

namespace rangezip {
namespace {

using drawing::draw;
using drawing::for_each_backend;
using drawing::kExtent;
using lattice::px;

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

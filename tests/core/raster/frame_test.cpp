// Whole images: bands of depth, images drawn in parts, threads.

#include <algorithm>
#include <catch2/catch.hpp>

#include "core/base/error.h"
#include "core/base/parallel.h"
#include "tests/core/raster/drawing.h"
#include "tests/support/raster_scenes.h"
#include "tests/support/shapes.h"

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

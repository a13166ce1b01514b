#include <catch2/catch.hpp>
#include <functional>

#include "tests/support/backends.h"
#include "tests/support/lattice.h"
#include "tests/support/raster_oracle.h"
#include "tests/support/raster_scenes.h"

namespace rangezip {
namespace {

constexpr std::uint64_t kSeeds = 40;

/// Calls body(scene) for kSeeds scenes of every family.
void for_each_scene(const std::function<void(const RasterScene&)>& body) {
  for (int index = 0; index < kSceneFamilies; ++index) {
    const auto family = static_cast<SceneFamily>(index);
    for (std::uint64_t seed = 1; seed <= kSeeds; ++seed) {
      const std::string name = name_of(family);
      CAPTURE(name, seed);
      body(make_raster_scene(family, seed));
    }
  }
}

TEST_CASE("render gives the bits of the oracle") {
  std::size_t drawn = 0;
  for (const Backend& backend : all_backends()) {
    CAPTURE(backend.name);
    const auto rasterizer = backend.make();
    Framebuffer image;  // kept, so that nothing of one scene may show in the next
    for_each_scene([&](const RasterScene& scene) {
      rasterizer->render(scene.view, scene.items, image);
      REQUIRE(image == oracle::render(scene.view, scene.items));
      for (const PrimitiveId id : image.id.pixels())
        drawn += id != kNoPrimitive ? 1 : 0;
    });
  }
  // The comparison is not one of empty images.
  CHECK(drawn > 40'000);
}

TEST_CASE("render_in_band gives the bits of the oracle") {
  for (const Backend& backend : all_backends()) {
    CAPTURE(backend.name);
    const auto rasterizer = backend.make();
    for_each_scene([&](const RasterScene& scene) {
      const DepthBand band = random_band(rasterizer->render(scene.view, scene.items), 7);
      Framebuffer image;
      rasterizer->render_in_band(scene.view, scene.items, band, image);
      REQUIRE(image == oracle::render(scene.view, scene.items, &band));
    });
  }
}

TEST_CASE("accumulate gives the sums of the oracle") {
  for (const Backend& backend : all_backends()) {
    CAPTURE(backend.name);
    const auto rasterizer = backend.make();
    for_each_scene([&](const RasterScene& scene) {
      AccumulateWindow window =
          lattice::whole_window(scene.view.extent(), static_cast<std::int32_t>(kMaxDepth / 3), 4);
      window.band = random_band(rasterizer->render(scene.view, scene.items), 11);
      Grid<PixelMoments> sums;
      rasterizer->accumulate(scene.view, scene.items, window, sums);
      REQUIRE(sums == oracle::accumulate(scene.view, scene.items, window));
    });
  }
}

/// Scenes in which the oracle with a mistake differs from the reference.
int scenes_that_notice(const oracle::Mistakes& mistakes) {
  const auto rasterizer = all_backends().front().make();
  int noticed = 0;
  for_each_scene([&](const RasterScene& scene) {
    const Framebuffer image = rasterizer->render(scene.view, scene.items);
    noticed += image == oracle::render(scene.view, scene.items, nullptr, mistakes) ? 0 : 1;
  });
  return noticed;
}

TEST_CASE("the comparison with the oracle notices each wrong rule") {
  CHECK(scenes_that_notice({}) == 0);
  CHECK(scenes_that_notice({.other_edges_own_ties = true}) > 0);
  CHECK(scenes_that_notice({.depth_rounds_to_nearest = true}) > 0);
  CHECK(scenes_that_notice({.quotient_in_float = true}) > 0);
  CHECK(scenes_that_notice({.ties_go_to_higher_id = true}) > 0);
  CHECK(scenes_that_notice({.points_lean_left = true}) > 0);
}

}  // namespace
}  // namespace rangezip

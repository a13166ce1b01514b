#include <catch2/catch.hpp>
#include <functional>
#include <tuple>

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

AccumulateWindow window_of(const Extent& extent) {
  return lattice::whole_window(extent, static_cast<std::int32_t>(kMaxDepth / 3), 4);
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
      AccumulateWindow window = window_of(scene.view.extent());
      window.band = random_band(rasterizer->render(scene.view, scene.items), 11);
      Grid<PixelMoments> sums;
      rasterizer->accumulate(scene.view, scene.items, window, sums);
      REQUIRE(sums == oracle::accumulate(scene.view, scene.items, window));
    });
  }
}

/// Whether an operation on the scene differs between the reference and the oracle with a mistake.
bool notices(Rasterizer& rasterizer, const RasterScene& scene, const oracle::Mistakes& mistakes) {
  const auto& [view, items] = std::tie(scene.view, scene.items);
  const Framebuffer image = rasterizer.render(view, items);
  if (image != oracle::render(view, items, nullptr, mistakes)) return true;
  const DepthBand band = random_band(image, 7);
  Framebuffer banded;
  rasterizer.render_in_band(view, items, band, banded);
  if (banded != oracle::render(view, items, &band, mistakes)) return true;
  const AccumulateWindow window = window_of(view.extent());
  Grid<PixelMoments> sums;
  rasterizer.accumulate(view, items, window, sums);
  return sums != oracle::accumulate(view, items, window, mistakes);
}

/// Whether any scene does.
bool is_noticed(const oracle::Mistakes& mistakes) {
  const auto rasterizer = all_backends().front().make();
  bool noticed = false;
  for_each_scene([&](const RasterScene& scene) {
    noticed = noticed || notices(*rasterizer, scene, mistakes);
  });
  return noticed;
}

TEST_CASE("the comparison with the oracle notices each wrong rule") {
  CHECK_FALSE(is_noticed({}));
  CHECK(is_noticed({.other_edges_own_ties = true}));
  CHECK(is_noticed({.depth_rounds_to_nearest = true}));
  CHECK(is_noticed({.quotient_in_float = true}));
  CHECK(is_noticed({.halves_go_down = true}));
  CHECK(is_noticed({.ties_go_to_higher_id = true}));
  CHECK(is_noticed({.points_lean_left = true}));
  CHECK(is_noticed({.denormals_are_zero = true}));
  CHECK(is_noticed({.band_is_open = true}));
  CHECK(is_noticed({.shift_rounds_to_zero = true}));
}

}  // namespace
}  // namespace rangezip

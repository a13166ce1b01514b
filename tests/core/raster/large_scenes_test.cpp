// Scenes that are split among threads, drawn by every set of instructions with 1 to 8 threads.
#include <algorithm>
#include <catch2/catch.hpp>
#include <optional>
#include <vector>

#include "core/base/parallel.h"
#include "tests/support/backends.h"
#include "tests/support/large_scenes.h"
#include "tests/support/lattice.h"
#include "tests/support/threads.h"

namespace rangezip {
namespace {

/// What the three operations give.
struct Drawings {
  Framebuffer image;
  Framebuffer banded;
  Grid<PixelMoments> sums;
};

/// A scene with the arguments of the operations and their results by scalar code in one thread.
struct Contract {
  RasterScene scene;
  DepthBand band;
  std::optional<AccumulateWindow> window;  ///< none: sums are not asked for
  Drawings expected;
};

void draw_images(Rasterizer& rasterizer, const Contract& contract, Drawings& out) {
  rasterizer.render(contract.scene.view, contract.scene.items, out.image);
  rasterizer.render_in_band(contract.scene.view, contract.scene.items, contract.band, out.banded);
}

void add_sums(Rasterizer& rasterizer, const Contract& contract, Drawings& out) {
  if (!contract.window) return;
  rasterizer.accumulate(contract.scene.view, contract.scene.items, *contract.window, out.sums);
}

bool has_points(const RasterScene& scene) {
  return std::any_of(scene.items.begin(), scene.items.end(),
                     [](const DrawItem& item) { return std::holds_alternative<DrawPoints>(item); });
}

/// @param most_sums sums take 80 bytes a pixel, and are asked for in images of up to so many pixels
Contract make_contract(RasterScene scene, std::size_t most_sums) {
  Contract contract{.scene = std::move(scene)};
  const View& view = contract.scene.view;
  const auto reference = all_backends().front().make();
  run_with_exactly(1, [&] {
    const Framebuffer image = reference->render(view, contract.scene.items);
    contract.band = random_band(image, 7);
    if (has_points(contract.scene) && view.extent().count() <= most_sums) {
      contract.window = lattice::whole_window(view.extent(), 1 << 22, 4);
      contract.window->band = random_band(image, 8);
    }
    draw_images(*reference, contract, contract.expected);
    add_sums(*reference, contract, contract.expected);
  });
  return contract;
}

std::size_t pixels_drawn(const Framebuffer& image) {
  std::size_t count = 0;
  for (const PrimitiveId id : image.id.pixels())
    count += id != kNoPrimitive ? 1 : 0;
  return count;
}

/// Draws with every backend and each number of threads; sums, which cost most, with every second
/// number, from `first_sums` on.
void check(const Contract& contract, const std::vector<int>& thread_counts,
           std::size_t first_sums) {
  for (const Backend& backend : all_backends()) {
    const auto rasterizer = backend.make();
    const std::size_t runs = backend.uses_threads ? thread_counts.size() : 1;
    Drawings found;  // kept, so that nothing of one drawing may show in the next
    for (std::size_t i = 0; i < runs; ++i) {
      const int threads = thread_counts[i];
      CAPTURE(backend.name, threads);
      run_with_exactly(threads, [&] { draw_images(*rasterizer, contract, found); });
      CHECK(found.image == contract.expected.image);
      CHECK(found.banded == contract.expected.banded);
      if (backend.uses_threads && i % 2 != first_sums % 2) continue;
      run_with_exactly(threads, [&] { add_sums(*rasterizer, contract, found); });
      CHECK(found.sums == contract.expected.sums);
    }
  }
}

/// Without oneTBB the cores of the machine are the limit (run_with_exactly), and two
/// threads are enough to look for races.
std::vector<int> all_thread_counts() {
#ifdef RANGEZIP_WITH_TBB
  return {1, 2, 3, 4, 5, 6, 7, 8};
#else
  return {1, 2};
#endif
}

TEST_CASE("large scenes give the bits of scalar code in one thread, with 1 to 8 threads") {
  constexpr std::uint64_t kSeed = 1;
  constexpr Extent kExtent{301, 223};  // more pixels than are drawn without bins
  for (int index = 0; index < kLargeScenes; ++index) {
    const auto kind = static_cast<LargeScene>(index);
    const std::string name = name_of(kind);
    CAPTURE(name, kSeed);
    const Contract contract =
        make_contract(make_large_scene(kind, kExtent, 200'000, kSeed), kExtent.count());
    // The comparison is not one of empty images.
    CHECK(pixels_drawn(contract.expected.image) > kExtent.count() / 20);
    CHECK(pixels_drawn(contract.expected.banded) > kExtent.count() / 40);
    check(contract, all_thread_counts(), static_cast<std::size_t>(index));
  }
}

TEST_CASE("scenes of a million points, and images of many tiles, show no threads") {
  struct Size {
    LargeScene kind;
    Extent extent;
    int primitives;
  };
  constexpr std::uint64_t kSeed = 2;
  constexpr Extent kSmall{127, 240};
  // The first is enough for eight threads to get 2^16 points each.
  for (const auto& [kind, extent, primitives] :
       {Size{LargeScene::cloud, kSmall, 1'100'000}, Size{LargeScene::soup, {2048, 2047}, 200'000},
        Size{LargeScene::mesh, {37, 5001}, 300'000},
        Size{LargeScene::central, {5003, 29}, 250'000}}) {
    const std::string name = name_of(kind);
    CAPTURE(name, kSeed, extent.width, extent.height);
    check(make_contract(make_large_scene(kind, extent, primitives, kSeed), kSmall.count()), {8}, 0);
  }
}

TEST_CASE("run_with_exactly gives the threads that are asked for, whatever the machine has") {
#ifdef RANGEZIP_WITH_TBB
  for (const int threads : {1, 5, 8})
    run_with_exactly(threads, [&] { CHECK(thread_count() == threads); });
#else
  run_with_exactly(1, [] { CHECK(thread_count() == 1); });
#endif
}

}  // namespace
}  // namespace rangezip

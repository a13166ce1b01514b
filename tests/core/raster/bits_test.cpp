#include <catch2/catch.hpp>
#include <fstream>
#include <iomanip>
#include <map>
#include <sstream>

#include "tests/support/backends.h"
#include "tests/support/large_scenes.h"
#include "tests/support/lattice.h"
#include "tests/support/raster_scenes.h"
#include "tests/support/threads.h"

namespace rangezip {
namespace {

/// FNV-1a over 64-bit values, byte by byte from the lowest.
class Hash {
 public:
  void add(std::uint64_t value) {
    for (int byte = 0; byte < 8; ++byte) {
      state_ = (state_ ^ (value >> (8 * byte) & 0xffU)) * 0x100'0000'01b3U;
    }
  }
  [[nodiscard]] std::string text() const {
    std::ostringstream out;
    out << std::hex << std::setw(16) << std::setfill('0') << state_;
    return out.str();
  }

 private:
  std::uint64_t state_ = 0xcbf2'9ce4'8422'2325U;
};

void add_image(Hash& hash, const Framebuffer& image) {
  for (const std::uint32_t depth : image.depth.pixels())
    hash.add(depth);
  for (const PrimitiveId id : image.id.pixels())
    hash.add(id);
}

void add_sums(Hash& hash, const Grid<PixelMoments>& sums) {
  for (const PixelMoments& m : sums.pixels()) {
    for (const std::int64_t sum : {m.w, m.w_dx, m.w_dy, m.w_dx_dx, m.w_dx_dy, m.w_dy_dy, m.w_z,
                                   m.w_z_dx, m.w_z_dy, m.w_vote}) {
      hash.add(static_cast<std::uint64_t>(sum));
    }
  }
}

using Hashes = std::map<std::string, std::string>;

void add_drawings(Rasterizer& rasterizer, const RasterScene& scene, std::uint64_t seed, Hash& drawn,
                  Hash& summed) {
  const Framebuffer image = rasterizer.render(scene.view, scene.items);
  add_image(drawn, image);
  Framebuffer banded;
  rasterizer.render_in_band(scene.view, scene.items, random_band(image, seed), banded);
  add_image(drawn, banded);
  Grid<PixelMoments> sums;
  rasterizer.accumulate(scene.view, scene.items,
                        lattice::whole_window(scene.view.extent(), 1 << 22, 4), sums);
  add_sums(summed, sums);
}

/// One hash per family and operation, over ten scenes.
Hashes hashes_of_families(Rasterizer& rasterizer) {
  Hashes hashes;
  for (int index = 0; index < kSceneFamilies; ++index) {
    const auto family = static_cast<SceneFamily>(index);
    Hash drawn;
    Hash summed;
    for (std::uint64_t seed = 1001; seed <= 1010; ++seed) {
      const RasterScene scene = make_raster_scene(family, seed);
      add_drawings(rasterizer, scene, seed, drawn, summed);
    }
    hashes[name_of(family) + ".drawn"] = drawn.text();
    hashes[name_of(family) + ".summed"] = summed.text();
  }
  return hashes;
}

/// One hash per kind of large scene and operation.
Hashes hashes_of_large_scenes(Rasterizer& rasterizer) {
  Hashes hashes;
  for (int index = 0; index < kLargeScenes; ++index) {
    const auto kind = static_cast<LargeScene>(index);
    const RasterScene scene = make_large_scene(kind, {311, 217}, 150'000, 1);
    Hash drawn;
    Hash summed;
    add_drawings(rasterizer, scene, 1, drawn, summed);
    hashes[name_of(kind) + ".drawn"] = drawn.text();
    hashes[name_of(kind) + ".summed"] = summed.text();
  }
  return hashes;
}

TEST_CASE("every backend, compiler and thread count gives the bits on file", "[bits]") {
  Hashes expected;
  std::ifstream file(RANGEZIP_RASTER_BITS);
  for (std::string name, hash; file >> name >> hash;)
    expected[name] = hash;
  int threads = 1;  // the scalar reference comes first
  for (const Backend& backend : all_backends()) {
    CAPTURE(backend.name, threads);
    const auto rasterizer = backend.make();
    Hashes hashes;
    run_with_exactly(threads, [&] {
      hashes = hashes_of_families(*rasterizer);
      hashes.merge(hashes_of_large_scenes(*rasterizer));
    });
    std::ostringstream found;
    for (const auto& [name, hash] : hashes)
      found << name << " " << hash << "\n";
    INFO("found, to be put on file after a wanted change of the rules:\n" << found.str());
    CHECK(hashes == expected);
    threads = threads == 1 ? 8 : threads - 1;
  }
}

}  // namespace
}  // namespace rangezip

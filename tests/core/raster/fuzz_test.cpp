// The beginning of a run of benchmarks/robustness/raster_fuzz, with another seed.
#include <catch2/catch.hpp>

#include "tests/support/backends.h"
#include "tests/support/raster_fuzz.h"
#include "tests/support/threads.h"
#include "tests/support/wrong_rasterizers.h"

namespace rangezip {
namespace {

constexpr std::uint64_t kSeed = 20'000;

TEST_CASE("random scenes give the bits of scalar code in one thread") {
  const auto backends = all_backends();
  const auto reference = backends.front().make();
  std::vector<std::unique_ptr<Rasterizer>> rasterizers;
  for (const Backend& backend : backends)
    rasterizers.push_back(backend.make());
  fuzz::Drawings found;
  for (std::uint64_t scene = 0; scene < 600; ++scene) {
    const fuzz::Case drawn = fuzz::make_case(kSeed, scene, *reference);
    for (std::size_t i = 0; i < backends.size(); ++i) {
      const int threads = 1 + static_cast<int>((scene + i) % 8);
      run_with_exactly(threads, [&] { fuzz::draw(*rasterizers[i], drawn, found); });
      const auto difference = fuzz::find_difference(drawn, found);
      INFO("seed " << kSeed << ", scene " << scene << " (" << drawn.family << "), "
                   << backends[i].name << ", threads " << threads << ", "
                   << (difference ? difference->operation + ": " + difference->text : ""));
      REQUIRE_FALSE(difference);
    }
  }
}

/// Whether a pixel of the first scenes tells the rasterizer from the reference.
bool is_noticed(const WrongRasterizer& wrong) {
  const auto reference = all_backends().front().make();
  const auto rasterizer = wrong.make();
  fuzz::Drawings found;
  for (std::uint64_t scene = 0; scene < 100; ++scene) {
    const fuzz::Case drawn = fuzz::make_case(kSeed, scene, *reference);
    fuzz::draw(*rasterizer, drawn, found);
    const auto difference = fuzz::find_difference(drawn, found);
    if (difference && difference->pixels > 0) return true;
  }
  return false;
}

TEST_CASE("the comparison of random scenes notices each wrong rasterizer, and no right one") {
  const auto make_right = all_backends().front().make;
  CHECK_FALSE(is_noticed({"right", make_right}));
  for (const WrongRasterizer& wrong : wrong_rasterizers(make_right)) {
    CAPTURE(wrong.name);
    CHECK(is_noticed(wrong));
  }
}

}  // namespace
}  // namespace rangezip

#include "tests/support/raster_fuzz.h"

#include <algorithm>
#include <cmath>
#include <sstream>
#include <tuple>

#include "tests/support/large_scenes.h"
#include "tests/support/lattice.h"
#include "tests/support/scene_builder.h"
#include "tests/support/threads.h"

namespace rangezip::fuzz {

namespace {

using scenes::Random;
using scenes::whole;

constexpr std::uint64_t kScenesPerLarge = 200;
constexpr std::size_t kMostSums = std::size_t{1} << 20;

/// Small ones as often as large ones.
int log_uniform(Random& random, double least, double most) {
  return static_cast<int>(least * std::pow(most / least, random.unit()));
}

Case make_large(Random& random) {
  const auto kind = static_cast<LargeScene>(whole(random, 0, kLargeScenes - 1));
  const Extent extent{log_uniform(random, 33, 2048), log_uniform(random, 33, 2048)};
  const int primitives = log_uniform(random, 20'000, 700'000);
  return {.family = name_of(kind),
          .is_large = true,
          .scene = make_large_scene(kind, extent, primitives, random.bits())};
}

Case make_small(Random& random, std::uint64_t index) {
  const auto family = static_cast<SceneFamily>(index % kSceneFamilies);
  // The seeds of a family are multiplied by a small number.
  return {.family = name_of(family), .scene = make_raster_scene(family, random.bits() >> 16U)};
}

/// One reference depth for all pixels, or that of the image.
AccumulateWindow random_window(Random& random, const Framebuffer& image) {
  const Extent extent = image.depth.extent();
  AccumulateWindow window = lattice::whole_window(extent, 1 << 22, whole(random, 4, 8));
  if (whole(random, 0, 1) == 0) window.band = random_band(image, random.bits());
  if (window.shift > 4 && whole(random, 0, 1) == 0) {
    for (std::size_t i = 0; i < extent.count(); ++i) {
      const std::uint32_t depth = image.depth.pixels()[i];
      if (depth != kNoDepth) window.reference.pixels()[i] = static_cast<std::int32_t>(depth);
    }
  }
  return window;
}

/// Number and place of the pixels where values differ.
struct Found {
  std::size_t count = 0;
  std::size_t first = 0;
};

template <class Differs>
Found find_pixels(std::size_t pixels, const Differs& differs) {
  Found found;
  for (std::size_t i = pixels; i-- > 0;) {
    if (!differs(i)) continue;
    ++found.count;
    found.first = i;
  }
  return found;
}

std::string place_of(std::size_t index, Extent extent) {
  const auto width = static_cast<std::size_t>(extent.width);
  return "pixel (" + std::to_string(index % width) + ", " + std::to_string(index / width) +
         ") of " + std::to_string(extent.width) + " x " + std::to_string(extent.height);
}

std::optional<Difference> compare_images(const char* operation, const Framebuffer& expected,
                                         const Framebuffer& image) {
  if (expected == image) return {};
  const Extent extent = expected.depth.extent();
  if (image.depth.extent() != extent || image.id.extent() != extent)
    return Difference{operation, extent.count(), "another extent"};
  const auto [count, first] = find_pixels(extent.count(), [&](std::size_t i) {
    return expected.depth.pixels()[i] != image.depth.pixels()[i] ||
           expected.id.pixels()[i] != image.id.pixels()[i];
  });
  std::ostringstream text;
  text << place_of(first, extent) << ": depth " << expected.depth.pixels()[first] << " id "
       << expected.id.pixels()[first] << ", found depth " << image.depth.pixels()[first] << " id "
       << image.id.pixels()[first];
  return Difference{operation, count, text.str()};
}

std::string text_of(const PixelMoments& m) {
  std::ostringstream text;
  for (const std::int64_t sum : {m.w, m.w_dx, m.w_dy, m.w_dx_dx, m.w_dx_dy, m.w_dy_dy, m.w_z,
                                 m.w_z_dx, m.w_z_dy, m.w_vote}) {
    text << " " << sum;
  }
  return text.str();
}

std::optional<Difference> compare_sums(const Grid<PixelMoments>& expected,
                                       const Grid<PixelMoments>& sums) {
  if (expected == sums) return {};
  const Extent extent = expected.extent();
  if (sums.extent() != extent) return Difference{"accumulate", extent.count(), "another extent"};
  const auto [count, first] = find_pixels(
      extent.count(), [&](std::size_t i) { return expected.pixels()[i] != sums.pixels()[i]; });
  return Difference{"accumulate", count,
                    place_of(first, extent) + ":" + text_of(expected.pixels()[first]) + ", found" +
                        text_of(sums.pixels()[first])};
}

std::optional<Difference> compare_reports(const Drawings& expected, const Drawings& found) {
  constexpr std::array kOperations{"render", "render_in_band", "accumulate"};
  for (std::size_t i = 0; i < kOperations.size(); ++i) {
    const DrawReport& a = expected.reports[i];
    const DrawReport& b = found.reports[i];
    if (a.dropped_points == b.dropped_points && a.dropped_triangles == b.dropped_triangles)
      continue;
    std::ostringstream text;
    text << "dropped points, triangles: " << a.dropped_points << ", " << a.dropped_triangles
         << ", found " << b.dropped_points << ", " << b.dropped_triangles;
    return Difference{kOperations[i], 0, text.str()};
  }
  return {};
}

}  // namespace

std::size_t Case::pixels() const {
  return scene.view.extent().count() * (window ? 3 : 2);
}

std::size_t Case::covered() const {
  const auto is_drawn = [](PrimitiveId id) { return id != kNoPrimitive; };
  const auto has_sums = [](const PixelMoments& m) { return m.w != 0; };
  const auto image = expected.image.id.pixels();
  const auto banded = expected.banded.id.pixels();
  const auto sums = expected.sums.pixels();
  return static_cast<std::size_t>(std::count_if(image.begin(), image.end(), is_drawn) +
                                  std::count_if(banded.begin(), banded.end(), is_drawn) +
                                  std::count_if(sums.begin(), sums.end(), has_sums));
}

std::size_t Case::primitives() const {
  std::size_t count = 0;
  for (const DrawItem& item : scene.items)
    count += primitive_count(item);
  return count;
}

Case make_case(std::uint64_t seed, std::uint64_t index, Rasterizer& reference) {
  Random random(Random(seed).bits() + index);
  const bool is_large = index % kScenesPerLarge == kScenesPerLarge - 1;
  Case made = is_large ? make_large(random) : make_small(random, index);
  run_with_exactly(1, [&] {
    const Framebuffer image = reference.render(made.scene.view, made.scene.items);
    made.band = random_band(image, random.bits());
    if (image.depth.extent().count() <= kMostSums) made.window = random_window(random, image);
    draw(reference, made, made.expected);
  });
  return made;
}

void draw(Rasterizer& rasterizer, const Case& drawn, Drawings& out) {
  const auto& [view, items] = std::tie(drawn.scene.view, drawn.scene.items);
  out.reports[0] = rasterizer.render(view, items, out.image);
  out.reports[1] = rasterizer.render_in_band(view, items, drawn.band, out.banded);
  if (drawn.window) {
    out.reports[2] = rasterizer.accumulate(view, items, *drawn.window, out.sums);
  } else {
    out.reports[2] = {};
    out.sums.reset({});
  }
}

std::optional<Difference> find_difference(const Case& drawn, const Drawings& found) {
  const Drawings& expected = drawn.expected;
  auto difference = compare_images("render", expected.image, found.image);
  if (!difference) difference = compare_images("render_in_band", expected.banded, found.banded);
  if (!difference) difference = compare_sums(expected.sums, found.sums);
  if (!difference) difference = compare_reports(expected, found);
  return difference;
}

}  // namespace rangezip::fuzz

#include "raster_gl/gl_rasterizer.h"

#include <algorithm>
#include <catch2/catch.hpp>
#include <cstdlib>
#include <memory>

#include "core/base/error.h"
#include "raster_cpu/cpu_rasterizer.h"
#include "raster_gl/context_list.h"
#include "tests/support/large_scenes.h"
#include "tests/support/lattice.h"
#include "tests/support/raster_fuzz.h"

namespace rangezip {
namespace {

using Catch::Contains;

/// Draws scenes of every family and compares them with scalar code.
void check_fuzz(Rasterizer& rasterizer, std::uint64_t seed, std::uint64_t scenes) {
  CpuRasterizer reference("scalar");
  fuzz::Drawings found;
  for (std::uint64_t scene = 0; scene < scenes; ++scene) {
    const fuzz::Case drawn = fuzz::make_case(seed, scene, reference);
    fuzz::draw(rasterizer, drawn, found);
    const auto difference = fuzz::find_difference(drawn, found);
    INFO("seed " << seed << ", scene " << scene << " (" << drawn.family << "), "
                 << (difference ? difference->operation + ": " + difference->text : ""));
    REQUIRE_FALSE(difference);
  }
}

/// The same for one large scene.
void check_large(Rasterizer& rasterizer, LargeScene kind, Extent extent, int primitives) {
  CpuRasterizer reference;
  const RasterScene scene = make_large_scene(kind, extent, primitives, 3);
  CAPTURE(name_of(kind));
  CHECK(rasterizer.render(scene.view, scene.items) == reference.render(scene.view, scene.items));
}

TEST_CASE("OSMesa and EGL draw different scenes in turn without mixing") {
  GlRasterizer osmesa(make_gl_context("osmesa"));
  GlRasterizer surfaceless(make_gl_context("egl:surfaceless"));
  GlRasterizer device(make_gl_context("egl:0"));
  CpuRasterizer reference("scalar");
  fuzz::Drawings found;
  for (std::uint64_t scene = 0; scene < 36; ++scene) {
    std::uint64_t seed = 100;
    for (GlRasterizer* rasterizer : {&osmesa, &surfaceless, &device}) {
      const fuzz::Case drawn = fuzz::make_case(seed++, scene, reference);
      fuzz::draw(*rasterizer, drawn, found);
      REQUIRE_FALSE(fuzz::find_difference(drawn, found));
    }
  }
}

TEST_CASE("scenes and images beyond a buffer are drawn in parts, with the same bits") {
  for (const GlStrategy strategy : {GlStrategy::compute, GlStrategy::fixed_function}) {
    CAPTURE(name_of(strategy));
    // Room for 500 positions, 166 gathered triangles, 1500 pixels, 75 pixels of sums.
    GlRasterizer rasterizer(make_gl_context("osmesa"), {.strategy = strategy, .block_bytes = 6000});
    check_fuzz(rasterizer, 7, 3 * kSceneFamilies);
    // A triangle with all of its tiles must fit.
    GlRasterizer larger(make_gl_context("osmesa"),
                        {.strategy = strategy, .block_bytes = std::size_t{1} << 17});
    for (int kind = 0; kind < kLargeScenes; ++kind)
      check_large(larger, static_cast<LargeScene>(kind), {301, 203}, 40'000);
  }
}

TEST_CASE("rows in double precision give the bits of floats") {
  for (const GlStrategy strategy : {GlStrategy::compute, GlStrategy::fixed_function}) {
    CAPTURE(name_of(strategy));
    GlRasterizer rasterizer(make_gl_context("osmesa"), {.strategy = strategy, .wide_rows = true});
    check_fuzz(rasterizer, 8, 3 * kSceneFamilies);
  }
}

TEST_CASE("a drawing may take more groups than OpenGL counts in one dimension") {
  // 64 invocations a point, 256 a group: 65,535 groups are 262,140 points.
  std::vector<Vec3f> positions;
  shapes::Random random(1);
  constexpr Extent kExtent{90, 80};
  for (int i = 0; i < 270'000; ++i) {
    positions.push_back({random.between(0, lattice::px(kExtent.width)),
                         random.between(0, lattice::px(kExtent.height)), random.between(0, 1e7)});
  }
  const std::vector<DrawItem> items{lattice::points(kExtent, positions, 0, 9)};
  GlRasterizer rasterizer(make_gl_context("osmesa"));
  CpuRasterizer reference;
  const View view = lattice::view(kExtent);
  CHECK(rasterizer.render(view, items) == reference.render(view, items));
}

TEST_CASE("an image of the largest extent is drawn") {
  constexpr Extent kLargest{kMaxRasterExtent, kMaxRasterExtent};
  const float edge = lattice::px(kMaxRasterExtent);
  const std::vector<Vec3f> corners{{0, 0, 1}, {edge, 0, 4e6F}, {0, edge, 1e7F}};
  const std::vector<Triangle> face{{0, 1, 2}};
  const std::vector<Vec3f> positions{{edge - 300, edge - 300, 7}, {200, edge - 1, 9}};
  const std::vector<DrawItem> items{lattice::triangles(kLargest, corners, face),
                                    lattice::points(kLargest, positions, 5, 255)};
  const View view = lattice::view(kLargest);
  const Framebuffer expected = CpuRasterizer().render(view, items);
  for (const GlStrategy strategy : {GlStrategy::compute, GlStrategy::fixed_function}) {
    CAPTURE(name_of(strategy));
    GlRasterizer rasterizer(make_gl_context("egl"), {.strategy = strategy});
    CHECK(rasterizer.render(view, items) == expected);
  }
}

TEST_CASE("strategies have names, and what is chosen is used") {
  for (const GlStrategy strategy :
       {GlStrategy::compute, GlStrategy::fixed_function, GlStrategy::native}) {
    CAPTURE(name_of(strategy));
    CHECK(gl_strategy(name_of(strategy)) == strategy);
    const GlRasterizer rasterizer(make_gl_context("osmesa"), {.strategy = strategy});
    CHECK(rasterizer.strategy() == strategy);
    CHECK_THAT(rasterizer.info().name,
               Catch::StartsWith("gl:osmesa, ") && Catch::EndsWith(", " + name_of(strategy)));
    CHECK(rasterizer.info().reproducible == (strategy != GlStrategy::native));
  }
  CHECK(GlRasterizer(make_gl_context("osmesa")).strategy() == GlStrategy::compute);
  CHECK_THROWS_AS(gl_strategy("abacus"), InvalidArgument);
  CHECK_THROWS_WITH(gl_strategy("abacus"), Contains("known: automatic, compute"));
}

TEST_CASE("native drawing comes near to the rules") {
  GlRasterizer native(make_gl_context("osmesa"), {.strategy = GlStrategy::native});
  CpuRasterizer reference;
  for (const LargeScene kind : {LargeScene::mesh, LargeScene::central, LargeScene::splats}) {
    CAPTURE(name_of(kind));
    const RasterScene scene = make_large_scene(kind, {301, 203}, 20'000, 3);
    const Framebuffer expected = reference.render(scene.view, scene.items);
    const Framebuffer image = native.render(scene.view, scene.items);
    std::size_t near = 0;
    std::size_t covered = 0;
    for (std::size_t i = 0; i < expected.id.pixels().size(); ++i) {
      if (expected.id.pixels()[i] == kNoPrimitive) continue;
      ++covered;
      const std::int64_t depth = expected.depth.pixels()[i];
      near += std::abs(depth - image.depth.pixels()[i]) < 1 << 12 ? 1 : 0;
    }
    REQUIRE(covered > 10'000);
    CHECK(near > covered * 9 / 10);
  }
}

TEST_CASE("native drawing has bands, sums, and the clip planes of OpenGL only") {
  constexpr Extent kExtent{20, 16};
  Camera camera = lattice::view(kExtent).camera();
  camera.clip_planes = {{{1.0, 0.0, 0.0}, 0.0}};  // the right half
  const std::vector<Vec3f> corners{{-9999, -9999, 500}, {40'000, -9999, 500}, {0, 40'000, 500}};
  const std::vector<Triangle> face{{0, 1, 2}};
  const std::vector<DrawItem> items{lattice::triangles(kExtent, corners, face, 3)};
  GlRasterizer native(make_gl_context("osmesa"), {.strategy = GlStrategy::native});
  const Framebuffer image = native.render(View(camera, kExtent), items);
  CHECK(image.id[{9, 5}] == kNoPrimitive);
  CHECK(image.id[{10, 5}] == 3);
  DepthBand band = lattice::whole_band(kExtent);
  band.upper[{12, 5}] = 400;
  Framebuffer banded;
  native.render_in_band(View(camera, kExtent), items, band, banded);
  CHECK(banded.id[{12, 5}] == kNoPrimitive);
  CHECK(banded.id[{13, 5}] == 3);
  camera.clip_planes.resize(9, camera.clip_planes.front());
  CHECK_THROWS_WITH(native.render(View(camera, kExtent), items), Contains("8 clip planes"));
}

TEST_CASE("what has a content key is uploaded once, as long as there is room") {
  constexpr Extent kExtent{20, 16};
  const View view = lattice::view(kExtent);
  const std::vector<Vec3f> positions{{1, 1, 1}, {3000, 1, 1}, {1, 3000, 1}};
  const std::vector<Triangle> faces{{0, 1, 2}};
  DrawPoints points = lattice::points(kExtent, positions);
  DrawTriangles triangles = lattice::triangles(kExtent, positions, faces, 9);
  points.content_key = 41;
  triangles.content_key = 42;
  GlRasterizer rasterizer(make_gl_context("osmesa"));
  const std::size_t before = rasterizer.uploads();
  const std::vector<DrawItem> items{points, triangles};
  const Framebuffer first = rasterizer.render(view, items);
  CHECK(rasterizer.uploads() == before + 3);  // points; positions and corners
  CHECK(rasterizer.render(view, items) == first);
  CHECK(rasterizer.uploads() == before + 3);
  // Other content under another key, and content without one.
  const std::vector<Vec3f> moved{{600, 600, 2}};
  points.positions = moved;
  points.content_key = 43;
  CHECK(rasterizer.render(view, std::vector<DrawItem>{points}).id[{2, 2}] == 0);
  points.content_key = 0;
  for (int round = 0; round < 2; ++round)
    CHECK(rasterizer.render(view, std::vector<DrawItem>{points}).id[{2, 2}] == 0);
  CHECK(rasterizer.uploads() == before + 6);
}

TEST_CASE("uploads that find no room push out those unused for longest") {
  constexpr Extent kExtent{20, 16};
  const View view = lattice::view(kExtent);
  const std::vector<Vec3f> positions(10, Vec3f{1, 1, 1});
  GlRasterizer rasterizer(make_gl_context("osmesa"), {.cache_bytes = 2 * sizeof(Vec3f) * 10});
  const auto uploads_for = [&](std::uint64_t key) {
    DrawPoints points = lattice::points(kExtent, positions);
    points.content_key = key;
    const std::size_t before = rasterizer.uploads();
    CHECK(rasterizer.render(view, std::vector<DrawItem>{points}).id[{0, 0}] == 0);
    return rasterizer.uploads() - before;
  };
  CHECK(uploads_for(1) == 1);
  CHECK(uploads_for(2) == 1);
  CHECK(uploads_for(1) == 0);
  CHECK(uploads_for(3) == 1);  // in place of 2
  CHECK(uploads_for(1) == 0);
  CHECK(uploads_for(2) == 1);
}

TEST_CASE("an observer is told the phases of a drawing, in which what is kept is not uploaded") {
  constexpr Extent kExtent{20, 16};
  const View view = lattice::view(kExtent);
  const std::vector<Vec3f> positions(10, Vec3f{1, 1, 1});
  DrawPoints points = lattice::points(kExtent, positions);
  points.content_key = 44;
  const std::vector<DrawItem> items{points};
  for (const GlStrategy strategy :
       {GlStrategy::compute, GlStrategy::fixed_function, GlStrategy::native}) {
    CAPTURE(name_of(strategy));
    std::vector<GlPhase> phases;
    GlRasterizer rasterizer(
        make_gl_context("osmesa"),
        {.strategy = strategy, .phase_observer = [&](GlPhase phase) { phases.push_back(phase); }});
    std::vector<std::ptrdiff_t> uploads;
    for (int round = 0; round < 2; ++round) {
      phases.clear();
      CHECK(rasterizer.render(view, items).id[{0, 0}] == 0);
      REQUIRE(phases.size() > 4);
      CHECK(phases.front() == GlPhase::draw);
      // The image comes last; after it the drawing goes on, with nothing left to do.
      CHECK(phases[phases.size() - 2] == GlPhase::read);
      CHECK(phases.back() == GlPhase::draw);
      uploads.push_back(std::count(phases.begin(), phases.end(), GlPhase::upload));
    }
    CHECK(uploads[1] == uploads[0] - 1);
  }
}

}  // namespace
}  // namespace rangezip

#include "raster_gl/gl_rasterizer.h"

#include <catch2/catch.hpp>
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
  // Room for 500 positions, 166 gathered triangles, 1500 pixels, 75 pixels of sums.
  GlRasterizer rasterizer(make_gl_context("osmesa"), {.block_bytes = 6000});
  check_fuzz(rasterizer, 7, 3 * kSceneFamilies);
  // A triangle with all of its tiles must fit.
  GlRasterizer larger(make_gl_context("osmesa"), {.block_bytes = std::size_t{1} << 17});
  for (int kind = 0; kind < kLargeScenes; ++kind)
    check_large(larger, static_cast<LargeScene>(kind), {301, 203}, 40'000);
}

TEST_CASE("rows in double precision give the bits of floats") {
  GlRasterizer rasterizer(make_gl_context("osmesa"), {.wide_rows = true});
  check_fuzz(rasterizer, 8, 5 * kSceneFamilies);
}

TEST_CASE("a drawing may take more groups than OpenGL counts in one dimension") {
  // 64 invocations a point, 256 a group: 65,535 groups are 262,140 points.
  std::vector<Vec3f> positions;
  shapes::Random random(1);
  constexpr Extent kExtent{90, 80};
  for (int i = 0; i < 270'000; ++i) {
    positions.emplace_back(random.between(0, lattice::px(kExtent.width)),
                           random.between(0, lattice::px(kExtent.height)), random.between(0, 1e7));
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
  GlRasterizer rasterizer(make_gl_context("egl"));
  CpuRasterizer reference;
  const View view = lattice::view(kLargest);
  CHECK(rasterizer.render(view, items) == reference.render(view, items));
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

}  // namespace
}  // namespace rangezip

#include "compare/drawing_judge.h"

#include <catch2/catch.hpp>
#include <memory>

#include "core/base/error.h"
#include "raster_cpu/cpu_rasterizer.h"
#include "tests/support/drawing_faults.h"
#include "tests/support/lattice.h"
#include "tests/support/raster_scenes.h"
#include "tests/support/scene_builder.h"
#include "tests/support/textbook_rasterizer.h"

using namespace rangezip;
using namespace rangezip::compare;

namespace {

constexpr Extent kExtent{16, 8};
constexpr DrawingTolerance kDriver{.edge = 3, .slope = 3, .depth = 16};

std::unique_ptr<Rasterizer> make_cpu() {
  return std::make_unique<CpuRasterizer>();
}

/// Two levels: a near rectangle of triangles 0 and 1 over the left 8 columns, up to 2/256 px past
/// its last centres, and a far one of triangles 2 and 3 over the whole image.
struct TwoLevels {
  RasterScene scene;
  Framebuffer drawn;

  TwoLevels() : scene(make()), drawn(CpuRasterizer("scalar").render(scene.view, scene.items)) {}

  static RasterScene make() {
    scenes::SceneBuilder builder = scenes::lattice_builder(kExtent);
    const auto add = [&](float left, float right, float z) {
      builder.add_triangles({{left, -64, z}, {right, -64, z}, {right, 2112, z}, {left, 2112, z}},
                            {{0, 1, 2}, {0, 2, 3}});
    };
    add(-64, 7 * 256 + 128 + 2, 1000);
    add(-64, 4160, 5000);
    return builder.take();
  }

  [[nodiscard]] DrawingVerdict judge(const Framebuffer& candidate,
                                     const DrawingTolerance& tolerance) const {
    return judge_drawing(scene.view, scene.items, drawn, candidate, tolerance);
  }
};

void show(Framebuffer& image, Pixel pixel, std::uint32_t depth, PrimitiveId id) {
  image.depth[pixel] = depth;
  image.id[pixel] = id;
}

}  // namespace

TEST_CASE("a drawing and its copy are identical") {
  const TwoLevels levels;
  const DrawingVerdict verdict = levels.judge(levels.drawn, {});
  CHECK(verdict.identical());
  CHECK(verdict.explained());
  CHECK(verdict.counts.pixels == kExtent.count());
  CHECK(verdict.counts.covered == kExtent.count());
  CHECK_FALSE(verdict.first);
}

TEST_CASE("a pixel whose centre is 2/256 px inside of the silhouette may show what lies behind") {
  const TwoLevels levels;
  Framebuffer candidate = levels.drawn;
  REQUIRE(candidate.id[{7, 2}] == 0);
  show(candidate, {7, 2}, 5000, 2);
  const DrawingVerdict verdict = levels.judge(candidate, kDriver);
  CHECK(verdict.explained());
  CHECK(verdict.counts.of(Difference::id) == 1);
  CHECK(verdict.counts.of(Cause::edge) == 1);
  CHECK(verdict.causes[{7, 2}] == 1);
  CHECK(levels.judge(candidate, {}).counts.of(Cause::unexplained) == 1);
  CHECK(levels.judge(candidate, {.edge = 1, .slope = 1}).counts.of(Cause::unexplained) == 1);
}

TEST_CASE("a pixel in the middle of a near triangle may not show what lies behind") {
  const TwoLevels levels;
  Framebuffer candidate = levels.drawn;
  show(candidate, {5, 1}, 5000, levels.drawn.id[{12, 1}]);
  const DrawingVerdict verdict = levels.judge(candidate, kDriver);
  CHECK(verdict.counts.of(Cause::unexplained) == 1);
  REQUIRE(verdict.first_unexplained);
  CHECK(verdict.first_unexplained->pixel == Pixel{5, 1});
  REQUIRE(verdict.first_unexplained->reference.primitive);
  CHECK(verdict.first_unexplained->reference.primitive->id == 0);
  CHECK(verdict.first_unexplained->reference.fit.must_be_drawn());
  CHECK(verdict.first_unexplained->reference.primitive->pieces.front()[0] ==
        SnappedPosition{-64, -64, 1000});
}

TEST_CASE("a silhouette does not explain an empty pixel if something must be seen behind it") {
  const TwoLevels levels;
  Framebuffer candidate = levels.drawn;
  show(candidate, {7, 2}, kNoDepth, kNoPrimitive);
  const DrawingVerdict verdict = levels.judge(candidate, kDriver);
  CHECK(verdict.counts.of(Difference::coverage) == 1);
  CHECK(verdict.counts.of(Cause::unexplained) == 1);
}

TEST_CASE("a primitive that the pixel is far away from is no explanation") {
  const TwoLevels levels;
  Framebuffer candidate = levels.drawn;
  show(candidate, {12, 3}, 1000, 1);
  show(candidate, {12, 4}, 1000, 99);  // of no item
  const DrawingVerdict verdict = levels.judge(candidate, kDriver);
  CHECK(verdict.counts.of(Cause::unexplained) == 2);
  CHECK(verdict.first->candidate.primitive);
  CHECK_FALSE(verdict.first->candidate.fit.may_cover);
}

TEST_CASE("depths within the tolerance are rounding, and counted by the size of the step") {
  const TwoLevels levels;
  Framebuffer candidate = levels.drawn;
  candidate.depth[{1, 1}] += 1;
  candidate.depth[{2, 1}] -= 3;
  candidate.depth[{3, 1}] += 16;
  candidate.depth[{4, 1}] += 17;
  const DrawingVerdict verdict = levels.judge(candidate, kDriver);
  CHECK(verdict.counts.of(Difference::depth) == 4);
  CHECK(verdict.counts.of(Cause::depth_rounding) == 3);
  CHECK(verdict.counts.of(Cause::unexplained) == 1);
  CHECK(verdict.counts.depth_steps[0] == 1);
  CHECK(verdict.counts.depth_steps[1] == 1);
  CHECK(verdict.counts.depth_steps[4] == 2);
  CHECK(verdict.counts.largest_depth_step == 17);
  CHECK(verdict.first_unexplained->pixel == Pixel{4, 1});
}

TEST_CASE("a fault of the reference is as unexplained as one of the candidate") {
  const TwoLevels levels;
  Framebuffer faulty = levels.drawn;
  show(faulty, {5, 1}, 5000, levels.drawn.id[{12, 1}]);
  const DrawingVerdict verdict =
      judge_drawing(levels.scene.view, levels.scene.items, faulty, levels.drawn, kDriver);
  CHECK(verdict.counts.of(Cause::unexplained) == 1);
}

TEST_CASE("a depth under no ID, and an ID without a depth, are unexplained") {
  const TwoLevels levels;
  Framebuffer candidate = levels.drawn;
  candidate.depth[{7, 2}] = kNoDepth;
  candidate.id[{7, 3}] = kNoPrimitive;
  CHECK(levels.judge(candidate, kDriver).counts.of(Cause::unexplained) == 2);
}

TEST_CASE("of two sheets that nearly touch either may be seen, but not of two that are apart") {
  scenes::SceneBuilder builder = scenes::lattice_builder(kExtent);
  for (const float z : {1000.0F, 1020.0F, 1100.0F}) {
    builder.add_triangles({{-500, -500, z}, {9000, -500, z}, {-500, 9000, z}}, {{0, 1, 2}});
  }
  const RasterScene scene = builder.take();
  const Framebuffer drawn = CpuRasterizer("scalar").render(scene.view, scene.items);
  Framebuffer candidate = drawn;
  show(candidate, {3, 3}, 1015, 1);
  const auto judge = [&] {
    return judge_drawing(scene.view, scene.items, drawn, candidate, kDriver);
  };
  CHECK(judge().counts.of(Cause::depth_tie) == 1);
  show(candidate, {3, 3}, 1100, 2);
  CHECK(judge().counts.of(Cause::unexplained) == 1);
}

TEST_CASE("a primitive at a depth plane may be dropped, one well behind the plane may not") {
  scenes::SceneBuilder builder = scenes::lattice_builder(kExtent);
  builder.add_points({{128, 128, 5}, {3 * 256 + 128, 128, 500}}, 1);
  const RasterScene scene = builder.take();
  const Framebuffer drawn = CpuRasterizer("scalar").render(scene.view, scene.items);
  REQUIRE(drawn.id[{3, 0}] == 1);
  const DrawingVerdict verdict =
      judge_drawing(scene.view, scene.items, drawn, make_framebuffer(kExtent), kDriver);
  CHECK(verdict.counts.of(Cause::depth_plane) == 1);
  CHECK(verdict.counts.of(Cause::unexplained) == 1);
  CHECK(verdict.first_unexplained->pixel == Pixel{3, 0});
}

TEST_CASE("a square of a point may begin a pixel later only if its centre is near a border") {
  scenes::SceneBuilder builder = scenes::lattice_builder(kExtent);
  builder.add_points({{256 + 2, 128, 500}, {5 * 256 + 40, 128, 500}}, 1);
  const RasterScene scene = builder.take();
  const Framebuffer drawn = CpuRasterizer("scalar").render(scene.view, scene.items);
  Framebuffer candidate = make_framebuffer(kExtent);
  show(candidate, {0, 0}, 500, 0);  // 2/256 px away
  show(candidate, {4, 0}, 500, 1);  // 40/256 px away
  const DrawingVerdict verdict = judge_drawing(scene.view, scene.items, drawn, candidate, kDriver);
  CHECK(verdict.counts.of(Cause::edge) == 2);
  CHECK(verdict.counts.of(Cause::unexplained) == 2);
}

TEST_CASE("the depth of a steep triangle may differ by what it changes within the tolerance") {
  scenes::SceneBuilder builder = scenes::lattice_builder(kExtent);
  // 10 units for each 1/256 px to the right.
  builder.add_triangles({{0, 0, 1000}, {4096, 0, 1000 + 40960}, {0, 4096, 1000}}, {{0, 1, 2}});
  const RasterScene scene = builder.take();
  const Framebuffer drawn = CpuRasterizer("scalar").render(scene.view, scene.items);
  REQUIRE(drawn.depth[{2, 2}] == 1000 + 10 * (2 * 256 + 128));
  Framebuffer candidate = drawn;
  // In 3/256 px that is 30 units, and a little more where corners have moved apart.
  candidate.depth[{2, 2}] += 31 + 16;
  candidate.depth[{3, 2}] -= 31 + 16;
  candidate.depth[{4, 2}] += 31 + 17;
  candidate.depth[{5, 2}] -= 31 + 17;
  const DrawingVerdict verdict = judge_drawing(scene.view, scene.items, drawn, candidate, kDriver);
  CHECK(verdict.counts.of(Cause::depth_rounding) == 2);
  CHECK(verdict.counts.of(Cause::unexplained) == 2);
  CHECK(verdict.first_unexplained->pixel == Pixel{4, 2});
}

TEST_CASE("a sliver that rounding may turn over may have any depth, but only where it is") {
  scenes::SceneBuilder builder = scenes::lattice_builder(kExtent);
  const float far = 5000;
  builder.add_triangles({{-64, -64, far}, {8192, -64, far}, {-64, 8192, far}}, {{0, 1, 2}});
  // 1/256 px wide, along the pixels (0, 0), (1, 1), ..., (6, 6).
  builder.add_triangles({{128, 128, 4000}, {1664, 1664, 4000}, {896, 897, 4100}}, {{0, 1, 2}});
  const RasterScene scene = builder.take();
  const Framebuffer drawn = CpuRasterizer("scalar").render(scene.view, scene.items);
  Framebuffer candidate = drawn;
  show(candidate, {3, 3}, 1000, 1);
  show(candidate, {3, 5}, 1000, 1);
  const DrawingVerdict verdict = judge_drawing(scene.view, scene.items, drawn, candidate, kDriver);
  CHECK(verdict.counts.different_pixels() == 2);
  CHECK(verdict.counts.of(Cause::unexplained) == 1);
  CHECK(verdict.first_unexplained->pixel == Pixel{3, 5});
}

TEST_CASE("every injected fault is seen and unexplained without a tolerance") {
  for (const WrongRasterizer& fault : drawing_faults(make_cpu)) {
    CAPTURE(fault.name);
    std::size_t different = 0;
    for (int family = 0; family < kSceneFamilies; ++family) {
      for (const std::uint64_t seed : {1U, 2U, 3U}) {
        const RasterScene scene = make_raster_scene(static_cast<SceneFamily>(family), seed);
        const DrawingVerdict verdict =
            judge_drawing(scene.view, scene.items, make_cpu()->render(scene.view, scene.items),
                          fault.make()->render(scene.view, scene.items));
        different += verdict.counts.different_pixels();
        REQUIRE(verdict.counts.of(Cause::unexplained) == verdict.counts.different_pixels());
      }
    }
    CHECK(different > 0);
  }
}

TEST_CASE("the right drawing has no certain primitive nearer than what it shows") {
  // The judge's own reading of R5-R9 against the rasterizer's: emptied pixels must all be missed,
  // and without a tolerance by the primitive that was there.
  for (int family = 0; family < kSceneFamilies; ++family) {
    CAPTURE(name_of(static_cast<SceneFamily>(family)));
    const RasterScene scene = make_raster_scene(static_cast<SceneFamily>(family), 7);
    const Framebuffer drawn = make_cpu()->render(scene.view, scene.items);
    const Framebuffer empty = make_framebuffer(scene.view.extent());
    const DrawingVerdict verdict = judge_drawing(scene.view, scene.items, drawn, empty);
    CHECK(verdict.counts.of(Cause::unexplained) == verdict.counts.covered);
    if (!verdict.first) continue;
    CHECK(verdict.first->reference.fit.must_be_drawn());
    CHECK(verdict.first->reference.fit.nearest == verdict.first->reference.depth);
    CHECK(verdict.first->reference.fit.farthest == verdict.first->reference.depth);
  }
}

TEST_CASE("all that a textbook rasterizer rounds on its own is explained, none of its gaps") {
  // The families without NaN, clip planes and the ends of the guard range, which it does not know.
  DrawingCounts sum;
  for (const SceneFamily family :
       {SceneFamily::lattice_points, SceneFamily::lattice_triangles, SceneFamily::tiny_triangles,
        SceneFamily::slivers, SceneFamily::duplicates, SceneFamily::shared_edges,
        SceneFamily::point_sizes}) {
    for (std::uint64_t seed = 1; seed <= 10; ++seed) {
      for (const int bits : {4, 8, 10}) {
        CAPTURE(name_of(family), seed, bits);
        const RasterScene scene = make_raster_scene(family, seed);
        const Framebuffer reference = make_cpu()->render(scene.view, scene.items);
        const DrawingVerdict verdict = judge_drawing(
            scene.view, scene.items, reference,
            TextbookRasterizer(bits).render(scene.view, scene.items), driver_tolerance(bits));
        CHECK(verdict.explained());
        sum += verdict.counts;
      }
    }
  }
  CHECK(sum.of(Cause::edge) > 1000);
  CHECK(sum.of(Cause::depth_tie) > 10);
  CHECK(sum.of(Cause::depth_rounding) > 1000);
}

TEST_CASE("a missing primitive and a moved viewport stay unexplained with a driver's tolerance") {
  for (const SceneFamily family : {SceneFamily::shared_edges, SceneFamily::lattice_triangles}) {
    const RasterScene scene = make_raster_scene(family, 4);
    const Framebuffer reference = make_cpu()->render(scene.view, scene.items);
    for (const WrongRasterizer& fault : drawing_faults(make_cpu)) {
      if (fault.name != "a_primitive_is_missing" && fault.name != "viewport_is_off_by_one" &&
          fault.name != "ids_are_swapped") {
        continue;  // within a driver's roundings
      }
      CAPTURE(name_of(family), fault.name);
      const DrawingVerdict verdict =
          judge_drawing(scene.view, scene.items, reference,
                        fault.make()->render(scene.view, scene.items), kDriver);
      CHECK(verdict.counts.of(Cause::unexplained) > 0);
    }
    const Framebuffer gap = without_a_primitive(std::make_unique<TextbookRasterizer>(8))
                                ->render(scene.view, scene.items);
    CHECK_FALSE(judge_drawing(scene.view, scene.items, reference, gap, kDriver).explained());
  }
}

TEST_CASE("framebuffers of other extents and senseless tolerances are refused") {
  const TwoLevels levels;
  CHECK_THROWS_AS(levels.judge(make_framebuffer({8, 16}), {}), InvalidArgument);
  CHECK_THROWS_AS(levels.judge(levels.drawn, {.edge = 2, .slope = 1}), InvalidArgument);
  CHECK_THROWS_AS(levels.judge(levels.drawn, {.edge = -1, .slope = 1}), InvalidArgument);
  CHECK_THROWS_AS(levels.judge(levels.drawn, {.depth = -1}), InvalidArgument);
  CHECK_THROWS_AS(driver_tolerance(0), InvalidArgument);
  CHECK(driver_tolerance(8).edge == 3);
  CHECK(driver_tolerance(4).edge == 18);
}

#include <catch2/catch.hpp>
#include <functional>
#include <limits>

#include "core/base/error.h"
#include "tests/support/backends.h"
#include "tests/support/lattice.h"

namespace rangezip {
namespace {

using Catch::Contains;

constexpr Extent kExtent{6, 5};
const std::vector<Vec3f> kPositions{{1, 1, 1}, {600, 1, 1}, {1, 600, 1}};
const std::vector<Triangle> kFaces{{0, 1, 2}, {2, 1, 0}};

DrawPoints good_points(PrimitiveId first_id = 0) {
  return lattice::points(kExtent, kPositions, first_id);
}
DrawTriangles good_triangles(PrimitiveId first_id = 0) {
  return lattice::triangles(kExtent, kPositions, kFaces, first_id);
}

/// Every operation of every backend refuses `items` with a text that holds `text`.
void check_refused(const std::vector<DrawItem>& items, const std::string& text,
                   const View& view = lattice::view(kExtent)) {
  for (const Backend& backend : all_backends()) {
    CAPTURE(backend.name, text);
    const auto rasterizer = backend.make();
    const Extent extent = view.extent();
    Framebuffer image;
    Grid<PixelMoments> sums;
    CHECK_THROWS_AS(rasterizer->render(view, items), InvalidArgument);
    CHECK_THROWS_WITH(rasterizer->render(view, items, image),
                      Contains("render: ") && Contains(text));
    CHECK_THROWS_WITH(rasterizer->render_in_band(view, items, lattice::whole_band(extent), image),
                      Contains("render_in_band: ") && Contains(text));
    CHECK_THROWS_WITH(
        rasterizer->accumulate(view, items, lattice::whole_window(extent, 0, 4), sums),
        Contains("accumulate: ") && Contains(text));
  }
}

void check_accepted(const std::vector<DrawItem>& items) {
  for (const Backend& backend : all_backends()) {
    CAPTURE(backend.name);
    CHECK_NOTHROW(backend.make()->render(lattice::view(kExtent), items));
  }
}

TEST_CASE(
    "the CPU rasterizer has scalar code everywhere, and refuses instructions it does not have") {
  const std::vector<std::string> instructions = cpu_instructions();
  REQUIRE(instructions.back() == "scalar");
  for (const std::string& name : instructions)
    REQUIRE_NOTHROW(CpuRasterizer(name));
  REQUIRE_THROWS_AS(CpuRasterizer("abacus"), InvalidArgument);
  REQUIRE_THROWS_WITH(CpuRasterizer("abacus"), Contains("abacus"));
  REQUIRE_THROWS_WITH(CpuRasterizer("scalar", 0), Contains("batch"));
}

TEST_CASE("a corner index out of range is refused") {
  DrawTriangles item = good_triangles();
  const std::vector<Triangle> faces{{0, 1, 2}, {0, 3, 1}};
  item.triangles = faces;
  check_refused({good_points(),
                 [&] {
                   DrawTriangles later = item;
                   later.first_id = 3;
                   return later;
                 }()},
                "item 1: corner index 3 is out of range; the item has 3 positions");
  item.positions = {};
  check_refused({item}, "the item has 0 positions");
  item.triangles = {};
  check_accepted({item});
}

TEST_CASE("a point size out of range is refused") {
  for (const int size : {0, -1, kMaxPointSize + 1}) {
    DrawPoints item = good_points();
    item.point_size = size;
    check_refused({item}, "point_size must lie in 1..255, got " + std::to_string(size));
  }
  DrawPoints item = good_points();
  item.point_size = kMaxPointSize;
  check_accepted({item});
}

TEST_CASE("votes for another number of points are refused") {
  DrawPoints item = good_points();
  const std::vector<std::int8_t> votes(2);
  item.votes = votes;
  check_refused({item}, "2 votes were given for 3 points");
}

TEST_CASE("ids that overlap, descend or run out are refused") {
  check_refused({good_points(0), good_triangles(2)}, "item 1: ids must ascend");
  check_refused({good_points(7), good_triangles(0)}, "item 1: ids must ascend");
  check_refused({good_points(kNoPrimitive - 2)}, "ids must stay below 2^32 - 1");
  check_refused({good_triangles(kNoPrimitive - 1)}, "ids must stay below 2^32 - 1");
  check_accepted({good_points(0), good_triangles(3)});
  check_accepted({good_points(10), good_triangles(2'000'000'000)});
  check_accepted({good_points(kNoPrimitive - 3)});
  DrawPoints none = good_points(3);
  none.positions = {};
  check_accepted({good_points(0), none, good_triangles(3)});
}

TEST_CASE("a placement that is not finite or not affine is refused") {
  for (const double bad :
       {std::numeric_limits<double>::quiet_NaN(), std::numeric_limits<double>::infinity()}) {
    DrawPoints item = good_points();
    item.world_from_item[3][1] = bad;
    check_refused({item}, "world_from_item must be finite and affine");
  }
  for (int column = 0; column < 4; ++column) {
    DrawTriangles item = good_triangles();
    item.world_from_item[column][3] += 0.5;
    check_refused({item}, "world_from_item must be finite and affine");
  }
}

TEST_CASE("an image larger than max_extent is refused") {
  for (const Extent extent : {Extent{kMaxRasterExtent + 1, 2}, Extent{2, kMaxRasterExtent + 1}}) {
    check_refused({}, "must not exceed 8192 x 8192", lattice::view(extent));
  }
}

TEST_CASE("grids of another extent than the view are refused") {
  const Extent other{5, 6};
  const View view = lattice::view(kExtent);
  for (const Backend& backend : all_backends()) {
    CAPTURE(backend.name);
    const auto rasterizer = backend.make();
    Framebuffer image;
    Grid<PixelMoments> sums;
    DepthBand band = lattice::whole_band(kExtent);
    band.lower.reset(other);
    CHECK_THROWS_WITH(rasterizer->render_in_band(view, {}, band, image),
                      Contains("band.lower must have the view's extent 6 x 5, got 5 x 6"));
    band = lattice::whole_band(kExtent);
    band.upper.reset(other);
    CHECK_THROWS_WITH(rasterizer->render_in_band(view, {}, band, image), Contains("band.upper"));

    AccumulateWindow window = lattice::whole_window(kExtent, 0, 4);
    window.reference.reset(other);
    CHECK_THROWS_WITH(rasterizer->accumulate(view, {}, window, sums), Contains("reference"));
    window = lattice::whole_window(kExtent, 0, 4);
    window.band.lower.reset(other);
    CHECK_THROWS_AS(rasterizer->accumulate(view, {}, window, sums), InvalidArgument);
    window = lattice::whole_window(kExtent, 0, 4);
    window.band.upper.reset(other);
    CHECK_THROWS_AS(rasterizer->accumulate(view, {}, window, sums), InvalidArgument);
  }
}

TEST_CASE("a shift out of range, or too small for the band, is refused") {
  const View view = lattice::view(kExtent);
  for (const Backend& backend : all_backends()) {
    CAPTURE(backend.name);
    const auto rasterizer = backend.make();
    Grid<PixelMoments> sums;
    const auto accumulate = [&](const AccumulateWindow& window) {
      rasterizer->accumulate(view, {}, window, sums);
    };
    for (const int shift : {-1, 9}) {
      CHECK_THROWS_WITH(accumulate(lattice::whole_window(kExtent, 0, shift)),
                        Contains("shift must lie in 0..8"));
    }
    // Depths of 24 bits need 4 bits less; measured from the middle of the range, 3 and a unit.
    CHECK_THROWS_WITH(accumulate(lattice::whole_window(kExtent, 0, 3)), Contains("2^20"));
    CHECK_NOTHROW(accumulate(lattice::whole_window(kExtent, 0, 4)));
    constexpr std::int32_t kMiddle = 1 << 23;
    CHECK_THROWS_AS(accumulate(lattice::whole_window(kExtent, kMiddle, 3)), InvalidArgument);
    CHECK_NOTHROW(accumulate(lattice::whole_window(kExtent, kMiddle - 8, 4)));
    // One pixel is enough to be refused, and a pixel that takes nothing is not asked.
    AccumulateWindow window = lattice::whole_window(kExtent, kMiddle, 0);
    for (std::int32_t& lower : window.band.lower.pixels())
      lower = kMiddle - 100;
    for (std::int32_t& upper : window.band.upper.pixels())
      upper = kMiddle + 100;
    CHECK_NOTHROW(accumulate(window));
    window.reference[{2, 3}] = 0;
    CHECK_THROWS_WITH(accumulate(window), Contains("at pixel (2, 3)"));
    window.band.upper[{2, 3}] = 0;
    CHECK_NOTHROW(accumulate(window));
  }
}

}  // namespace
}  // namespace rangezip

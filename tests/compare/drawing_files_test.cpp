#include "compare/drawing_files.h"

#include <catch2/catch.hpp>
#include <cmath>
#include <limits>

#include "compare/difference_picture.h"
#include "compare/views_around.h"
#include "core/base/error.h"
#include "core/image/range_image.h"
#include "core/io/image_file.h"
#include "tests/core/io/temporary_folder.h"

using namespace rangezip;
using namespace rangezip::compare;
using namespace rangezip::test;
using Catch::Contains;

namespace {

/// One pixel drawn as ID 7 at unit 5, one at the last unit, the others cleared either way.
struct Files {
  TemporaryFolder folder;
  Grid<double> depth{Extent{2, 2}, kNoSample};
  Grid<PrimitiveId> ids{Extent{2, 2}, kNoPrimitive};

  Files() {
    depth[{0, 0}] = std::ldexp(5.0, -kDepthBits);
    ids[{0, 0}] = 7;
    depth[{1, 0}] = 1.0;
    ids[{1, 0}] = 8;
    depth[{0, 1}] = 1.0;
  }

  [[nodiscard]] Framebuffer read() const {
    write_pfm(folder / "d.pfm", depth);
    write_id_png(folder / "i.png", ids);
    return read_drawing(folder / "d.pfm", folder / "i.png");
  }
};

}  // namespace

TEST_CASE("a drawing on file has the units of a framebuffer, and nothing where it was cleared") {
  const Framebuffer drawing = Files().read();
  CHECK(drawing.depth[{0, 0}] == 5);
  CHECK(drawing.id[{0, 0}] == 7);
  CHECK(drawing.depth[{1, 0}] == kMaxDepth);
  for (const Pixel empty : {Pixel{0, 1}, Pixel{1, 1}}) {
    CHECK(drawing.depth[empty] == kNoDepth);
    CHECK(drawing.id[empty] == kNoPrimitive);
  }
}

TEST_CASE("a drawing on file with a depth out of range or another size is refused by its name") {
  for (const double wrong : {-0.25, 1.5, std::numeric_limits<double>::infinity()}) {
    Files files;
    files.depth[{1, 0}] = wrong;
    CHECK_THROWS_WITH(files.read(), Contains("d.pfm: pixel (1, 0)") && Contains("[0, 1]"));
  }
  Files files;
  files.ids = Grid<PrimitiveId>({3, 2}, kNoPrimitive);
  CHECK_THROWS_WITH(files.read(), Contains("d.pfm: must be of the size of") && Contains("3 x 2"));
}

TEST_CASE("every view around a box shows all of its corners in the middle") {
  Box bounds;
  bounds.add({-1, 2, 3});
  bounds.add({5, 2.5, 4});
  for (const Extent extent : {Extent{64, 64}, Extent{90, 30}, Extent{30, 90}}) {
    const std::vector<View> views = views_around(bounds, 26, extent);
    REQUIRE(views.size() == 26);
    for (const View& view : views) {
      Vec3 sum{0.0};
      for (int corner = 0; corner < 8; ++corner) {
        const Vec3 window = view.window_from_world(
            {(corner & 1) != 0 ? -1 : 5, (corner & 2) != 0 ? 2 : 2.5, (corner & 4) != 0 ? 3 : 4});
        CHECK((window.x > 0.0 && window.x < extent.width && window.y > 0.0 &&
               window.y < extent.height && window.z > 0.0 && window.z < 1.0));
        sum += window;
      }
      CHECK(sum.x / 8.0 == Approx(0.5 * extent.width));
      CHECK(sum.y / 8.0 == Approx(0.5 * extent.height));
    }
  }
  CHECK_THROWS_AS(views_around(Box{}, 1, {8, 8}), InvalidArgument);
  CHECK_THROWS_AS(views_around(bounds, 0, {8, 8}), InvalidArgument);
  CHECK_THROWS_AS(views_around(bounds, 1, {8, 0}), InvalidArgument);
}

TEST_CASE("in a picture of differences an unexplained pixel is red and an empty one white") {
  Framebuffer reference = make_framebuffer({3, 1});
  reference.depth[{1, 0}] = 0;
  Grid<std::uint8_t> causes({3, 1}, 0);
  causes[{2, 0}] = 1 + static_cast<std::uint8_t>(Cause::unexplained);
  const Grid<Rgb> picture = draw_differences(reference, causes);
  CHECK(picture[{0, 0}] == Rgb{255, 255, 255});
  CHECK((picture[{1, 0}][0] == picture[{1, 0}][1] && picture[{1, 0}][0] < 255));
  CHECK(picture[{2, 0}] == Rgb{230, 20, 20});
}

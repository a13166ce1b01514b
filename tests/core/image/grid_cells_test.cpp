#include "core/image/grid_cells.h"

#include <catch2/catch.hpp>

#include "tests/support/images.h"

namespace rangezip {
namespace {

TEST_CASE("the triangles of a cell run counter-clockwise and tile it", "[image]") {
  for (const std::uint8_t bits : {std::uint8_t{3}, std::uint8_t{7}}) {
    int area = 0;
    for (const std::uint8_t which : {kLowerTriangle, kUpperTriangle}) {
      const auto [a, b, c] = grid_triangle({4, 7}, bits, which);
      const int doubled = (b.x - a.x) * (c.y - a.y) - (b.y - a.y) * (c.x - a.x);
      CHECK(doubled == 1);
      area += doubled;
    }
    CHECK(area == 2);
  }
}

TEST_CASE("a cell needs three active corners with samples", "[image]") {
  for (unsigned present = 0; present < 16; ++present) {
    CAPTURE(present);
    const Extent extent{2, 2};
    RangeImage image = images::image_of(images::parallel_view(extent), [](Pixel) { return 1.0; });
    Mask active(extent, 1);
    int corners = 0;
    for (unsigned i = 0; i < 4; ++i) {
      const Pixel p{static_cast<int>(i % 2), static_cast<int>(i / 2)};
      if ((present >> i & 1U) != 0) {
        ++corners;
      } else if (i % 2 == 0) {
        active[p] = 0;
      } else {
        image[p] = kNoSample;
      }
    }
    int triangles = 0;
    for (int y = 0; y < 2; ++y) {
      for (int x = 0; x < 2; ++x) {
        int here = 0;
        for_each_triangle_at(build_grid_cells(image, active), {x, y}, [&](const auto&) { ++here; });
        triangles += here;
        const bool is_present = active[{x, y}] != 0 && image.has_sample({x, y});
        CHECK((here > 0) == (is_present && corners >= 3));
      }
    }
    CHECK(triangles == 3 * std::max(0, corners - 2));
  }
}

TEST_CASE("eye_position and the view agree", "[image]") {
  const Camera camera = look_at({3, -2, 5}, {0, 0.5, 0}, {0, 1, 0}, Perspective{.fov_y = 0.7});
  RangeImage image(View(camera, {64, 48}));
  image[{50, 7}] = 4.25;
  const Vec3 eye = eye_position(image, {50, 7});
  const Vec3 expected(camera.eye_from_world * Vec4(image.position({50, 7}), 1.0));
  CHECK(glm::length(eye - expected) < 1e-13);
}

}  // namespace
}  // namespace rangezip

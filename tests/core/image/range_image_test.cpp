#include "core/image/range_image.h"

#include <limits>

#include <catch2/catch.hpp>

#include "core/base/error.h"
#include "raster_cpu/cpu_rasterizer.h"
#include "tests/support/images.h"

namespace rangezip {
namespace {

/// A large triangle of the plane z = -(depth + slope . (x, y)).
TriangleSoup plane_triangle(double depth, const glm::dvec2& slope) {
  TriangleSoup soup;
  for (const glm::dvec2 p :
       {glm::dvec2{-200, -200}, glm::dvec2{600, -200}, glm::dvec2{-200, 600}}) {
    soup.positions.emplace_back(p.x, p.y, -(depth + glm::dot(slope, p)));
  }
  soup.triangles = {{0, 1, 2}};
  return soup;
}

DrawTriangles item_of(const TriangleSoup& soup, PrimitiveId first_id = 0) {
  return {.positions = soup.positions, .triangles = soup.triangles, .first_id = first_id};
}

TEST_CASE("a range image of triangles has the plane's depth at pixel centres", "[image]") {
  CpuRasterizer rasterizer;
  const glm::dvec2 slope{0.125, -0.0625};
  const TriangleSoup soup = plane_triangle(16.0, slope);
  const DrawItem item = item_of(soup);

  const View parallel = images::parallel_view({32, 24}, 0.5);
  const RangeImage flat =
      make_range_image(parallel, rasterizer.render(parallel, {&item, 1}), {&item, 1});
  for (int y = 0; y < 24; ++y) {
    for (int x = 0; x < 32; ++x) {
      const glm::dvec2 at{(x + 0.5 - 16) * 0.5, (y + 0.5 - 12) * 0.5};
      // Rounding of some twenty operations on numbers below 2^10 with the plane's exact corners.
      REQUIRE(std::abs(flat[{x, y}] - (16.0 + glm::dot(slope, at))) < 1e-11);
    }
  }

  const View central = images::central_view({32, 24});
  const RangeImage deep =
      make_range_image(central, rasterizer.render(central, {&item, 1}), {&item, 1});
  for (int y = 0; y < 24; ++y) {
    for (int x = 0; x < 32; ++x) {
      // On the ray (u, v, -1) t the plane is met at t = 16 / (1 - slope . (u, v)).
      const glm::dvec2 ray{(x + 0.5 - 16) / 24.0, (y + 0.5 - 12) / 24.0};
      REQUIRE(std::abs(deep[{x, y}] - 16.0 / (1.0 - glm::dot(slope, ray))) < 1e-10);
    }
  }
}

TEST_CASE("a range image of points has their own depth, without depth steps", "[image]") {
  CpuRasterizer rasterizer;
  shapes::Random random(1);
  PointCloud cloud;
  for (int i = 0; i < 2000; ++i) {
    cloud.positions.push_back(
        {random.between(-16, 16), random.between(-12, 12), -random.between(2, 60)});
  }
  const DrawItem item = DrawPoints{.positions = cloud.positions, .first_id = 7};
  for (const View& view : {images::parallel_view({32, 24}), images::central_view({32, 24})}) {
    const Framebuffer drawn = rasterizer.render(view, {&item, 1});
    const RangeImage image = make_range_image(view, drawn, {&item, 1});
    for (std::size_t i = 0; i < drawn.id.pixels().size(); ++i) {
      const PrimitiveId id = drawn.id.pixels()[i];
      const double depth = image.depth().pixels()[i];
      if (id == kNoPrimitive) {
        REQUIRE(depth == kNoSample);
      } else {
        REQUIRE(depth == -static_cast<double>(cloud.positions[id - 7].z));
      }
    }
  }
}

TEST_CASE("several items resolve by their own IDs and placements", "[image]") {
  CpuRasterizer rasterizer;
  PointCloud near;
  near.positions = {{0.5F, 0.5F, -1.0F}};
  const TriangleSoup far = plane_triangle(30.0, {0, 0});
  const std::vector<DrawItem> items{DrawPoints{.positions = {}, .first_id = 0},
                                    DrawPoints{.positions = near.positions,
                                               .world_from_item = shapes::translation({0, 0, -4}),
                                               .first_id = 0},
                                    DrawPoints{.positions = {}, .first_id = 1}, item_of(far, 100)};
  const View view = images::parallel_view({8, 8});
  const Framebuffer drawn = rasterizer.render(view, items);
  const RangeImage image = make_range_image(view, drawn, items);
  CHECK(image[{4, 4}] == 5.0);
  CHECK(image[{3, 4}] == 30.0);

  Framebuffer unknown = drawn;
  unknown.id[{2, 2}] = 50;
  CHECK_THROWS_AS(make_range_image(view, unknown, items), InvalidArgument);
  CHECK_THROWS_AS(make_range_image(images::parallel_view({9, 8}), drawn, items), InvalidArgument);
}

TEST_CASE("a triangle seen on edge keeps a depth of its own", "[image]") {
  TriangleSoup soup;
  // In a plane that holds the line of sight, so no plane depth exists; the resolver is asked
  // directly, since such a triangle has no pixels.
  soup.positions = {{0, -3, -10}, {0, 3, -10}, {0, 0, -20}};
  soup.triangles = {{0, 1, 2}};
  const DrawItem item = item_of(soup);
  Framebuffer drawn = make_framebuffer({8, 8});
  drawn.id[{4, 4}] = 0;
  const RangeImage image = make_range_image(images::parallel_view({8, 8}), drawn, {&item, 1});
  CHECK(image[{4, 4}] >= 10.0);
  CHECK(image[{4, 4}] <= 20.0);
}

TEST_CASE("a range image refuses depths that are none", "[image]") {
  const View view = images::parallel_view({4, 3});
  CHECK_THROWS_AS(RangeImage(view, Grid<double>(Extent{3, 4})), InvalidArgument);
  Grid<double> depth(view.extent(), kNoSample);
  CHECK_NOTHROW(RangeImage(view, depth));
  depth[{1, 1}] = std::numeric_limits<double>::quiet_NaN();
  CHECK_THROWS_AS(RangeImage(view, depth), InvalidArgument);
  depth[{1, 1}] = -std::numeric_limits<double>::infinity();
  CHECK_THROWS_AS(RangeImage(view, depth), InvalidArgument);
}

TEST_CASE("estimate_slopes finds the slope of planes and is not fooled by steps", "[image]") {
  const double size = 0.25;
  const View view = images::parallel_view({16, 12}, size, 1000.0);
  const RangeImage image = images::image_of(view, [&](Pixel p) {
    if (p == Pixel{5, 5}) return kNoSample;
    return (p.x < 8 ? 100.0 : 300.0) + size * (1.5 * p.x - 0.75 * p.y);
  });
  const SlopeImage slopes = estimate_slopes(image);
  for (int y = 0; y < 12; ++y) {
    for (int x = 0; x < 16; ++x) {
      const glm::dvec2 expected = x == 5 && y == 5 ? glm::dvec2{0, 0} : glm::dvec2{1.5, -0.75};
      REQUIRE(slopes[{x, y}] == expected);
    }
  }
}

TEST_CASE("estimate_slopes halves where the sides disagree, and clamps", "[image]") {
  const View view = images::parallel_view({3, 1});
  const auto slope_of = [&](double a, double b, double c) {
    RangeImage image(view, Grid<double>(view.extent()));
    image[{0, 0}] = a;
    image[{1, 0}] = b;
    image[{2, 0}] = c;
    return estimate_slopes(image)[{1, 0}].x;
  };
  CHECK(slope_of(10, 11, 13) == 1.0);
  CHECK(slope_of(13, 11, 10) == -1.0);
  CHECK(slope_of(10, 11, 9) == 0.5);   // +1 and -2
  CHECK(slope_of(9, 11, 10) == -0.5);  // +2 and -1
  CHECK(slope_of(10, 11, 10) == 0.0);  // a ridge
  CHECK(slope_of(10, 30, 60) == kMaxSlope);
  CHECK(slope_of(60, 30, 10) == -kMaxSlope);
  CHECK(slope_of(kNoSample, 11, 13) == 2.0);
  CHECK(slope_of(10, 11, kNoSample) == 1.0);
  CHECK(slope_of(kNoSample, 11, kNoSample) == 0.0);
}

TEST_CASE("estimate_slopes of a mirrored image has the opposite slopes along x", "[image]") {
  const RangeImage image = images::rough_image({41, 30}, 5);
  const SlopeImage slopes = estimate_slopes(image);
  const SlopeImage mirrored = estimate_slopes(images::mirrored(image));
  for (int y = 0; y < 30; ++y) {
    for (int x = 0; x < 41; ++x) {
      const glm::dvec2 there = mirrored[{40 - x, y}];
      REQUIRE(slopes[{x, y}] == glm::dvec2(-there.x, there.y));
    }
  }
}

}  // namespace
}  // namespace rangezip

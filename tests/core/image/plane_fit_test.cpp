#include "core/image/plane_fit.h"

#include <catch2/catch.hpp>

#include "core/base/error.h"
#include "raster_cpu/cpu_rasterizer.h"
#include "tests/support/images.h"

namespace rangezip {
namespace {

constexpr double kFarDepth = 64.0;
constexpr double kQuantum = kFarDepth / 16777216.0;  ///< one depth unit of the parallel view

struct ScannedCloud {
  PointCloud cloud;
  std::vector<std::int8_t> votes;
  View view;
  Framebuffer drawn;

  PlaneFitResult fit(const PlaneFitOptions& options = {}) {
    CpuRasterizer rasterizer;
    const DrawItem drawn_item = item();
    return fit_planes(rasterizer, {&drawn_item, 1}, drawn, nearest(), estimate_slopes(nearest()),
                      options);
  }
  DrawItem item() const { return DrawPoints{.positions = cloud.positions, .votes = votes}; }
  RangeImage nearest() const {
    const DrawItem drawn_item = item();
    return make_range_image(view, drawn, {&drawn_item, 1});
  }
  void scan() {
    const DrawItem drawn_item = item();
    drawn = CpuRasterizer().render(view, {&drawn_item, 1});
  }
};

/// Points drawn at random, `per_pixel` in the mean, on the plane of eye depth 20 + slope . (x, y).
ScannedCloud random_plane(const View& view, const glm::dvec2& slope, double per_pixel,
                          std::uint64_t seed, double noise = 0.0) {
  ScannedCloud scanned{.view = view};
  shapes::Random random(seed);
  const double half_width = 0.6 * view.extent().width * view.pixel_size(30.0);
  const double half_height = 0.6 * view.extent().height * view.pixel_size(30.0);
  const double count = per_pixel * static_cast<double>(view.extent().count()) * 1.44;
  for (int i = 0; i < static_cast<int>(count); ++i) {
    const glm::dvec2 p{random.between(-half_width, half_width),
                       random.between(-half_height, half_height)};
    scanned.cloud.positions.emplace_back(p.x, p.y,
                                         -(20.0 + glm::dot(slope, p) + noise * random.normal()));
  }
  scanned.scan();
  return scanned;
}

TEST_CASE("fit_planes puts samples of a scanned tilted plane onto it", "[image]") {
  const Extent extent{48, 40};
  const View view = images::parallel_view(extent, 0.5, kFarDepth);
  for (const glm::dvec2 slope : {glm::dvec2{0, 0}, glm::dvec2{0.5, -0.25}, glm::dvec2{1.0, 0.75}}) {
    CAPTURE(slope.x, slope.y);
    ScannedCloud scanned = random_plane(view, slope, 6.0, 11);
    const PlaneFitResult result = scanned.fit({.slope_ridge = 0.0});
    CHECK(result.inside == 0);
    CHECK(result.unsupported == 0);
    // Positions are rounded to 1/256 px (half of it is 1/512) and depths to a quantum; on a plane
    // fitted to many points both average out, but no sample may be farther away than one point's
    // rounding, amplified by extrapolation from the points to the centre (below 4 here).
    const double bound =
        4.0 * (kQuantum + 0.5 / 512.0 * (std::abs(slope.x) + std::abs(slope.y)) + 1e-6);
    for (int y = 1; y + 1 < extent.height; ++y) {
      for (int x = 1; x + 1 < extent.width; ++x) {
        const Pixel p{x, y};
        if (!result.image.has_sample(p)) continue;
        const glm::dvec2 at{(x + 0.5 - 24) * 0.5, (y + 0.5 - 20) * 0.5};
        const double error = result.image[p] - (20.0 + glm::dot(slope, at));
        REQUIRE(std::abs(error) < bound);
      }
    }
  }
}

TEST_CASE("points on the pixel grid give the plane exact to the depth quantum", "[image]") {
  // Points at multiples of 1/256 px: no rounding of positions, only of depths.
  const Extent extent{32, 32};
  ScannedCloud scanned{.view = images::parallel_view(extent, 1.0, kFarDepth)};
  shapes::Random random(3);
  for (int i = 0; i < 8000; ++i) {
    const double x = static_cast<double>(random.bits() % 8192) / 256.0 - 16.0;
    const double y = static_cast<double>(random.bits() % 8192) / 256.0 - 16.0;
    scanned.cloud.positions.emplace_back(x, y, -(20.0 + 0.5 * x - 0.25 * y));
  }
  scanned.scan();
  const PlaneFitResult result = scanned.fit({.slope_ridge = 0.0});
  int fitted = 0;
  for (int y = 1; y + 1 < extent.height; ++y) {
    for (int x = 1; x + 1 < extent.width; ++x) {
      const double expected = 20.0 + 0.5 * (x - 15.5) - 0.25 * (y - 15.5);
      if (!result.image.has_sample({x, y})) continue;
      ++fitted;
      // Depths here are multiples of 2^-10 of the range's 2^-24 units: Z is exact, so the fit is
      // exact but for double rounding, unless the points lie on a line (not so here).
      REQUIRE(std::abs(result.image[{x, y}] - expected) < kQuantum);
      REQUIRE(glm::length(result.slopes[{x, y}] - glm::dvec2{0.5, -0.25}) < 1e-6);
    }
  }
  CHECK(fitted > 850);
}

TEST_CASE("the nearest points are biased towards the viewer, the planes are not", "[image]") {
  const Extent extent{100, 100};
  const glm::dvec2 slope{0.7, 0.4};
  for (std::uint64_t seed = 1; seed <= 3; ++seed) {
    CAPTURE(seed);
    ScannedCloud scanned =
        random_plane(images::parallel_view(extent, 1.0 / 4, kFarDepth), slope, 3.0, seed);
    const RangeImage nearest = scanned.nearest();
    const PlaneFitResult result = scanned.fit();
    double nearest_bias = 0.0;
    double plane_bias = 0.0;
    double plane_error = 0.0;
    int count = 0;
    for (int y = 2; y < 98; ++y) {
      for (int x = 2; x < 98; ++x) {
        if (!nearest.has_sample({x, y})) continue;
        const glm::dvec2 at{(x + 0.5 - 50) / 4, (y + 0.5 - 50) / 4};
        const double truth = 20.0 + glm::dot(slope, at);
        nearest_bias += nearest[{x, y}] - truth;
        plane_bias += result.image[{x, y}] - truth;
        plane_error += std::abs(result.image[{x, y}] - truth);
        ++count;
      }
    }
    const double pixel = 1.0 / 4;
    // Three points a pixel on a slope sum of 1.1: their nearest lies about a quarter pixel in
    // front.
    CHECK(nearest_bias / count < -0.15 * pixel);
    CHECK(std::abs(plane_bias / count) < 0.01 * pixel);
    CHECK(plane_error / count < 0.03 * pixel);
  }
}

TEST_CASE("fit_planes averages noise and keeps to the front sheet", "[image]") {
  const Extent extent{60, 60};
  ScannedCloud scanned =
      random_plane(images::parallel_view(extent, 0.5, kFarDepth), {0.3, 0.0}, 8.0, 5, 0.05);
  // A second sheet five pixel sides behind the first.
  for (const Vec3f p : std::vector<Vec3f>(scanned.cloud.positions)) {
    scanned.cloud.positions.push_back(p + Vec3f{0.01F, 0.02F, -2.5F});
  }
  scanned.scan();
  const PlaneFitResult result = scanned.fit();
  double squared = 0.0;
  int count = 0;
  for (int y = 2; y < 58; ++y) {
    for (int x = 2; x < 58; ++x) {
      const double truth = 20.0 + 0.3 * (x + 0.5 - 30) * 0.5;
      if (!result.image.has_sample({x, y}) || result.image[{x, y}] > truth + 1.2) continue;
      squared += (result.image[{x, y}] - truth) * (result.image[{x, y}] - truth);
      ++count;
    }
  }
  CHECK(count > 3000);
  // Below the deviation of a single point, 0.05; the nearest of eight has 0.07 of bias alone.
  CHECK(std::sqrt(squared / count) < 0.03);
}

TEST_CASE("fit_planes works in window space under perspective", "[image]") {
  const Extent extent{64, 48};
  ScannedCloud scanned =
      random_plane(images::central_view(extent, 4.0, 64.0), {0.3, -0.2}, 30.0, 17);
  const PlaneFitResult result = scanned.fit({.slope_ridge = 0.0});
  double bias = 0.0;
  int count = 0;
  for (int y = 2; y < 46; ++y) {
    for (int x = 2; x < 62; ++x) {
      if (!result.image.has_sample({x, y})) continue;
      const glm::dvec2 ray{(x + 0.5 - 32) / 48.0, (y + 0.5 - 24) / 48.0};
      const double truth = 20.0 / (1.0 - glm::dot(glm::dvec2{0.3, -0.2}, ray));
      // A pixel is 20/48 here; positions round to 1/512 of it, depths to 4e-6 of 20^2 * 15/60.
      REQUIRE(std::abs(result.image[{x, y}] - truth) < 0.01);
      bias += result.image[{x, y}] - truth;
      ++count;
    }
  }
  CHECK(count > 2000);
  CHECK(std::abs(bias / count) < 2e-4);
}

TEST_CASE("fit_planes shifts depths of a shallow range without a bias", "[image]") {
  // Pixels of 1/2 in a depth range of 3: a window of up to 3.5 pixel sides is more than 2^20 units.
  const Extent extent{40, 40};
  ScannedCloud scanned{
      .view =
          View(Camera{.lens = Orthographic{.height = 20.0}, .near_depth = 19.0, .far_depth = 22.0},
               extent)};
  shapes::Random random(8);
  for (int i = 0; i < 9000; ++i) {
    const double x = random.between(-10, 10);
    scanned.cloud.positions.emplace_back(x, random.between(-10, 10), -(20.5 + 0.125 * x));
  }
  scanned.scan();
  const PlaneFitResult result = scanned.fit({.slope_ridge = 0.0});
  double bias = 0.0;
  int count = 0;
  for (int y = 1; y < 39; ++y) {
    for (int x = 1; x < 39; ++x) {
      if (!result.image.has_sample({x, y})) continue;
      bias += result.image[{x, y}] - (20.5 + 0.125 * (x + 0.5 - 20) * 0.5);
      ++count;
    }
  }
  // Far below the 1/512 px of a position on this slope, 1.2e-4.
  CHECK(std::abs(bias / count) < 2e-5);
}

TEST_CASE("fit_planes removes pixels whose votes look away", "[image]") {
  const Extent extent{20, 20};
  ScannedCloud scanned =
      random_plane(images::parallel_view(extent, 1.0, kFarDepth), {0, 0}, 6.0, 2);
  const RangeImage nearest = scanned.nearest();
  for (const Vec3f& p : scanned.cloud.positions) {
    scanned.votes.push_back(p.x < 0.0F ? std::int8_t{-3} : std::int8_t{3});
  }
  const PlaneFitResult result = scanned.fit();
  std::size_t lost = 0;
  for (int y = 0; y < 20; ++y) {
    for (int x = 0; x < 20; ++x) {
      if (!nearest.has_sample({x, y})) continue;
      lost += result.image.has_sample({x, y}) ? 0 : 1;
      if (x < 9) REQUIRE_FALSE(result.image.has_sample({x, y}));
      if (x > 10) REQUIRE(result.image.has_sample({x, y}));
    }
  }
  CHECK(result.inside == lost);
  for (std::int8_t& vote : scanned.votes)
    vote = 0;
  CHECK(scanned.fit().inside == 0);
}

TEST_CASE("fit_planes leaves pixels of triangles alone", "[image]") {
  const TriangleSoup soup = shapes::sphere(8.0, 24);
  const DrawItem item = DrawTriangles{.positions = soup.positions,
                                      .triangles = soup.triangles,
                                      .world_from_item = shapes::translation({0, 0, -20})};
  CpuRasterizer rasterizer;
  const View view = images::parallel_view({40, 40}, 0.5);
  const Framebuffer drawn = rasterizer.render(view, {&item, 1});
  const RangeImage image = make_range_image(view, drawn, {&item, 1});
  const SlopeImage slopes = estimate_slopes(image);
  const PlaneFitResult result = fit_planes(rasterizer, {&item, 1}, drawn, image, slopes);
  CHECK(images::sample_count(image) > 700);
  CHECK(result.image == image);
  CHECK(result.slopes == slopes);
}

TEST_CASE("fit_planes refuses images that do not belong together", "[image]") {
  ScannedCloud scanned =
      random_plane(images::parallel_view({20, 20}, 1.0, kFarDepth), {0, 0}, 2.0, 2);
  CpuRasterizer rasterizer;
  const DrawItem item = scanned.item();
  const RangeImage nearest = scanned.nearest();
  CHECK_THROWS_AS(
      fit_planes(rasterizer, {&item, 1}, scanned.drawn, nearest, SlopeImage(Extent{3, 3})),
      InvalidArgument);
  CHECK_THROWS_AS(fit_planes(rasterizer, {}, scanned.drawn, nearest, estimate_slopes(nearest)),
                  InvalidArgument);
}

}  // namespace
}  // namespace rangezip

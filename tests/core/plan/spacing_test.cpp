#include "core/plan/spacing.h"

#include <algorithm>
#include <catch2/catch.hpp>
#include <cmath>
#include <numbers>

#include "core/base/error.h"
#include "tests/support/shapes.h"

namespace rangezip {
namespace {

/// A square lattice of side * side points in the plane z = 0, `step` apart.
std::vector<Vec3> lattice(int side, double step) {
  std::vector<Vec3> points;
  for (int y = 0; y < side; ++y) {
    for (int x = 0; x < side; ++x)
      points.emplace_back(x * step, y * step, 0.0);
  }
  return points;
}

std::vector<Vec3> rotated(std::vector<Vec3> points) {
  const Mat3 rotation(shapes::tilt());
  for (Vec3& p : points)
    p = rotation * p;
  return points;
}

}  // namespace

TEST_CASE("estimate_spacing of a square lattice is the closed form") {
  // Within the lattice the 16th neighbour lies at sqrt(5) steps (4 at 1, 4 at sqrt 2, 4 at 2, 8 at
  // sqrt 5), so the spacing reads sqrt(5) sqrt(pi / 16) = 0.991 steps.
  for (const double step : {1.0, 0.003, 5e4}) {
    CAPTURE(step);
    const Spacing spacing = estimate_spacing(lattice(150, step));
    const double expected = step * std::sqrt(5.0 * std::numbers::pi / 16.0);
    CHECK(spacing.median == Approx(expected).epsilon(1e-12));
    CHECK(spacing.quantile75 == Approx(expected).epsilon(1e-12));
    CHECK(spacing.noise == 0.0);
    const Spacing turned = estimate_spacing(rotated(lattice(150, step)));
    CHECK(turned.median == Approx(expected).epsilon(1e-12));
    CHECK(turned.noise < 1e-7 * step);
  }
}

TEST_CASE("a pixel is chosen for the sparse part of an uneven cloud, not for outliers") {
  // A sixteenth of the points, as far apart as four others, on as much surface beside them.
  std::vector<Vec3> points = lattice(400, 1.0);
  for (const Vec3& p : lattice(100, 4.0))
    points.push_back(p - Vec3(500.0, 0.0, 0.0));
  const Spacing uneven = estimate_spacing(points);
  const double expected = std::sqrt(5.0 * std::numbers::pi / 16.0);
  CHECK(uneven.median == Approx(expected));
  CHECK(uneven.quantile75 == Approx(expected));
  CHECK(uneven.sparse == Approx(4.0 * expected));
  CHECK(pixel_size_from_spacing(uneven) == Approx((1.3 + 1.45 * (4.0 - 1.25)) * expected));

  std::vector<Vec3> with_outliers = lattice(400, 1.0);
  shapes::Random random(7);
  for (int i = 0; i < 3000; ++i)
    with_outliers.push_back(400.0 * Vec3{random.unit(), random.unit(), 0.05 + random.unit()});
  const Spacing even = estimate_spacing(with_outliers);
  CHECK(even.sparse < 1.5 * expected);
  CHECK(pixel_size_from_spacing(even) == Approx(2.2 * expected).epsilon(0.05));
}

TEST_CASE("a pixel is chosen for a scan beside a far denser one, noisy or not") {
  // On as much surface, one point of 65, of which 300 points spread over the cloud have five.
  const double noise = GENERATE(0.0, 0.25);  // of its spacing
  const std::uint64_t seed = GENERATE(range<std::uint64_t>(1, 4));
  CAPTURE(noise, seed);
  shapes::Random random(seed);
  std::vector<Vec3> points = lattice(400, 1.0);
  for (const Vec3& p : lattice(50, 8.0)) {
    const double height = noise * 8.0 * std::sqrt(12.0) * (random.unit() - 0.5);
    points.push_back(p - Vec3(500.0, 0.0, height));
  }
  const Spacing spacing = estimate_spacing(points);
  const double expected = std::sqrt(5.0 * std::numbers::pi / 16.0);
  CHECK(spacing.median == Approx(expected));
  CHECK(spacing.sparse == Approx(8.0 * expected).epsilon(0.1));
  CHECK(is_uneven(spacing));
}

TEST_CASE("a cloud whose density falls evenly is given pixels for its sparse end") {
  const std::uint64_t seed = GENERATE(range<std::uint64_t>(1, 6));
  const double ratio = GENERATE(1.0, 5.0, 10.0);
  CAPTURE(seed, ratio);
  shapes::Random random(seed);
  std::vector<Vec3> points;
  for (int i = 0; i < 20'000; ++i) {  // of a density of ratio^x, by the inverse of its sum
    const double u = random.unit();
    const double x = ratio > 1.0 ? std::log1p(u * (ratio - 1.0)) / std::log(ratio) : u;
    points.emplace_back(x, random.unit(), 0.0);
  }
  const Spacing spacing = estimate_spacing(points);
  const double total = ratio > 1.0 ? (ratio - 1.0) / std::log(ratio) : 1.0;
  const auto spacing_at = [&](double x) {
    return std::sqrt(total / 20'000.0 / std::pow(ratio, x));
  };
  CHECK(spacing.sparse > 0.95 * spacing_at(0.1));
  CHECK(spacing.sparse < 1.25 * spacing_at(0.1));  // it varies by chance
  CHECK(pixel_size_from_spacing(spacing) > 1.15 * spacing_at(0.1));
  CHECK(pixel_size_from_spacing(spacing) < 1.75 * spacing_at(0.1));
  CHECK(is_uneven(spacing) == (ratio > 1.0));
}

TEST_CASE("no outliers make a cloud uneven, near its surface or far from it") {
  // Of those near it, all neighbours are one spot of the surface: they lie in a plane with it.
  const std::uint64_t seed = GENERATE(range<std::uint64_t>(1, 11));
  const double height = GENERATE(10.0, 40.0, 200.0);
  const int share = GENERATE(8, 20, 100);  // one in so many
  CAPTURE(seed, height, share);
  std::vector<Vec3> points = lattice(300, 1.0);
  const double pixel = pixel_size_from_spacing(estimate_spacing(points));
  shapes::Random random(seed);
  const std::size_t count = points.size() / static_cast<std::size_t>(share);
  for (std::size_t i = 0; i < count; ++i) {
    points.push_back({300.0 * random.unit(), 300.0 * random.unit(), height * random.unit()});
  }
  CHECK(pixel_size_from_spacing(estimate_spacing(points)) == Approx(pixel).epsilon(0.25));
}

TEST_CASE("points that a depth camera sees past an object's outline do not make a cloud uneven") {
  // Thirty cameras around a sphere; each sees points between its outline and what is behind it.
  const std::uint64_t seed = GENERATE(range<std::uint64_t>(1, 6));
  CAPTURE(seed);
  std::vector<Vec3> points =
      shapes::to_points(shapes::sampled(shapes::sphere(1.0, 64), 100'000, seed));
  const double sparse = estimate_spacing(points).sparse;
  shapes::Random random(seed);
  for (int camera = 0; camera < 30; ++camera) {
    const Vec3 away = random.direction();
    for (int i = 0; i < 500; ++i) {
      const Vec3 outline = glm::normalize(glm::cross(away, random.direction()));
      const double share = random.unit();
      points.push_back(outline + 2.0 * share * share * away);
    }
  }
  const Spacing spacing = estimate_spacing(points);
  CHECK(spacing.sparse == Approx(sparse).epsilon(0.25));
  CHECK_FALSE(is_uneven(spacing));
}

TEST_CASE("estimate_spacing is one over the root of the density of a random cloud") {
  for (std::uint64_t seed = 1; seed <= 5; ++seed) {
    CAPTURE(seed);
    const std::size_t count = 60'000;
    const TriangleSoup soup = shapes::torus();
    const auto points = shapes::to_points(shapes::sampled(soup, count, seed));
    const Spacing spacing = estimate_spacing(points);
    const double expected = std::sqrt(shapes::area_of(soup) / static_cast<double>(count));
    // 16 points in a disc: its radius scatters by 1 / (2 sqrt 16) = 12.5 % and its median is near
    // the mean; the median of 300 scatters by 1.25 * 12.5 % / sqrt(300) = 0.9 %; five of them.
    CHECK(spacing.median == Approx(expected).epsilon(0.05));
    // The upper quartile of such a scatter lies 0.67 deviations higher.
    CHECK(spacing.quantile75 / spacing.median == Approx(1.0 + 0.67 * 0.125).epsilon(0.05));
  }
}

TEST_CASE("estimate_spacing does not see exact duplicates") {
  const std::vector<Vec3> once = rotated(lattice(100, 1.0));
  std::vector<Vec3> thrice;
  for (const Vec3& p : once)
    thrice.insert(thrice.end(), 3, p);
  CHECK(estimate_spacing(thrice).median == Approx(estimate_spacing(once).median).epsilon(1e-12));

  // Scanners write what they did not see as the origin.
  std::vector<Vec3> with_origin = once;
  with_origin.insert(with_origin.end(), 30'000, Vec3(0.0));
  CHECK(estimate_spacing(with_origin).median ==
        Approx(estimate_spacing(once).median).epsilon(1e-12));
}

TEST_CASE("estimate_spacing measures noise across the surface") {
  const double sigma = 0.002;
  const TriangleSoup soup = shapes::sphere(1.0, 128);
  const auto points = shapes::to_points(shapes::sampled(soup, 100'000, 3, sigma));
  const Spacing spacing = estimate_spacing(points);  // 0.0112: six times the noise
  // The estimate is unbiased in the square; its median over 300 discs with 14 degrees of freedom
  // lies 2.4 % below, and scatters by 24 % / sqrt(300) = 1.4 %. The plane of 17 points in 3D takes
  // the least spread, which costs some more.
  CHECK(spacing.noise == Approx(sigma).epsilon(0.15));
}

TEST_CASE("estimate_spacing measures noise that is wider than the nearest points reach") {
  // Of that noise the nearest 16 points fill a ball that shows hardly half of it.
  const std::size_t count = 160'000;
  const double step = 1.0 / std::sqrt(static_cast<double>(count));
  for (const double sigma : {2.0 * step, 4.0 * step, 8.0 * step}) {
    CAPTURE(sigma / step);
    shapes::Random random(11);
    std::vector<Vec3> points;
    for (std::size_t i = 0; i < count; ++i) {
      double height = 0.0;  // nearly Gaussian
      for (int k = 0; k < 12; ++k)
        height += sigma * random.between(-0.5, 0.5);
      points.push_back({random.between(0.0, 1.0), random.between(0.0, 1.0), height});
    }
    const Spacing spacing = estimate_spacing(rotated(std::move(points)));
    CHECK(spacing.noise == Approx(sigma).epsilon(0.1));
    CHECK(spacing.near_noise < 0.75 * sigma);
    CHECK(pixel_size_from_spacing(spacing) >= 2.2 * sigma);
  }
}

TEST_CASE("estimate_spacing does not take the other side of a thin wall for noise") {
  // Two sheets of random points: among 16 neighbours, in a disc of a radius of 2.3 spacings, some
  // are on the other sheet.
  const std::size_t count = 20'000;  // a sheet, 1 across
  const double step = 1.0 / std::sqrt(static_cast<double>(count));
  for (const double sigma : {0.0, 0.1 * step}) {
    for (const double thickness : {1.6 * step, 2.0 * step, 2.5 * step}) {
      CAPTURE(sigma / step, thickness / step);
      shapes::Random random(7);
      std::vector<Vec3> points;
      for (std::size_t i = 0; i < 2 * count; ++i) {
        const double height = i % 2 == 0 ? 0.0 : thickness;
        const double noise = sigma * std::sqrt(3.0) * random.between(-1.0, 1.0);
        points.push_back({random.between(0.0, 1.0), random.between(0.0, 1.0), height + noise});
      }
      const double noise = estimate_spacing(rotated(std::move(points))).noise;
      CHECK(noise == Approx(sigma).epsilon(0.25).margin(1e-9));
    }
  }
}

TEST_CASE(
    "pixel_size_from_spacing closes the sheet of a dense cloud and keeps the shape of a sparse "
    "one") {
  const auto size = [](double diagonal, double noise, double wide_noise = 0.0) {
    return pixel_size_from_spacing({.median = 1.0,
                                    .quantile75 = 1.5,
                                    .near_noise = noise,
                                    .noise = std::max(noise, wide_noise),
                                    .diagonal = diagonal});
  };
  const double mean = 1.25;
  CHECK(size(1000.0, 0.0) == Approx(2.2 * mean));
  CHECK(size(250.0 * 2.0 * mean, 0.0) == Approx(2.0 * mean));  // 250 pixels across
  CHECK(size(10.0, 0.0) == Approx(1.3 * mean));
  CHECK(size(1000.0, 2.0) == 8.0);  // four times the noise, dense or sparse
  CHECK(size(10.0, 2.0) == 8.0);
  CHECK(size(1000.0, 2.0, 4.0) == 10.0);  // two and a half times what neighbours do not show
  CHECK(closed_sheet_pixel_size({.median = 1.0, .quantile75 = 1.5, .diagonal = 10.0}) ==
        Approx(2.2 * mean));
}

/// Lines of points `gap` apart in the plane z = 0, one point in every `step` along them.
std::vector<Vec3> lines(int count, double gap, double step) {
  std::vector<Vec3> points;
  shapes::Random random(4);
  for (int line = 0; line < count; ++line) {
    const int along = static_cast<int>(count * gap / step);
    for (int i = 0; i < along; ++i)
      points.emplace_back((i + random.between(0.0, 1.0)) * step, line * gap, 0.0);
  }
  return points;
}

TEST_CASE("estimate_spacing of a cloud of contours tells the gap between them and its density") {
  for (const double step : {0.02, 0.1, 0.25}) {
    CAPTURE(step);
    const Spacing spacing = estimate_spacing(rotated(lines(40, 1.0, step)));
    // The nearest point of the next line is at most a step off the foot of the perpendicular; at
    // the first and last line there is no other side, and the far ones do not count.
    CHECK(spacing.gap >= Approx(1.0));
    CHECK(spacing.gap < std::sqrt(1.0 + step * step));
    // A fifth neighbour is 2.5 steps away on average, and scatters by half a step.
    CHECK(spacing.median == Approx(std::sqrt(step)).epsilon(0.2));
    CHECK(pixel_size_from_spacing(spacing) >= spacing.gap);
    CHECK(closed_sheet_pixel_size(spacing) >= 1.5 * spacing.gap);
  }
}

TEST_CASE("estimate_spacing takes no evenly spread cloud for contours") {
  CHECK(estimate_spacing(rotated(lattice(80, 1.0))).gap == 0.0);
  CHECK(estimate_spacing(lines(60, 1.0, 0.8)).gap == 0.0);
  const Spacing line = estimate_spacing(lines(1, 100.0, 0.1));
  CHECK(line.gap == 0.0);
  CHECK(line.median > 0.0);
  std::vector<Vec3> oblong = lattice(80, 1.0);
  for (Vec3& p : oblong)
    p.y *= 2.0;
  CHECK(estimate_spacing(rotated(oblong)).gap == 0.0);
  for (const TriangleSoup& soup : {shapes::sphere(), shapes::torus(), shapes::plate(0.01)}) {
    const auto points = shapes::to_points(shapes::sampled(soup, 20'000));
    CHECK(estimate_spacing(points).gap == 0.0);
  }
}

TEST_CASE("estimate_spacing works with as few as three points") {
  const std::vector<Vec3> three{{0, 0, 0}, {1, 0, 0}, {0, 1, 0}};
  const Spacing spacing = estimate_spacing(three);
  // Two neighbours each: sqrt(pi / 2) times 1, sqrt 2, sqrt 2.
  CHECK(spacing.median == Approx(std::sqrt(2.0) * std::sqrt(std::numbers::pi / 2.0)));
  CHECK(spacing.noise == 0.0);
}

TEST_CASE("estimate_spacing refuses fewer than three distinct points") {
  const std::vector<Vec3> equal(100, Vec3(1.0, 2.0, 3.0));
  std::vector<Vec3> two = equal;
  two[50] = Vec3(0.0);
  two[99] = Vec3(0.0);
  CHECK_THROWS_AS(estimate_spacing({}), InvalidArgument);
  CHECK_THROWS_AS(estimate_spacing(equal), InvalidArgument);
  CHECK_THROWS_AS(estimate_spacing(two), InvalidArgument);
}

TEST_CASE("estimate_spacing moves with the cloud") {
  const auto points = shapes::to_points(shapes::sampled(shapes::torus(), 30'000));
  std::vector<Vec3> far = points;
  for (Vec3& p : far)
    p += Vec3(636'763.0, 851'298.0, 415.0);
  const Spacing here = estimate_spacing(points);
  const Spacing there = estimate_spacing(far);
  CHECK(there.median == Approx(here.median).epsilon(1e-6));
  CHECK(there.quantile75 == Approx(here.quantile75).epsilon(1e-6));
}

TEST_CASE("robust_bounds are the box of a cloud without outliers") {
  for (const TriangleSoup& soup :
       {shapes::sphere(), shapes::plate(0.01), shapes::trefoil(), shapes::two_spheres(3.0)}) {
    const auto points = shapes::to_points(shapes::sampled(soup, 20'000));
    Box box;
    for (const Vec3& p : points)
      box.add(p);
    CHECK(robust_bounds(points) == box);
  }
  CHECK(robust_bounds(std::vector<Vec3>{}).is_empty());
  const std::vector<Vec3> one{{1.0, 2.0, 3.0}};
  CHECK(robust_bounds(one) == Box{one[0], one[0]});
}

TEST_CASE("robust_bounds leave far outliers out, few or one in a hundred") {
  const auto points = shapes::to_points(shapes::sampled(shapes::sphere(), 20'000));
  const Box box = robust_bounds(points);
  std::vector<Vec3> strayed = points;
  strayed.emplace_back(1e6, 0.0, 0.0);
  strayed.emplace_back(0.0, -40.0, 0.0);
  CHECK(robust_bounds(strayed) == box);

  shapes::Random random(5);
  for (int i = 0; i < 200; ++i) {
    const Vec3 d = random.direction();
    strayed.push_back(random.between(20.0, 500.0) * d /
                      std::max({std::abs(d.x), std::abs(d.y), std::abs(d.z)}));
  }
  CHECK(robust_bounds(strayed) == box);
}

TEST_CASE("robust_bounds keep a mast on a plane") {
  // 1000 x 1000, and a mast of 3 % of the points.
  std::vector<Vec3> points;
  shapes::Random random(9);
  for (int i = 0; i < 30'000; ++i) {
    points.push_back({random.between(-1, 1), random.between(-1, 1), random.between(0, 1e-3)});
  }
  points.emplace_back(0.0, 0.0, 0.0);
  for (int i = 0; i <= 1000; ++i)
    points.emplace_back(0.0, 0.0, 12.0 * i / 1000.0);
  CHECK(robust_bounds(points).upper.z == 12.0);
}

TEST_CASE("robust_bounds of a scene hold its polygons whole") {
  Scene scene;
  auto cloud = std::make_shared<PointCloud>(shapes::sampled(shapes::sphere(), 5000));
  cloud->positions.emplace_back(1e5F, 0.0F, 0.0F);
  scene.add(cloud);
  const Box alone = robust_bounds(scene);
  CHECK(alone.upper.x <= 1.0);
  scene.add(std::make_shared<TriangleSoup>(shapes::box({90, 0, 0}, {100, 1, 1})));
  CHECK(robust_bounds(scene).upper.x == 100.0);
  CHECK(robust_bounds(scene).lower == alone.lower);
}

}  // namespace rangezip

// What finish() refuses, that it stops, and what it makes of nothing or next to nothing.

#include <catch2/catch.hpp>
#include <limits>
#include <stop_token>
#include <vector>

#include "core/base/error.h"
#include "core/finish/finish.h"
#include "tests/core/finish/shapes.h"

namespace rangezip {
namespace {

/// For spheres of n rows.
FinishOptions fast_options(int n) {
  return {.method = FinishMethod::fast, .pixel_size = 2.0 / n};
}

TEST_CASE("finish refuses lengths and counts out of range") {
  FinishOptions options = fast_options(4);
  const double infinity = std::numeric_limits<double>::infinity();
  SECTION("a hole") {
    options.max_hole_perimeter = -1.0;
  }
  SECTION("a crack") {
    options.narrow_width = infinity;
  }
  SECTION("a tolerance") {
    options.flat_tolerance = -0.1;
  }
  SECTION("a gap") {
    options.gap = infinity;
  }
  SECTION("triangles") {
    options.triangles = 17 * testing::sphere(4).triangles.size();
  }
  REQUIRE_THROWS_AS(finish(testing::sphere(4), {}, options), InvalidArgument);
}

TEST_CASE("finish refuses a pixel size that is not positive and finite") {
  FinishOptions options;
  options.pixel_size = GENERATE(0.0, -1.0, std::numeric_limits<double>::infinity(),
                                std::numeric_limits<double>::quiet_NaN());
  REQUIRE_THROWS_AS(finish(testing::sphere(4), {}, options), InvalidArgument);
}

TEST_CASE("finish stops when asked to") {
  std::stop_source source;
  source.request_stop();
  Progress progress;
  progress.stop = source.get_token();
  REQUIRE_THROWS_AS(finish(testing::sphere(8), {}, fast_options(8), progress), Cancelled);
}

TEST_CASE("finish of nothing is nothing") {
  REQUIRE(finish({}, {}, {.pixel_size = 0.25}).mesh.empty());
}

TEST_CASE("of a scrap that finishing takes apart nothing is left, and that is no error") {
  const TriangleMesh scrap{
      {{0.233848, 0.212036, -0.0372404},
       {0.829069, -0.00642361, 0.346493},
       {2.11564, -0.110221, -0.374812},
       {-0.249045, 1.21869, 0.0},
       {1.06017, 0.995733, 0.0},
       {1.94642, 0.960188, 0.0},
       {0.293357, 2.12453, 0.0},
       {1.04558, 2.25682, 0.0},
       {2.22316, 2.10101, -0.18872}},
      {{0, 1, 4}, {0, 4, 3}, {1, 2, 5}, {1, 5, 4}, {3, 4, 7}, {3, 7, 6}, {4, 8, 7}},
      {}};
  const std::vector<Vec3> cloud{{3.58352, 3.52808, -0.283932},   {-0.668488, 2.86177, 0.783349},
                                {-1.64185, 1.95978, 0.455515},   {3.07791, 0.70662, -0.0626695},
                                {1.67373, -0.152108, -0.840529}, {0.434568, 4.47541, -0.916849},
                                {1.05184, 4.69228, -0.635676},   {-1.03502, 2.56959, -0.235067},
                                {3.744, 2.51426, 0.0738106},     {1.31873, 4.36211, 0.932571},
                                {-2.92333, 1.56449, -0.862727},  {3.66343, 3.51284, 0.0411185},
                                {4.4773, 1.07885, 0.630222},     {-0.711948, 1.17746, 0.305183},
                                {-0.965335, -1.0443, -0.407554}, {4.07372, -2.41618, -0.530087},
                                {-2.06345, 3.28027, -0.806679},  {1.61911, 1.12834, 0.58052},
                                {-1.97672, 0.936053, -0.497391}, {-0.472994, -0.213862, -0.497237}};
  double sum = 0.0;
  for (const auto& [a, b, c] : scrap.triangles) {
    sum += glm::distance(scrap.positions[a], scrap.positions[b]) +
           glm::distance(scrap.positions[b], scrap.positions[c]) +
           glm::distance(scrap.positions[c], scrap.positions[a]);
  }
  FinishOptions options;
  options.pixel_size = sum / (3.0 * static_cast<double>(scrap.triangles.size()));
  options.flat_tolerance = GENERATE(0.0, 0.1);
  REQUIRE(finish(scrap, {cloud}, options).mesh.empty());
}

}  // namespace
}  // namespace rangezip

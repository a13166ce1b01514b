#include "core/finish/left_out_faces.h"

#include <catch2/catch.hpp>
#include <cmath>
#include <numbers>

#include "tests/core/finish/shapes.h"
#include "tests/support/shapes.h"

namespace rangezip {
namespace {

constexpr int kSide = 30;
constexpr double kMargin = 0.6;  ///< half a face

/// Points at random over the sheet, `spacing` apart on average, but for a disc around its middle.
PointGrid sampled_sheet(double spacing, double radius, std::mt19937_64& engine) {
  std::vector<Vec3> points(
      static_cast<std::size_t>(static_cast<double>(kSide * kSide) / (spacing * spacing)));
  for (Vec3& p : points) {
    p = {testing::uniform(engine, -0.5 * kSide, 0.5 * kSide),
         testing::uniform(engine, -0.5 * kSide, 0.5 * kSide), 0.0};
  }
  std::erase_if(points, [&](const Vec3& p) { return std::hypot(p.x, p.y) < radius; });
  return PointGrid(points, Box{Vec3(-kSide), Vec3(kSide)}, 0.7);
}

/// In h^2, of the faces of a sheet of edge length h that are flagged.
double area_left_out(double spacing, double radius, std::mt19937_64& engine) {
  const TriangleMesh sheet = shapes::square_sheet(kSide);
  const PointGrid cloud = sampled_sheet(spacing, radius, engine);
  const auto flags = left_out_faces(
      sheet.triangles, [&](std::uint32_t v) { return sheet.positions[v]; }, cloud, 1.0);
  REQUIRE(flags.size() == sheet.triangles.size());
  double area = 0.0;
  for (std::size_t f = 0; f < flags.size(); ++f) {
    if (flags[f] == 0) continue;
    const auto& [a, b, c] = sheet.triangles[f];
    const Vec3 middle = (sheet.positions[a] + sheet.positions[b] + sheet.positions[c]) / 3.0;
    CHECK(std::hypot(middle.x, middle.y) < radius + kMargin);
    area +=
        0.5 * glm::length(area_vector(sheet.positions[a], sheet.positions[b], sheet.positions[c]));
  }
  return area;
}

}  // namespace

TEST_CASE("of a sheet the disc that was not sampled is left out, up to half a face at its rim",
          "[finish]") {
  const auto seed = static_cast<std::uint64_t>(Catch::rngSeed());
  CAPTURE(seed);
  std::mt19937_64 engine(seed);
  for (const double radius : {4.0, 6.0, 9.0}) {
    CAPTURE(radius);
    const double area = area_left_out(0.4, radius, engine);
    CHECK(area < std::numbers::pi * (radius + kMargin) * (radius + kMargin));
    CHECK(area > std::numbers::pi * (radius - kMargin) * (radius - kMargin));
  }
}

TEST_CASE("gaps that are narrow, or come from how points happen to lie, are not left out",
          "[finish]") {
  const auto seed = static_cast<std::uint64_t>(Catch::rngSeed());
  CAPTURE(seed);
  std::mt19937_64 engine(seed);
  CHECK(area_left_out(0.4, 1.5, engine) == 0.0);
  for (const double spacing : {0.4, 0.8, 1.2}) {
    CAPTURE(spacing);
    CHECK(area_left_out(spacing, 0.0, engine) == 0.0);
  }
}

}  // namespace rangezip

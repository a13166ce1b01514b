#include "core/finish/other_wall.h"

#include <catch2/catch.hpp>
#include <cmath>
#include <random>

#include "core/finish/local_plane.h"
#include "tests/core/finish/shapes.h"
#include "tests/support/shapes.h"

namespace rangezip {
namespace {

using testing::uniform;

constexpr double kH = 1.0;
constexpr double kHalf = 8.0;       ///< half a side of the plates
constexpr double kThickness = 0.8;  ///< less than a pixel
constexpr int kPerPixel = 6;

PointGrid grid_of(const std::vector<Vec3>& points) {
  return PointGrid(points, Box{Vec3(-3.0 * kHalf), Vec3(3.0 * kHalf)}, 0.7 * kH);
}

/// A plate with faces about h across, without the end of its lower wall.
TriangleMesh open_plate() {
  TriangleMesh mesh = testing::cube(static_cast<int>(2.0 * kHalf));
  for (Vec3& p : mesh.positions)
    p *= Vec3(kHalf, kHalf, 0.5 * kThickness);
  testing::cut_where(mesh, [](const Vec3& p) {
    return p.x > 4.5 && p.x < kHalf - 0.5 && std::abs(p.y) < kHalf - 0.5 && p.z < 0.0;
  });
  return mesh;
}

/// Random points of a square at a height.
void add_points(std::vector<Vec3>& points, double z, std::mt19937_64& engine) {
  const auto count = static_cast<int>(kPerPixel * 4.0 * kHalf * kHalf);
  for (int i = 0; i < count; ++i)
    points.push_back({uniform(engine, -kHalf, kHalf), uniform(engine, -kHalf, kHalf), z});
}

bool is_wall(const TriangleMesh& mesh, const std::vector<Vec3>& points, double noise) {
  const CornerTable table(mesh.triangles, mesh.positions.size());
  const std::vector<BoundaryLoop> loops = boundary_loops(table);
  REQUIRE(loops.size() == 1);
  const FaceTree faces(mesh.positions, table);
  return is_other_wall(mesh.positions, table, loops[0], faces, grid_of(points), noise, kH);
}

}  // namespace

TEST_CASE("the lost end of a thin plate's wall is a wall if it has points of its own", "[finish]") {
  const auto seed = static_cast<std::uint64_t>(Catch::rngSeed());
  CAPTURE(seed);
  std::mt19937_64 engine(seed);
  std::vector<Vec3> points;
  add_points(points, 0.5 * kThickness, engine);
  const TriangleMesh mesh = open_plate();
  CHECK_FALSE(is_wall(mesh, points, 0.0));
  add_points(points, -0.5 * kThickness, engine);
  CHECK(is_wall(mesh, points, 0.0));
}

TEST_CASE("what would fold back over an open sheet is no wall, with noise or without", "[finish]") {
  const auto seed = static_cast<std::uint64_t>(Catch::rngSeed());
  const double noise = GENERATE(0.0, 0.05, 0.2);  // of a pixel
  CAPTURE(seed, noise);
  std::mt19937_64 engine(seed);
  TriangleMesh mesh = shapes::square_sheet(static_cast<std::uint32_t>(2.0 * kHalf));
  const auto wave = [](const Vec3& p) { return 0.8 * std::sin(0.4 * p.x) * std::cos(0.3 * p.y); };
  for (Vec3& p : mesh.positions)
    p.z = wave(p);
  std::vector<Vec3> points;
  add_points(points, 0.0, engine);
  for (Vec3& p : points) {
    p.z = wave(p);
    for (int i = 0; i < 12; ++i)
      p.z += noise * uniform(engine, -0.5, 0.5);
  }
  CHECK_FALSE(is_wall(mesh, points, noise));
}

TEST_CASE("the noise of a cloud is the deviation from its surface, and creases add none",
          "[finish]") {
  const auto seed = static_cast<std::uint64_t>(Catch::rngSeed());
  const double noise = GENERATE(0.0, 0.1, 0.2);  // of a pixel
  CAPTURE(seed, noise);
  std::mt19937_64 engine(seed);
  std::vector<Vec3> points;
  add_points(points, 0.0, engine);
  for (Vec3& p : points) {  // folded at a right angle
    if (p.x > 0.0) p = Vec3(0.0, p.y, p.x);
    const Vec3 normal = p.x < 0.0 ? Vec3(0.0, 0.0, 1.0) : Vec3(1.0, 0.0, 0.0);
    for (int i = 0; i < 12; ++i)
      p += noise * uniform(engine, -0.5, 0.5) * normal;
  }
  // The thinnest quarter of a thousand discs of 30 points: each scatters by 13 %.
  CHECK(noise_of(points, grid_of(points), kH) == Approx(noise).epsilon(0.25).margin(1e-6));
  CHECK(noise_of({}, grid_of({}), kH) == 0.0);
}

}  // namespace rangezip

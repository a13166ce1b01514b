#include "core/finish/papered_faces.h"

#include <algorithm>
#include <array>
#include <catch2/catch.hpp>
#include <cmath>
#include <cstdint>
#include <random>
#include <vector>

#include "core/finish/finish.h"
#include "core/mesh/mesh_report.h"
#include "tests/core/finish/shapes.h"

namespace rangezip {
namespace {

using testing::uniform;
using Vote = std::array<std::int8_t, 3>;

constexpr double kH = 1.0;
constexpr double kHalf = 12.0;    // of a cube, in h
constexpr double kPocket = 4.0;   // half the width of a pocket in its top
constexpr double kFloor = -4.0;   // height of the pocket's floor
constexpr double kDensity = 6.0;  // points a square h

/// Points with votes, all over the cube with the pocket.
struct Cloud {
  std::vector<Vec3> points;
  std::vector<Vote> votes;

  [[nodiscard]] SeenPoints seen() const { return {points, votes}; }

  /// Points all over origin + s * u + t * v, for s and t in [-1, 1].
  void add(const Vec3& origin, const Vec3& u, const Vec3& v, const Vote& vote,
           std::mt19937_64& engine) {
    const auto count = static_cast<int>(4.0 * glm::length(u) * glm::length(v) * kDensity);
    for (int i = 0; i < count; ++i) {
      points.push_back(origin + uniform(engine, -1, 1) * u + uniform(engine, -1, 1) * v);
      votes.push_back(vote);
    }
  }
};

bool is_over_pocket(const Vec3& p) {
  return std::max(std::abs(p.x), std::abs(p.y)) < kPocket;
}

Cloud outside_of_cube(std::mt19937_64& engine) {
  Cloud whole;
  for (int axis = 0; axis < 3; ++axis) {
    for (const int side : {-1, 1}) {
      Vec3 origin{0.0}, u{0.0}, v{0.0};
      origin[axis] = side * kHalf;
      u[(axis + 1) % 3] = v[(axis + 2) % 3] = kHalf;
      Vote vote{};
      vote[static_cast<std::size_t>(axis)] = static_cast<std::int8_t>(127 * side);
      whole.add(origin, u, v, vote, engine);
    }
  }
  Cloud open;
  for (std::size_t i = 0; i < whole.points.size(); ++i) {
    if (whole.points[i].z == kHalf && is_over_pocket(whole.points[i])) continue;
    open.points.push_back(whole.points[i]);
    open.votes.push_back(whole.votes[i]);
  }
  return open;
}

/// Few directions see the floor, and those are around the axis; the walls more of them.
void add_pocket(Cloud& cloud, std::mt19937_64& engine) {
  const Vec3 x{kPocket, 0.0, 0.0}, y{0.0, kPocket, 0.0};
  const Vec3 z{0.0, 0.0, 0.5 * (kHalf - kFloor)}, middle{0.0, 0.0, 0.5 * (kHalf + kFloor)};
  cloud.add({0.0, 0.0, kFloor}, x, y, {0, 0, 14}, engine);
  cloud.add(middle + x, y, z, {-30, 0, 15}, engine);
  cloud.add(middle - x, y, z, {30, 0, 15}, engine);
  cloud.add(middle + y, x, z, {0, -30, 15}, engine);
  cloud.add(middle - y, x, z, {0, 30, 15}, engine);
}

Cloud cube_with_pocket(std::mt19937_64& engine) {
  Cloud cloud = outside_of_cube(engine);
  add_pocket(cloud, engine);
  return cloud;
}

/// The cube with edges of h, closed over the pocket.
TriangleMesh closed_cube() {
  TriangleMesh mesh = testing::cube(static_cast<int>(2.0 * kHalf / kH));
  for (Vec3& p : mesh.positions)
    p *= kHalf;
  return mesh;
}

PointGrid grid_of(const Cloud& cloud) {
  return {cloud.points, {Vec3(-2.0 * kHalf), Vec3(2.0 * kHalf)}, 0.7 * kH};
}

}  // namespace

TEST_CASE("the faces over a pocket that points look out of are papered, and no others",
          "[finish]") {
  const auto seed = static_cast<std::uint64_t>(Catch::rngSeed());
  CAPTURE(seed);
  std::mt19937_64 engine(seed);
  const Cloud cloud = cube_with_pocket(engine);
  const TriangleMesh mesh = closed_cube();
  const auto is_papered = papered_faces(mesh, grid_of(cloud), cloud.seen(), kH);
  REQUIRE(is_papered.size() == mesh.triangles.size());
  std::size_t inner = 0, found = 0;
  for (std::size_t f = 0; f < is_papered.size(); ++f) {
    const Vec3 p = centroid_of(mesh.positions, mesh.triangles[f]);
    const bool is_over = p.z == kHalf && is_over_pocket(p);
    CHECK((is_papered[f] == 0 || is_over));
    if (!is_over || std::max(std::abs(p.x), std::abs(p.y)) > kPocket - 2.0 * kH) continue;
    ++inner;  // farther from the walls than what a walk down meets
    found += is_papered[f];
  }
  CHECK(inner == 32);
  CHECK(found == inner);
}

TEST_CASE("over what was not measured no face is papered: the far side looks away", "[finish]") {
  const auto seed = static_cast<std::uint64_t>(Catch::rngSeed());
  CAPTURE(seed);
  std::mt19937_64 engine(seed);
  const Cloud cloud = outside_of_cube(engine);
  const auto is_papered = papered_faces(closed_cube(), grid_of(cloud), cloud.seen(), kH);
  CHECK(std::count(is_papered.begin(), is_papered.end(), 1) == 0);
}

TEST_CASE("points without votes, and such as hardly any direction sees, tell nothing", "[finish]") {
  const auto seed = static_cast<std::uint64_t>(Catch::rngSeed());
  CAPTURE(seed);
  std::mt19937_64 engine(seed);
  Cloud cloud = outside_of_cube(engine);
  const std::size_t outside = cloud.points.size();
  add_pocket(cloud, engine);
  const TriangleMesh mesh = closed_cube();
  CHECK(papered_faces(mesh, grid_of(cloud), {cloud.points}, kH).empty());
  const SeenPoints without_pocket{cloud.points, std::span(cloud.votes).first(outside)};
  const auto by_rest = papered_faces(mesh, grid_of(cloud), without_pocket, kH);
  CHECK(std::count(by_rest.begin(), by_rest.end(), 1) == 0);
  std::fill(cloud.votes.begin() + static_cast<std::ptrdiff_t>(outside), cloud.votes.end(),
            Vote{0, 0, 5});
  const auto hardly_seen = papered_faces(mesh, grid_of(cloud), cloud.seen(), kH);
  CHECK(std::count(hardly_seen.begin(), hardly_seen.end(), 1) == 0);
}

TEST_CASE("papered faces go, unless a hole of under two pixels is all that they leave",
          "[finish]") {
  const auto seed = static_cast<std::uint64_t>(Catch::rngSeed());
  CAPTURE(seed);
  std::mt19937_64 engine(seed);
  const Cloud cloud = cube_with_pocket(engine);
  TriangleMesh mesh = closed_cube();
  TriangleMesh crumb = mesh;  // four of the faces, of h^2 / 2, over the middle of the pocket
  testing::cut_where(crumb, [](const Vec3& p) {
    return p.z < kHalf - 0.1 || p.x < -0.1 || p.x > 1.1 || p.y < -0.1 || p.y > 2.1;
  });
  REQUIRE(crumb.triangles.size() == 4);
  CHECK(drop_papered_faces(crumb, grid_of(cloud), cloud.seen(), kH) == 0);
  TriangleMesh kept = mesh;  // the pocket is 16 h around or more
  CHECK(drop_papered_faces(kept, grid_of(cloud), cloud.seen(), kH, 60.0 * kH) == 0);
  CHECK(kept == mesh);
  CHECK(drop_papered_faces(mesh, grid_of(cloud), cloud.seen(), kH, 12.0 * kH) >= 32);
  const MeshReport report = report_mesh(mesh);
  CHECK(report.is_manifold());
  CHECK(report.boundary_loops == 1);
}

TEST_CASE("of papered faces a crack is left as it is, however long", "[finish]") {
  const auto seed = static_cast<std::uint64_t>(Catch::rngSeed());
  CAPTURE(seed);
  std::mt19937_64 engine(seed);
  const Cloud cloud = cube_with_pocket(engine);
  // A strip of eight squares over the middle of the pocket, 8 h^2 and 18 h around: 0.9 h wide.
  TriangleMesh strip = closed_cube();
  testing::cut_where(strip, [](const Vec3& p) {
    return p.z > kHalf - 0.1 && (p.x < -4.1 || p.x > 4.1 || p.y < -0.1 || p.y > 1.1);
  });
  TriangleMesh dropped = strip;
  CHECK(drop_papered_faces(strip, grid_of(cloud), cloud.seen(), kH, 12.0 * kH) == 0);
  CHECK(drop_papered_faces(dropped, grid_of(cloud), cloud.seen(), kH) >= 6);
}

TEST_CASE("the finish closes no pocket that points look out of", "[finish]") {
  const auto seed = static_cast<std::uint64_t>(Catch::rngSeed());
  CAPTURE(seed);
  std::mt19937_64 engine(seed);
  const Cloud cloud = cube_with_pocket(engine);
  FinishOptions options{.method = FinishMethod::fast, .pixel_size = kH};
  CHECK(report_mesh(finish(closed_cube(), {cloud.points}, options).mesh).boundary_loops == 0);

  const FinishResult open = finish(closed_cube(), cloud.seen(), options);
  CHECK(open.report.papered_faces >= 32);
  CHECK(report_mesh(open.mesh).boundary_loops == 1);

  options.max_hole_perimeter = 60.0;  // asked for, whatever looks out
  CHECK(report_mesh(finish(closed_cube(), cloud.seen(), options).mesh).boundary_loops == 0);
  options.max_hole_perimeter = 0.0;

  options.regrow = true;  // down into it
  const FinishResult grown = finish(closed_cube(), cloud.seen(), options);
  const MeshReport report = report_mesh(grown.mesh);
  CHECK(report.is_manifold());
  CHECK(report.boundary_loops == 0);
  CHECK(report.euler == 2);
  const double volume = testing::volume_of(grown.mesh);
  const double pocket = 4.0 * kPocket * kPocket * (kHalf - kFloor);
  CHECK(std::abs(volume - (8.0 * kHalf * kHalf * kHalf - pocket)) < 0.1 * pocket);
}

}  // namespace rangezip

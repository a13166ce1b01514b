#include <catch2/catch.hpp>

#include "core/mesh/mesh_report.h"
#include "core/plan/view_planner.h"
#include "tests/support/shapes.h"

namespace rangezip {
namespace {

struct Hole {
  Vec3 direction;
  double cosine = 1.0;  ///< of half its opening angle
};

/// The sphere without the faces whose middle lies in a hole.
TriangleMesh punched_sphere(const std::vector<Hole>& holes) {
  TriangleMesh mesh = shapes::to_mesh(shapes::sphere());
  std::erase_if(mesh.triangles, [&](const Triangle& t) {
    const Vec3 middle =
        glm::normalize(mesh.positions[t[0]] + mesh.positions[t[1]] + mesh.positions[t[2]]);
    return std::any_of(holes.begin(), holes.end(), [&](const Hole& hole) {
      return glm::dot(middle, hole.direction) > hole.cosine;
    });
  });
  return mesh;
}

}  // namespace

TEST_CASE("plan_fill_views look into a hole") {
  for (std::uint64_t seed = 1; seed <= 20; ++seed) {
    CAPTURE(seed);
    const Vec3 hole = shapes::Random(seed).direction();
    const TriangleMesh mesh = punched_sphere({{hole, 0.95}});
    const std::vector<Vec3> views = plan_fill_views(mesh, 0.5, 6);
    REQUIRE_FALSE(views.empty());
    CHECK(glm::length(views[0]) == Approx(1.0));
    // 200 directions: the nearest one is within 15 degrees.
    CHECK(glm::dot(views[0], hole) > 0.96);
  }
}

TEST_CASE("plan_fill_views look into every hole, the longest first") {
  const Vec3 large{1, 0, 0};
  const TriangleMesh mesh = punched_sphere(
      {{large, 0.9}, {Vec3{-1, 0, 0}, 0.97}, {Vec3{0, 1, 0}, 0.97}, {Vec3{0, 0, -1}, 0.97}});
  const std::vector<Vec3> views = plan_fill_views(mesh, 0.5, 6);
  REQUIRE(views.size() >= 4);
  CHECK(glm::dot(views[0], large) > 0.96);
  for (const Vec3& hole : {large, Vec3{-1, 0, 0}, Vec3{0, 1, 0}, Vec3{0, 0, -1}}) {
    CHECK(std::any_of(views.begin(), views.end(),
                      [&](const Vec3& view) { return glm::dot(view, hole) > 0.8; }));
  }
  CHECK(plan_fill_views(mesh, 0.5, 2).size() == 2);
}

TEST_CASE("plan_fill_views see a slit around an edge from both sides") {
  // A tube without its middle ring has two loops whose normals point all around.
  const std::vector<Vec2> low{{1.0, -2.0}, {1.0, -0.1}};
  const std::vector<Vec2> high{{1.0, 0.1}, {1.0, 2.0}};
  const TriangleMesh mesh =
      shapes::to_mesh(shapes::merged(shapes::revolved(low, false), shapes::revolved(high, false)));
  const std::vector<Vec3> views = plan_fill_views(mesh, 0.5, 6);
  REQUIRE(views.size() >= 3);
  Vec3 sum{0.0};
  for (const Vec3& view : views) {
    CHECK(std::abs(view.z) < 0.8);
    sum += view;
  }
  CHECK(glm::length(sum) < 0.6 * static_cast<double>(views.size()));
}

TEST_CASE("plan_fill_views leave closed meshes and short loops alone") {
  CHECK(plan_fill_views(shapes::to_mesh(shapes::sphere()), 0.01, 6).empty());
  CHECK(plan_fill_views(TriangleMesh{}, 0.01, 6).empty());
  const TriangleMesh mesh = punched_sphere({{Vec3{0, 0, 1}, 0.95}});
  const double loop = report_mesh(mesh).longest_loop;
  CHECK(plan_fill_views(mesh, 1.001 * loop, 6).empty());
  CHECK_FALSE(plan_fill_views(mesh, 0.999 * loop, 6).empty());
  CHECK(plan_fill_views(mesh, 0.5, 0).empty());
}

}  // namespace rangezip

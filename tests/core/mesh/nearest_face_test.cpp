#include "core/mesh/nearest_face.h"

#include <catch2/catch.hpp>

#include "tests/support/shapes.h"

namespace rangezip {
namespace {

/// The nearest face by trying all.
NearestFace nearest_of_all(const TriangleMesh& mesh, const Vec3& point) {
  NearestFace best{0, std::numeric_limits<double>::infinity()};
  for (std::uint32_t f = 0; f < mesh.triangles.size(); ++f) {
    const Triangle& t = mesh.triangles[f];
    const Vec3 offset = closest_point_on_triangle(point, mesh.positions[t[0]], mesh.positions[t[1]],
                                                  mesh.positions[t[2]]) -
                        point;
    const double squared = glm::dot(offset, offset);
    if (squared < best.squared_distance) best = {f, squared};
  }
  return best;
}

TEST_CASE("the walk over a convex body reaches the nearest face from anywhere on its side",
          "[mesh]") {
  // Outside of a convex body distance has one minimum, so downhill must find it.
  const TriangleMesh mesh = shapes::to_mesh(shapes::sphere(1.0, 12));
  const OutgoingEdges edges(mesh);
  for (std::uint64_t seed = 1; seed <= 300; ++seed) {
    CAPTURE(seed);
    shapes::Random random(seed);
    const double length = random.between(1.0, 2.0);
    const Vec3 point = length * random.direction();
    const auto start = static_cast<std::uint32_t>(random.bits() % mesh.triangles.size());
    const NearestFace found = walk_to_nearest_face(mesh, edges, start, point);
    REQUIRE(found.squared_distance <= nearest_of_all(mesh, point).squared_distance * (1 + 1e-12));
  }
}

TEST_CASE("the walk turns around a corner where every edge leads uphill", "[mesh]") {
  // A fan of twelve flat triangles; the point is above the one opposite to the start, so all
  // triangles beside the start are equally far: at the common corner.
  TriangleMesh mesh;
  mesh.positions.emplace_back(0.0, 0.0, 0.0);
  for (int i = 0; i < 12; ++i) {
    const double angle = std::numbers::pi * i / 6.0;
    mesh.positions.emplace_back(std::cos(angle), std::sin(angle), 0.0);
  }
  for (std::uint32_t i = 0; i < 12; ++i)
    mesh.triangles.push_back({0, 1 + i, 1 + (i + 1) % 12});
  const OutgoingEdges edges(mesh);
  for (std::uint32_t target = 0; target < 12; ++target) {
    const Triangle& t = mesh.triangles[target];
    const Vec3 middle = (mesh.positions[t[1]] + mesh.positions[t[2]]) / 4.0;
    for (std::uint32_t start = 0; start < 12; ++start) {
      REQUIRE(walk_to_nearest_face(mesh, edges, start, middle + Vec3{0, 0, 0.125}).face == target);
    }
  }
}

TEST_CASE("the walk stops at the boundary and stays on the start where that is nearest", "[mesh]") {
  const TriangleMesh bowl = shapes::to_mesh(shapes::bowl(1.0, 8));
  const OutgoingEdges edges(bowl);
  for (std::uint32_t start = 0; start < bowl.triangles.size(); ++start) {
    const Triangle& t = bowl.triangles[start];
    const Vec3 middle = (bowl.positions[t[0]] + bowl.positions[t[1]] + bowl.positions[t[2]]) / 3.0;
    const NearestFace found = walk_to_nearest_face(bowl, edges, start, middle);
    REQUIRE(found.face == start);
    REQUIRE(found.squared_distance < 1e-30);
  }
}

}  // namespace
}  // namespace rangezip

#include "core/finish/face_tree.h"

#include <catch2/catch.hpp>
#include <cstdint>
#include <random>
#include <vector>

#include "tests/core/finish/shapes.h"

namespace rangezip {

TEST_CASE("the faces in a box are those whose boxes meet it, in their order", "[finish]") {
  const auto seed = static_cast<std::uint64_t>(Catch::rngSeed());
  CAPTURE(seed);
  std::mt19937_64 engine(seed);
  const TriangleMesh mesh = testing::sphere(10);
  const CornerTable table(mesh.triangles, mesh.positions.size());
  const FaceTree faces(mesh.positions, table);
  for (int i = 0; i < 100; ++i) {
    const Vec3 center = testing::direction(engine);
    const Box box{center - Vec3(0.2), center + Vec3(0.2)};
    std::vector<Vec3> corners;
    for (const Triangle& t : mesh.triangles) {
      if (!boxes_meet(box_of(mesh, t), box)) continue;
      for (const std::uint32_t v : t)
        corners.push_back(mesh.positions[v]);
    }
    const TriangleMesh found = faces.faces_in(box);
    std::vector<Vec3> found_corners;
    for (const Triangle& t : found.triangles) {
      for (const std::uint32_t v : t)
        found_corners.push_back(found.positions[v]);
    }
    REQUIRE_FALSE(corners.empty());
    CHECK(found_corners == corners);
  }
}

}  // namespace rangezip

#include "core/finish/air_bridges.h"

#include <catch2/catch.hpp>
#include <cstddef>
#include <random>

#include "core/mesh/mesh_report.h"
#include "tests/core/finish/bridged_sheets.h"

namespace rangezip {
namespace {

constexpr Box kAround{Vec3(-10.0), Vec3(10.0)};
constexpr std::size_t kMinBody = 30;

PointGrid grid(const std::vector<Vec3>& points) {
  return {points, kAround, 0.7};
}

}  // namespace

TEST_CASE("two sheets 2.2 h apart lose the bridge between them, and hardly anything else",
          "[finish]") {
  const auto seed = static_cast<std::uint64_t>(Catch::rngSeed());
  CAPTURE(seed);
  std::mt19937_64 engine(seed);
  testing::BridgedSheets sheets = testing::bridged_sheets(2.2, 8, engine);
  REQUIRE(report_mesh(sheets.mesh).components == 1);
  CHECK(drop_air_bridges(sheets.mesh, grid(sheets.points), 1.0, kMinBody) >= 2);
  const MeshReport report = report_mesh(sheets.mesh);
  CHECK(report.components == 2);
  CHECK(report.is_manifold());
  CHECK(report.faces >= 390);  // of 400: next to the bridge some may be bare by chance
}

TEST_CASE("a bridge with points on it is surface, and stays", "[finish]") {
  std::mt19937_64 engine(5);
  testing::BridgedSheets sheets = testing::bridged_sheets(2.2, 8, engine);
  for (double z = 0.2; z < 2.2; z += 0.2) {
    for (double y = 0.0; y < 1.05; y += 0.2)
      sheets.points.emplace_back(-5.0, y, z);
  }
  CHECK(drop_air_bridges(sheets.mesh, grid(sheets.points), 1.0, kMinBody) == 0);
}

TEST_CASE("what is small is no body: a scrap beside a sheet keeps its bridge", "[finish]") {
  std::mt19937_64 engine(6);
  testing::BridgedSheets sheets = testing::bridged_sheets(2.2, 8, engine);
  CHECK(drop_air_bridges(sheets.mesh, grid(sheets.points), 1.0, 250) == 0);
}

TEST_CASE("a place of one sheet without points stays closed", "[finish]") {
  std::mt19937_64 engine(7);
  testing::BridgedSheets sheets = testing::bridged_sheets(2.2, 8, engine);
  sheets.mesh.triangles.resize(sheets.mesh.triangles.size() - 2);
  std::erase_if(sheets.points,
                [](const Vec3& p) { return p.x * p.x + p.y * p.y < 4.0 && p.z == 0.0; });
  CHECK(drop_air_bridges(sheets.mesh, grid(sheets.points), 1.0, kMinBody) == 0);
}

TEST_CASE("a wide band without points may be surface, and stays", "[finish]") {
  std::mt19937_64 engine(8);
  testing::BridgedSheets sheets = testing::bridged_sheets(2.2, 8, engine);
  sheets.mesh.triangles.resize(sheets.mesh.triangles.size() - 2);
  std::erase_if(sheets.points, [](const Vec3& p) { return p.x > -2.0 && p.x < 2.0; });
  CHECK(drop_air_bridges(sheets.mesh, grid(sheets.points), 1.0, kMinBody) == 0);
}

TEST_CASE("without points, or faces, no bridge is dropped", "[finish]") {
  std::mt19937_64 engine(9);
  testing::BridgedSheets sheets = testing::bridged_sheets(2.2, 1, engine);
  CHECK(drop_air_bridges(sheets.mesh, PointGrid({}, Box{}, 1.0), 1.0, kMinBody) == 0);
  TriangleMesh nothing;
  CHECK(drop_air_bridges(nothing, grid(sheets.points), 1.0, kMinBody) == 0);
}

}  // namespace rangezip

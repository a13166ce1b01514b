// Passes that may take long end when the caller asks for it.

#include <catch2/catch.hpp>
#include <cmath>
#include <stop_token>
#include <vector>

#include "core/base/error.h"
#include "core/finish/join_loops.h"
#include "core/finish/mesh_pieces.h"
#include "core/finish/repair.h"
#include "core/finish/small_angles.h"
#include "core/finish/take_back_losses.h"
#include "core/finish/untangle.h"
#include "core/finish/verified_fills.h"
#include "tests/core/finish/all_faces.h"
#include "tests/core/finish/shapes.h"

namespace rangezip {
namespace {

constexpr int kN = 20;
constexpr double kH = 2.0 / kN;

Progress stopped() {
  std::stop_source source;
  source.request_stop();
  return {.stop = source.get_token()};
}

const PointGrid& no_points() {
  static const PointGrid grid({}, Box{}, kH);
  return grid;
}

TriangleMesh open_sphere() {
  TriangleMesh mesh = testing::sphere(kN);
  testing::cut_where(mesh, [](const Vec3& p) { return p.z > 0.85; });
  return mesh;
}

TEST_CASE("closing holes stops when asked to", "[finish]") {
  TriangleMesh mesh = open_sphere();
  FinishOptions options;
  options.pixel_size = kH;
  FinishReport report;
  CHECK_THROWS_AS(repair(mesh, {}, SettledLoops(), no_points(), options, report, stopped()),
                  Cancelled);
  CHECK_THROWS_AS(zip_open_loops(mesh, no_points(), options, report, stopped()), Cancelled);
  const MeshPieces pieces = pieces_of(mesh);
  const std::vector<FillRequest> requests{{.loop = pieces.loops.at(0)}};
  CHECK_THROWS_AS(fill_verified(mesh, pieces.table, requests, {.edge_length = kH}, stopped()),
                  Cancelled);
  CHECK_THROWS_AS(take_back_losses(mesh, testing::sphere(kN), nullptr, kH, stopped()), Cancelled);
}

TEST_CASE("joining loops stops when asked to", "[finish]") {
  TriangleMesh mesh = testing::sphere(kN);
  testing::cut_where(mesh, [](const Vec3& p) { return std::abs(p.z) < 0.05; });
  const MeshPieces pieces = pieces_of(mesh);
  REQUIRE(pieces.loops.size() == 2);
  CHECK_THROWS_AS(join_loops(mesh, pieces, no_points(), kH, false, stopped()), Cancelled);
}

TEST_CASE("mending faces stops when asked to", "[finish]") {
  TriangleMesh mesh = testing::sphere(kN);
  CHECK_THROWS_AS(untangle(mesh, testing::all_faces(mesh), stopped()), Cancelled);
  CHECK_THROWS_AS(take_back_crossing(mesh, mesh.positions, stopped()), Cancelled);
  const Triangle& face = mesh.triangles[mesh.triangles.size() / 2];
  mesh.positions[face[0]] = 0.99 * mesh.positions[face[1]] + 0.01 * mesh.positions[face[0]];
  CHECK_THROWS_AS(mend_small_angles(mesh, no_points(), kH, stopped()), Cancelled);
}

}  // namespace
}  // namespace rangezip

// rangezip play: sessions written by hand.

#include <catch2/catch.hpp>

#include "core/io/mesh_file.h"
#include "core/mesh/mesh_report.h"
#include "tests/apps/program.h"
#include "tests/core/io/temporary_folder.h"
#include "tests/support/shapes.h"

using namespace rangezip;
using namespace rangezip::test;
using Catch::Contains;

namespace {

/// A camera above the +z pole of a unit sphere about the origin, one unit 50 pixels.
constexpr const char* kCamera =
    R"("camera": {"look_at": {"eye": [0,0,5], "target": [0,0,0], "up": [0,1,0]}, "height": 3},
       "extent": {"width": 150, "height": 150})";
/// The middle of its image: a square of 0.6 units.
constexpr const char* kMiddle = R"("region": [[60,60],[90,60],[90,90],[60,90]])";

struct Played {
  RunResult result;
  MeshReport report;
  TriangleMesh mesh;
};

Played play(const TemporaryFolder& folder, const std::string& commands) {
  write_mesh(folder / "sphere.ply", shapes::to_mesh(shapes::sphere(1.0, 48)));
  folder.store("s.json", R"({"version": 1, "inputs": [], "initial_mesh": {"path": "sphere.ply"},
                             "commands": [)" +
                             commands + "]}");
  Played played;
  played.result = run({"play", folder / "s.json", "-o", folder / "out.ply"});
  if (played.result.code != 0) return played;
  played.mesh = read_mesh(folder / "out.ply");
  played.report = report_mesh(played.mesh);
  return played;
}

std::string erase(const std::string& more = "") {
  return std::string(R"({"command": "erase", )") + kCamera + ", " + kMiddle + more + "}";
}

}  // namespace

TEST_CASE("a hand-written session erases, fills, smooths and takes back", "[apps]") {
  const TemporaryFolder folder;
  const std::size_t faces = shapes::sphere(1.0, 48).triangles.size();

  const Played erased = play(folder, erase());
  CAPTURE(erased.result.err);
  REQUIRE(erased.result.code == 0);
  CHECK(erased.report.boundary_loops == 1);
  CHECK(erased.report.faces < faces);
  CHECK_NOTHROW(check_mesh(erased.mesh));

  const Played through = play(folder, erase(R"(, "visible_only": false)"));
  REQUIRE(through.result.code == 0);
  CHECK(through.report.boundary_loops == 2);

  const Played filled = play(folder, erase() + R"(, {"command": "fill"})");
  REQUIRE(filled.result.code == 0);
  CHECK(filled.report.boundary_loops == 0);
  CHECK(filled.report.euler == 2);

  const Played smoothed = play(folder, R"({"command": "smooth", "iterations": 10, "factor": 1})");
  REQUIRE(smoothed.result.code == 0);
  CHECK(smoothed.report.faces == faces);
  double largest = 0.0;
  for (const Vec3& p : smoothed.mesh.positions)
    largest = std::max(largest, glm::length(p));
  CHECK(largest < 1.0);

  const Played finished = play(folder, erase() + R"(, {"command": "finish", "method": "fast"})");
  CAPTURE(finished.result.err);
  REQUIRE(finished.result.code == 0);
  CHECK(finished.report.is_manifold());

  const Played undone =
      play(folder, erase() + R"(, {"command": "smooth"}, {"command": "undo", "count": 2})");
  REQUIRE(undone.result.code == 0);
  CHECK(undone.mesh.triangles == shapes::sphere(1.0, 48).triangles);
}

TEST_CASE("a hand-written session scans its inputs", "[apps]") {
  const TemporaryFolder folder;
  store_sphere(folder / "cloud.ply");
  folder.store("s.json", R"({"version": 1, "inputs": [{"path": "cloud.ply"}], "commands": [
      {"command": "scan", "plane_fit": {}, "fill_holes": {},
       "camera": {"look_at": {"eye": [3,0,5], "target": [3,0,0], "up": [0,1,0]}, "height": 3},
       "extent": {"width": 100, "height": 100}}]})");
  const RunResult result = run({"play", folder / "s.json", "-o", folder / "out.ply"});
  CAPTURE(result.err);
  REQUIRE(result.code == 0);
  const TriangleMesh mesh = read_mesh(folder / "out.ply");
  CHECK_NOTHROW(check_mesh(mesh));
  CHECK(mesh.triangles.size() > 3000);
}

TEST_CASE("a wrong session is refused with its place and no output", "[apps]") {
  const TemporaryFolder folder;
  const std::vector<std::pair<std::string, std::string>> commands{
      {R"({"command": "smooth", "factor": 2})", "/commands/0/factor"},
      {R"({"command": "undo"})", "/commands/0: "},
      {erase() + R"(, {"command": "undo", "count": 3})", "/commands/1: "},
      {R"({"command": "scan", "camera": {"eye_from_world":
          [[2,0,0,0],[0,1,0,0],[0,0,1,0],[0,0,0,1]]}})",
       "/commands/0: "}};
  for (const auto& [command, place] : commands) {
    CAPTURE(command);
    const Played played = play(folder, command);
    CHECK(played.result.code == 2);
    CHECK_THAT(played.result.err, Contains("s.json: ") && Contains(place));
    CHECK_FALSE(std::filesystem::exists(folder / "out.ply"));
  }
  folder.store("s.json", R"({"version": 1, "inputs": [], "commands": []})");
  CHECK(run({"play", folder / "s.json", "-o", folder / "out.ply"}).code == 2);
  folder.store("s.json",
               R"({"version": 1, "inputs": [{"path": "sphere.ply", "hash": "0000000000000000"}],
                             "commands": []})");
  const RunResult changed = run({"play", folder / "s.json", "-o", folder / "out.ply"});
  CHECK(changed.code == 2);
  CHECK_THAT(changed.err, Contains("has changed since the session was recorded"));
}

TEST_CASE("info tells what is in a session", "[apps]") {
  const TemporaryFolder folder;
  play(folder, erase() + R"(, {"command": "smooth"}, {"command": "smooth"})");
  const RunResult result = run({"info", folder / "s.json"});
  CHECK(result.code == 0);
  CHECK_THAT(result.out, Contains("session, version 1") && Contains("sphere.ply") &&
                             Contains("1 x erase") && Contains("2 x smooth"));
}

TEST_CASE("an input that a session cannot name is refused before the work", "[apps]") {
  const TemporaryFolder folder;
  store_sphere(folder / "caf\xe9.ply", 1000);
  const RunResult result = run(
      {"mesh", folder / "caf\xe9.ply", "-o", folder / "out.ply", "--session", folder / "s.json"});
  CHECK(result.code == 3);
  CHECK_THAT(result.err, Contains("caf\xe9.ply") && Contains("UTF-8"));
  CHECK(folder.count() == 1);
  CHECK(run({"mesh", folder / "caf\xe9.ply", "-o", folder / "out.ply"}).code == 0);
}

TEST_CASE("so is one that the session for --verify cannot name", "[apps]") {
  const TemporaryFolder folder;
  store_sphere(folder / "caf\xe9.ply", 1000);
  const RunResult result =
      run({"mesh", folder / "caf\xe9.ply", "-o", folder / "out.ply", "--verify"});
  CHECK(result.code == 3);
  CHECK_THAT(result.err, Contains("caf\xe9.ply") && Contains("UTF-8"));
  CHECK_THAT(result.err, !Contains("reading"));
  CHECK(folder.count() == 1);
}

TEST_CASE("info knows a session by its name in capital letters, too", "[apps]") {
  const TemporaryFolder folder;
  const std::string session = R"({"version": 1, "inputs": [], "commands": []})";
  const RunResult result = run({"info", folder.store("S.JSON", session)});
  CHECK(result.code == 0);
  CHECK_THAT(result.out, Contains("session, version 1"));
}

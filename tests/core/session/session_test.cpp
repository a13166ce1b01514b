// Session: what each command does, and that undo, redo and replay give the same meshes whatever is
// kept in memory.

#include <catch2/catch.hpp>

#include "core/base/error.h"
#include "core/finish/laplacian_smooth.h"
#include "core/mesh/mesh_report.h"
#include "core/session/erase_region.h"
#include "core/session/session.h"
#include "raster_cpu/cpu_rasterizer.h"
#include "tests/support/shapes.h"

using namespace rangezip;

namespace {

TriangleMesh sphere_mesh() {
  return shapes::to_mesh(shapes::sphere(1.0, 32));
}

/// A camera on the z axis that sees 3 x 3 units in 150 x 150 pixels.
EraseRegion erase_square(double half_side, bool visible_only = true) {
  EraseRegion erase;
  erase.camera = look_at({0, 0, 5}, {0, 0, 0}, {0, 1, 0}, Orthographic{.height = 3.0});
  erase.extent = {150, 150};
  const double r = 50.0 * half_side;
  erase.region = {{75 - r, 75 - r}, {75 + r, 75 - r}, {75 + r, 75 + r}, {75 - r, 75 + r}};
  erase.visible_only = visible_only;
  return erase;
}

Scene cloud_scene() {
  Scene scene;
  scene.add(std::make_shared<const PointCloud>(shapes::sampled(shapes::sphere(), 5000)));
  return scene;
}

AddScan scan_from(const Vec3& toward_viewer, bool vote) {
  const double pixel_size = 0.06;
  FramedCamera framed =
      frame_box({.lower = Vec3{-1.0}, .upper = Vec3{1.0}}, toward_viewer, pixel_size);
  AddScan scan;
  scan.scan.camera = framed.camera;
  scan.scan.extent = framed.extent;
  scan.scan.plane_fit = PlaneFitOptions{};
  scan.scan.fill_holes = FillHolesOptions{};
  scan.scan.quality = QualityMaskOptions{};
  scan.scan.triangulate.max_slope_cosine = 0.3;
  if (vote) scan.vote = VoteOptions{.pixel_size = pixel_size};
  return scan;
}

/// A small session with every kind of command that has a result.
std::vector<Command> sample_session() {
  return {scan_from({0, 0, 1}, true),  scan_from({0, 1, 0.2}, true),
          erase_square(0.4),           ErasePlaces{{{{0.0, 0.0, 1.0}, 0.3}}},
          SmoothMesh{.iterations = 2}, FillMeshHoles{},
          DropUnsupported{},           FinishMesh{}};
}

}  // namespace

TEST_CASE("erasing a place takes the faces in it and no others", "[session]") {
  const TriangleMesh sphere = sphere_mesh();
  const Sphere top{{0.0, 0.0, 1.0}, 0.3};
  const EraseResult erased = erase_places(sphere, {&top, 1});
  CHECK_NOTHROW(check_mesh(erased.mesh));
  CHECK(report_mesh(erased.mesh).boundary_loops == 1);
  CHECK(erased.erased_faces == sphere.triangles.size() - erased.mesh.triangles.size());
  for (const auto& [a, b, c] : erased.mesh.triangles) {
    const std::vector<Vec3>& p = erased.mesh.positions;
    CHECK_FALSE(top.contains((p[a] + p[b] + p[c]) / 3.0));
  }
}

TEST_CASE("erasing the visible faces of a square leaves one hole, erasing all leaves two",
          "[session]") {
  CpuRasterizer rasterizer;
  const TriangleMesh sphere = sphere_mesh();
  const EraseResult front = erase_region(sphere, rasterizer, erase_square(0.4));
  CHECK_NOTHROW(check_mesh(front.mesh));
  CHECK(report_mesh(front.mesh).boundary_loops == 1);
  CHECK(front.erased_faces == sphere.triangles.size() - front.mesh.triangles.size());
  for (const Vec3& p : front.mesh.positions)
    CHECK_FALSE((p.z > 0.0 && std::abs(p.x) < 0.3 && std::abs(p.y) < 0.3));

  const EraseResult through = erase_region(sphere, rasterizer, erase_square(0.4, false));
  CHECK_NOTHROW(check_mesh(through.mesh));
  CHECK(report_mesh(through.mesh).boundary_loops == 2);
  CHECK(report_mesh(through.mesh).components == 1);
}

TEST_CASE("a clip plane shields what it cuts away from being erased", "[session]") {
  CpuRasterizer rasterizer;
  EraseRegion erase = erase_square(0.4, false);
  erase.camera.clip_planes = {{{0, 0, -1}, 0.0}};  // only z < 0 is there
  const EraseResult result = erase_region(sphere_mesh(), rasterizer, erase);
  CHECK(report_mesh(result.mesh).boundary_loops == 1);
  double highest = -1.0;
  for (const Vec3& p : result.mesh.positions)
    highest = std::max(highest, p.z);
  CHECK(highest == Approx(1.0));
}

TEST_CASE("an empty region erases all that is seen, an empty mesh stays empty", "[session]") {
  CpuRasterizer rasterizer;
  EraseRegion all = erase_square(1.0, false);
  all.region.clear();
  CHECK(erase_region(sphere_mesh(), rasterizer, all).mesh.empty());
  CHECK(erase_region({}, rasterizer, all).mesh.empty());
  EraseRegion wrong = all;
  wrong.region = {{0, 0}, {1, 1}};
  CHECK_THROWS_AS(erase_region(sphere_mesh(), rasterizer, wrong), InvalidArgument);
}

TEST_CASE("erasing leaves no two sheets that touch in a vertex only", "[session]") {
  // Two opposite quarters of a flat grid go: what is left meets in the middle.
  TriangleMesh grid;
  for (int y = 0; y <= 10; ++y) {
    for (int x = 0; x <= 10; ++x)
      grid.positions.emplace_back(0.2 * x - 1.0, 0.2 * y - 1.0, 0.0);
  }
  for (std::uint32_t y = 0; y < 10; ++y) {
    for (std::uint32_t x = 0; x < 10; ++x) {
      const std::uint32_t a = 11 * y + x;
      grid.triangles.push_back({a, a + 1, a + 12});
      grid.triangles.push_back({a, a + 12, a + 11});
    }
  }
  CpuRasterizer rasterizer;
  for (const bool visible_only : {false, true}) {
    EraseRegion erase = erase_square(1.0, visible_only);
    erase.region = {{25, 25}, {75, 25}, {75, 125}, {125, 125}, {125, 75}, {25, 75}};
    const EraseResult result = erase_region(grid, rasterizer, erase);
    CHECK_NOTHROW(check_mesh(result.mesh));
    CHECK(result.erased_faces >= 100);
  }
}

TEST_CASE("undo and redo give back the same meshes, however little is kept", "[session]") {
  CpuRasterizer rasterizer;
  const std::vector<Command> commands = sample_session();
  std::vector<TriangleMesh> expected{TriangleMesh{}};
  {
    Session session(cloud_scene());
    for (const Command& command : commands) {
      session.apply(command, rasterizer);
      expected.push_back(*session.mesh());
    }
    CHECK(expected.back() != expected[expected.size() - 2]);
  }
  for (const std::size_t bytes : {std::size_t{0}, std::size_t{200'000}, std::size_t{1} << 30U}) {
    CAPTURE(bytes);
    Session session(cloud_scene(), SessionOptions{.history_bytes = bytes});
    for (const Command& command : commands)
      session.apply(command, rasterizer);
    CHECK_FALSE(session.redo(rasterizer));
    for (std::size_t i = commands.size(); i-- > 0;) {
      REQUIRE(session.undo(rasterizer));
      CHECK(*session.mesh() == expected[i]);
      CHECK(session.history().size() == i);
    }
    CHECK_FALSE(session.undo(rasterizer));
    for (std::size_t i = 1; i <= commands.size(); ++i) {
      REQUIRE(session.redo(rasterizer));
      CHECK(*session.mesh() == expected[i]);
    }
    CHECK_FALSE(session.redo(rasterizer));
  }
}

TEST_CASE("a new command drops what could be redone", "[session]") {
  CpuRasterizer rasterizer;
  Session session({}, sphere_mesh());
  session.apply(erase_square(0.4), rasterizer);
  session.apply(SmoothMesh{}, rasterizer);
  session.apply(UndoSteps{.count = 2}, rasterizer);
  CHECK(session.history().empty());
  CHECK(*session.mesh() == sphere_mesh());
  REQUIRE(session.redo(rasterizer));
  session.apply(FillMeshHoles{}, rasterizer);
  CHECK_FALSE(session.redo(rasterizer));
  REQUIRE(session.history().size() == 2);
  CHECK(std::holds_alternative<FillMeshHoles>(session.history()[1]));
  CHECK(report_mesh(*session.mesh()).boundary_loops == 0);
}

TEST_CASE("a command that fails leaves the session as it was", "[session]") {
  CpuRasterizer rasterizer;
  Session session({}, sphere_mesh());
  session.apply(SmoothMesh{}, rasterizer);
  const auto before = session.mesh();
  CHECK_THROWS_AS(session.apply(SmoothMesh{.factor = 2.0}, rasterizer), InvalidArgument);
  CHECK_THROWS_AS(session.apply(UndoSteps{.count = 0}, rasterizer), InvalidArgument);
  CHECK_THROWS_AS(session.apply(UndoSteps{.count = 2}, rasterizer), InvalidArgument);
  std::stop_source stop;
  stop.request_stop();
  CHECK_THROWS_AS(session.apply(SmoothMesh{}, rasterizer, {.stop = stop.get_token()}), Cancelled);
  CHECK(session.mesh() == before);
  CHECK(session.history().size() == 1);
  CHECK(session.undo(rasterizer));
}

TEST_CASE("a viewer keeps its mesh while the session goes on", "[session]") {
  CpuRasterizer rasterizer;
  Session session({}, sphere_mesh(), SessionOptions{.history_bytes = 0});
  const auto shown = session.mesh();
  session.apply(SmoothMesh{}, rasterizer);
  session.apply(SmoothMesh{}, rasterizer);
  CHECK(*shown == sphere_mesh());
  const Session moved = std::move(session);
  CHECK(*moved.mesh() == laplacian_smooth(laplacian_smooth(sphere_mesh(), 1, 0.5), 1, 0.5));
}

TEST_CASE("the last scan is at hand until another command", "[session]") {
  CpuRasterizer rasterizer;
  Session session(cloud_scene());
  CHECK(session.last_scan() == nullptr);
  const CommandReport report = session.apply(scan_from({0, 0, 1}, false), rasterizer);
  REQUIRE(session.last_scan() != nullptr);
  CHECK(session.last_scan()->report.samples == report.scan.samples);
  CHECK(report.scan.samples > 500);
  CHECK(report.stitch.patch_faces > 500);
  CHECK(report.seconds > 0.0);
  session.apply(SmoothMesh{}, rasterizer);
  CHECK(session.last_scan() == nullptr);
}

TEST_CASE("votes are computed once for each set of options", "[session]") {
  CpuRasterizer rasterizer;
  const Scene scene = cloud_scene();
  VoteCache cache;
  const VoteOptions options{.pixel_size = 0.06};
  const VisibilityVotes* first = &cache.votes(rasterizer, scene, options);
  CHECK(&cache.votes(rasterizer, scene, options) == first);
  const VisibilityVotes few = cache.votes(rasterizer, scene, {.pixel_size = 0.06, .directions = 6});
  CHECK(few != cache.votes(rasterizer, scene, options));
  CHECK(few.size() == scene.point_count());
}

TEST_CASE("UndoSteps needs a session, a default pixel size needs a mesh", "[session]") {
  CpuRasterizer rasterizer;
  VoteCache votes;
  CHECK_THROWS_AS(run_command(UndoSteps{}, {}, sphere_mesh(), votes, rasterizer), InvalidArgument);
  CHECK_THROWS_AS(run_command(FinishMesh{}, {}, {}, votes, rasterizer), InvalidArgument);
  CHECK_THROWS_AS(mean_edge_length({}), InvalidArgument);
  const TriangleMesh triangle{.positions = {{0, 0, 0}, {3, 0, 0}, {0, 4, 0}},
                              .triangles = {{0, 1, 2}}};
  CHECK(mean_edge_length(triangle) == 4.0);
}

TEST_CASE("the evidence of a scene is its points, then samples of its polygons", "[session]") {
  Scene scene = cloud_scene();
  CHECK(evidence_points(scene) == scene.points());
  scene.add(std::make_shared<const TriangleSoup>(shapes::cube(2.0)));
  const std::vector<Vec3> points = evidence_points(scene);
  REQUIRE(points.size() > 100'000);
  CHECK(points[0] == scene.points()[0]);
  for (std::size_t i = scene.point_count(); i < points.size(); i += 997) {
    const Vec3 p = glm::abs(points[i]);
    CHECK(std::max({p.x, p.y, p.z}) == Approx(2.0));
  }
}

TEST_CASE("a scene's polygons are sampled as densely as small pixels ask for", "[session]") {
  Scene scene;
  scene.add(std::make_shared<const TriangleSoup>(shapes::cube(2.0)));  // of an area of 96
  const auto count = [&](double h) { return evidence_points(scene, h).size(); };
  CHECK(count(0.0) == 200'000);
  CHECK(count(1.0) == 20'000);
  CHECK(static_cast<double>(count(0.03)) == Approx(8.0 * 96.0 / (0.03 * 0.03)).epsilon(1e-3));
  CHECK(count(1e-9) == 4'000'000);
}

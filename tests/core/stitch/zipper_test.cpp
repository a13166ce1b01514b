// The steps of zippering, each by itself.
#include "core/stitch/zipper.h"

#include <catch2/catch.hpp>

#include "core/stitch/collapse_seam.h"
#include "core/stitch/insert_segments.h"
#include "core/stitch/insert_vertices.h"
#include "core/stitch/remove_covered.h"
#include "tests/core/stitch/hand_scans.h"

using namespace rangezip;
using namespace rangezip::test;

namespace {

using VertexHandle = SheetMesh::VertexHandle;
using FaceHandle = SheetMesh::FaceHandle;

SheetMesh sheet_of(const TriangleMesh& mesh) {
  const std::vector<std::uint8_t> all(mesh.triangles.size(), 1);
  SheetMesh sheet = cut_out(mesh, all);
  set_image(sheet, project_to_image(mesh.positions, images::parallel_view(kExtent)));
  return sheet;
}

TriangleMesh mesh_of(const SheetMesh& sheet) {
  return mesh_from_halfedge(sheet.mesh);
}

/// A sheet over pixels 10..50 at depth 20 to compare with.
Scan wide_scan() {
  return hand_scan(plane(20.0), rectangle({10, 10}, {50, 50}));
}

BoundaryVertex vertex_at(Pixel pixel, double depth) {
  return {
      .index = 1000, .pixel = pixel, .position = world(pixel.x, pixel.y, depth), .depth = depth};
}

std::size_t valence(const SheetMesh& sheet, VertexHandle v) {
  return sheet.mesh.valence(v);
}

/// A vertex of the sheet by its place.
VertexHandle find(const SheetMesh& sheet, const Vec2& place) {
  for (const auto v : sheet.mesh.vertices()) {
    if (glm::length(in_pixels(sheet.point(v)) - place) < 1e-3) return v;
  }
  return VertexHandle();
}

}  // namespace

TEST_CASE("a boundary vertex goes into a face, onto an edge, or takes a vertex's place",
          "[stitch]") {
  const Scan scan = wide_scan();
  const PatchSheet patch(scan, 5);
  // Squares of side 4 with corners on samples.
  const TriangleMesh mesh = lattice({16.0, 16.0}, 4, 4, 4.0, 20.0);
  SheetMesh sheet = sheet_of(mesh);
  struct Case {
    Pixel pixel;
    std::size_t faces_more;
    std::size_t vertices_more;
    std::size_t valence;
  };
  const Case c = GENERATE(Case{{21, 18}, 2, 1, 3},   // inside a face
                          Case{{22, 20}, 2, 1, 4},   // on an edge between two
                          Case{{22, 16}, 1, 1, 3},   // on the edge at the end
                          Case{{24, 24}, 0, 0, 8});  // on a vertex
  CAPTURE(c.pixel.x, c.pixel.y);
  const std::vector<BoundaryVertex> vertices{vertex_at(c.pixel, 20.5)};
  const std::vector<FaceHandle> start{FaceHandle(31)};  // far away: a walk
  const InsertedVertices inserted =
      insert_boundary_vertices(sheet, mesh, vertices, start, patch, 1.0);
  REQUIRE(inserted.inserted == 1);
  const VertexHandle v = inserted.handles[0];
  CHECK(sheet.point(v) == grid_point(c.pixel));
  CHECK(sheet.depth(v) == 20.5);
  CHECK(sheet.mesh.point(v) == vertices[0].position);
  CHECK(valence(sheet, v) == c.valence);
  const TriangleMesh result = mesh_of(sheet);
  check_mesh(result);
  CHECK(result.triangles.size() == mesh.triangles.size() + c.faces_more);
  CHECK(result.positions.size() == mesh.positions.size() + c.vertices_more);
  CHECK(projected_area(result) == Approx(256.0));
}

TEST_CASE("a boundary vertex without a place in the sheet stays out", "[stitch]") {
  const Scan scan = wide_scan();
  const PatchSheet patch(scan, 5);
  const TriangleMesh old_surface = lattice({16.0, 16.0}, 4, 4, 4.0, 20.0);
  SheetMesh sheet = sheet_of(old_surface);
  BoundaryVertex too_far = vertex_at({21, 18}, 20.5);
  too_far.reach = 0.49;
  const std::vector<BoundaryVertex> vertices{
      too_far,                     // half a pixel side before the face in sight
      vertex_at({40, 20}, 20.0),   // beside the sheet
      vertex_at({21, 18}, 21.6),   // farther in depth than 1.5 bands of one pixel side
      vertex_at({21, 18}, 20.0)};  // with no face to start from
  const std::vector<FaceHandle> start{FaceHandle(0), FaceHandle(0), FaceHandle(0), FaceHandle()};
  const InsertedVertices inserted =
      insert_boundary_vertices(sheet, old_surface, vertices, start, patch, 1.0);
  CHECK(inserted.inserted == 0);
  for (const VertexHandle v : inserted.handles)
    CHECK_FALSE(v.is_valid());
  CHECK(sheet.mesh.n_faces() == 32);
}

TEST_CASE("a segment becomes an edge by flips, whatever it crosses", "[stitch]") {
  shapes::Random random(3);
  for (int round = 0; round < 50; ++round) {
    CAPTURE(round);
    SheetMesh sheet = sheet_of(lattice({10.0, 10.0}, 12, 12, 2.0, 20.0));
    const auto any_vertex = [&] {
      return Vec2{10.0 + 2.0 * static_cast<double>(random.bits() % 13),
                  10.0 + 2.0 * static_cast<double>(random.bits() % 13)};
    };
    const Vec2 from = any_vertex();
    const Vec2 to = any_vertex();
    if (from == to) continue;
    const VertexHandle a = find(sheet, from);
    const VertexHandle b = find(sheet, to);
    const std::vector<std::array<VertexHandle, 2>> segments{{a, b}};
    const InsertedSegments inserted = insert_boundary_segments(sheet, segments);
    // Along the border of the sheet a vertex on the line cannot move aside to the right of it
    // or out of it; everywhere else there is always a way.
    const bool is_on_border = (from.x == to.x && (from.x == 10.0 || from.x == 34.0)) ||
                              (from.y == to.y && (from.y == 10.0 || from.y == 34.0));
    if (!is_on_border) CHECK(inserted.inserted == 1);
    CHECK(sheet.mesh.find_halfedge(a, b).is_valid() == (inserted.inserted == 1));
    for (const auto face : sheet.mesh.faces())
      REQUIRE(sheet.area(face) > 0);
    check_mesh(mesh_of(sheet));
    CHECK(projected_area(mesh_of(sheet)) == Approx(24.0 * 24.0));
  }
}

TEST_CASE("a segment that leaves the sheet is skipped and changes nothing", "[stitch]") {
  // A sheet with a notch: the line between its two arms runs outside.
  TriangleMesh mesh = lattice({10.0, 10.0}, 6, 6, 2.0, 20.0);
  std::erase_if(mesh.triangles, [&](const Triangle& t) {
    const Vec3 middle = (mesh.positions[t[0]] + mesh.positions[t[1]] + mesh.positions[t[2]]) / 3.0;
    const Vec3 lower = world(14.0, 14.0, 20.0);
    const Vec3 upper = world(18.0, 22.0, 20.0);
    return middle.x > lower.x && middle.x < upper.x && middle.y > lower.y;
  });
  SheetMesh sheet = sheet_of(mesh);
  const std::vector<std::array<VertexHandle, 2>> segments{
      {find(sheet, {12.0, 18.0}), find(sheet, {20.0, 20.0})}};
  const InsertedSegments inserted = insert_boundary_segments(sheet, segments);
  CHECK(inserted.skipped == 1);
  CHECK(inserted.flips == 0);
  CHECK(mesh_of(sheet).triangles.size() == mesh.triangles.size());
}

TEST_CASE("covered faces go one by one, those of another sheet stay", "[stitch]") {
  const Scan scan = hand_scan(plane(20.0), rectangle({20, 20}, {30, 30}));
  const PatchSheet patch(scan, 5);
  SECTION("with corners on the boundary of the patch") {
    SheetMesh sheet = sheet_of(lattice({10.0, 10.0}, 30, 30, 1.0, 20.0));
    CHECK(remove_covered_faces(sheet, patch, 1.0) == 200);
    CHECK(projected_area(mesh_of(sheet)) == Approx(900.0 - 100.0));
  }
  SECTION("a boundary that is not in the sheet lets nothing else go") {
    SheetMesh sheet = sheet_of(lattice({10.3, 10.6}, 30, 30, 1.0, 20.0));
    const std::size_t removed = remove_covered_faces(sheet, patch, 1.0);
    CHECK(removed >= 200);          // all that is covered
    CHECK(removed <= 11 * 11 * 2);  // squares with any part under the patch
  }
  SECTION("at another depth") {
    SheetMesh sheet = sheet_of(lattice({10.0, 10.0}, 30, 30, 1.0, 22.1));
    CHECK(remove_covered_faces(sheet, patch, 1.0) == 0);
  }
}

TEST_CASE("short edges at the seam collapse, others stay", "[stitch]") {
  TriangleMesh mesh = lattice({10.0, 10.0}, 10, 10, 1.0, 20.0);
  // Two inner vertices move close to their right neighbours; only one of these is on the seam.
  const std::uint32_t at_seam = 5 * 11 + 4;
  const std::uint32_t elsewhere = 2 * 11 + 4;
  mesh.positions[at_seam].x += 0.8;
  mesh.positions[elsewhere].x += 0.8;
  std::vector<std::uint8_t> seam(mesh.positions.size(), 0);
  seam[at_seam + 1] = 1;
  const Vec3 kept = mesh.positions[at_seam + 1];
  TriangleMesh result = mesh;
  CHECK(collapse_short_seam_edges(result, seam, 0.45) == 1);
  remove_unused_vertices(result);
  check_mesh(result);
  CHECK(result.positions.size() == mesh.positions.size() - 1);
  CHECK(result.triangles.size() == mesh.triangles.size() - 2);
  CHECK(projected_area(result) == Approx(100.0));
  CHECK(std::count(result.positions.begin(), result.positions.end(), kept) == 1);
  CHECK(std::count(result.positions.begin(), result.positions.end(), mesh.positions[at_seam]) == 0);
  TriangleMesh same = mesh;
  CHECK(collapse_short_seam_edges(same, seam, 0.1) == 0);
  CHECK(same == mesh);
}

TEST_CASE("a collapse leaves the boundary in its place", "[stitch]") {
  TriangleMesh mesh = lattice({10.0, 10.0}, 10, 10, 1.0, 20.0);
  // A boundary vertex close to an inner one: the inner one may come to it, not it inside.
  const std::uint32_t inner = 1 * 11 + 5;
  mesh.positions[inner].y -= 0.8;
  std::vector<std::uint8_t> seam(mesh.positions.size(), 0);
  seam[inner] = 1;
  collapse_short_seam_edges(mesh, seam, 0.45);
  check_mesh(mesh);
  CHECK(projected_area(mesh) == Approx(100.0));
}

TEST_CASE("zippering a flat mesh inserts the whole boundary of the patch", "[stitch]") {
  const TriangleMesh mesh = lattice({8.2, 8.3}, 40, 40, 1.0, 20.0);
  const Scan scan = hand_scan(plane(20.0), rectangle({20, 22}, {35, 33}), mesh);
  const StitchResult result = stitch(mesh, scan, {.method = StitchMethod::zipper});
  const StitchReport& report = result.report;
  CHECK(report.inserted_vertices == 2 * (15 + 11));
  CHECK(report.inserted_segments == 2 * (15 + 11));
  CHECK(report.skipped_vertices == 0);
  CHECK(report.skipped_segments == 0);
  CHECK(report.strip_faces == 0);
  // The record names, of the mesh as it was, the face under each vertex, and every edge.
  CHECK(result.record.segments.size() == report.inserted_segments);
  REQUIRE(result.record.vertices.size() == report.inserted_vertices);
  for (const auto& [vertex, face] : result.record.vertices) {
    const auto& [a, b, c] = mesh.triangles[face];
    const Vec3& point = scan.patch.mesh.positions[vertex];
    const Vec3 foot =
        closest_point_on_triangle(point, mesh.positions[a], mesh.positions[b], mesh.positions[c]);
    CHECK(glm::length(point - foot) < 1e-3);  // the grid of the stitcher is coarser than doubles
  }
  // Every vertex of the patch is there, and the collapse has left no short edge at the seam.
  for (const Vec3& p : scan.patch.mesh.positions) {
    CHECK(std::count(result.mesh.positions.begin(), result.mesh.positions.end(), p) == 1);
  }
  CHECK(report.collapsed_edges > 0);
}

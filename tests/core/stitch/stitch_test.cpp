#include "core/stitch/stitch.h"

#include <algorithm>
#include <catch2/catch.hpp>
#include <limits>
#include <set>
#include <stop_token>

#include "core/base/error.h"
#include "core/base/parallel.h"
#include "tests/core/stitch/hand_scans.h"

using namespace rangezip;
using namespace rangezip::test;

namespace {

StitchOptions options_of(StitchMethod method) {
  return {.method = method, .min_component = 1};
}

/// Stitches and checks what holds for every stitch.
TriangleMesh stitched(const TriangleMesh& mesh, const Scan& scan, const StitchOptions& options) {
  const StitchResult result = stitch(mesh, scan, options);
  check_mesh(result.mesh);
  if (options.method == StitchMethod::clear_and_fill) {
    const StitchReport& r = result.report;
    CHECK(result.mesh.triangles.size() + r.removed_faces + r.opened_fans + r.dropped_faces ==
          mesh.triangles.size() + r.patch_faces + r.strip_faces);
  }
  return result.mesh;
}

TriangleMesh stitched(const TriangleMesh& mesh, const Scan& scan, StitchMethod method) {
  return stitched(mesh, scan, options_of(method));
}

/// The faces as positions, so that two meshes compare whatever the numbering.
std::multiset<std::array<std::array<double, 3>, 3>> face_set(const TriangleMesh& mesh) {
  std::multiset<std::array<std::array<double, 3>, 3>> faces;
  for (const Triangle& t : mesh.triangles) {
    std::array<std::array<double, 3>, 3> face;
    for (std::size_t k = 0; k < 3; ++k) {
      const Vec3& p = mesh.positions[t[k]];
      face[k] = {p.x, p.y, p.z};
    }
    std::rotate(face.begin(), std::min_element(face.begin(), face.end()), face.end());
    faces.insert(face);
  }
  return faces;
}

/// Rounding of sums of a few thousand areas of order 1.
Approx exactly(double value) {
  return Approx(value).margin(1e-9);
}

StitchMethod any_method() {
  return GENERATE(StitchMethod::clear_and_fill, StitchMethod::zipper);
}

}  // namespace

TEST_CASE("the first patch becomes the mesh", "[stitch]") {
  const StitchMethod method = any_method();
  const Scan scan = hand_scan(plane(20.0), rectangle({10, 10}, {30, 25}));
  const TriangleMesh mesh = stitched({}, scan, method);
  CHECK(mesh.positions == scan.patch.mesh.positions);
  CHECK(mesh.triangles == scan.patch.mesh.triangles);
}

TEST_CASE("an empty patch changes nothing", "[stitch]") {
  const StitchMethod method = any_method();
  const TriangleMesh mesh = lattice({10.25, 10.5}, 5, 5, 1.0, 20.0);
  const Scan scan = hand_scan(plane(20.0), rectangle({1, 1}, {1, 1}), mesh);
  CHECK(stitched(mesh, scan, method) == mesh);
}

TEST_CASE("two patches of a plane that overlap cover their union once", "[stitch]") {
  const StitchMethod method = any_method();
  const Scan first = hand_scan(plane(20.0), rectangle({5, 10}, {25, 30}));
  const TriangleMesh mesh = stitched({}, first, method);
  const Scan second = hand_scan(plane(20.0), rectangle({15, 10}, {40, 30}), mesh);
  const TriangleMesh both = stitched(mesh, second, method);
  CHECK(area_of(both) == exactly(35.0 * 20.0));
  CHECK(projected_area(both) == exactly(35.0 * 20.0));
  const MeshReport report = report_mesh(both);
  CHECK(report.euler == 1);
  CHECK(report.boundary_loops == 1);
}

TEST_CASE("decimated patches that overlap cover their union once", "[stitch]") {
  const StitchMethod method = any_method();
  const int left = GENERATE(8, 13, 22, 31);
  CAPTURE(left);
  const Scan first = decimated(hand_scan(plane(20.0), rectangle({4, 4}, {40, 56})));
  const TriangleMesh mesh = stitched({}, first, method);
  const Scan second = decimated(hand_scan(plane(20.0), rectangle({left, 4}, {60, 56}), mesh));
  const TriangleMesh both = stitched(mesh, second, method);
  const double area = 56.0 * 52.0;
  CHECK(area_of(both) == exactly(area));
  CHECK(projected_area(both) == exactly(area));
  const MeshReport report = report_mesh(both);
  CHECK(report.euler == 1);
  CHECK(report.boundary_loops == 1);
  CHECK(static_cast<double>(both.triangles.size()) < 1.2 * area);  // of two a pixel
}

TEST_CASE("a patch inside a mesh replaces its middle without a gap", "[stitch]") {
  const StitchMethod method = any_method();
  // Seen shifted by part of a pixel, so that no two vertices have the same image.
  const TriangleMesh mesh = lattice({8.3, 8.6}, 40, 40, 1.0, 20.0);
  const Scan scan = hand_scan(plane(20.0), rectangle({20, 22}, {35, 33}), mesh);
  const TriangleMesh both = stitched(mesh, scan, method);
  CHECK(area_of(both) == exactly(1600.0));
  CHECK(projected_area(both) == exactly(1600.0));
  const MeshReport report = report_mesh(both);
  CHECK(report.euler == 1);
  CHECK(report.boundary_loops == 1);
}

TEST_CASE("a patch inside one old triangle leaves no gap", "[stitch]") {
  const StitchMethod method = any_method();
  TriangleMesh mesh;
  mesh.positions = {world(5.3, 5.2, 20.0), world(58.1, 8.4, 20.0), world(25.7, 57.9, 20.0)};
  mesh.triangles = {{0, 1, 2}};
  const double area = area_of(mesh);
  const Scan scan = hand_scan(plane(20.0), rectangle({24, 20}, {34, 28}), mesh);
  REQUIRE(scan.patch.mesh.triangles.size() == 160);
  const TriangleMesh both = stitched(mesh, scan, method);
  CHECK(area_of(both) == exactly(area));
  CHECK(projected_area(both) == exactly(area));
  CHECK(report_mesh(both).euler == 1);
}

TEST_CASE("a fine patch in a coarser mesh leaves no gap", "[stitch]") {
  const StitchMethod method = any_method();
  const double side = GENERATE(2.0, 3.0, 4.0, 7.0);
  CAPTURE(side);
  const int count = static_cast<int>(56.0 / side);
  const TriangleMesh mesh = lattice({3.3, 3.7}, count, count, side, 20.0);
  const double area = area_of(mesh);
  const Scan scan = hand_scan(plane(20.0), rectangle({20, 22}, {37, 33}), mesh);
  const TriangleMesh both = stitched(mesh, scan, method);
  CHECK(area_of(both) == exactly(area));
  CHECK(projected_area(both) == exactly(area));
  const MeshReport report = report_mesh(both);
  CHECK(report.euler == 1);
  CHECK(report.boundary_loops == 1);
}

TEST_CASE("a hole of the patch stays what it was", "[stitch]") {
  const StitchMethod method = any_method();
  const auto ring = [](Pixel p) {
    return rectangle({15, 15}, {45, 45})(p) && !rectangle({26, 26}, {34, 34})(p);
  };
  SECTION("a hole, where nothing was") {
    const TriangleMesh mesh = stitched({}, hand_scan(plane(20.0), ring), method);
    // In each of the four corners the strip may add a triangle with legs up to max_gap.
    const double gap = StitchOptions{}.max_gap;
    CHECK(area_of(mesh) >= 800.0 - 1e-9);
    CHECK(area_of(mesh) <= 800.0 + 4.0 * 0.5 * gap * gap);
    CHECK(report_mesh(mesh).boundary_loops == 2);
    CHECK(report_mesh(mesh).euler == 0);
  }
  SECTION("covered, where the old surface is") {
    const TriangleMesh mesh = lattice({8.3, 8.6}, 45, 45, 1.0, 20.0);
    const TriangleMesh both = stitched(mesh, hand_scan(plane(20.0), ring, mesh), method);
    CHECK(area_of(both) == exactly(45.0 * 45.0));
    CHECK(report_mesh(both).euler == 1);
  }
}

TEST_CASE("a patch that leaves the mesh extends it", "[stitch]") {
  const StitchMethod method = any_method();
  const TriangleMesh mesh = lattice({8.3, 8.6}, 30, 30, 1.0, 20.0);  // to (38.3, 38.6)
  const Scan scan = hand_scan(plane(20.0), rectangle({30, 20}, {50, 28}), mesh);
  const TriangleMesh both = stitched(mesh, scan, method);
  const double united = 900.0 + (50.0 - 38.3) * 8.0;
  // In each of the two notches the strip may add a triangle with legs up to max_gap.
  const double gap = StitchOptions{}.max_gap;
  CHECK(area_of(both) >= united - 1e-9);
  CHECK(area_of(both) <= united + 2.0 * 0.5 * gap * gap);
  CHECK(projected_area(both) == exactly(area_of(both)));
  CHECK(report_mesh(both).euler == 1);
}

TEST_CASE("a gap is closed up to max_gap", "[stitch]") {
  const StitchMethod method = any_method();
  const TriangleMesh mesh =
      stitched({}, hand_scan(plane(20.0), rectangle({5, 10}, {25, 30})), method);
  const int gap = GENERATE(1, 2, 3, 4, 8);
  CAPTURE(gap);
  const Scan scan = hand_scan(plane(20.0), rectangle({25 + gap, 10}, {45 + gap, 30}), mesh);
  const TriangleMesh both = stitched(mesh, scan, method);
  // The diagonal of a strip of squares is the longest edge: sqrt(1 + 9) < 3.5 < sqrt(1 + 16).
  const bool is_closed = gap <= 3;
  CHECK(area_of(both) == exactly(800.0 + (is_closed ? gap * 20.0 : 0.0)));
  CHECK(report_mesh(both).components == (is_closed ? 1 : 2));
}

TEST_CASE("a gap is not closed by steep faces", "[stitch]") {
  const StitchMethod method = any_method();
  const TriangleMesh mesh = lattice({5.0, 10.0}, 20, 20, 1.0, 20.0);
  // One pixel beside and eight pixels nearer or farther: 83 degrees.
  const double depth = GENERATE(12.0, 28.0);
  const Scan scan = hand_scan(plane(depth), rectangle({26, 10}, {45, 30}), mesh);
  CHECK(report_mesh(stitched(mesh, scan, method)).components == 2);
}

TEST_CASE("a gap in a tilted sheet is closed unless the scan saw through it", "[stitch]") {
  const StitchMethod method = any_method();
  const double behind = GENERATE(0.0, 8.0);  // of the samples between the two parts
  const bool is_slot = behind > 0.0;
  const auto depth = [behind](Pixel p) {
    const bool is_between = p.x == 26 || p.x == 27;
    return 150.0 - 2.0 * p.x + (is_between ? behind : 0.0);
  };
  const TriangleMesh mesh = stitched({}, hand_scan(depth, rectangle({5, 10}, {25, 30})), method);
  const Scan scan = hand_scan(depth, rectangle({28, 10}, {48, 30}), mesh);
  const TriangleMesh both = stitched(mesh, scan, method);
  const double stretch = std::sqrt(5.0);
  CHECK(area_of(both) == exactly((800.0 + (is_slot ? 0.0 : 60.0)) * stretch));
  CHECK(report_mesh(both).components == (is_slot ? 2 : 1));
}

TEST_CASE("a sheet at another depth is not touched", "[stitch]") {
  const StitchMethod method = any_method();
  const double behind = GENERATE(25.0, 15.0);
  const TriangleMesh front = lattice({8.3, 8.6}, 40, 40, 1.0, 20.0);
  const TriangleMesh other = lattice({9.1, 9.9}, 38, 38, 1.0, behind);
  const TriangleMesh mesh = merged(front, other);
  const Scan scan = hand_scan(plane(20.0), rectangle({20, 20}, {40, 40}), mesh);
  const auto faces = face_set(stitched(mesh, scan, method));
  const auto kept = face_set(other);
  CHECK(std::includes(faces.begin(), faces.end(), kept.begin(), kept.end()));
}

TEST_CASE("clear_and_fill leaves order and numbers of what is far away as they are", "[stitch]") {
  const TriangleMesh mesh = lattice({2.3, 2.6}, 58, 58, 1.0, 20.0);
  const Scan scan = hand_scan(plane(20.0), rectangle({45, 45}, {50, 50}), mesh);
  const TriangleMesh both = stitched(mesh, scan, StitchMethod::clear_and_fill);
  // The lower 40 rows of vertices and of squares come first and lie far below the patch.
  const std::size_t vertices = 40 * 59;
  const std::size_t faces = 39 * 58 * 2;
  CHECK(std::equal(mesh.positions.begin(), mesh.positions.begin() + vertices,
                   both.positions.begin()));
  CHECK(std::equal(mesh.triangles.begin(), mesh.triangles.begin() + faces, both.triangles.begin()));
}

TEST_CASE("a back face of the old surface is not touched", "[stitch]") {
  const StitchMethod method = any_method();
  TriangleMesh mesh = lattice({8.3, 8.6}, 40, 40, 1.0, 20.1);
  for (Triangle& t : mesh.triangles)
    std::swap(t[1], t[2]);
  const Scan scan = hand_scan(plane(20.0), rectangle({20, 20}, {40, 40}), mesh);
  const auto faces = face_set(stitched(mesh, scan, method));
  const auto kept = face_set(mesh);
  CHECK(std::includes(faces.begin(), faces.end(), kept.begin(), kept.end()));
}

TEST_CASE("the same scan a second time gives the same surface", "[stitch]") {
  const StitchMethod method = any_method();
  const auto bumps = [](Pixel p) {
    return 20.0 + 0.02 * (p.x - 30) * (p.x - 30) * 0.3 + 0.1 * ((p.x + p.y) % 3);
  };
  const MaskAt mask = rectangle({10, 12}, {40, 38});
  const TriangleMesh once = stitched({}, hand_scan(bumps, mask), method);
  const TriangleMesh twice = stitched(once, hand_scan(bumps, mask, once), method);
  CHECK(face_set(twice) == face_set(once));
}

TEST_CASE("old vertices exactly under samples are no obstacle", "[stitch]") {
  const StitchMethod method = any_method();
  // A lattice on pixel centres, and one with every second vertex on them.
  const double side = GENERATE(1.0, 0.5);
  const int count = static_cast<int>(40.0 / side);
  CAPTURE(side, static_cast<int>(method));
  const TriangleMesh mesh = lattice({10.0, 10.0}, count, count, side, 20.0);
  const Scan scan = hand_scan(plane(20.0), rectangle({20, 22}, {35, 33}), mesh);
  const TriangleMesh both = stitched(mesh, scan, method);
  CHECK(area_of(both) == exactly(1600.0));
  CHECK(projected_area(both) == exactly(1600.0));
  CHECK(report_mesh(both).euler == 1);
}

TEST_CASE("masks of any shape give a manifold mesh without folds", "[stitch]") {
  const StitchMethod method = any_method();
  for (std::uint64_t seed = 0; seed < 40; ++seed) {
    CAPTURE(seed);
    shapes::Random random(seed);
    // Bow ties, tongues and islands, denser and sparser; three generations over each other.
    TriangleMesh mesh;
    for (int generation = 0; generation < 3; ++generation) {
      const double density = random.between(0.55, 0.95);
      const auto ragged = [&](Pixel p) {
        return rectangle({6, 6}, {57, 57})(p) && random.between(0.0, 1.0) < density;
      };
      const double lift = random.between(0.0, 0.5);  // within the band: one surface
      const auto slope = [&](Pixel p) { return 30.0 + lift + 0.3 * p.x; };
      mesh = stitched(mesh, hand_scan(slope, ragged, mesh), method);
      CHECK(projected_area(mesh) <= 51.0 * 51.0 + 1e-9);
    }
  }
}

TEST_CASE("new vertices know the primitive and the view they come from", "[stitch]") {
  const StitchMethod method = any_method();
  StitchOptions options = options_of(method);
  options.view = 3;
  const Scan scan = hand_scan(plane(20.0), rectangle({10, 10}, {30, 25}));
  const TriangleMesh mesh = stitched({}, scan, options);
  REQUIRE(mesh.sources.size() == mesh.positions.size());
  for (std::size_t v = 0; v < mesh.positions.size(); ++v) {
    const auto id = static_cast<PrimitiveId>(kExtent.index(scan.patch.pixels[v]));
    CHECK(mesh.sources[v] == VertexSource{id, 3});
  }
  options.view = 4;
  const Scan next = hand_scan(plane(20.0), rectangle({20, 10}, {40, 25}), mesh);
  const TriangleMesh both = stitched(mesh, next, options);
  REQUIRE(both.sources.size() == both.positions.size());
  for (std::size_t v = 0; v < both.positions.size(); ++v) {
    // Both scans have their samples in the same places: the number of the pixel tells the place.
    const Vec3 window = scan.image.view().window_from_world(both.positions[v]);
    const Pixel pixel{static_cast<int>(window.x), static_cast<int>(window.y)};
    CHECK(both.sources[v].primitive == kExtent.index(pixel));
    CAPTURE(pixel.x, pixel.y, static_cast<int>(method));
    if (pixel.x >= 20) CHECK(both.sources[v].view == 4);
  }
}

TEST_CASE("vertices of filled samples have a view, but no primitive", "[stitch]") {
  StitchOptions options = options_of(any_method());
  options.view = 3;
  Scan scan = hand_scan(plane(20.0), rectangle({10, 10}, {30, 25}));
  std::vector<VertexSource>& sources = scan.patch.mesh.sources;
  const VertexSource filled{};  // whatever primitive was drawn into the pixel
  sources.at(sources.size() / 2) = filled;
  const TriangleMesh mesh = stitched({}, scan, options);
  REQUIRE(mesh.sources.size() == sources.size());
  for (std::size_t v = 0; v < sources.size(); ++v)
    CHECK(mesh.sources[v] == VertexSource{sources[v].primitive, 3});
  sources.clear();
  const TriangleMesh unrecorded = stitched({}, scan, options);
  REQUIRE(unrecorded.sources.size() == mesh.positions.size());
  for (const VertexSource& source : unrecorded.sources)
    CHECK(source == VertexSource{kNoPrimitive, 3});
}

TEST_CASE("a mesh without sources gets none", "[stitch]") {
  const StitchMethod method = any_method();
  const TriangleMesh mesh = lattice({8.3, 8.6}, 40, 40, 1.0, 20.0);
  const Scan scan = hand_scan(plane(20.0), rectangle({20, 20}, {40, 40}), mesh);
  CHECK(stitched(mesh, scan, method).sources.empty());
}

TEST_CASE("small pieces go where the stitch made them, and stay elsewhere", "[stitch]") {
  const StitchMethod method = any_method();
  StitchOptions options = options_of(method);
  options.min_component = 30;
  const TriangleMesh far = lattice({50.3, 50.6}, 2, 2, 1.0, 20.0);
  const auto two_islands = [](Pixel p) {
    return rectangle({10, 10}, {20, 20})(p) || rectangle({35, 10}, {36, 13})(p);
  };
  const StitchResult result = stitch(far, hand_scan(plane(20.0), two_islands, far), options);
  CHECK(result.report.dropped_components == 1);
  CHECK(result.report.dropped_faces == 6);
  CHECK(result.mesh.triangles.size() == 8 + 200);
}

TEST_CASE("stitch refuses options out of range, and stops when asked to", "[stitch]") {
  const TriangleMesh mesh = lattice({8.3, 8.6}, 40, 40, 1.0, 20.0);
  const Scan scan = hand_scan(plane(20.0), rectangle({20, 20}, {21, 21}), mesh);
  const double nan = std::numeric_limits<double>::quiet_NaN();
  CHECK_THROWS_AS(stitch(mesh, scan, {.band = 0.0}), InvalidArgument);
  CHECK_THROWS_AS(stitch(mesh, scan, {.clearance = -0.1}), InvalidArgument);
  CHECK_THROWS_AS(stitch(mesh, scan, {.max_gap = 0.0}), InvalidArgument);
  CHECK_THROWS_AS(stitch(mesh, scan, {.max_gap = 65.0}), InvalidArgument);
  CHECK_THROWS_AS(stitch(mesh, scan, {.min_strip_cosine = nan}), InvalidArgument);
  CHECK_THROWS_AS(stitch(mesh, scan, {.collapse_ratio = -1.0}), InvalidArgument);
  CHECK_THROWS_AS(stitch(mesh, scan, {.withdrawal = -1}), InvalidArgument);
  std::stop_source source;
  source.request_stop();
  CHECK_THROWS_AS(stitch(mesh, scan, {}, {.stop = source.get_token()}), Cancelled);
}

TEST_CASE("stitch refuses a mesh that is not one", "[stitch]") {
  const StitchMethod method = any_method();
  const StitchOptions options = options_of(method);
  TriangleMesh mesh = lattice({8.3, 8.6}, 40, 40, 1.0, 20.0);
  const Scan scan = hand_scan(plane(20.0), rectangle({20, 20}, {21, 21}), mesh);
  SECTION("an index out of range") {
    mesh.triangles[0][1] = 5000;
    CHECK_THROWS_AS(stitch(mesh, scan, options), TopologyError);
  }
  SECTION("a repeated corner") {
    mesh.triangles[0][1] = mesh.triangles[0][0];
    CHECK_THROWS_AS(stitch(mesh, scan, options), TopologyError);
  }
  SECTION("an edge with two faces on one side, near the patch") {
    // Beside the square of the patch, not under it.
    const std::size_t near = 2 * (14 * 40 + 11);
    mesh.triangles.push_back(mesh.triangles[near]);
    CHECK_THROWS_AS(stitch(mesh, scan, options), TopologyError);
  }
}

TEST_CASE("stitch gives the same bytes with one thread and with many", "[stitch]") {
  const StitchMethod method = any_method();
  const TriangleMesh mesh = lattice({2.3, 2.6}, 116, 116, 0.5, 20.0);
  const Scan scan = hand_scan(plane(20.0), rectangle({20, 20}, {40, 40}), mesh);
  TriangleMesh one;
  TriangleMesh many;
  run_with_threads(1, [&] { one = stitched(mesh, scan, method); });
  run_with_threads(4, [&] { many = stitched(mesh, scan, method); });
  CHECK(one == many);
}

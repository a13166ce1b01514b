// The parts of a stitch, each by itself.
#include <algorithm>
#include <catch2/catch.hpp>
#include <map>
#include <set>

#include "core/stitch/clean_up.h"
#include "core/stitch/covered_faces.h"
#include "core/stitch/joint.h"
#include "core/stitch/patch_sheet.h"
#include "core/stitch/seam_segments.h"
#include "core/stitch/wide_faces.h"
#include "tests/core/stitch/hand_scans.h"

using namespace rangezip;
using namespace rangezip::test;

namespace {

std::size_t count_of(const std::vector<std::uint8_t>& marks) {
  return static_cast<std::size_t>(std::count(marks.begin(), marks.end(), 1));
}

}  // namespace

TEST_CASE("samples project to the points of their pixels, at their depths", "[stitch]") {
  const Extent extent{40, 30};
  const View view =
      GENERATE_COPY(images::parallel_view(extent, 0.37), images::central_view(extent));
  std::vector<Vec3> positions;
  std::vector<Pixel> pixels;
  for (int y = 0; y < extent.height; ++y) {
    for (int x = 0; x < extent.width; ++x) {
      pixels.push_back({x, y});
      positions.push_back(view.position(Pixel{x, y}, 5.0 + 0.3 * x + 0.1 * y));
    }
  }
  const ImagePlane image = project_to_image(positions, view);
  for (std::size_t i = 0; i < pixels.size(); ++i) {
    CHECK(image.points[i] == grid_point(pixels[i]));
    CHECK(nearest_pixel(image.points[i]) == pixels[i]);
    CHECK(image.depths[i] == Approx(view.depth_of(positions[i])));
  }
}

TEST_CASE("what lies behind the viewer has no image, what is far aside has one on the limit",
          "[stitch]") {
  const View view = images::central_view({40, 30});
  const std::vector<Vec3> positions{{0.0, 0.0, 3.0}, {0.0, 0.0, -3.0}, {1e9, 0.0, -3.0}};
  const ImagePlane image = project_to_image(positions, view);
  CHECK_FALSE(image.has_image(0));
  CHECK(image.has_image(1));
  CHECK(image.points[2].x == kGridLimit);
}

TEST_CASE("a patch sheet knows the boundary of a decimated patch", "[stitch]") {
  for (std::uint64_t seed = 0; seed < 20; ++seed) {
    CAPTURE(seed);
    shapes::Random random(seed);
    const double slope = random.between(0.0, 0.1);
    const Scan full = hand_scan([&](Pixel p) { return 20.0 + slope * std::max(0, p.x - p.y); },
                                [&](Pixel p) {
                                  return rectangle({5, 5}, {54, 50})(p) && random.bits() % 400 != 0;
                                });
    const Scan scan = decimated(full, 0.01);
    const PatchSheet sheet(scan, 3);
    std::set<std::array<Pixel, 2>> edges;
    const auto& pixels = scan.patch.pixels;
    for (const Triangle& t : scan.patch.mesh.triangles) {
      for (std::size_t k = 0; k < 3; ++k)
        edges.insert({pixels[t[k]], pixels[t[(k + 1) % 3]]});
    }
    for (const auto& [from, to] : edges)
      REQUIRE(sheet.is_boundary(from, to) == (edges.count({to, from}) == 0));
    // What is covered does not change.
    const PatchSheet before(full, 3);
    for (int y = 0; y < kExtent.height; ++y) {
      for (int x = 0; x < kExtent.width; ++x)
        REQUIRE(sheet[{x, y}] == before[{x, y}]);
    }
  }
}

TEST_CASE("a patch sheet knows the edges and the places of its triangles", "[stitch]") {
  for (std::uint64_t seed = 0; seed < 20; ++seed) {
    CAPTURE(seed);
    shapes::Random random(seed);
    // Random depths make both diagonals occur, random masks all the half cells.
    const Scan scan = hand_scan([&](Pixel) { return random.between(20.0, 21.0); },
                                [&](Pixel p) {
                                  return rectangle({5, 5}, {24, 20})(p) && random.bits() % 5 != 0;
                                });
    const PatchSheet sheet(scan, 3);
    std::set<std::array<std::uint32_t, 2>> edges;
    for (const Triangle& t : scan.patch.mesh.triangles) {
      for (std::size_t k = 0; k < 3; ++k)
        edges.insert({t[k], t[(k + 1) % 3]});
    }
    const auto& pixels = scan.patch.pixels;
    for (std::uint32_t i = 0; i < pixels.size(); ++i) {
      for (std::uint32_t j = 0; j < pixels.size(); ++j) {
        if (i == j || std::abs(pixels[i].x - pixels[j].x) > 1 ||
            std::abs(pixels[i].y - pixels[j].y) > 1) {
          continue;
        }
        CHECK(sheet.has_edge(pixels[i], pixels[j]) == (edges.count({i, j}) != 0));
      }
    }
    for (int i = 0; i < 500; ++i) {
      const Vec2 place{random.between(3.0, 27.0), random.between(3.0, 23.0)};
      const bool is_covered = std::any_of(
          scan.patch.mesh.triangles.begin(), scan.patch.mesh.triangles.end(),
          [&](const Triangle& t) {
            const auto turns_left = [&](std::size_t k) {
              const Pixel a = pixels[t[k]];
              const Pixel b = pixels[t[(k + 1) % 3]];
              return (b.x - a.x) * (place.y - a.y) - (b.y - a.y) * (place.x - a.x) >= 0.0;
            };
            return turns_left(0) && turns_left(1) && turns_left(2);
          });
      CHECK(sheet.covers(place) == is_covered);
    }
  }
}

TEST_CASE("a patch sheet continues a plane exactly, ring by ring", "[stitch]") {
  const auto tilted = [](Pixel p) { return 20.0 + 0.25 * p.x - 0.5 * p.y; };
  // Samples go on to the right of the patch, and end with it on the left.
  const Scan scan = hand_scan([&](Pixel p) { return p.x < 20 ? kNoSample : tilted(p); },
                              rectangle({20, 20}, {30, 30}));
  const PatchSheet sheet(scan, 4);
  for (int y = 10; y <= 40; ++y) {
    for (int x = 10; x <= 40; ++x) {
      const int dx = std::max({0, 20 - x, x - 30});
      const int dy = std::max({0, 20 - y, y - 30});
      const int ring = std::max(dx, dy);
      const SheetSample& sample = sheet[{x, y}];
      if (ring > 4) {
        CHECK(sample.ring == SheetSample::kUnknown);
        continue;
      }
      CHECK(sample.ring == ring);
      CHECK(sample.depth == Approx(tilted({x, y})));
    }
  }
}

TEST_CASE("a patch sheet does not follow a step of depth", "[stitch]") {
  const Scan scan =
      hand_scan([](Pixel p) { return p.x > 30 ? 28.0 : 20.0; }, rectangle({20, 20}, {30, 30}));
  const PatchSheet sheet(scan, 4);
  CHECK(sheet[{33, 25}].depth == Approx(20.0));
}

TEST_CASE("faces under the patch are covered, those beside it are not", "[stitch]") {
  const Scan scan = hand_scan(plane(20.0), rectangle({20, 20}, {30, 30}));
  const PatchSheet sheet(scan, 5);
  const auto covered_of = [&](const TriangleMesh& mesh, double clearance) {
    const ImagePlane image = project_to_image(mesh.positions, scan.image.view());
    return find_covered_faces(mesh, image, sheet, {.band = 1.0, .clearance = clearance});
  };
  // Squares from x = 10.25: those with x in (19.25, 30.25] overlap 20..30, eleven a row.
  const TriangleMesh mesh = lattice({10.25, 10.25}, 30, 30, 1.0, 20.0);
  const std::vector<std::uint8_t> covered = covered_of(mesh, 0.0);
  for (std::size_t f = 0; f < covered.size(); ++f) {
    const std::size_t column = f / 2 % 30;
    const std::size_t row = f / 60;
    const bool is_inside = column >= 10 && column <= 19 && row >= 10 && row <= 19;
    const bool is_outside = column < 9 || column > 20 || row < 9 || row > 20;
    if (is_inside) CHECK(covered[f] == 1);
    if (is_outside) CHECK(covered[f] == 0);
  }
  // The vertices at 30.25 are closer than 0.4 to the patch, so the squares beyond them go too.
  CHECK(count_of(covered_of(mesh, 0.4)) > count_of(covered));

  // Out of the band of one pixel side (plus half for the rounding of samples), on either side.
  CHECK(count_of(covered_of(lattice({10.25, 10.25}, 30, 30, 1.0, 21.6), 0.4)) == 0);
  CHECK(count_of(covered_of(lattice({10.25, 10.25}, 30, 30, 1.0, 18.4), 0.4)) == 0);
  CHECK(count_of(covered_of(lattice({10.25, 10.25}, 30, 30, 1.0, 21.4), 0.0)) == count_of(covered));

  TriangleMesh from_behind = mesh;
  for (Triangle& t : from_behind.triangles)
    std::swap(t[1], t[2]);
  CHECK(count_of(covered_of(from_behind, 0.4)) == 0);
}

TEST_CASE("segments in conflict with an earlier one are dropped", "[stitch]") {
  const std::vector<GridPoint> points{{0, 0},      {40000, 0},     {20000, -9000}, {20000, 9000},
                                      {40000, 0},  {70000, 5000},  {10000, 0},     {30000, 0},
                                      {0, 500000}, {40000, 500000}};
  const auto kept = [&](std::vector<SeamSegment> segments, std::size_t first_optional) {
    drop_conflicting_segments(segments, first_optional, points);
    return segments.size();
  };
  CHECK(kept({{0, 1}, {2, 3}}, 1) == 1);          // they cross
  CHECK(kept({{0, 1}, {2, 3}}, 2) == 2);          // neither is optional
  CHECK(kept({{0, 1}, {1, 5}}, 1) == 2);          // a common vertex
  CHECK(kept({{0, 1}, {4, 5}}, 1) == 1);          // two vertices in one place
  CHECK(kept({{0, 1}, {0, 7}}, 1) == 1);          // from one vertex over each other
  CHECK(kept({{0, 1}, {6, 7}}, 1) == 1);          // within the other
  CHECK(kept({{0, 1}, {1, 4}}, 1) == 1);          // without length
  CHECK(kept({{0, 1}, {8, 9}}, 1) == 2);          // far apart
  CHECK(kept({{0, 1}, {2, 3}, {3, 5}}, 1) == 2);  // the dropped one is no obstacle
}

TEST_CASE("wide faces know the places they cover", "[stitch]") {
  const TriangleMesh mesh = lattice({10.0, 10.0}, 4, 4, 8.0, 20.0);
  const View view = images::parallel_view(kExtent);
  const ImagePlane image = project_to_image(mesh.positions, view);
  const std::vector<Triangle> some(mesh.triangles.begin(), mesh.triangles.begin() + 8);
  const WideFaces wide(some, image);
  const double longest = 8.0 * std::sqrt(2.0);
  CHECK(wide.longest_side_at(grid_point({12, 11})) == Approx(longest));
  CHECK(wide.longest_side_at(grid_point({41, 17})) == Approx(longest));
  CHECK(wide.longest_side_at(grid_point({12, 19})) == 0.0);  // the next row
  CHECK(wide.longest_side_at(grid_point({5, 11})) == 0.0);
  CHECK(wide.longest_side_at(grid_point({60, 11})) == 0.0);
  CHECK(WideFaces({}, image).longest_side_at({0, 0}) == 0.0);
}

TEST_CASE("clean_up removes small fans and splits large ones", "[stitch]") {
  // Two squares of faces that share the vertex at their corner.
  const auto two_sheets = [](int columns) {
    TriangleMesh mesh = merged(lattice({0.0, 0.0}, 8, 8, 1.0, 20.0),
                               lattice({8.0, 8.0}, columns, columns, 1.0, 20.0));
    const std::uint32_t corner = 80;  // (8, 8) of the first
    const std::uint32_t copy = 81;    // (0, 0) of the second
    for (Triangle& t : mesh.triangles)
      std::replace(t.begin(), t.end(), copy, corner);
    return mesh;
  };
  const auto cleaned = [](TriangleMesh& mesh, std::size_t min_component, std::size_t kept = 0) {
    std::vector<std::uint8_t> touched(mesh.positions.size(), 0);
    touched[80] = 1;
    std::vector<std::uint8_t> marks = touched;
    const CleanUpReport report = clean_up(mesh, touched, marks, min_component, {}, kept);
    CHECK(marks.size() == mesh.positions.size());
    check_mesh(mesh);
    return report;
  };
  SECTION("a fan of two faces goes") {
    TriangleMesh mesh = two_sheets(4);
    const CleanUpReport report = cleaned(mesh, 1);
    CHECK(report.opened_fans == 2);
    CHECK(report.split_vertices == 0);
    CHECK(mesh.triangles.size() == 128 + 32 - 2);
    CHECK(report_mesh(mesh).components == 2);
  }
  SECTION("a fan of three gets its own vertex") {
    TriangleMesh mesh = two_sheets(4);
    // On each side one of the two faces at the corner becomes three, two of them at the corner.
    for (std::size_t f : {std::size_t{0}, std::size_t{128}}) {
      while (std::count(mesh.triangles[f].begin(), mesh.triangles[f].end(), 80U) == 0)
        ++f;
      const auto [a, b, c] = mesh.triangles[f];
      const auto middle = static_cast<std::uint32_t>(mesh.positions.size());
      const Vec3 center = (mesh.positions[a] + mesh.positions[b] + mesh.positions[c]) / 3.0;
      mesh.positions.push_back(center);
      mesh.triangles[f] = {a, b, middle};
      mesh.triangles.push_back({b, c, middle});
      mesh.triangles.push_back({c, a, middle});
    }
    const CleanUpReport report = cleaned(mesh, 1);
    CHECK(report.opened_fans == 0);
    CHECK(report.split_vertices == 1);
    CHECK(mesh.triangles.size() == 128 + 32 + 4);
    CHECK(report_mesh(mesh).components == 2);
  }
  SECTION("a small piece goes only if it was touched") {
    TriangleMesh mesh = merged(two_sheets(3), lattice({30.0, 30.0}, 2, 2, 1.0, 20.0));
    const CleanUpReport report = cleaned(mesh, 40);
    CHECK(report.dropped_components == 1);
    CHECK(report.dropped_faces + report.opened_fans == 18);
    CHECK(mesh.triangles.size() == 128 + 8);
  }
  SECTION("a small piece stays if it has a vertex of those that are kept") {
    const std::size_t first_of_small = 81;
    for (const std::size_t kept : {first_of_small, first_of_small + 2}) {
      CAPTURE(kept);
      TriangleMesh mesh = two_sheets(3);
      const CleanUpReport report = cleaned(mesh, 40, kept);
      CHECK(report.dropped_components == (kept == first_of_small ? 1U : 0U));
      CHECK(mesh.triangles.size() == 128 + (kept == first_of_small ? 0U : 16U));
    }
  }
}

#include "core/finish/orient_pieces.h"

#include <algorithm>
#include <catch2/catch.hpp>
#include <cmath>
#include <cstdint>
#include <utility>
#include <vector>

#include "core/finish/corner_table.h"
#include "core/mesh/mesh_report.h"
#include "core/mesh/triangle_mesh.h"
#include "tests/core/finish/shapes.h"

namespace rangezip {
namespace {

constexpr int kN = 32;
constexpr double kSide = 2.0 / kN;

/// A sphere cut open at the heights 0.2 and 0.6: a large piece, a ring, and a cap.
TriangleMesh cut_sphere() {
  TriangleMesh mesh = testing::sphere(kN);
  for (const double height : {0.2, 0.6})
    testing::cut_where(mesh, [&](const Vec3& p) { return std::abs(p.z - height) < 0.5 * kSide; });
  REQUIRE(report_mesh(mesh).components == 3);
  return mesh;
}

/// Turns the faces that lie between two heights inside out.
TriangleMesh turned_between(TriangleMesh mesh, double low, double high) {
  for (Triangle& t : mesh.triangles) {
    const double z = mesh.positions[t[0]].z;
    if (z > low && z < high) std::swap(t[1], t[2]);
  }
  return mesh;
}

/// Half-edges of faces at the boundary between two heights that have none on the other side.
std::vector<std::pair<std::uint32_t, std::uint32_t>> rim_between(const TriangleMesh& mesh,
                                                                 double low, double high) {
  const CornerTable table(mesh.triangles, mesh.positions.size());
  std::vector<std::pair<std::uint32_t, std::uint32_t>> rim;
  for (std::uint32_t c = 0; c < table.corner_count(); ++c) {
    const double z = mesh.positions[table.vertex(c)].z;
    if (table.across(c) == CornerTable::kNone && z > low && z < high)
      rim.emplace_back(table.vertex(c), table.head(c));
  }
  return rim;
}

/// Joins what is below a cut to a turned piece above it by two faces that fold back, as a seam may.
void join_by_fold(TriangleMesh& mesh, double height) {
  const auto [p, q] = rim_between(mesh, height, height + 2.0 * kSide).front();
  std::pair<std::uint32_t, std::uint32_t> below;
  double least = 10.0;
  for (const auto& edge : rim_between(mesh, height - 2.0 * kSide, height)) {
    const double distance = glm::distance(mesh.positions[edge.first], mesh.positions[p]);
    if (distance >= least) continue;
    least = distance;
    below = edge;
  }
  mesh.triangles.push_back({q, p, below.first});
  mesh.triangles.push_back({below.second, below.first, p});
}

/// A square sheet of n x n cells in the plane z = `level`, from x = `left` on, that looks up.
void add_sheet(TriangleMesh& mesh, double left, double level, int n, bool looks_up) {
  const auto first = static_cast<std::uint32_t>(mesh.positions.size());
  const auto row = static_cast<std::uint32_t>(n + 1);
  for (int y = 0; y <= n; ++y) {
    for (int x = 0; x <= n; ++x)
      mesh.positions.emplace_back(left + x, y, level);
  }
  for (std::uint32_t y = 0; y + 1 < row; ++y) {
    for (std::uint32_t x = 0; x + 1 < row; ++x) {
      const std::uint32_t a = first + y * row + x;
      mesh.triangles.push_back({a, a + 1, a + row + 1});
      mesh.triangles.push_back({a, a + row + 1, a + row});
      if (looks_up) continue;
      for (std::size_t i = mesh.triangles.size() - 2; i < mesh.triangles.size(); ++i)
        std::swap(mesh.triangles[i][1], mesh.triangles[i][2]);
    }
  }
}

/// Whether what a mesh lacks of another are faces near one of the heights at which pieces are
/// parted that face opposite ways, and all else is the same.
bool lacks_only_joints(const TriangleMesh& mesh, const TriangleMesh& whole,
                       const std::vector<double>& heights) {
  if (mesh.positions != whole.positions) return false;
  auto next = mesh.triangles.begin();
  for (const Triangle& t : whole.triangles) {
    if (next != mesh.triangles.end() && *next == t) {
      ++next;
      continue;
    }
    const double z = whole.positions[t[0]].z;
    if (std::none_of(heights.begin(), heights.end(),
                     [&](double height) { return std::abs(z - height) < 3.5 * kSide; }))
      return false;
  }
  return next == mesh.triangles.end();
}

}  // namespace

TEST_CASE("pieces that continue a surface come to face as its largest one does") {
  const TriangleMesh right = cut_sphere();
  const auto [low, high, count] = GENERATE(table<double, double, std::size_t>(
      {{2.0, 3.0, 0U},  // none
       {0.6, 2.0, 1U},  // the cap
       {0.2, 0.6, 1U},  // the ring: the cap is compared with it as it is to be
       {0.2, 2.0, 2U}}));
  CAPTURE(low, high);
  TriangleMesh mesh = turned_between(right, low, high);
  REQUIRE(orient_pieces(mesh, kSide) == count);
  REQUIRE(lacks_only_joints(mesh, right, {low, high}));
}

TEST_CASE("a piece that hangs by a fold only is one of its own") {
  const TriangleMesh right = cut_sphere();
  TriangleMesh mesh = turned_between(right, 0.6, 2.0);
  join_by_fold(mesh, 0.6);
  REQUIRE(report_mesh(mesh).components == 2);
  REQUIRE(report_mesh(mesh).misoriented_edges == 0);
  REQUIRE(orient_pieces(mesh, kSide) == 1);
  REQUIRE(lacks_only_joints(mesh, right, {0.6}));  // of the fold nothing can stay
}

TEST_CASE("where the largest piece faces inwards, so do all") {
  const TriangleMesh inwards = turned_between(cut_sphere(), -2.0, 2.0);
  TriangleMesh mesh = turned_between(inwards, 0.6, 2.0);
  REQUIRE(orient_pieces(mesh, kSide) == 1);
  REQUIRE(lacks_only_joints(mesh, inwards, {0.6}));
}

TEST_CASE("a piece that meets another along a side is turned, one that does in a place stays") {
  const auto [width, count] = GENERATE(table<int, std::size_t>({{24, 1U}, {3, 0U}}));
  CAPTURE(width);
  TriangleMesh mesh;
  add_sheet(mesh, 0.0, 0.0, 30, true);
  TriangleMesh tongue;  // from the middle of a side of the sheet to the piece
  add_sheet(tongue, 30.5, 0.0, 24, false);
  const double low = 12.0 - 0.5 * width, high = 12.0 + 0.5 * width;
  testing::cut_where(
      tongue, [&](const Vec3& p) { return p.x < 34.0 && (p.y < low - 0.1 || p.y > high + 0.1); });
  testing::append(mesh, tongue);
  REQUIRE(orient_pieces(mesh, 0.6) == count);
}

TEST_CASE("a scrap is not turned, whatever it continues") {
  const auto [n, count] = GENERATE(table<int, std::size_t>({{6, 1U}, {4, 0U}}));
  CAPTURE(n);
  TriangleMesh mesh;
  add_sheet(mesh, 0.0, 0.0, 30, true);
  add_sheet(mesh, 30.5, 0.0, n, false);
  const TriangleMesh before = mesh;
  REQUIRE(orient_pieces(mesh, 0.6) == count);
  REQUIRE((mesh == before) == (count == 0));
}

TEST_CASE("a turned piece ends before what it continues, though it lay over its rim") {
  TriangleMesh mesh;
  add_sheet(mesh, 0.0, 0.0, 30, true);
  add_sheet(mesh, 29.5, 0.1, 24, false);
  REQUIRE(orient_pieces(mesh, 1.0) == 1);
  double nearest = 100.0;
  for (const Triangle& t : mesh.triangles) {
    REQUIRE(unit_normal(mesh.positions, t).z == Approx(1.0));
    for (const std::uint32_t v : t) {
      const Vec3& p = mesh.positions[v];
      if (p.z > 0.0 && p.y > 6.0 && p.y < 18.0) nearest = std::min(nearest, p.x);
    }
  }
  REQUIRE(nearest > 31.0);  // the rim is at 30
  REQUIRE(nearest < 33.0);
}

TEST_CASE("the two sides of a plate or wall stay as they are, over each other or side by side") {
  const auto [left, n] = GENERATE(table<double, int>({{0.0, 11}, {13.0, 12}}));
  CAPTURE(left);
  TriangleMesh mesh;
  add_sheet(mesh, 0.0, 0.0, 12, true);
  add_sheet(mesh, left, -2.0, n, false);
  const TriangleMesh before = mesh;
  REQUIRE(orient_pieces(mesh, 1.0) == 0);
  REQUIRE(mesh == before);
}

}  // namespace rangezip

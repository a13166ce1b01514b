#include "core/finish/border_step.h"

#include <algorithm>
#include <catch2/catch.hpp>
#include <cmath>
#include <optional>

#include "core/mesh/mesh_report.h"

namespace rangezip {
namespace {

constexpr double kH = 1.0;

/// Three triangles of a fan around (0, 0): the border runs (2, 0), (2, 2), (0, 2), (-2, 2), and
/// back through the middle, where the fan is open.
TriangleMesh fan() {
  return {{{0, 0, 0}, {2, 0, 0}, {2, 2, 0}, {0, 2, 0}, {-2, 2, 0}},
          {{0, 1, 2}, {0, 2, 3}, {0, 3, 4}},
          {}};
}

/// The gap of a point beyond the edge from vertex `a` to `b`.
BorderGap gap_at(const TriangleMesh& mesh, const CornerTable& table, std::uint32_t a,
                 std::uint32_t b, const Vec3& point) {
  for (std::uint32_t c = 0; c < table.corner_count(); ++c) {
    if (table.vertex(c) != a || table.head(c) != b) continue;
    const Vec3 along = mesh.positions[b] - mesh.positions[a];
    const Vec3 from = point - mesh.positions[a];
    const double share = std::clamp(glm::dot(from, along) / glm::dot(along, along), 0.0, 1.0);
    const Vec3 outward = glm::normalize(Vec3(along.y, -along.x, 0.0));
    return {c, point, share, glm::dot(from - share * along, outward), point.z, outward, {0, 0, 1}};
  }
  FAIL("no such edge");
  return {};
}

std::optional<BorderStep> find(const std::vector<BorderStep>& steps, BorderStepKind kind,
                               int halvings = 0) {
  const auto at = std::find_if(steps.begin(), steps.end(), [&](const BorderStep& s) {
    return s.kind == kind && s.halvings == halvings;
  });
  return at == steps.end() ? std::nullopt : std::optional(*at);
}

double area_of(const TriangleMesh& mesh) {
  double sum = 0.0;
  for (const Triangle& t : mesh.triangles) {
    sum += 0.5 * area_vector(mesh.positions[t[0]], mesh.positions[t[1]], mesh.positions[t[2]]).z;
  }
  return sum;
}

TEST_CASE("each step towards a point makes the faces it says and keeps the mesh manifold") {
  const TriangleMesh before = fan();
  const CornerTable table(before.triangles, before.positions.size());
  const BorderGap gap = gap_at(before, table, 2, 3, {1, 2.5, 0});
  const auto steps = steps_towards(gap, before, table, kH);
  struct Expected {
    BorderStepKind kind;
    std::size_t faces, vertices;
    double area;  // that comes in
  };
  for (const Expected& e :
       {Expected{BorderStepKind::split, 4, 6, 0.5}, Expected{BorderStepKind::ear, 4, 6, 0.5},
        // (2, 2) goes to (1, 2.5): the two faces around it change.
        Expected{BorderStepKind::move_start, 3, 5, -0.5},
        // (0, 2) goes there: so do those around that.
        Expected{BorderStepKind::move_end, 3, 5, 1.0}}) {
    CAPTURE(static_cast<int>(e.kind));
    const auto step = find(steps, e.kind);
    REQUIRE(step);
    REQUIRE(step->target == gap.point);
    REQUIRE(step->quality > 0.0);
    TriangleMesh mesh = before;
    const auto changed = apply_step(*step, table, mesh);
    REQUIRE(mesh.triangles.size() == e.faces);
    REQUIRE(mesh.positions.size() == e.vertices);
    REQUIRE(report_mesh(mesh).is_manifold());
    REQUIRE(area_of(mesh) - area_of(before) == Approx(e.area));
    for (std::uint32_t f = 0; f < before.triangles.size(); ++f) {
      const bool is_changed = std::find(changed.begin(), changed.end(), f) != changed.end();
      if (!is_changed) REQUIRE(mesh.triangles[f] == before.triangles[f]);
    }
  }
}

TEST_CASE("a halved step goes half the way from the edge's foot or the vertex") {
  const TriangleMesh mesh = fan();
  const CornerTable table(mesh.triangles, mesh.positions.size());
  const auto steps = steps_towards(gap_at(mesh, table, 2, 3, {1, 2.5, 0}), mesh, table, kH);
  REQUIRE(find(steps, BorderStepKind::split, 1)->target == Vec3(1, 2.25, 0));
  REQUIRE(find(steps, BorderStepKind::ear, 2)->target == Vec3(1, 2.125, 0));
  REQUIRE(find(steps, BorderStepKind::move_start, 1)->target == Vec3(1.5, 2.25, 0));
}

TEST_CASE("a point high over the sheet is passed under, one that rises gently is reached") {
  const TriangleMesh mesh = fan();
  const CornerTable table(mesh.triangles, mesh.positions.size());
  const auto high = steps_towards(gap_at(mesh, table, 2, 3, {1, 2.25, 0.75}), mesh, table, kH);
  REQUIRE(find(high, BorderStepKind::ear)->target == Vec3(1, 2.25, 0));
  const auto gentle = steps_towards(gap_at(mesh, table, 2, 3, {1, 2.75, 0.5}), mesh, table, kH);
  REQUIRE(find(gentle, BorderStepKind::ear)->target == Vec3(1, 2.75, 0.5));
}

TEST_CASE("a notch is closed by one face between its two edges, unless its ends are far apart") {
  // Three quarters of a square around the middle; its ends are 2 sqrt(2) apart.
  const TriangleMesh before{{{0, 0, 0}, {2, 0, 0}, {0, 2, 0}, {-2, 0, 0}, {0, -2, 0}},
                            {{0, 1, 2}, {0, 2, 3}, {0, 3, 4}},
                            {}};
  const CornerTable table(before.triangles, before.positions.size());
  const BorderGap gap = gap_at(before, table, 0, 1, {1, -0.25, 0});
  REQUIRE_FALSE(find(steps_towards(gap, before, table, 0.9 * kH), BorderStepKind::notch_start));
  const auto step = find(steps_towards(gap, before, table, kH), BorderStepKind::notch_start);
  REQUIRE(step);
  TriangleMesh mesh = before;
  apply_step(*step, table, mesh);
  REQUIRE(mesh.triangles.back() == Triangle{1, 0, 4});
  REQUIRE(report_mesh(mesh).is_manifold());
}

TEST_CASE("no step turns a face over") {
  const TriangleMesh mesh = fan();
  const CornerTable table(mesh.triangles, mesh.positions.size());
  // The start of the edge would pass over its neighbour.
  const auto steps = steps_towards(gap_at(mesh, table, 2, 3, {-0.5, 2.25, 0}), mesh, table, kH);
  REQUIRE_FALSE(find(steps, BorderStepKind::move_start));
}

TEST_CASE("a cut takes the edge's face, and with each ring the faces around it") {
  const TriangleMesh mesh = fan();
  const CornerTable table(mesh.triangles, mesh.positions.size());
  const BorderGap gap = gap_at(mesh, table, 1, 2, {2.5, 1, 0});
  REQUIRE(cut_at(gap.corner, table, 0).faces == std::vector<std::uint32_t>{0});
  REQUIRE(cut_at(gap.corner, table, 0).vertices.size() == 3);
  REQUIRE(cut_at(gap.corner, table, 1).faces.size() == 3);
  REQUIRE(cut_at(gap.corner, table, 1).vertices.size() == 5);
}

}  // namespace
}  // namespace rangezip

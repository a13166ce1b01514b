#include "core/finish/relax_border.h"

#include <algorithm>
#include <cstdint>
#include <optional>
#include <vector>

#include "core/finish/corner_table.h"
#include "core/finish/relax_features.h"
#include "core/finish/surface_fit.h"
#include "core/finish/vertex_geometry.h"
#include "core/mesh/face_changes.h"
#include "core/mesh/self_intersection.h"

namespace rangezip {
namespace {

constexpr int kRounds = 4;
// Angles are cosines.
constexpr double kFitMinCosine = 0.6;  // between the fitted surface and the mesh
constexpr double kFaceCosine = 0.5;    // between a face and the mesh
constexpr std::uint8_t kCorner = 2;    // relax_features() moves none

std::vector<std::uint8_t> border_of(const CornerTable& table) {
  std::vector<std::uint8_t> is_border(table.vertex_count(), 0);
  for (std::uint32_t v = 0; v < is_border.size(); ++v) {
    if (table.corner_of(v) != CornerTable::kNone && table.is_boundary(v)) is_border[v] = kCorner;
  }
  return is_border;
}

/// Whether a feature may run through a vertex.
bool has_crease(const CornerTable& table, const std::vector<Vec3>& positions, std::uint32_t v) {
  bool found = false;
  table.for_each_corner(v, [&](std::uint32_t c) {
    if (table.across(c) == CornerTable::kNone) return;
    found = found || is_crease(table, positions, c);
  });
  return found;
}

/// Moves what does not stay.
void relax(TriangleMesh& mesh, const std::vector<std::uint8_t>& is_border,
           const std::vector<std::uint8_t>& stays, const PointGrid& surface, const FitWindow& fit) {
  CornerTable table(mesh.triangles, mesh.positions.size());
  std::vector<Vec3>& positions = mesh.positions;
  const auto may_change = [&](std::uint32_t v) {
    return stays[v] == 0 && !has_crease(table, positions, v);
  };
  const auto place_on = [&](std::uint32_t v, const Vec3& target) -> std::optional<Vec3> {
    if (!may_change(v)) return std::nullopt;
    const Vec3 normal = vertex_normal(table, positions, v);
    const SurfaceFit found = fit_surface(surface, target, normal, fit.at(target));
    if (!found.is_found || glm::dot(found.normal, normal) < kFitMinCosine) return std::nullopt;
    return found.foot;
  };
  const auto may_face = [&](std::uint32_t v, const Vec3& direction) {
    return has_cosine(vertex_normal(table, positions, v), direction, kFaceCosine);
  };
  relax_features(table, positions, is_border, {place_on, may_change, may_face});
  mesh.triangles = table.triangles();
}

}  // namespace

bool relax_border(TriangleMesh& mesh, const PointGrid& surface, const FitWindow& fit,
                  const Progress& progress) {
  const std::vector<std::uint8_t> is_border =
      border_of(CornerTable(mesh.triangles, mesh.positions.size()));
  if (std::find(is_border.begin(), is_border.end(), kCorner) == is_border.end()) return false;
  const TriangleMesh before{mesh.positions, mesh.triangles, {}};
  std::vector<std::uint8_t> stays(mesh.positions.size(), 0);
  for (int round = 0; round < kRounds; ++round) {
    progress.check_stop();
    relax(mesh, is_border, stays, surface, fit);
    const auto crossing =
        self_intersections(mesh, find_face_changes(before, mesh).made, {}, progress);
    if (crossing.empty()) return true;
    for (const auto& [i, j] : crossing) {
      for (const std::uint32_t f : {i, j}) {
        for (const std::uint32_t v : mesh.triangles[f])
          stays[v] = 1;
      }
    }
    mesh.positions = before.positions;
    mesh.triangles = before.triangles;
  }
  return false;
}

}  // namespace rangezip

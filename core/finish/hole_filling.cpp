#include "core/finish/hole_filling.h"

#include <algorithm>
#include <map>
#include <utility>

#include "core/base/check_number.h"
#include "core/finish/clean_topology.h"
#include "core/finish/fill_patch.h"
#include "core/finish/loop_triangulation.h"
#include "core/finish/verified_fills.h"

namespace rangezip {
namespace {

/// Holes around which fewer edges fit need no new points.
constexpr double kMinEdgesToRefine = 10.5;

/// Of new edges, in lengths of the loop.
constexpr double kShortestEdge = 0.001;

double perimeter_of(const std::vector<Vec3>& loop) {
  double perimeter = 0.0;
  for (std::size_t i = 0; i < loop.size(); ++i)
    perimeter += glm::length(loop[(i + 1) % loop.size()] - loop[i]);
  return perimeter;
}

/// Per point of the loop the length asked for, or the mean of its two edges.
std::vector<double> scales_of(const std::vector<Vec3>& loop, double edge_length) {
  const std::size_t n = loop.size();
  const double least = perimeter_of(loop) * std::min(kShortestEdge, 1.0 / static_cast<double>(n));
  std::vector<double> scales(n, std::max(edge_length, least));
  for (std::size_t i = 0; i < n && edge_length == 0.0; ++i) {
    const double before = glm::length(loop[i] - loop[(i + n - 1) % n]);
    const double after = glm::length(loop[(i + 1) % n] - loop[i]);
    scales[i] = 0.5 * (before + after);
  }
  return scales;
}

/// As many edges of the loop or of the length asked for that new points are worth it.
bool is_worth_refining(const LoopShape& loop, double edge_length) {
  if (static_cast<double>(loop.points.size()) > kMinEdgesToRefine) return true;
  return edge_length > 0.0 && perimeter_of(loop.points) > kMinEdgesToRefine * edge_length;
}

LoopSurroundings surroundings_of(const std::vector<Vec3>& positions, const CornerTable& table,
                                 const std::vector<std::uint32_t>& vertices) {
  LoopSurroundings around;
  for (const std::uint32_t v : vertices) {
    Vec3 sum{0.0};
    int count = 0;
    table.for_each_neighbor(v, [&](std::uint32_t w) {
      sum += positions[w];
      ++count;
    });
    around.neighbor_sum.push_back(sum);
    around.neighbor_count.push_back(count);
  }
  return around;
}

}  // namespace

HoleFill fill_loop(const std::vector<Vec3>& positions, const CornerTable& table,
                   const BoundaryLoop& loop, FillShape shape, double edge_length,
                   const CloudEvidence& evidence, TriangulationMemo* memo) {
  const std::vector<std::uint32_t> vertices = vertices_of(loop, table);
  LoopShape polygon = shape_of(loop, table, positions, evidence);
  polygon.by_length = shape == FillShape::narrow;
  FillPatch patch{polygon.points, triangulate_loop(polygon, memo), vertices.size()};
  const bool is_refined = shape == FillShape::flat || shape == FillShape::smooth;
  if (is_refined && !patch.triangles.empty() && is_worth_refining(polygon, edge_length)) {
    refine_patch(patch, scales_of(polygon.points, edge_length),
                 [&](std::uint32_t i, std::uint32_t k) { return polygon.is_forbidden(i, k); });
    flatten_patch(patch);
    if (shape == FillShape::smooth) fair_patch(patch, surroundings_of(positions, table, vertices));
  }
  HoleFill fill;
  const auto n = static_cast<std::uint32_t>(vertices.size());
  const auto first_new = static_cast<std::uint32_t>(positions.size());
  for (Triangle t : patch.triangles) {
    for (std::uint32_t& v : t)
      v = v < n ? vertices[v] : first_new + (v - n);
    fill.triangles.push_back(t);
  }
  fill.new_positions.assign(patch.positions.begin() + n, patch.positions.end());
  return fill;
}

double continuation_of(const std::vector<Vec3>& positions, const CornerTable& table,
                       std::span<const std::uint32_t> corners, const std::vector<Triangle>& fill) {
  std::map<std::pair<std::uint32_t, std::uint32_t>, Vec3> beside;
  for (const std::uint32_t c : corners)
    beside[{table.head(c), table.vertex(c)}] = unit_normal(positions, table.triangle(c / 3));
  double sum = 0.0;
  for (const Triangle& t : fill) {
    for (std::size_t k = 0; k < 3; ++k) {
      const auto found = beside.find({t[k], t[(k + 1) % 3]});
      if (found != beside.end()) sum += glm::dot(found->second, unit_normal(positions, t));
    }
  }
  return sum / static_cast<double>(corners.size());
}

void append_fill(TriangleMesh& mesh, const HoleFill& fill, std::size_t base) {
  const std::size_t first_new = mesh.positions.size();
  for (Triangle t : fill.triangles) {
    for (std::uint32_t& v : t) {
      if (v >= base) v = static_cast<std::uint32_t>(v - base + first_new);
    }
    mesh.triangles.push_back(t);
  }
  mesh.positions.insert(mesh.positions.end(), fill.new_positions.begin(), fill.new_positions.end());
  if (!mesh.sources.empty()) mesh.sources.resize(mesh.positions.size());
}

FilledMesh fill_mesh_holes(TriangleMesh mesh, double edge_length, double max_perimeter) {
  check_not_negative("fill_mesh_holes: edge_length", edge_length);
  check_not_negative("fill_mesh_holes: max_perimeter", max_perimeter);
  clean_topology(mesh);
  std::vector<FillRequest> requests;
  const CornerTable table(mesh.triangles, mesh.positions.size());
  for (BoundaryLoop& loop : boundary_loops(table)) {
    if (perimeter_of(loop, table, mesh.positions) > max_perimeter) continue;
    requests.push_back({std::move(loop), FillShape::smooth});
  }
  const VerifiedFills fills = fill_verified(mesh, table, requests, {.edge_length = edge_length});
  FilledMesh result;
  result.filled_holes = fills.filled_holes;
  result.filled_faces = fills.filled_faces;
  remove_unused_vertices(mesh);
  result.mesh = std::move(mesh);
  return result;
}

}  // namespace rangezip

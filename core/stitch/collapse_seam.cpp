#include "core/stitch/collapse_seam.h"

#include <algorithm>

#include "core/stitch/sheet_mesh.h"

namespace rangezip {

namespace {

using VertexHandle = SheetMesh::VertexHandle;
using HalfedgeHandle = SheetMesh::HalfedgeHandle;

/// Each pass can shorten edges below the limit; few do after the third.
constexpr int kPasses = 3;

/// Largest turn of a face: the cosine of 60 degrees.
constexpr double kMinTurnCosine = 0.5;

/// A face must keep this share of the area of a square with the shortest allowed edge.
constexpr double kMinAreaShare = 0.25;

/// Marks the vertices of all faces that have a marked one.
std::vector<std::uint8_t> grow(const TriangleMesh& mesh, const std::vector<std::uint8_t>& marked) {
  std::vector<std::uint8_t> grown = marked;
  for (const Triangle& face : mesh.triangles) {
    if (marked[face[0]] + marked[face[1]] + marked[face[2]] == 0) continue;
    for (const std::uint32_t v : face)
      grown[v] = 1;
  }
  return grown;
}

class Collapser {
 public:
  /// @param seam, movable per vertex of the sheet; all faces around a movable one are in it
  Collapser(SheetMesh& sheet, std::vector<std::uint8_t> seam, std::vector<std::uint8_t> movable,
            double min_length)
      : mesh_(sheet.mesh),
        seam_(std::move(seam)),
        movable_(std::move(movable)),
        min_square_(min_length * min_length) {}

  std::size_t collapse_all();

 private:
  [[nodiscard]] bool is_seam(VertexHandle v) const {
    return seam_[static_cast<std::size_t>(v.idx())] != 0;
  }
  [[nodiscard]] bool is_movable(VertexHandle v) const {
    return movable_[static_cast<std::size_t>(v.idx())] != 0;
  }
  [[nodiscard]] bool is_candidate(HalfedgeMesh::EdgeHandle edge) const;
  [[nodiscard]] bool can_collapse(HalfedgeHandle e) const;
  [[nodiscard]] bool keeps_faces(HalfedgeHandle e) const;

  HalfedgeMesh& mesh_;
  std::vector<std::uint8_t> seam_;
  std::vector<std::uint8_t> movable_;
  double min_square_;
};

bool Collapser::is_candidate(HalfedgeMesh::EdgeHandle edge) const {
  const HalfedgeHandle e = mesh_.halfedge_handle(edge, 0);
  const VertexHandle a = mesh_.from_vertex_handle(e);
  const VertexHandle b = mesh_.to_vertex_handle(e);
  const Vec3 vector = mesh_.point(b) - mesh_.point(a);
  return (is_seam(a) || is_seam(b)) && is_movable(a) && is_movable(b) &&
         glm::dot(vector, vector) < min_square_;
}

/// Whether every face that moves with the vertex keeps its area and direction.
bool Collapser::keeps_faces(HalfedgeHandle e) const {
  const VertexHandle from = mesh_.from_vertex_handle(e);
  const VertexHandle to = mesh_.to_vertex_handle(e);
  for (const HalfedgeHandle out : mesh_.voh_range(from)) {
    if (mesh_.is_boundary(out)) continue;
    const VertexHandle a = mesh_.to_vertex_handle(out);
    const VertexHandle b = mesh_.to_vertex_handle(mesh_.next_halfedge_handle(out));
    if (a == to || b == to) continue;  // a face that vanishes
    const Vec3 before = area_vector(mesh_.point(from), mesh_.point(a), mesh_.point(b));
    const Vec3 after = area_vector(mesh_.point(to), mesh_.point(a), mesh_.point(b));
    const double size = glm::length(after);
    if (size < kMinAreaShare * min_square_) return false;
    if (glm::dot(before, after) < kMinTurnCosine * glm::length(before) * size) return false;
  }
  return true;
}

bool Collapser::can_collapse(HalfedgeHandle e) const {
  const bool moves_boundary =
      mesh_.is_boundary(mesh_.from_vertex_handle(e)) && !mesh_.is_boundary(mesh_.edge_handle(e));
  return !moves_boundary && mesh_.is_collapse_ok(e) && keeps_faces(e);
}

std::size_t Collapser::collapse_all() {
  std::size_t count = 0;
  for (int pass = 0; pass < kPasses; ++pass) {
    const std::size_t before = count;
    for (const auto edge : mesh_.edges()) {
      if (!is_candidate(edge)) continue;
      HalfedgeHandle e = mesh_.halfedge_handle(edge, 0);
      if (!is_seam(mesh_.to_vertex_handle(e))) e = mesh_.opposite_halfedge_handle(e);
      if (!can_collapse(e)) e = mesh_.opposite_halfedge_handle(e);
      if (!can_collapse(e)) continue;
      seam_[static_cast<std::size_t>(mesh_.to_vertex_handle(e).idx())] = 1;
      mesh_.collapse(e);
      ++count;
    }
    if (count == before) break;
  }
  return count;
}

}  // namespace

std::size_t collapse_short_seam_edges(TriangleMesh& mesh, const std::vector<std::uint8_t>& seam,
                                      double min_length) {
  // A collapse looks at the neighbours of both ends: of seam vertices and their neighbours.
  const std::vector<std::uint8_t> movable = grow(mesh, seam);
  std::vector<std::uint8_t> cut(mesh.triangles.size(), 0);
  for (std::size_t f = 0; f < cut.size(); ++f) {
    const Triangle& face = mesh.triangles[f];
    cut[f] = movable[face[0]] + movable[face[1]] + movable[face[2]] > 0 ? 1 : 0;
  }
  SheetMesh sheet = cut_out(mesh, cut);
  const auto in_sheet = [&](const std::vector<std::uint8_t>& whole) {
    std::vector<std::uint8_t> part;
    for (const std::uint32_t v : sheet.vertex_in_whole)
      part.push_back(whole[v]);
    return part;
  };
  const std::size_t count =
      Collapser(sheet, in_sheet(seam), in_sheet(movable), min_length).collapse_all();
  if (count == 0) return 0;

  remove_triangles(mesh.triangles, cut);
  const std::vector<Triangle> faces = faces_in_whole(sheet);
  mesh.triangles.insert(mesh.triangles.end(), faces.begin(), faces.end());
  return count;
}

}  // namespace rangezip

#include "core/mesh/nearest_face.h"

#include <optional>

namespace rangezip {

namespace {

Vec3 closest_point(const TriangleMesh& mesh, std::uint32_t face, const Vec3& point) {
  const Triangle& t = mesh.triangles[face];
  return closest_point_on_triangle(point, mesh.positions[t[0]], mesh.positions[t[1]],
                                   mesh.positions[t[2]]);
}

void keep_nearer(NearestFace& best, const TriangleMesh& mesh, std::uint32_t face,
                 const Vec3& point) {
  if (face == OutgoingEdges::kNone) return;
  const NearestFace candidate = measure_face(mesh, face, point);
  if (candidate.squared_distance < best.squared_distance) best = candidate;
}

/// Which corner of the face is its closest point, if one is.
std::optional<std::size_t> closest_corner(const TriangleMesh& mesh, std::uint32_t face,
                                          const Vec3& point) {
  const Vec3 closest = closest_point(mesh, face, point);
  for (std::size_t i = 0; i < 3; ++i) {
    if (mesh.positions[mesh.triangles[face][i]] == closest) return i;
  }
  return std::nullopt;
}

/// Looks at the faces that one meets by turning around a corner, one way until the boundary or the
/// start is reached. A turn in a mesh whose edges are in more than two faces need not come back.
void turn_around(NearestFace& best, const TriangleMesh& mesh, const OutgoingEdges& edges,
                 std::uint32_t start, std::size_t corner, bool counter_clockwise,
                 const Vec3& point) {
  constexpr int kMaxTurn = 64;  // faces; a corner of more is not worth the search
  const std::uint32_t vertex = mesh.triangles[start][corner];
  std::uint32_t face = start;
  for (int turn = 0; turn < kMaxTurn; ++turn) {
    const Triangle& t = mesh.triangles[face];
    const std::size_t i = t[0] == vertex ? 0 : t[1] == vertex ? 1 : 2;
    face =
        counter_clockwise ? edges.find(vertex, t[(i + 2) % 3]) : edges.find(t[(i + 1) % 3], vertex);
    if (face == OutgoingEdges::kNone || face == start) return;
    keep_nearer(best, mesh, face, point);
  }
}

NearestFace step(const TriangleMesh& mesh, const OutgoingEdges& edges, const NearestFace& here,
                 const Vec3& point) {
  const Triangle& t = mesh.triangles[here.face];
  NearestFace best = here;
  for (std::size_t i = 0; i < 3; ++i) {
    keep_nearer(best, mesh, edges.find(t[(i + 1) % 3], t[i]), point);
  }
  if (best != here) return best;
  const auto corner = closest_corner(mesh, here.face, point);
  if (!corner) return here;
  turn_around(best, mesh, edges, here.face, *corner, true, point);
  turn_around(best, mesh, edges, here.face, *corner, false, point);
  return best;
}

}  // namespace

NearestFace measure_face(const TriangleMesh& mesh, std::uint32_t face, const Vec3& point) {
  const Vec3 offset = closest_point(mesh, face, point) - point;
  return {face, glm::dot(offset, offset)};
}

NearestFace walk_to_nearest_face(const TriangleMesh& mesh, const OutgoingEdges& edges,
                                 std::uint32_t start, const Vec3& point) {
  NearestFace here = measure_face(mesh, start, point);
  for (;;) {
    const NearestFace next = step(mesh, edges, here, point);
    if (next == here) return here;
    here = next;
  }
}

}  // namespace rangezip

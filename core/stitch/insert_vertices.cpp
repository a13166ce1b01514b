#include "core/stitch/insert_vertices.h"

#include <cmath>

namespace rangezip {

namespace {

using VertexHandle = SheetMesh::VertexHandle;
using HalfedgeHandle = SheetMesh::HalfedgeHandle;
using FaceHandle = SheetMesh::FaceHandle;

/// The start of a walk is wrong by less than a pixel of the rasterizer: a few faces.
constexpr int kMaxSteps = 200;

/// Old and new surface may differ by this much more than the band: both have errors.
constexpr double kDepthShare = 1.5;

/// Where a point lies in the sheet.
struct Place {
  FaceHandle face = FaceHandle();          ///< invalid: outside
  HalfedgeHandle edge = HalfedgeHandle();  ///< of the face, if the point is on it
  VertexHandle vertex = VertexHandle();    ///< of the face, if the point is on it
};

/// The halfedge of the face that has the point strictly on its right.
HalfedgeHandle edge_toward(const SheetMesh& sheet, FaceHandle face, const GridPoint& point) {
  HalfedgeHandle e = sheet.mesh.halfedge_handle(face);
  for (int k = 0; k < 3; ++k, e = sheet.mesh.next_halfedge_handle(e)) {
    if (sheet.side(e, point) < 0) return e;
  }
  return HalfedgeHandle();
}

Place place_in_face(const SheetMesh& sheet, FaceHandle face, const GridPoint& point) {
  Place place{.face = face};
  HalfedgeHandle e = sheet.mesh.halfedge_handle(face);
  for (int k = 0; k < 3; ++k, e = sheet.mesh.next_halfedge_handle(e)) {
    if (sheet.side(e, point) == 0) place.edge = e;
    const VertexHandle v = sheet.mesh.to_vertex_handle(e);
    if (sheet.point(v) == point) place.vertex = v;
  }
  return place;
}

/// Walks over faces that look at the viewer.
Place locate(const SheetMesh& sheet, FaceHandle face, const GridPoint& point) {
  for (int step = 0; step < kMaxSteps && face.is_valid() && sheet.area(face) > 0; ++step) {
    const HalfedgeHandle e = edge_toward(sheet, face, point);
    if (!e.is_valid()) return place_in_face(sheet, face, point);
    face = sheet.mesh.face_handle(sheet.mesh.opposite_halfedge_handle(e));
  }
  return Place();
}

double depth_in_face(const SheetMesh& sheet, FaceHandle face, const GridPoint& p) {
  const auto [a, b, c] = sheet.corners(face);
  const auto of_a = static_cast<double>(orientation(sheet.point(b), sheet.point(c), p));
  const auto of_b = static_cast<double>(orientation(sheet.point(c), sheet.point(a), p));
  const auto of_c = static_cast<double>(orientation(sheet.point(a), sheet.point(b), p));
  return (of_a * sheet.depth(a) + of_b * sheet.depth(b) + of_c * sheet.depth(c)) /
         (of_a + of_b + of_c);
}

std::uint32_t& origin_of(SheetMesh& sheet, HalfedgeHandle e) {
  return sheet.face_in_whole[static_cast<std::size_t>(sheet.mesh.face_handle(e).idx())];
}

/// The two faces made by the split come from those that they were cut off, on the same side.
void split_edge(SheetMesh& sheet, HalfedgeHandle edge, VertexHandle v) {
  const std::array<HalfedgeHandle, 2> sides{edge, sheet.mesh.opposite_halfedge_handle(edge)};
  std::array<VertexHandle, 2> apexes;
  std::array<std::uint32_t, 2> origins{};
  for (std::size_t k = 0; k < 2; ++k) {
    if (sheet.mesh.is_boundary(sides[k])) continue;
    apexes[k] = sheet.mesh.to_vertex_handle(sheet.mesh.next_halfedge_handle(sides[k]));
    origins[k] = origin_of(sheet, sides[k]);
  }
  sheet.mesh.split(sheet.mesh.edge_handle(edge), v);
  sheet.face_in_whole.resize(sheet.mesh.n_faces());
  for (std::size_t k = 0; k < 2; ++k) {
    if (!apexes[k].is_valid()) continue;
    const HalfedgeHandle spoke = sheet.mesh.find_halfedge(v, apexes[k]);
    origin_of(sheet, spoke) = origins[k];
    origin_of(sheet, sheet.mesh.opposite_halfedge_handle(spoke)) = origins[k];
  }
}

void split_face(SheetMesh& sheet, FaceHandle face, VertexHandle v) {
  const std::uint32_t origin = sheet.face_in_whole[static_cast<std::size_t>(face.idx())];
  sheet.mesh.split(face, v);
  sheet.face_in_whole.resize(sheet.mesh.n_faces(), origin);
}

VertexHandle insert(SheetMesh& sheet, const Place& place, const BoundaryVertex& vertex) {
  if (place.vertex.is_valid()) {
    const auto v = static_cast<std::size_t>(place.vertex.idx());
    sheet.mesh.set_point(place.vertex, vertex.position);
    sheet.depths[v] = vertex.depth;
    return place.vertex;
  }
  const VertexHandle v = sheet.mesh.add_vertex(vertex.position);
  sheet.points.push_back(grid_point(vertex.pixel));
  sheet.depths.push_back(vertex.depth);
  sheet.vertex_in_whole.push_back(vertex.index);
  if (place.edge.is_valid()) {
    split_edge(sheet, place.edge, v);
  } else {
    split_face(sheet, place.face, v);
  }
  return v;
}

}  // namespace

double distance_to_face(const TriangleMesh& mesh, std::uint32_t face, const Vec3& point) {
  const auto& [a, b, c] = mesh.triangles[face];
  return std::sqrt(
      squared_distance_to_triangle(point, mesh.positions[a], mesh.positions[b], mesh.positions[c]));
}

InsertedVertices insert_boundary_vertices(SheetMesh& sheet, const TriangleMesh& old_surface,
                                          std::span<const BoundaryVertex> vertices,
                                          std::span<const FaceHandle> faces,
                                          const PatchSheet& patch, double band) {
  InsertedVertices result;
  result.handles.resize(vertices.size());
  result.faces.resize(vertices.size());
  for (std::size_t i = 0; i < vertices.size(); ++i) {
    const BoundaryVertex& vertex = vertices[i];
    const GridPoint point = grid_point(vertex.pixel);
    const Place place = locate(sheet, faces[i], point);
    if (!place.face.is_valid()) continue;
    const double limit = kDepthShare * band * patch[vertex.pixel].stretch *
                         patch.image().view().pixel_size(vertex.depth);
    if (std::abs(depth_in_face(sheet, place.face, point) - vertex.depth) > limit) continue;
    const std::uint32_t face = sheet.face_in_whole[static_cast<std::size_t>(place.face.idx())];
    if (distance_to_face(old_surface, face, vertex.position) > vertex.reach) continue;
    result.faces[i] = face;
    result.handles[i] = insert(sheet, place, vertex);
    ++result.inserted;
  }
  return result;
}

}  // namespace rangezip

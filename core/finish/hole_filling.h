#pragma once

#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

#include "core/finish/boundary_loops.h"
#include "core/finish/cloud_evidence.h"
#include "core/finish/corner_table.h"
#include "core/finish/triangulation_memo.h"
#include "core/mesh/triangle_mesh.h"

namespace rangezip {

/// Shape of a fill inside its loop.
enum class FillShape {
  coarse,  ///< no new points: small holes and cracks
  narrow,  ///< the same with the shortest edges: cracks with sides so ragged that angles mislead
  flat,    ///< points as dense as around the hole, as a soap film
  smooth,  ///< the same, continuing the surface around
  zipped,  ///< only where the sides are close together (zip_loop)
};

/// Faces that fill a hole. Corners are vertices of the mesh or, from the count of positions on, new
/// ones.
struct HoleFill {
  std::vector<Triangle> triangles;
  std::vector<Vec3> new_positions;
};

/// Where a corner of a fill is.
/// @param positions of the table's vertices when the fill was made
[[nodiscard]] inline Vec3 corner_of(const HoleFill& fill, const std::vector<Vec3>& positions,
                                    std::uint32_t vertex) {
  return vertex < positions.size() ? positions[vertex]
                                   : fill.new_positions[vertex - positions.size()];
}

/// Fills one loop: least sharp triangulation (core/finish/loop_triangulation.h), or the one with
/// the shortest edges, then refined and shaped, unless ten edges go around it or fewer. Never makes
/// an edge that the mesh already has. Empty if there is no such triangulation.
/// @param edge_length of new edges, model units; 0: as long as those around the hole. Edges are not
///     shorter than the mean of these or a thousandth of the loop, whichever is less: that bounds
///     how many there are
/// @param positions of the table's vertices; more may follow
/// @param evidence points to air, which a fill avoids
/// @param memo of triangulations of the same cloud; none: nothing is remembered
/// @pre shape is not FillShape::zipped
[[nodiscard]] HoleFill fill_loop(const std::vector<Vec3>& positions, const CornerTable& table,
                                 const BoundaryLoop& loop, FillShape shape, double edge_length,
                                 const CloudEvidence& evidence = {},
                                 TriangulationMemo* memo = nullptr);

/// Closes a loop only where its sides are close together: of the least sharp triangulation it takes
/// the triangles with all sides up to max_edge that continue the surface beside them, in pieces
/// that hang together. Together with the mesh they are manifold, and so is it with any of the
/// pieces.
/// @param max_edge model units
/// @param memo as for fill_loop()
[[nodiscard]] std::vector<HoleFill> zip_loop(const std::vector<Vec3>& positions,
                                             const CornerTable& table, const BoundaryLoop& loop,
                                             double max_edge, const CloudEvidence& evidence = {},
                                             TriangulationMemo* memo = nullptr);

/// Mean cosine between a fill's faces and the mesh's across the edges of its loops: 1 where it
/// continues the surface, -1 where it folds back.
/// @param corners of the loops, as in BoundaryLoop; not empty
/// @param fill with vertices of the mesh only
[[nodiscard]] double continuation_of(const std::vector<Vec3>& positions, const CornerTable& table,
                                     std::span<const std::uint32_t> corners,
                                     const std::vector<Triangle>& fill);

/// Appends a fill to a mesh; new vertices have no source.
/// @param base count of positions when the fill was made; the mesh may have grown since
void append_fill(TriangleMesh& mesh, const HoleFill& fill, std::size_t base);

struct FilledMesh {
  TriangleMesh mesh;
  std::size_t filled_holes = 0;
  std::size_t filled_faces = 0;
};

/// Closes every boundary loop up to a perimeter where that crosses nothing, continuing the surface
/// around it smoothly. The input is made manifold first (core/finish/clean_topology.h).
/// @param edge_length model units, of new edges: see fill_loop
/// @param max_perimeter model units
/// @throws InvalidArgument if a length is negative or not finite.
[[nodiscard]] FilledMesh fill_mesh_holes(TriangleMesh mesh, double edge_length,
                                         double max_perimeter);

}  // namespace rangezip

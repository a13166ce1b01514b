#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "core/finish/boundary_loops.h"
#include "core/finish/corner_table.h"
#include "core/mesh/edge_map.h"
#include "core/mesh/triangle_mesh.h"

namespace rangezip {

/// Remembers the faces of a mesh from which others are taken away, and to which fills are added,
/// while its vertices keep their numbers: to know what a fill would close over, and to put back
/// what was taken for nothing.
class RemovedFaces {
 public:
  /// @param start oriented and manifold
  explicit RemovedFaces(const TriangleMesh& start);

  /// The faces that are gone and hang together, edge by edge, with a boundary loop of what is left
  /// of the mesh: those that a fill of the loop would replace.
  /// @param table of the mesh as it is now
  [[nodiscard]] std::vector<Triangle> behind(const CornerTable& table,
                                             const BoundaryLoop& loop) const;

  /// Appends the faces that are gone and hang together with a boundary of the mesh, but those that
  /// would cross others, or whose edges are in use. The mesh stays oriented and free of
  /// self-intersections, and becomes manifold by clean_topology(). @return how many
  std::size_t put_back(TriangleMesh& mesh) const;

 private:
  std::vector<Triangle> start_;
  EdgeMap edges_;  ///< of start_
};

/// Whether a fill may take the place of surface that it closes over: of its places all but one in
/// twenty lie within 1.5 h of the fill. A flat fill over a hole at a sharp edge leaves out a
/// corner; one that closes over a finger or across the mouth of a slot leaves out most.
/// @param places of that surface
/// @param pixel_size h, model units
[[nodiscard]] bool stands_for(const TriangleMesh& fill, std::span<const Vec3> places,
                              double pixel_size);

}  // namespace rangezip

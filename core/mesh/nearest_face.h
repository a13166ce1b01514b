#pragma once

#include <cstdint>

#include "core/mesh/outgoing_edges.h"
#include "core/mesh/triangle_mesh.h"

namespace rangezip {

/// A face and how far it is.
struct NearestFace {
  std::uint32_t face = 0;
  double squared_distance = 0.0;  ///< model units squared

  friend bool operator==(const NearestFace&, const NearestFace&) = default;
};

/// How far a face is. @pre it is one of the mesh
[[nodiscard]] NearestFace measure_face(const TriangleMesh& mesh, std::uint32_t face,
                                       const Vec3& point);

/// The face reached from `start` by going downhill in distance to `point`: to the nearest of the
/// faces across the three edges or, where none is nearer, to the nearest one around the corner that
/// is nearest to the point. Ends in a local minimum: the local search of
/// [Kobbelt, Botsch 2000, 4.3]. Ties stay where they are.
/// @param edges of the mesh
/// @pre start is a face of the mesh
[[nodiscard]] NearestFace walk_to_nearest_face(const TriangleMesh& mesh, const OutgoingEdges& edges,
                                               std::uint32_t start, const Vec3& point);

}  // namespace rangezip

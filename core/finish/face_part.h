#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "core/mesh/triangle_mesh.h"

namespace rangezip {

/// Some faces of a mesh as a mesh of their own, in the same order; without sources.
struct FacePart {
  static constexpr std::uint32_t kNone = 0xFFFFFFFFU;

  TriangleMesh mesh;
  std::vector<std::uint32_t> faces;     ///< of the whole, rising, one per face
  std::vector<std::uint32_t> vertices;  ///< of the whole, one per position
  std::vector<std::uint32_t> index;     ///< of each vertex of the whole in the part, or kNone
};

/// The faces with a flag. O(faces + vertices).
/// @param is_in per face of the mesh
[[nodiscard]] FacePart face_part(const TriangleMesh& mesh, const std::vector<std::uint8_t>& is_in);

/// Flags the vertices of faces, and those up to so many edges away. O(edges faces).
[[nodiscard]] std::vector<std::uint8_t> vertices_within(const TriangleMesh& mesh,
                                                        std::span<const std::uint32_t> faces,
                                                        int edges);

/// The faces with a vertex up to so many edges away from one of these faces.
[[nodiscard]] FacePart part_within(const TriangleMesh& mesh, std::span<const std::uint32_t> faces,
                                   int edges);

/// What was made of a part takes the place of its faces, at the end of the mesh. Positions of the
/// part beyond those that were taken are new vertices; vertices without faces stay.
/// @pre no face of the mesh has come or gone since, and no position of the part has gone
void put_back(FacePart part, TriangleMesh& mesh);

}  // namespace rangezip

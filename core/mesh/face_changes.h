#pragma once

#include <cstdint>
#include <vector>

#include "core/mesh/triangle_mesh.h"

namespace rangezip {

/// How a mesh differs from what it was, face by face.
struct FaceChanges {
  std::vector<std::uint32_t> gone;  ///< faces of the mesh before that are not in it after
  std::vector<std::uint32_t> made;  ///< faces of the mesh after that were not in it before
};

/// Compares two meshes whose vertices have the same numbers, those after being more. A face is the
/// same if it has the same corners, at the same places, in the same direction. O(faces).
/// @throws InvalidArgument if there are fewer vertices after
/// @pre both are oriented: no directed edge in two faces
[[nodiscard]] FaceChanges find_face_changes(const TriangleMesh& before, const TriangleMesh& after);

/// A mesh after with the vertex numbers of the mesh before, to which vertices belong that lie at
/// the same place; all others come after them. The faces keep their order. Sources stay if both
/// have them. O(faces + vertices log vertices).
[[nodiscard]] TriangleMesh with_numbers_of(const TriangleMesh& before, const TriangleMesh& after);

/// The faces of a mesh after that were not in it before, where vertices may have new numbers: they
/// are told by their places. O(faces + vertices log vertices).
/// @pre both are oriented: no directed edge in two faces
[[nodiscard]] std::vector<std::uint32_t> find_new_faces(const TriangleMesh& before,
                                                        const TriangleMesh& after);

/// What find_face_changes() compares with, for keeping it while the mesh changes.
[[nodiscard]] inline TriangleMesh geometry_of(const TriangleMesh& mesh) {
  return {mesh.positions, mesh.triangles, {}};
}

}  // namespace rangezip

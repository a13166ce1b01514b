#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "core/mesh/face_changes.h"
#include "core/mesh/triangle_mesh.h"
#include "core/view/view.h"

namespace rangezip {

/// The part of a mesh that a stitch may change, as a mesh of its own.
struct MeshPart {
  TriangleMesh mesh;                           ///< vertices and faces in the order of the whole
  std::vector<std::uint32_t> vertex_in_whole;  ///< ascending
  std::vector<std::uint32_t> face_in_whole;    ///< ascending
  std::vector<std::uint8_t> is_rim;            ///< per vertex: has faces outside of the part
};

/// Cuts out the faces whose box in the image comes within `margin` pixels of one of the pixels,
/// those that meet their boxes in turn, both to a tile of 4 pixels, and one ring around: whatever
/// is done to the faces near the pixels, their neighbours are there. Faces with a corner behind the
/// viewer belong to it. O(vertices + faces) of the whole, 10 ns each, and the only step of a stitch
/// that is.
[[nodiscard]] MeshPart cut_out_part(const TriangleMesh& whole, const View& view,
                                    std::span<const Pixel> pixels, int margin);

/// All of it: for what leads out of every smaller part.
[[nodiscard]] MeshPart whole_as_part(const TriangleMesh& whole);

/// Makes of the whole what has become of the part. Vertices of `changed` are first those of the
/// part, which may have moved, then new ones; those of either kind that it does not use are
/// dropped. Faces and vertices that stay keep their order, and new ones follow.
/// @param changes from the part's mesh to `changed`
/// @pre no face around a rim vertex is among the changes
void put_back(TriangleMesh& whole, const MeshPart& part, const TriangleMesh& changed,
              const FaceChanges& changes);

}  // namespace rangezip

#pragma once

#include <cstddef>
#include <span>

#include "core/base/sphere.h"
#include "core/mesh/triangle_mesh.h"
#include "core/raster/rasterizer.h"
#include "core/session/command.h"

namespace rangezip {

struct EraseResult {
  TriangleMesh mesh;
  std::size_t erased_faces = 0;  ///< with those that then hung on a vertex only
};

/// Deletes the faces that have a visible pixel inside the lasso, and those too small to have one
/// whose centroid lies on the sheet that the lasso shows there. Without `visible_only`, all faces
/// whose centroid projects into the lasso, in front of the eye and inside the clip planes, so that
/// what lies behind goes too. Where two sheets then touch in a vertex only, the largest fan of
/// faces stays, so the mesh remains manifold. O(faces + pixels).
/// @throws InvalidArgument for a camera or extent that View refuses, or a lasso that
///     mask_from_lasso() refuses.
[[nodiscard]] EraseResult erase_region(TriangleMesh mesh, Rasterizer& rasterizer,
                                       const EraseRegion& command);

/// Deletes the faces with their centroid in one of the places. The mesh stays manifold, as above.
/// O(faces).
[[nodiscard]] EraseResult erase_places(TriangleMesh mesh, std::span<const Sphere> places);

}  // namespace rangezip

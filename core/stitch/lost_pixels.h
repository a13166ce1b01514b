#pragma once

#include <vector>

#include "core/mesh/face_changes.h"
#include "core/mesh/triangle_mesh.h"
#include "core/stitch/image_plane.h"
#include "core/view/view.h"

namespace rangezip {

/// A mesh and its vertices in the image.
struct SeenMesh {
  const TriangleMesh& mesh;
  const ImagePlane& image;
};

/// Pixels whose centre a face covered that is gone, and at about the same depth none does now: a
/// hole where the surface was. Exact in the image; depths may differ by three pixel sides
/// times the stretch of the face that is gone. Looked for in the image and as far beyond each side
/// of it as it is wide. In the order of rows. O(faces), and pixels of those that changed.
[[nodiscard]] std::vector<Pixel> find_lost_pixels(const SeenMesh& before, const SeenMesh& after,
                                                  const FaceChanges& changes, const View& view);

}  // namespace rangezip

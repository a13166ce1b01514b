#pragma once

#include <cstdint>
#include <optional>
#include <vector>

#include "core/base/geometry.h"
#include "core/base/grid.h"
#include "core/mesh/outgoing_edges.h"
#include "core/mesh/triangle_mesh.h"
#include "core/stitch/image_plane.h"
#include "core/view/view.h"

namespace rangezip::compare {

/// A way over a mesh from face to face: its ends lie on faces, what is between them on edges.
struct SurfacePath {
  std::vector<std::uint32_t> faces;  ///< in their order; each shares an edge with the next
  std::vector<Vec3> points;          ///< one more than faces
};

/// Model units.
[[nodiscard]] double length_of(const std::vector<Vec3>& points);

/// A mesh as one view sees it, with the images of its vertices on the grid of the stitcher. Mesh
/// and view must outlive it.
struct ViewedMesh {
  ViewedMesh(const TriangleMesh& mesh, const View& view);

  const TriangleMesh* mesh;
  const View* view;
  ImagePlane image;
  OutgoingEdges edges;
};

/// The centre of a pixel on a face that holds it in the image.
struct SeenPlace {
  Pixel pixel;
  std::uint32_t face = 0;
};

/// The path over the mesh whose image is the straight line from one pixel to another: what a
/// boundary segment replaces when it becomes an edge of the old surface. Crosses edges of faces
/// that look at the viewer only; a line through a vertex passes it on the right.
/// @return nothing if a face does not hold its pixel, or the line leaves these faces, or arrives on
///     another sheet
[[nodiscard]] std::optional<SurfacePath> follow_line(const ViewedMesh& seen, const SeenPlace& from,
                                                     const SeenPlace& to);

}  // namespace rangezip::compare

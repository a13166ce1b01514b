#pragma once

#include <array>
#include <cstdint>
#include <optional>
#include <vector>

#include "core/base/grid.h"
#include "core/mesh/triangle_mesh.h"
#include "core/raster/rasterizer.h"
#include "core/view/camera.h"

namespace rangezip {

/// Red, green and blue, 8 bits each, as a screen shows them (sRGB).
using Picture = Grid<std::array<std::uint8_t, 3>>;

/// What is in a picture: faces, and points beside them. World coordinates.
struct PictureContent {
  TriangleMesh mesh;
  std::vector<Vec3> points;
};

struct PictureOptions {
  Extent extent{1200, 900};
  int supersampling = 2;  ///< samples a pixel along each axis, 1..4
  bool flat = false;      ///< every face with its own normal instead of smooth ones
  bool edges = false;     ///< draws the edges of all faces
  bool boundary = false;  ///< marks edges that belong to one face only, in a strong colour
  int point_size = 2;     ///< pixels
};

/// The parallel camera from `toward_viewer` that shows all of the content in the middle of the
/// extent, as large as it can be with a small margin. `up` defaults as in frame_box().
/// @throws InvalidArgument if the content or the extent is empty, and as frame_box().
[[nodiscard]] Camera frame_picture(const PictureContent& content, const Vec3& toward_viewer,
                                   Extent extent, const std::optional<Vec3>& up = std::nullopt);

/// Draws the content with the given rasterizer and shades it: lights beside the viewer, hollows
/// darker, faces seen from behind in another hue, so that inverted ones show; points darker where
/// they lie behind their neighbours. White background. Normals are smooth across edges flatter
/// than about 35 degrees. The depth planes of `camera` are fitted to the content.
/// O(faces + pixels * supersampling^2).
/// @throws InvalidArgument for an option out of range, a camera that View refuses, or an empty
///     content.
[[nodiscard]] Picture draw_picture(Rasterizer& rasterizer, const PictureContent& content,
                                   const Camera& camera, const PictureOptions& options = {});

}  // namespace rangezip

#pragma once

#include <span>
#include <vector>

#include "core/mesh/triangle_mesh.h"
#include "core/raster/framebuffer.h"
#include "core/view/view.h"

namespace rangezip {

/// Linear light, 1 is white.
using LightImage = Grid<Vec3f>;

/// Eye depth of every pixel of `drawn`, to the precision of its buffer; infinity where it is empty.
[[nodiscard]] Grid<double> eye_depths(const View& view, const Framebuffer& drawn);

struct ShadingOptions {
  bool flat = false;            ///< every face with its own normal
  double hollow_radius = 30.0;  ///< pixels; how far away a wall may stand to darken a place
  int point_reach = 3;          ///< pixels; from the middle of a point to beyond its border
};

/// The colour of what each pixel shows: ids below the number of faces are faces of `mesh`, the
/// others points. White where nothing was drawn. O(pixels).
[[nodiscard]] LightImage shade(const View& view, const Framebuffer& drawn,
                               const Grid<double>& depths, const TriangleMesh& mesh,
                               const ShadingOptions& options = {});

}  // namespace rangezip

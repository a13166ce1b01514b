#pragma once

#include <cstddef>
#include <span>

#include "core/base/geometry.h"
#include "core/base/progress.h"
#include "core/mesh/triangle_mesh.h"
#include "core/raster/rasterizer.h"

namespace rangezip {

/// Turns components inside out that show their backs to the scanners (own). A cloud does not tell
/// from which side it was measured: a room scanned from within comes out facing outwards, and a
/// sheet, as of one depth image, facing away. Where the scanners stood tells: each looks around, in
/// six images of 90 degrees, and a component is turned if a tenth of its area or more is seen, and
/// most of that from behind. What no scanner sees stays as it is.
/// @param scanners positions, world coordinates, of any number
/// @pre oriented and manifold; stays so. Positions stay, and the order of faces.
/// @return components turned
/// @throws InvalidArgument if a position is not finite; Cancelled, with the mesh as it was
/// Cost: six images of 1024 x 1024 pixels for each scanner, and O(faces).
std::size_t turn_to_scanners(TriangleMesh& mesh, Rasterizer& rasterizer,
                             std::span<const Vec3> scanners, const Progress& progress = {});

}  // namespace rangezip

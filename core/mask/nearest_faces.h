#pragma once

#include "core/image/range_image.h"
#include "core/mesh/triangle_mesh.h"
#include "core/raster/framebuffer.h"

namespace rangezip {

/// The local search of [Kobbelt, Botsch 2000, 4.3]: from what is seen of a mesh in each pixel to
/// the face nearest to its sample.
///
/// Walks over neighbours go downhill in distance from the three nearest faces seen in the pixel and
/// the eight around it. Where they end 0.1 pixel sides away or more, a nearer face may hang
/// together with none of them: beyond a gap, or around a corner on a face that is not seen. There
/// the faces around the vertices that are within a pixel side of that distance are tried too. They
/// are found by the pixel in which they lie, seen or not; only those near such samples are looked
/// up. O(pixels + vertices).
/// @param seen the face drawn in each pixel, or kNoPrimitive; a pixel without one gets none
/// @param reach pixel sides: farther than that no face is given
/// @return a face for each pixel, or kNoPrimitive
[[nodiscard]] Grid<PrimitiveId> search_nearest_faces(const Grid<PrimitiveId>& seen,
                                                     const RangeImage& image,
                                                     const TriangleMesh& mesh, double reach);

}  // namespace rangezip

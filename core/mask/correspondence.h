#pragma once

#include "core/image/range_image.h"
#include "core/mask/mask.h"
#include "core/mesh/triangle_mesh.h"
#include "core/raster/rasterizer.h"

namespace rangezip {

enum class CorrespondenceMethod {
  depth_band,  ///< only fragments of the mesh within a band around the samples are drawn
  id_buffer,   ///< the paper's: what is seen of the mesh, if it is as close as that
};

struct CorrespondenceOptions {
  CorrespondenceMethod method = CorrespondenceMethod::depth_band;
  double band = 1.5;       ///< depth_band: half width of the band in pixel sides times
                           ///< stretch_of(slope); id_buffer: largest distance of the face, pixel
                           ///< sides
  double back_band = 0.6;  ///< the same for faces seen from behind; 0: not looked for
};

/// Which face of the mesh each sample lies on.
struct Correspondence {
  Grid<PrimitiveId> face;  ///< index of the triangle, kNoPrimitive where nothing corresponds
  Mask from_behind;        ///< 1 where the sample re-scans a known sheet from its inside
};

/// The face of `mesh` that corresponds to each sample [Kobbelt, Botsch 2000, 4.3].
///
/// Both go from what is drawn to the face nearest to each sample (core/mask/nearest_faces.h).
/// depth_band: the mesh is drawn under the image's view and every fragment outside the band around
/// the range image is dropped, so that what is drawn is of the right sheet by construction. Front
/// faces (Facing::front) and back faces are drawn apart. id_buffer: the paper's way; the mesh is
/// drawn as it is. A sample may then see a face of another sheet far behind it; that is no
/// correspondence. Cost: two passes of the rasterizer over the mesh or one, O(faces + pixels).
/// @param any_face only whether there is a face matters, not which: depth_band then does not search
/// @throws InvalidArgument if the extents differ or a band is negative or not finite.
[[nodiscard]] Correspondence find_correspondence(Rasterizer& rasterizer, const RangeImage& image,
                                                 const SlopeImage& slopes, const TriangleMesh& mesh,
                                                 const CorrespondenceOptions& options = {},
                                                 bool any_face = false);

}  // namespace rangezip

#pragma once

#include <cstddef>

#include "core/base/progress.h"
#include "core/finish/point_grid.h"
#include "core/mesh/triangle_mesh.h"

namespace rangezip {

/// As a sine: 10 degrees and the rounding of a file.
inline constexpr double kSmallAngle = 0.1737;

struct SmallAngleReport {
  std::size_t mended = 0;  ///< places where faces changed
  std::size_t left = 0;    ///< faces with an angle under 10 degrees
};

/// Mends the last faces with an angle under 10 degrees, and then those under 30 if they are no more
/// than a twentieth of all, also at the border, where they come from steps towards the end of the
/// cloud: in rounds, each such face gets the best of its mends (core/finish/angle_mends.h) with
/// which no faces cross and no point of the cloud gets beyond the border; at last, for angles under
/// 10 degrees, by up to h/50, then h/2, then h. Angles over 10 degrees are mended only where faces
/// turn by less than 14. What has no mend stays. The topology does, and without self-intersections
/// before there are none after. Only the faces around such angles are looked at closely. Cost: some
/// passes over the mesh; and for each such face what is around it.
/// @param pixel_size h, model units
/// @throws Cancelled if `progress` says so.
/// @pre oriented, manifold (core/finish/clean_topology.h)
SmallAngleReport mend_small_angles(TriangleMesh& mesh, const PointGrid& cloud, double pixel_size,
                                   const Progress& progress = {});

}  // namespace rangezip

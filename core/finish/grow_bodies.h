#pragma once

#include <cstddef>
#include <span>

#include "core/base/progress.h"
#include "core/finish/grow_over.h"
#include "core/finish/seen_points.h"
#include "core/mesh/triangle_mesh.h"

namespace rangezip {

/// What has come by growing.
struct GrowthReport {
  std::size_t faces = 0;   ///< 0 if nothing was to be done
  std::size_t bodies = 0;  ///< apart from all others
};

/// Grows bodies that no scan has shown (own): the wall of a closed cavity, what lies inside of a
/// hollow body, and bodies of a few pixels. They are points that a mesh leaves out and that lie
/// apart: groups of points with links of up to 1.3 h, forty at least, none of which is within 1.4 h
/// of the mesh; what is nearer is grown from the mesh's border (core/finish/regrow.h). In each
/// group a front starts with one face, in the plane of the points where they are flattest, and goes
/// over the others (core/finish/grow_over.h). What has come stays if it shows three quarters of its
/// group and its faces look to all sides, as those around an inside do: their area vector is at
/// most 0.3 of their area. So a sheet, of which nobody could tell the side, brings nothing, nor do
/// stray points: most of them lie in no plane with those around. Cracks and small holes are left.
///
/// A body is turned to where its points are seen from (core/finish/votes_near.h). If none is, as in
/// a cavity, its front is where a ray goes through an even number of faces
/// (core/finish/facing_inwards.h): the wall of a cavity faces into it.
/// Cost: that of growing over such points, and of a few hundred rays a body; none without any.
/// @param left_out points that the mesh leaves out (core/finish/left_out_points.h)
/// @param seen the cloud
/// @param options of the fronts
/// @pre oriented, manifold; stays so. Vertices keep their numbers, and faces: those that come are
///     the last ones.
GrowthReport grow_bodies(TriangleMesh& mesh, std::span<const Vec3> left_out, const SeenPoints& seen,
                         const GrowOverOptions& options, const Progress& progress = {});

}  // namespace rangezip

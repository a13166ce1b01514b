#pragma once

#include <cstddef>

#include "core/finish/point_grid.h"
#include "core/mesh/triangle_mesh.h"

namespace rangezip {

/// Drops the faces by which bodies hang together through the air alone (own): where two come as
/// near to each other as 2 h, a scan joins samples of both by a few faces, or a stitch does, and no
/// handle tells it. Faces whose centroid or the middle of a side has no point near it
/// (is_supported(), kCloseSupport) are bare; what they part, if it has `min_body` faces at least,
/// is a body; and where a piece of bare faces and scraps between, of 20 h^2 at most, is beside two
/// of them, its bare faces go. One in twenty places of a surface is bare by chance, so a narrow
/// strip of the surface may go, too: to be called before the mesh grows over what it leaves out.
/// The mesh stays oriented and manifold. O(faces), in parallel where the cloud is asked.
/// @param pixel_size h, model units; positive
/// @return how many went
std::size_t drop_air_bridges(TriangleMesh& mesh, const PointGrid& cloud, double pixel_size,
                             std::size_t min_body);

}  // namespace rangezip

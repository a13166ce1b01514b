#pragma once

#include <cstdint>
#include <vector>

#include "core/base/geometry.h"
#include "core/mesh/triangle_mesh.h"

namespace rangezip {

/// Drops samples that nothing shows and that lie behind the mesh, from 0.3 to 4 h, where it
/// has samples that are seen: the inside of walls, parts within parts, and where two bodies overlap
/// the wall of each that goes on inside of the other. They are no evidence for what the mesh is to
/// be, but too near to be told from it by those who fit surfaces. Others stay: so does the ground
/// of a groove under faces in the air.
/// @param samples those that stay keep their order
/// @param is_unseen one per sample
/// @param pixel_size h, model units
/// @pre as many flags as samples; the mesh is oriented and manifold, but for vertices with several
///     fans; pixel_size is positive
/// Cost: linear in the samples and faces; those that are not seen look for faces up to 4 h around,
/// in parallel. Nothing where all are seen.
void drop_hidden_layers(std::vector<Vec3>& samples, const std::vector<std::uint8_t>& is_unseen,
                        const TriangleMesh& mesh, double pixel_size);

}  // namespace rangezip

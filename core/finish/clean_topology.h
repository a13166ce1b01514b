#pragma once

#include <cstddef>

#include "core/mesh/triangle_mesh.h"

namespace rangezip {

/// Makes a mesh oriented and manifold by dropping as few faces as simple rules allow: those that
/// repeat a corner, those that use a directed edge that an earlier face has, and at a vertex with
/// several fans all but the fan with most faces (the earliest of equals).
/// Positions stay, unused ones too. O(faces). @return faces dropped
std::size_t clean_topology(TriangleMesh& mesh);

}  // namespace rangezip

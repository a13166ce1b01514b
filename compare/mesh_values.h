#pragma once

#include "core/base/geometry.h"
#include "core/mesh/triangle_mesh.h"

namespace rangezip::compare {

[[nodiscard]] bool is_finite(const Vec3& point) noexcept;

/// What every judge asks of a mesh before it hands it to CGAL.
/// @throws TopologyError naming `function` if a triangle has a corner index that is out of range,
///     or a corner that is not finite.
void check_mesh_values(const char* function, const TriangleMesh& mesh);

}  // namespace rangezip::compare

#pragma once

#include <cstddef>
#include <string>

#include "core/mesh/mesh_report.h"

namespace rangezip::app {

/// "1 component, 2 boundary loops, Euler number 0".
[[nodiscard]] std::string topology_text(const MeshReport& report);

/// What keeps a mesh from being a clean one: "2 non-manifold edges, 1 self-intersecting pair";
/// empty for a clean one.
[[nodiscard]] std::string faults_text(const MeshReport& report, std::size_t self_intersections);

}  // namespace rangezip::app

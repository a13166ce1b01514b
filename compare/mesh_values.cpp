#include "compare/mesh_values.h"

#include <cmath>
#include <string>

#include "core/base/error.h"

namespace rangezip::compare {

bool is_finite(const Vec3& point) noexcept {
  return std::isfinite(point.x) && std::isfinite(point.y) && std::isfinite(point.z);
}

void check_mesh_values(const char* function, const TriangleMesh& mesh) {
  for (std::size_t i = 0; i < mesh.triangles.size(); ++i) {
    for (const std::uint32_t corner : mesh.triangles[i]) {
      if (corner < mesh.positions.size() && is_finite(mesh.positions[corner])) continue;
      throw TopologyError(std::string(function) + ": triangle " + std::to_string(i) +
                          " must have finite corners with indices below " +
                          std::to_string(mesh.positions.size()) + ", got index " +
                          std::to_string(corner));
    }
  }
}

}  // namespace rangezip::compare

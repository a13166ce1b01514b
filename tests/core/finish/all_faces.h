#pragma once

#include <cstdint>
#include <numeric>
#include <vector>

#include "core/mesh/triangle_mesh.h"

namespace rangezip::testing {

/// The numbers of all faces of a mesh.
inline std::vector<std::uint32_t> all_faces(const TriangleMesh& mesh) {
  std::vector<std::uint32_t> faces(mesh.triangles.size());
  std::iota(faces.begin(), faces.end(), 0U);
  return faces;
}

}  // namespace rangezip::testing

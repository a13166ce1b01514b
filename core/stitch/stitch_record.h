#pragma once

#include <array>
#include <cstdint>
#include <vector>

namespace rangezip {

/// Where zippering put the boundary of a patch into the old surface: what another way of finding
/// it can be held against. Empty after clear_and_fill(), which puts nothing there.
struct StitchRecord {
  struct Vertex {
    std::uint32_t patch_vertex = 0;
    std::uint32_t old_face =
        0;  ///< of the mesh as it was given: what holds the vertex in the image
  };
  std::vector<Vertex> vertices;  ///< inserted ones, by patch_vertex

  /// Boundary edges of the patch that became edges of the old surface: both ends are in `vertices`.
  std::vector<std::array<std::uint32_t, 2>> segments;  ///< vertices of the patch
};

}  // namespace rangezip

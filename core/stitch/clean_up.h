#pragma once

#include <cstddef>
#include <cstdint>
#include <vector>

#include "core/mesh/triangle_mesh.h"

namespace rangezip {

struct CleanUpReport {
  std::size_t opened_fans = 0;     ///< faces removed because they touched in one vertex only
  std::size_t split_vertices = 0;  ///< made for fans that stay
  std::size_t dropped_components = 0;
  std::size_t dropped_faces = 0;  ///< of those components
};

/// Makes every touched vertex manifold. Of the fans of faces around one, all but the largest are
/// removed if they have at most two faces; larger ones get a vertex of their own, a little inside
/// of the fan, since two at one place would touch. Then drops the connected pieces with a touched
/// vertex and fewer than `min_component` faces. What is nowhere near a touched vertex stays as it
/// is; vertices keep their numbers, used or not, and copies follow them.
///
/// @param touched one per vertex: 1 where faces came or went
/// @param marks one per vertex; copies get theirs
/// @param rim one per vertex: 1 where faces are missing here that belong to the surface; faces with
///     such a corner stay, and so do pieces that reach one. Empty: none
/// @param kept pieces with one of the first `kept` vertices stay
/// @pre no directed edge in two faces, and vertices not touched are manifold
[[nodiscard]] CleanUpReport clean_up(TriangleMesh& mesh, std::vector<std::uint8_t> touched,
                                     std::vector<std::uint8_t>& marks, std::size_t min_component,
                                     const std::vector<std::uint8_t>& rim = {},
                                     std::size_t kept = 0);

/// Whether every marked (1) vertex has one fan of faces, or none, and none of the directed edges
/// from or to it is in two faces: what clean_up() promises, looked at again.
[[nodiscard]] bool is_manifold_at(const TriangleMesh& mesh,
                                  const std::vector<std::uint8_t>& marked);

}  // namespace rangezip

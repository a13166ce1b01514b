#pragma once

#include "core/mesh/triangle_mesh.h"

namespace rangezip {

/// True if the triangle has no area: its corners lie on one line (exact).
[[nodiscard]] bool is_degenerate(const TriangleMesh& mesh, const Triangle& triangle) noexcept;

/// True if two triangles of a mesh share more than they should (exact):
/// - no common corner: any common point;
/// - one common corner: the side opposite to it in one meets the other triangle;
/// - two common corners (an edge): they lie in one plane, on the same side of the edge;
/// - three common corners: always.
/// @pre neither is degenerate.
[[nodiscard]] bool overlap(const TriangleMesh& mesh, const Triangle& first,
                           const Triangle& second) noexcept;

}  // namespace rangezip

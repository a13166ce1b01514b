#pragma once

#include <array>
#include <cstdint>
#include <vector>

#include "core/mesh/triangle_mesh.h"
#include "core/render/shading.h"
#include "core/view/view.h"

namespace rangezip {

/// Two vertices, the lower index first.
using MeshEdge = std::array<std::uint32_t, 2>;

/// Every edge of the mesh once, sorted; with `boundary_only`, those of one face. O(n log n).
[[nodiscard]] std::vector<MeshEdge> edges_of(const TriangleMesh& mesh, bool boundary_only);

struct LineStyle {
  Vec3f color{0.0F};
  double width = 1.0;    ///< pixels
  double opacity = 1.0;  ///< in [0, 1]
};

/// Paints the visible parts of edges over a picture: a pixel within half the width of the line
/// takes its colour, once however many lines meet there, unless what the pixel shows is nearer than
/// the line by more than two widths. O(pixels of the lines).
void paint_lines(LightImage& light, const View& view, const Grid<double>& depths,
                 const TriangleMesh& mesh, const std::vector<MeshEdge>& edges,
                 const LineStyle& style);

}  // namespace rangezip

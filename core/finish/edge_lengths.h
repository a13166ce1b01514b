#pragma once

#include <vector>

#include "core/finish/corner_table.h"
#include "core/finish/surface_fit.h"

namespace rangezip {

/// How long edges shall be around each vertex, relative to one another: shorter where the surface
/// bends. The error of flat triangles goes with bending times squared length; for a given number of
/// them its mean square is least where the length goes with the bending's inverse cube root.
/// Lengths change gently from vertex to vertex and stay within 0.6 to 1.6. Their scale is such that
/// as many triangles fit on the surface as with length 1 everywhere. O(faces).
/// @param fits one a vertex; vertices without one take after their neighbours
/// @param length mean edge length, model units: bending that it can hardly show counts as none
[[nodiscard]] std::vector<double> relative_edge_lengths(const CornerTable& table,
                                                        const std::vector<Vec3>& positions,
                                                        const std::vector<SurfaceFit>& fits,
                                                        double length);

}  // namespace rangezip

#pragma once

#include <cstddef>
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

struct GradedLengths {
  double tolerance =
      0.0;                ///< model units, positive: of triangles from the surface between vertices
  double shortest = 0.0;  ///< model units, positive, as is longest
  double longest = 0.0;
};

/// How long edges may be around each vertex for triangles to stay within the tolerance: of
/// equilateral ones on a surface with curvature k, sqrt(6 tolerance / k)
/// [Dunyach, Vanderhaeghe, Barthe, Botsch 2013, 3.2]. Lengths grow by no more than four
/// fifths of the way between two vertices. O(faces).
/// @param fits one a vertex; of vertices without one those on the boundary get the shortest, others
///     take after their neighbours
[[nodiscard]] std::vector<double> graded_edge_lengths(const CornerTable& table,
                                                      const std::vector<Vec3>& positions,
                                                      const std::vector<SurfaceFit>& fits,
                                                      const GradedLengths& options);

/// The factor by which lengths have to be multiplied for this many triangles to fit on the surface.
[[nodiscard]] double scale_for_triangles(const CornerTable& table,
                                         const std::vector<Vec3>& positions,
                                         const std::vector<double>& lengths, std::size_t triangles);

}  // namespace rangezip

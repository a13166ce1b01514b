#pragma once

#include <span>
#include <vector>

#include "core/base/geometry.h"
#include "core/base/sphere.h"
#include "core/mesh/triangle_mesh.h"

namespace rangezip {

/// Where a cloud is so much denser than elsewhere that scans may have finer pixels there.
struct DensePlaces {
  std::vector<Sphere> places;
  std::vector<Vec3> points;  ///< of the cloud in these places
  double pixel_size = 0.0;   ///< that suits most of them, model units
};

/// Finds the places where local_sizes() are smaller than a pixel side. A sphere is about 12 h
/// across. None if they are so small, all together, that no patch would come of them.
/// @param pixel_size h of the scans that made the mesh, model units; positive
/// @param noise of the points, model units
/// Cost: linear in faces and points.
[[nodiscard]] DensePlaces find_dense_places(std::span<const Vec3> points, const TriangleMesh& mesh,
                                            double pixel_size, double noise);

}  // namespace rangezip

#pragma once

#include <span>
#include <vector>

#include "core/base/geometry.h"
#include "core/base/sphere.h"
#include "core/mesh/triangle_mesh.h"

namespace rangezip {

/// Of points, in h: with more, steps of a pixel would be noise in scans of half the pixel size. A
/// pixel size that is chosen for a cloud is four times its noise, too.
inline constexpr double kMaxHoleNoise = 0.125;

/// Where scans have closed over holes of the object.
struct PaperedHoles {
  std::vector<Sphere> places;  ///< of the faces over a hole, with what they bend around it
  std::vector<Vec3> points;    ///< of the cloud in these places
};

/// Finds holes that a mesh of scans has papered over (own). Pixels at the rim of a hole of a few
/// pixels see points on both sides of it, and faces join these across the air. Such a place is told
/// by two things together: faces without a point near their centroid or the middle of a side
/// (within 0.75 h, or one spacing), of at least h^2 in all; and the wall of the hole, at least a
/// dozen points near by that the mesh leaves out, by more than 0.6 h. It is none where
/// - these are over half of the points there: what is as fine as that no scan resolves;
/// - they have noise of over h / 8, as in pockets of real scans: the wall is to be a clean surface.
/// The radius of a place is 1.5 h more than that of the faces, since the faces around bend into the
/// hole. O(points + faces), in parallel, and for each place the points near it.
/// @param pixel_size h of the scans, model units; positive
[[nodiscard]] PaperedHoles find_papered_holes(std::span<const Vec3> points,
                                              const TriangleMesh& mesh, double pixel_size);

}  // namespace rangezip

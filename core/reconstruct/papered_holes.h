#pragma once

#include <cstddef>
#include <optional>
#include <span>
#include <vector>

#include "core/base/geometry.h"
#include "core/base/sphere.h"
#include "core/mesh/triangle_mesh.h"

namespace rangezip {

/// Of points, in h: with more, steps of a pixel would be noise in scans of half the pixel size. A
/// pixel size that is chosen for a cloud is four times its noise, too.
inline constexpr double kMaxHoleNoise = 0.125;

/// What tells a hole's wall.
struct PaperedHoleOptions {
  double pixel_size = 0.0;    ///< h of the scans, model units; positive
  double off_mesh = 0.6;      ///< in h: how far from the mesh a point of a wall is
  std::size_t min_wall = 12;  ///< points that are
};

/// The same where points are sparse, and fronts grow over what is taken off: faces bend into a hole
/// as far as a point reaches, so few points are far from them. Five are to be, by 0.6 h: no more
/// are left out where scans cut off a sharp edge, over which no front would go.
[[nodiscard]] inline PaperedHoleOptions of_sparse_points(double pixel_size) {
  return {.pixel_size = pixel_size, .off_mesh = 0.35, .min_wall = 8};
}

/// Where scans have closed over holes of the object.
struct PaperedHoles {
  std::vector<Sphere> places;  ///< of the faces over a hole, with what they bend around it
  std::vector<Vec3> points;    ///< of the cloud in these places
};

/// Finds holes that a mesh of scans has papered over (own). Pixels at the rim of a hole of a few
/// pixels see points on both sides of it, and faces join these across the air. Such a place is told
/// by two things together: faces without a point near their centroid or the middle of a side
/// (within 0.75 h, or one spacing), of at least h^2 in all; and the wall of the hole, at least a
/// dozen points near by that the mesh leaves out, by more than 0.6 h (or as the options say). It is
/// none where
/// - these are over half of the points there: what is as fine as that no scan resolves;
/// - they have noise of over h / 8, as in pockets of real scans: the wall is to be a clean surface.
/// The radius of a place is 1.5 h more than that of the faces, since the faces around bend into the
/// hole. O(points + faces), in parallel, and for each place the points near it.
[[nodiscard]] PaperedHoles find_papered_holes(std::span<const Vec3> points,
                                              const TriangleMesh& mesh,
                                              const PaperedHoleOptions& options);

/// Those of sparse points that can be left to fronts: nothing if over three quarters of the faces
/// of a component (of a hundred faces at least) lie in them. Then it is thin walls that are papered
/// over, and with all that gone fronts would have hardly anything to start from.
[[nodiscard]] std::optional<PaperedHoles> find_holes_for_fronts(std::span<const Vec3> points,
                                                                const TriangleMesh& mesh,
                                                                double pixel_size);

}  // namespace rangezip

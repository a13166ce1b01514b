#pragma once

#include <cstddef>

#include "core/base/progress.h"
#include "core/finish/seen_points.h"
#include "core/mesh/triangle_mesh.h"

namespace rangezip {

enum class FinishMethod {
  fast,  ///< closes holes and removes self-intersections
  full,  ///< also makes the triangles anew, fits them to the cloud, snaps sharp features, and moves
         ///< borders out to the end of the cloud
};

struct FinishOptions {
  FinishMethod method = FinishMethod::full;
  double pixel_size = 0.0;          ///< h, model units, of the scans; must be positive
  double max_hole_perimeter = 0.0;  ///< in h: holes up to this are closed even if the cloud shows
                                    ///< that the surface was not sampled there
  double narrow_width = 3.0;        ///< in h: cracks up to this are closed whatever their length
  int rounds = 8;                   ///< of {cut self-intersections, bridge, fill}, at most
  int relaxations = 9;              ///< of {split, collapse, flip, relax, project}
  std::size_t triangles = 0;    ///< target of `full`, met within a few percent, up to 16 times as
                                ///< many as there are; 0: as many as come
  double flat_tolerance = 0.0;  ///< in h: `full` lets triangles grow where they stay within this of
                                ///< the surface; 0, or with `triangles`: as many as are asked for
  bool snap_features = true;    ///< sharp edges and corners
  double gap = 0.0;  ///< between the contours that the cloud is made of, model units: the surface
                     ///< is fitted to several of them; 0: the points are spread evenly
  bool narrow_gaps = false;  ///< the cloud has gaps that scans reach only in part: handles are cut
                             ///< where no points lie
  bool regrow = false;       ///< grows over places that no scan has reached
  bool open_sheet = false;   ///< the cloud shows one side only, and most borders stay, those of
                             ///< small pieces too: what is cleared along them in vain comes back
  bool follow_density = false;      ///< `full` makes smaller triangles where the cloud is so dense
                                    ///< that scans might have had pixels of under 0.6 h there
  std::size_t min_component = 100;  ///< smaller pieces are dropped, but for small bodies
                                    ///< (core/finish/small_pieces.h)
  bool is_clean = false;  ///< no faces of the mesh cross, as stitches leave it: only those that
                          ///< come are checked
};

struct FinishReport {
  std::size_t self_intersections_cut = 0;  ///< faces removed because they crossed others
  std::size_t untangled_pairs = 0;         ///< of faces that crossed after vertices had moved
  std::size_t bridged_loops = 0;
  std::size_t papered_faces = 0;  ///< far from points, or that points look through: they went
  std::size_t joined_loops = 0;   ///< pairs inside of holes that lead through the object
  std::size_t cut_handles = 0;    ///< thinner than what scans resolve
  std::size_t filled_holes = 0;
  std::size_t filled_faces = 0;
  std::size_t open_loops = 0;  ///< boundary loops left
  double noise = 0.0;          ///< standard deviation of the cloud from the surface, model units
  double fit_radius = 0.0;     ///< of the points that were taken together for a place, model units
  std::size_t split_edges = 0;
  std::size_t collapsed_edges = 0;
  std::size_t flipped_edges = 0;
  std::size_t flattened_spikes = 0;
  std::size_t unfolded = 0;  ///< folds that were taken out
  std::size_t snapped_vertices = 0;
  std::size_t rim_moves = 0;      ///< of vertices, out to where the cloud has points
  std::size_t regrown_faces = 0;  ///< over what no scan has reached
  std::size_t grown_bodies = 0;   ///< of those: inside of others, or too small for scans
  std::size_t border_steps = 0;   ///< that brought the border out to the end of the cloud
  std::size_t small_angles = 0;   ///< faces with an angle under 10 degrees left, if not coarsened
  std::size_t turned_pieces = 0;  ///< that faced the wrong way
  std::size_t dropped_components = 0;
  std::size_t dropped_faces = 0;
};

struct FinishResult {
  TriangleMesh mesh;
  FinishReport report;
};

/// Makes a clean mesh of the stitched scans: turns pieces that face the wrong way, removes
/// self-intersections, bridges cracks between pieces, closes holes that the cloud does not show to
/// be real, takes back components that all this has cleared away altogether, then improves
/// triangles without leaving the cloud and moves borders that stay to where it ends. The result is
/// oriented, manifold and free of self-intersections. Faces that the points contradict, or that lie
/// far from any (unsupported_faces.h), go, before holes are closed and, with a max_hole_perimeter
/// of 0, after, unless they leave a hole so small that it would be closed (papered_faces.h).
/// @param cloud the points that were scanned (and area samples of polygons), to which vertices are
///     fitted and which give evidence; may be empty: no fitting. Without votes no face is
///     contradicted.
/// @throws InvalidArgument if pixel_size is not positive and finite, another length is negative or
///     not finite, or more triangles are asked for than can be made.
[[nodiscard]] FinishResult finish(TriangleMesh mesh, const SeenPoints& cloud,
                                  const FinishOptions& options, const Progress& progress = {});

}  // namespace rangezip

#pragma once

#include <cstddef>
#include <cstdint>

#include "core/base/progress.h"
#include "core/mesh/triangle_mesh.h"
#include "core/patch/patch.h"
#include "core/scan/scan.h"
#include "core/stitch/stitch_record.h"

namespace rangezip {

enum class StitchMethod {
  clear_and_fill,  ///< removes the old faces under and near the patch, fills the strip between
  zipper,          ///< the paper's: inserts the patch's boundary into the old faces
};

struct StitchOptions {
  /// Wider than any seam is to be; what is near the patch is looked for so far.
  static constexpr int kMostPixels = 64;

  StitchMethod method = StitchMethod::clear_and_fill;
  double band = 1.0;  ///< half width, in pixel sides times stretch_of(slope), of the depth
                      ///< band in which old surface counts as covered by the patch
  double clearance =
      0.4;  ///< pixels, up to kMostPixels; old vertices closer to the patch go (against slivers)
  double max_gap =
      3.5;  ///< pixels, up to kMostPixels; longest edge of a strip triangle in the image plane
  double min_strip_cosine = 0.139;  ///< of the angle to the line of sight (82 degrees)
  double collapse_ratio = 0.45;  ///< zipper: seam edges shorter than this share of a pixel side are
                                 ///< collapsed; 0 turns it off
  int withdrawal =
      0;  ///< pixels, 0 to kMostPixels; so far around a hole the patch gives way first.
          ///< 0: its grid triangles at the pixel of the hole, the least there is
  std::size_t min_component = 30;  ///< pieces of the result with fewer triangles are dropped
  std::uint32_t view = VertexSource::kNoView;  ///< recorded with each new vertex
};

/// What happened, in numbers that a test can check and a user can read.
struct StitchReport {
  std::size_t removed_faces = 0;  ///< of the mesh, replaced by the patch
  std::size_t patch_faces = 0;    ///< added
  std::size_t strip_faces = 0;    ///< added between patch and mesh
  std::size_t rejected_strip_faces = 0;
  std::size_t inserted_vertices = 0;  ///< zipper: of the patch's boundary, into the mesh
  std::size_t inserted_segments = 0;  ///< zipper: boundary edges found or made in the mesh
  std::size_t skipped_vertices = 0;   ///< zipper: with no counterpart in the sheet
  std::size_t skipped_segments = 0;   ///< zipper: that leave the sheet
  std::size_t flipped_edges = 0;
  std::size_t collapsed_edges = 0;
  std::size_t opened_fans = 0;     ///< faces removed because they touched in one vertex only
  std::size_t split_vertices = 0;  ///< made for larger fans that touched in one vertex only
  std::size_t dropped_components = 0;
  std::size_t dropped_faces = 0;         ///< of those components
  std::size_t crossing_seam_faces = 0;   ///< rolled back: they crossed others, or had no area
  std::size_t crossing_patch_faces = 0;  ///< the same
  std::size_t withdrawn_faces = 0;       ///< of the patch, so that no pixel lost its surface
};

struct StitchResult {
  TriangleMesh mesh;
  StitchReport report;
  StitchRecord record;
};

/// Joins the patch of `scan` to `mesh` and lets it replace what it covers. All seam geometry
/// happens in the scan's image plane on an integer grid of 2^-14 px with exact predicates.
/// `mesh` is taken by value: a caller who moves it pays no copy, one who copies has it for undo.
///
/// Whatever the patch, these hold for the result if they hold for `mesh`, and are checked:
/// - it is oriented and manifold (else nothing is stitched; no input is known for which that is);
/// - it has no self-intersection and no face without area (exact). A face that would cross another
///   is rolled back, those of the seam first, then those of the patch;
/// - every pixel that showed the surface shows it (find_lost_pixels()), and every place of it has a
///   face within a pixel side (find_lost_places()): where a hole would appear the patch is
///   withdrawn from it by StitchOptions::withdrawal or as many pixels as reach it, as often as it
///   takes, later by more, at last altogether; before that, crumbs of `mesh` that it leaves are
///   kept;
/// - faces whose image is nowhere near the patch are the same, bit by bit.
///
/// clear_and_fill removes every front-facing old face that overlaps a patch cell within the band
/// and those with a vertex closer than `clearance`, then fills the strip between the two
/// boundaries by a constrained Delaunay triangulation in the image plane.
/// zipper inserts the patch's boundary vertices into their faces, flips the edges that its boundary
/// edges cross until these are edges of the sheet, removes what is inside, fills the strip where
/// the boundary leaves the sheet, and collapses short edges in the seam
/// [Kobbelt, Botsch 2000, 4.4; Turk, Levoy 1994].
///
/// Pieces are dropped only where this stitch changed them. An empty patch changes nothing.
///
/// @throws InvalidArgument if an option is out of range; Cancelled, which is looked for before each
///     attempt
/// @throws TopologyError if `mesh` has an index out of range or is not oriented and manifold; the
///     latter is looked at near the patch only, since the rest is not touched.
/// Cost: O(n log n) of the faces near the patch, and about 20 ns for each other face of the mesh.
[[nodiscard]] StitchResult stitch(TriangleMesh mesh, const Scan& scan,
                                  const StitchOptions& options = {}, const Progress& progress = {});

}  // namespace rangezip

#pragma once

#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

#include "core/mesh/edge_map.h"
#include "core/mesh/triangle_mesh.h"
#include "core/stitch/image_plane.h"
#include "core/stitch/patch_sheet.h"
#include "core/stitch/seam_segments.h"
#include "core/stitch/wide_faces.h"

namespace rangezip {

struct FillStripOptions {
  double max_gap = 3.5;             ///< pixels; longest edge of a strip triangle in the image
  double min_strip_cosine = 0.139;  ///< of the angle to the line of sight
  double band = 1.0;                ///< pixel sides times stretch; samples this far behind a
                                    ///< triangle were seen past it
};

struct FilledStrip {
  std::vector<Triangle> faces;
  std::size_t rejected_faces = 0;  ///< outside of the patch and near it, but not acceptable
};

/// The seam as the strip sees it. Vertices from `first_new` on are those of the patch.
struct Seam {
  std::span<const Vec3> positions;
  const ImagePlane& image;
  const PatchSheet& sheet;
  const WideFaces& removed;
  std::uint32_t first_new = 0;
  std::span<const SeamSegment> segments;  ///< of both boundaries, without conflicts
  std::span<const Triangle> old_faces;    ///< at least those around ends of segments
};

/// Fills the strip between the patch and the old surface: the triangles of the constrained
/// Delaunay triangulation of the segments in the image that lie outside of the patch, near it, are
/// not too long in the image or in space, nor too steep, overlap no old face around their
/// corners, and whose directed edges are free. Edges that only the tilt of the sheet lets be so
/// long must not lead through the air: where the scan saw something behind their middle. In the
/// place of a removed wide face triangles may be far and as long as that was.
/// @param edges of the surface near the seam; receives the edges of the new faces, numbered as
///     they are in the result from `first_face` on
[[nodiscard]] FilledStrip fill_strip(const Seam& seam, EdgeMap& edges, std::uint32_t first_face,
                                     const FillStripOptions& options);

}  // namespace rangezip

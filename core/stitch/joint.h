#pragma once

#include <cstddef>
#include <cstdint>
#include <vector>

#include "core/mesh/triangle_mesh.h"
#include "core/stitch/image_plane.h"
#include "core/stitch/patch_scan.h"
#include "core/stitch/patch_sheet.h"
#include "core/stitch/stitch.h"
#include "core/stitch/wide_faces.h"

namespace rangezip {

/// Old surface and patch in one mesh, between the removal of what the patch covers and the closing
/// of what is open between them: the part that all ways of stitching share.
struct Joint {
  TriangleMesh mesh;        ///< vertices: old ones, then one for each of the patch
  ImagePlane image;         ///< of the vertices
  std::uint32_t first_new;  ///< the first vertex of the patch
  std::size_t old_faces;    ///< faces of the old surface; they come first, the patch's follow
  std::vector<std::uint32_t> vertex_of_patch;  ///< differs from first_new + i where the vertex of
                                               ///< the patch became one with an old one
  std::vector<std::uint8_t> touched;           ///< per vertex: faces around it came or went
  std::vector<Triangle> removed_wide_faces;    ///< see WideFaces
  std::vector<std::uint8_t> seam;              ///< per vertex: on the boundary of the patch
};

/// The mesh with the vertices of the patch, but without its faces.
[[nodiscard]] Joint begin_joint(TriangleMesh mesh, const PatchScan& scan, std::uint32_t view);

/// Removes the marked old faces; counts them in the report.
/// @pre the faces of the patch are not there yet
void remove_old_faces(Joint& joint, const std::vector<std::uint8_t>& marked, StitchReport& report);

/// Adds the faces of the patch; counts them in the report.
/// @pre all their directed edges are free
void add_patch_faces(Joint& joint, const Patch& patch, StitchReport& report);

/// Fills the strip between the open edges of the patch and those of the old surface near it.
/// @throws TopologyError if two old faces share a directed edge near the patch
void fill_seam(Joint& joint, const PatchScan& scan, const PatchSheet& sheet,
               const StitchOptions& options, StitchReport& report);

/// Radius of the sheet that fill_seam() needs, pixels.
[[nodiscard]] int sheet_radius(const StitchOptions& options);

}  // namespace rangezip

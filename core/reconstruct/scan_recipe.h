#pragma once

#include <optional>
#include <vector>

#include "core/base/geometry.h"
#include "core/base/sphere.h"
#include "core/reconstruct/reconstruct.h"
#include "core/session/command.h"

namespace rangezip {

/// Cells of the grid that are steeper are cut.
inline constexpr double kCosine75Degrees = 0.2588190451025207;

/// What every scan of an automatic run has in common.
struct ScanRecipe {
  ReconstructMethod method = ReconstructMethod::automatic;
  Box bounds;                      ///< of the object, model units
  std::vector<Sphere> places;      ///< where samples are taken, all that the image shows; empty:
                                   ///< everywhere
  double pixel_size = 0.0;         ///< model units
  double vote_pixel_size = 0.0;    ///< model units, of the visibility vote
  int point_size = 1;              ///< pixels
  double gap = 0.0;                ///< between contours, model units; 0: no contours
  std::optional<double> decimate;  ///< tolerance of DecimateOptions
  bool has_points = true;          ///< false: polygons only, no passes against gaps between points
  bool one_sided = false;          ///< an open sheet, seen from the side of the first view; else a
                                   ///< visibility vote tells outsides from insides
};

/// The visibility vote of its scans, if there is one: of points whose inside is not to be seen.
[[nodiscard]] std::optional<VoteOptions> vote_of(const ScanRecipe& recipe);

/// The command that scans along -`toward_viewer` and stitches what is better or new.
[[nodiscard]] AddScan planned_scan(const ScanRecipe& recipe, const Vec3& toward_viewer,
                                   std::uint32_t view);

/// The command that scans along -`toward_viewer` and adds only what the mesh does not cover yet:
/// a fill view that may cut the old surface destroys coverage.
[[nodiscard]] AddScan fill_scan(const ScanRecipe& recipe, const Vec3& toward_viewer,
                                std::uint32_t view);

}  // namespace rangezip

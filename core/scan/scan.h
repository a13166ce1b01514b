#pragma once

#include <cstdint>
#include <optional>
#include <span>
#include <vector>

#include "core/base/progress.h"
#include "core/base/sphere.h"
#include "core/image/back_side.h"
#include "core/image/fill_holes.h"
#include "core/image/median_filter.h"
#include "core/image/plane_fit.h"
#include "core/image/range_image.h"
#include "core/image/see_through.h"
#include "core/image/steep_cells.h"
#include "core/mask/correspondence.h"
#include "core/mask/mask.h"
#include "core/mask/morphology.h"
#include "core/mask/quality_mask.h"
#include "core/patch/decimate.h"
#include "core/patch/patch.h"
#include "core/scene/scene.h"

namespace rangezip {

/// Everything one scan depends on besides the input and the mesh so far. Plain data: it can be
/// written to a session file and played back. A pass whose options are absent is not run.
struct ScanRequest {
  Camera camera;
  Extent extent{1024, 1024};
  std::vector<Vec2> region;    ///< green lasso, window coordinates; empty: all
  std::vector<Sphere> places;  ///< where samples are taken, world space; empty: everywhere
  int point_size = 1;          ///< pixels
  std::optional<SeeThroughOptions> see_through;
  std::optional<BackSideOptions> back_side;
  std::optional<PlaneFitOptions> plane_fit;  ///< absent: the z-buffer minimum, as in the paper
  std::optional<FillHolesOptions> fill_holes;
  std::optional<MedianFilterOptions> median;
  std::optional<SteepCellsOptions> steep_cells;  ///< samples so marked are left out
  CorrespondenceOptions correspondence;
  bool unmatched_only = false;  ///< a fill view: only samples that lie on no face are taken
  std::optional<QualityMaskOptions> quality;  ///< absent: all samples of the region replace
  bool smooth_quality = true;                 ///< see sample_quality()
  CleanMaskOptions clean_mask;
  TriangulateOptions triangulate;
  std::optional<DecimateOptions> decimate;  ///< of the patch, before it is stitched in
};

/// Per-scan counts for the report.
struct ScanReport {
  std::size_t samples = 0;      ///< pixels with a sample after all passes
  std::size_t see_through = 0;  ///< samples removed
  std::size_t back_side = 0;    ///< samples removed
  std::size_t inside = 0;       ///< samples removed by the visibility vote
  std::size_t filled = 0;       ///< samples made
  std::size_t steep = 0;        ///< samples left out
  std::size_t matched = 0;      ///< samples that lie on a face of the mesh so far
  std::size_t active = 0;       ///< pixels in the final mask
  std::size_t patch_faces = 0;
};

/// Every intermediate product of one scan, for display, tests and debugging.
struct Scan {
  Framebuffer scene_buffer;  ///< the scene, as drawn
  RangeImage image;          ///< after all passes
  Mask filled;               ///< 1 where fill_holes() made the sample
  SlopeImage slopes;
  Correspondence correspondence;  ///< with the mesh so far
  Mask active;                    ///< after all masks
  Patch patch;
  std::optional<DecimateOptions> decimate;  ///< what made the patch of the whole one
  Patch whole_patch;                        ///< before that; empty if it is not decimated
  ScanReport report;
};

/// One pass through the pipeline, up to the patch:
/// scene -> view -> rasterizer -> range image -> passes -> mask -> patch.
/// A pure function of its arguments; the rasterizer is only a tool.
/// The patch's vertices name the primitive that won their pixel (none for filled ones).
/// @param votes one per point of the scene (see DrawPoints), or empty: no visibility vote. Asked by
///     ScanRequest::plane_fit, in vain without that
/// @throws InvalidArgument if a part of the request breaks the rule of its pass, Cancelled.
[[nodiscard]] Scan scan(Rasterizer& rasterizer, const Scene& scene, const TriangleMesh& mesh,
                        const ScanRequest& request, std::span<const std::int8_t> votes = {},
                        const Progress& progress = {});

}  // namespace rangezip

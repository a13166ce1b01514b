#pragma once

// The members of every command as a session file names them: one list that the writer, the reader
// and the schema walk over, so that the three cannot disagree. A structured binding opens each
// struct: a member added there does not compile until it is listed here. Private to core/io.

#include <array>
#include <limits>
#include <optional>
#include <string_view>
#include <utility>

#include "core/session/command.h"

namespace rangezip::session_file {

/// What a number may be; all bounds that are given must hold.
struct NumberRule {
  std::optional<double> minimum;
  std::optional<double> exclusive_minimum;
  std::optional<double> maximum;
};

inline constexpr NumberRule kAny{};
inline constexpr NumberRule kPositive{.exclusive_minimum = 0.0};
inline constexpr NumberRule kNotNegative{.minimum = 0.0};
inline constexpr NumberRule kCosine{.minimum = 0.0, .maximum = 1.0};
inline constexpr NumberRule kShare{.exclusive_minimum = 0.0, .maximum = 1.0};

struct IntegerRule {
  std::int64_t minimum = 0;
  std::int64_t maximum = std::numeric_limits<int>::max();
};

inline constexpr IntegerRule kCount{};
inline constexpr IntegerRule kAtLeastOne{.minimum = 1};
/// In which nothing is left to change, or all of it has changed.
inline constexpr IntegerRule kRounds{.maximum = 10'000};

template <class Enum>
using Choice = std::pair<std::string_view, Enum>;

template <class Fields>
void describe(Fields& f, Extent& extent) {
  auto& [width, height] = extent;
  f.integer("width", width, {1, kMaxRasterExtent}, "pixels");
  f.integer("height", height, {1, kMaxRasterExtent}, "pixels");
}

template <class Fields>
void describe(Fields& f, SeeThroughOptions& options) {
  auto& [max_slope, remove_outliers, rounds] = options;
  f.number("max_slope", max_slope, kPositive,
           "a neighbour d pixels away is compatible within max_slope * d pixel sides of depth");
  f.boolean("remove_outliers", remove_outliers,
            "also samples that fewer than two neighbours are compatible with");
  f.integer("rounds", rounds, kCount, "at most");
}

template <class Fields>
void describe(Fields& f, BackSideOptions& options) {
  auto& [min_gap] = options;
  f.number("min_gap", min_gap, kNotNegative,
           "model units; a smaller largest gap between the sorted depths removes nothing");
}

template <class Fields>
void describe(Fields& f, PlaneFitOptions& options) {
  auto& [slope_ridge] = options;
  f.number("slope_ridge", slope_ridge, kNotNegative,
           "pull of the slope towards that of the nearest samples, as a share of the weight");
}

template <class Fields>
void describe(Fields& f, FillHolesOptions& options) {
  auto& [min_neighbours, rounds, max_step, reach] = options;
  f.integer("min_neighbours", min_neighbours, {1, 8},
            "of the eight, that must have a sample for a pixel to be filled");
  f.integer("rounds", rounds, kRounds, "a round fills what the one before made fillable");
  f.number("max_step", max_step, kPositive,
           "pixel sides of depth; neighbours beyond a larger step belong to another sheet");
  f.integer("reach", reach, {0, kMaxRasterExtent},
            "pixels; lines between samples no farther apart are filled first; 0: none");
}

template <class Fields>
void describe(Fields& f, MedianFilterOptions& options) {
  auto& [radius, max_step] = options;
  f.integer("radius", radius, {1, MedianFilterOptions::kMostRadius}, "pixels");
  f.number("max_step", max_step, kPositive,
           "pixel sides of depth; neighbours farther away do not take part");
}

template <class Fields>
void describe(Fields& f, SteepCellsOptions& options) {
  auto& [min_cosine] = options;
  f.number("min_cosine", min_cosine, kShare,
           "samples whose cells all have a smaller cosine between normal and line of sight go");
}

template <class Fields>
void describe(Fields& f, CorrespondenceOptions& options) {
  auto& [method, band, back_band] = options;
  f.choice("method", method,
           std::array{Choice<CorrespondenceMethod>{"depth_band", CorrespondenceMethod::depth_band},
                      Choice<CorrespondenceMethod>{"id_buffer", CorrespondenceMethod::id_buffer}},
           "faces within a band of depth, or the paper's: the nearest face and a local search");
  f.number("band", band, kPositive,
           "depth_band: half width, in pixel sides times the stretch of the slope; id_buffer: "
           "largest distance, in pixel sides");
  f.number("back_band", back_band, kNotNegative, "the same for faces seen from behind; 0: none");
}

template <class Fields>
void describe(Fields& f, QualityMaskOptions& options) {
  auto& [hysteresis, max_replacing_slope] = options;
  f.number("hysteresis", hysteresis, kPositive,
           "a sample replaces old surface if its quality is less than this times the old one");
  f.limit("max_replacing_slope", max_replacing_slope,
          "tangent; steeper samples never replace; null: no limit");
}

template <class Fields>
void describe(Fields& f, CleanMaskOptions& options) {
  auto& [erosions, dilations] = options;
  f.integer("erosions", erosions, kRounds, "rounds");
  f.integer("dilations", dilations, kRounds, "rounds, after the erosions, inside the region");
}

template <class Fields>
void describe(Fields& f, TriangulateOptions& options) {
  auto& [max_edge, max_slope_cosine, min_component] = options;
  f.limit("max_edge", max_edge,
          "pixel sides; cells with a step of depth longer than sqrt(2) times this stay open; null: "
          "no limit");
  f.number("max_slope_cosine", max_slope_cosine, kCosine,
           "triangles with a smaller cosine between normal and line of sight stay open");
  f.integer("min_component", min_component, kCount, "triangles; smaller pieces are dropped");
}

template <class Fields>
void describe(Fields& f, DecimateOptions& options) {
  auto& [tolerance, max_block] = options;
  f.number("tolerance", tolerance, kNotNegative,
           "pixel sides along the line of sight, of every sample from its triangle");
  f.integer("max_block", max_block, {1, kMaxRasterExtent},
            "cells along the side of the largest blocks");
}

template <class Fields>
void describe(Fields& f, StitchOptions& options) {
  auto& [method, band, clearance, max_gap, min_strip_cosine, collapse_ratio, withdrawal,
         min_component, view] = options;
  f.choice("method", method,
           std::array{Choice<StitchMethod>{"clear_and_fill", StitchMethod::clear_and_fill},
                      Choice<StitchMethod>{"zipper", StitchMethod::zipper}},
           "removes the old faces near the patch and fills the strip, or the paper's zippering");
  f.number("band", band, kPositive,
           "half width, in pixel sides times the stretch of the slope, in which old surface counts "
           "as covered");
  f.number("clearance", clearance, {.minimum = 0.0, .maximum = StitchOptions::kMostPixels},
           "pixels; old vertices closer to the patch are removed");
  f.number("max_gap", max_gap, {.exclusive_minimum = 0.0, .maximum = StitchOptions::kMostPixels},
           "pixels; longest edge of a strip triangle");
  f.number("min_strip_cosine", min_strip_cosine, kCosine,
           "strip triangles with a smaller cosine to the line of sight stay open");
  f.number("collapse_ratio", collapse_ratio, kNotNegative,
           "zipper: seam edges shorter than this share of a pixel side are collapsed; 0: none");
  f.integer("withdrawal", withdrawal, {0, StitchOptions::kMostPixels},
            "pixels around a hole by which the patch gives way first; 0: its triangles there");
  f.integer("min_component", min_component, kCount,
            "triangles; smaller pieces of the result are dropped");
  f.optional_integer("view", view, VertexSource::kNoView,
                     "recorded with each new vertex; null: none");
}

template <class Fields>
void describe(Fields& f, VoteOptions& options) {
  auto& [pixel_size, directions] = options;
  f.required_number("pixel_size", pixel_size, kPositive, "model units, of the scans");
  f.integer("directions", directions, kAtLeastOne, "on the sphere, from which points are seen");
}

/// The members of a ScanRequest stand beside those of AddScan.
template <class Fields>
void describe(Fields& f, ScanRequest& request) {
  auto& [camera, extent, region, places, point_size, see_through, back_side, plane_fit, fill_holes,
         median, steep_cells, correspondence, unmatched_only, quality, smooth_quality, clean_mask,
         triangulate, decimate] = request;
  f.camera("camera", camera, "where the virtual scanner stands");
  f.object("extent", extent, "size of the image");
  f.polygon("region", region, "corners [x, y] in window coordinates (pixels, y up); empty: all");
  f.spheres("places", places,
            "where samples are taken, as [x, y, z, radius] in world space; empty: everywhere");
  f.integer("point_size", point_size, {1, kMaxPointSize}, "pixels");
  f.optional("see_through", see_through,
             "removes samples seen through gaps of a nearer sheet, and outliers; null: not run");
  f.optional("back_side", back_side,
             "removes samples behind the largest gap of the sorted depths; null: not run");
  f.optional("plane_fit", plane_fit,
             "fits a plane to the points around each sample; null: the z-buffer minimum");
  f.optional("fill_holes", fill_holes, "averages into gaps of the sampling; null: not run");
  f.optional("median", median, "edge-preserving median filter; null: not run");
  f.optional("steep_cells", steep_cells, "leaves out samples seen on edge; null: not run");
  f.object("correspondence", correspondence, "which face of the mesh each sample lies on");
  f.boolean("unmatched_only", unmatched_only, "takes only samples that lie on no face of the mesh");
  f.optional("quality", quality,
             "of old and new surface the better sampled one wins; null: the new one");
  f.boolean("smooth_quality", smooth_quality, "the quality of a sample varies less between pixels");
  f.object("clean_mask", clean_mask, "erosion and dilation of what is taken");
  f.object("triangulate", triangulate, "how samples become triangles");
  f.optional("decimate", decimate, "larger triangles where the patch is flat; null: not run");
}

template <class Fields>
void describe(Fields& f, AddScan& command) {
  auto& [scan, stitch, vote] = command;
  describe(f, scan);
  f.object("stitch", stitch, "how the patch joins the mesh");
  f.optional("vote", vote,
             "with plane_fit, removes samples that show the inside of the surface; null: not run");
}

template <class Fields>
void describe(Fields& f, EraseRegion& command) {
  auto& [camera, extent, region, visible_only] = command;
  f.camera("camera", camera, "from where the lasso is drawn; depth planes are fitted to the mesh");
  f.object("extent", extent, "size of the image");
  f.polygon("region", region, "corners [x, y] in window coordinates (pixels, y up); empty: all");
  f.boolean("visible_only", visible_only, "false: faces behind the visible ones too");
}

template <class Fields>
void describe(Fields& f, ErasePlaces& command) {
  auto& [places] = command;
  f.spheres("places", places,
            "spheres as [x, y, z, radius]: a face with its centroid in one of them is deleted");
}

template <class Fields>
void describe(Fields& f, SmoothMesh& command) {
  auto& [iterations, factor] = command;
  f.integer("iterations", iterations, {1, kRounds.maximum}, "rounds");
  f.number("factor", factor, kShare, "share of the way to the mean of the neighbours");
}

template <class Fields>
void describe(Fields& f, FillMeshHoles& command) {
  auto& [pixel_size, max_perimeter] = command;
  f.number("pixel_size", pixel_size, kNotNegative,
           "length of new edges, model units; 0: as long as those around the hole");
  f.limit("max_perimeter", max_perimeter, "model units; longer loops stay open; null: no limit");
}

template <class Fields>
void describe(Fields& f, DropUnsupported& command) {
  auto& [pixel_size] = command;
  f.number("pixel_size", pixel_size, kNotNegative,
           "of the scans, model units; 0: the mesh's mean edge length");
}

template <class Fields>
void describe(Fields& f, TurnToScanners& command) {
  auto& [scanners] = command;
  f.points("scanners", scanners, "positions [x, y, z] of the scanners, world coordinates");
}

template <class Fields>
void describe(Fields& f, FinishMesh& command) {
  auto& [options, vote] = command;
  auto& [method, pixel_size, max_hole_perimeter, narrow_width, rounds, relaxations, triangles,
         flat_tolerance, snap_features, gap, narrow_gaps, regrow, open_sheet, follow_density,
         min_component, is_clean] = options;
  f.choice("method", method,
           std::array{Choice<FinishMethod>{"fast", FinishMethod::fast},
                      Choice<FinishMethod>{"full", FinishMethod::full}},
           "fast: closes holes and removes self-intersections; full: also improves the triangles");
  f.number("pixel_size", pixel_size, kNotNegative,
           "of the scans, model units; 0: the mesh's mean edge length");
  f.number("max_hole_perimeter", max_hole_perimeter, kNotNegative,
           "pixel sizes; loops up to this are closed even where no points show a surface");
  f.number("narrow_width", narrow_width, kNotNegative,
           "pixel sizes; loops whose sides face each other within this are always closed");
  f.integer("rounds", rounds, kRounds, "of removing self-intersections and closing, at most");
  f.integer("relaxations", relaxations, kRounds, "rounds of improving the triangles");
  f.integer("triangles", triangles, kCount,
            "how many there are to be, met within a few percent; 0: as many as come");
  f.number("flat_tolerance", flat_tolerance, kNotNegative,
           "pixel sizes; edges collapse where triangles stay within this of the surface; 0: of one "
           "size");
  f.boolean("snap_features", snap_features, "moves vertices onto sharp edges and corners");
  f.number("gap", gap, kNotNegative,
           "model units; between the contours that the points lie on; 0: they are spread evenly");
  f.boolean("narrow_gaps", narrow_gaps, "cuts handles where no points lie");
  f.boolean("regrow", regrow, "the mesh grows over points that no scan has reached");
  f.boolean("open_sheet", open_sheet, "what is cleared along open borders in vain comes back");
  f.boolean("follow_density", follow_density,
            "full: smaller triangles where the points are denser than pixel_size asks for");
  f.integer("min_component", min_component, kCount, "triangles; smaller pieces are dropped");
  f.boolean("is_clean", is_clean,
            "no faces of the mesh cross, as scans leave it: only those that come are checked");
  f.optional("vote", vote,
             "drops faces that lie in the air where points look through; null: not run");
}

template <class Fields>
void describe(Fields& f, UndoSteps& command) {
  auto& [count] = command;
  f.integer("count", count, kAtLeastOne, "commands to take back");
}

/// Calls visit(name, text, Command type) for each command a session may hold.
template <class Visit>
void for_each_command_type(const Visit& visit) {
  visit("scan", "scans the inputs and stitches the patch into the mesh", AddScan{});
  visit("erase", "deletes the faces seen inside a region", EraseRegion{});
  visit("erase_places", "deletes the faces in some places", ErasePlaces{});
  visit("smooth", "Laplacian smoothing of all inner vertices", SmoothMesh{});
  visit("fill", "closes boundary loops", FillMeshHoles{});
  visit("drop_unsupported", "drops the faces that no point lies near", DropUnsupported{});
  visit("finish", "closes, cleans and improves the mesh", FinishMesh{});
  visit("turn_to_scanners", "turns components that show scanners their backs", TurnToScanners{});
  visit("undo", "takes back the last commands", UndoSteps{});
}

}  // namespace rangezip::session_file

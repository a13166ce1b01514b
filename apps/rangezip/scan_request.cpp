#include "apps/rangezip/scan_request.h"

#include <algorithm>
#include <cmath>
#include <numbers>
#include <string>

#include "apps/rangezip/commands.h"
#include "apps/rangezip/exit_code.h"
#include "apps/rangezip/values.h"
#include "core/base/deterministic_math.h"
#include "core/plan/align_to_feature.h"
#include "core/reconstruct/resolution.h"
#include "core/reconstruct/scan_recipe.h"
#include "core/session/run_command.h"
#include "core/session/session.h"

namespace rangezip::app {

namespace {

constexpr int kMargin = 4;  ///< pixels around the object

/// A flag, and its opposite --no-..., which the help mentions once for all.
void add_switch(CLI::App& command, const std::string& name, std::optional<bool>& target,
                const std::string& text) {
  const auto choose = [&target, name](bool choice) {
    if (target == !choice) throw CLI::ValidationError("--" + name, "given with its opposite");
    target = choice;
  };
  command
      .add_flag_callback(
          "--" + name, [choose] { choose(true); }, text)
      ->group("Passes");
  command.add_flag_callback("--no-" + name, [choose] { choose(false); })->group("");
}

void add_count(CLI::App& command, const std::string& name, std::optional<int>& target, int lowest,
               int highest, const std::string& text) {
  command
      .add_option_function<int>(
          name, [&target](const int& value) { target = value; }, text)
      ->check(CLI::Range(lowest, highest))
      ->type_name("N")
      ->group("Passes");
}

void add_view_options(CLI::App& command, ScanChoices& choices) {
  const auto add = [&](const char* name, auto& target, const auto& parse, const char* text,
                       const char* form) {
    add_parsed(command, name, target, parse, text, form)->group("View");
  };
  add("--direction", choices.direction, parse_vector, "From the object toward the scanner [0,0,1]",
      "X,Y,Z");
  add("--up", choices.up, parse_vector,
      "What points upwards in the image [y, or x if looking along y]", "X,Y,Z");
  add("--size", choices.size, parse_extent, "Of the image, in pixels [around all of the input]",
      "W,H");
  add("--pixel-size", choices.pixel_size, parse_positive,
      "Side of a pixel, in the units of the input [from the spacing of the points, or so that all "
      "fits into --size]",
      "H");
  add("--perspective", choices.perspective, parse_positive,
      "Central projection with this vertical angle, from where all is seen [parallel]", "DEGREES");
  command
      .add_flag(
          "--align", choices.align,
          "Turn and shift the image so that the dominant sharp edge runs along a row or column "
          "of pixels")
      ->group("View");
  add("--region", choices.region, parse_polygon,
      "Take only what is seen inside of this polygon: corners in pixels, from the lower left of "
      "the image, y up",
      "\"X,Y X,Y X,Y ...\"");
  add_repeated(command, "--clip", choices.clip_planes, parse_plane,
               "Cut away what has NX x + NY y + NZ z + D < 0; may be given several times",
               "NX,NY,NZ,D")
      ->group("View");
}

void add_pass_options(CLI::App& command, ScanChoices& choices) {
  add_count(command, "--point-size", choices.point_size, 1, kMaxPointSize,
            "Size of a drawn point, in pixels [so that the sheet has no gaps]");
  add_switch(command, "back-side", choices.back_side,
             "Remove what lies behind the largest gap of the sorted depths");
  add_parsed(command, "--min-gap", choices.min_gap, parse_not_negative,
             "For --back-side: a smaller gap removes nothing [0]", "LENGTH")
      ->group("Passes");
  add_switch(command, "see-through", choices.see_through,
             "Remove samples seen through gaps of a nearer sheet, and outliers");
  add_switch(command, "vote", choices.vote,
             "For --plane-fit: remove samples that show the inside of a surface, by how its points "
             "are seen from all around");
  add_switch(command, "plane-fit", choices.plane_fit,
             "Fit a plane to the points around each pixel instead of taking the nearest");
  add_switch(command, "fill-holes", choices.fill_holes, "Fill gaps of the sampling by averages");
  add_switch(command, "median", choices.median, "Edge-preserving median filter");
  add_count(command, "--median-radius", choices.median_radius, 1, MedianFilterOptions::kMostRadius,
            "For --median: pixels [1]");
  add_switch(command, "steep-cells", choices.steep_cells, "Leave out samples seen on edge");
  add_parsed(command, "--steep-cosine", choices.steep_cosine, parse_positive,
             "For --steep-cells: smallest cosine between normal and line of sight [0.2588]",
             "COSINE")
      ->group("Passes");
  add_parsed(command, "--correspondence", choices.correspondence,
             one_of<CorrespondenceMethod>({{"depth-band", CorrespondenceMethod::depth_band},
                                           {"id-buffer", CorrespondenceMethod::id_buffer}}),
             "How samples find the face they lie on: depth-band or id-buffer", "HOW")
      ->group("Passes");
  add_switch(command, "quality", choices.quality,
             "Replace old surface only where the new one is sampled better");
  command
      .add_flag("--only-new", choices.only_new, "Take only samples that lie on no face of the mesh")
      ->group("Passes");
  add_count(command, "--erosions", choices.erosions, 0, 100, "Of what is taken, in rounds");
  add_count(command, "--dilations", choices.dilations, 0, 100, "After the erosions, in rounds");
  add_parsed(command, "--max-edge", choices.max_edge, parse_positive,
             "Longest step of depth that a triangle bridges, over the square root of 2", "PIXELS")
      ->group("Passes");
  add_parsed(command, "--decimate", choices.decimate, parse_not_negative,
             "Merge triangles where all samples stay within this of them, in pixels along the line "
             "of sight [keep all]",
             "TOLERANCE")
      ->group("Passes");
  add_parsed(command, "--stitch", choices.stitch,
             one_of<StitchMethod>({{"clear-and-fill", StitchMethod::clear_and_fill},
                                   {"zipper", StitchMethod::zipper}}),
             "How the patch joins the mesh: clear-and-fill or zipper", "HOW")
      ->group("Passes");
  add_parsed(command, "--collapse-ratio", choices.collapse_ratio, parse_not_negative,
             "For zipper: seam edges shorter than this share of a pixel are collapsed", "SHARE")
      ->group("Passes");
}

/// A camera with its image, and the side of a pixel in the middle of what it sees.
struct Framing {
  Camera camera;
  Extent extent;
  double pixel_size = 0.0;  ///< model units
};

Framing frame_parallel(const Box& bounds, double pixel_size, const ScanChoices& choices) {
  FramedCamera framed = frame_box(bounds, choices.direction, pixel_size, kMargin, choices.up);
  if (choices.size) {
    const Extent size = *choices.size;
    if (!choices.pixel_size) {
      pixel_size *= std::max(static_cast<double>(framed.extent.width) / size.width,
                             static_cast<double>(framed.extent.height) / size.height);
    }
    framed.camera.lens = Orthographic{.height = pixel_size * size.height};
    framed.extent = size;
  }
  return {std::move(framed.camera), framed.extent, pixel_size};
}

/// The eye stands where the sphere around the box just fits into the angle.
Framing frame_perspective(const Box& bounds, double pixel_size, const ScanChoices& choices) {
  constexpr double kHalfTurn = 180.0;
  if (*choices.perspective >= kHalfTurn) {
    throw UsageError("--perspective: must be less than 180 degrees");
  }
  if (choices.size && choices.pixel_size) {
    throw UsageError("--perspective: give only one of --size and --pixel-size; the other follows");
  }
  const double fov_y = *choices.perspective * std::numbers::pi / kHalfTurn;
  const double slope = deterministic_tan(0.5 * fov_y);
  const double aspect =
      choices.size ? static_cast<double>(choices.size->width) / choices.size->height : 1.0;
  const double narrow = slope * std::min(1.0, aspect);
  const double distance = 0.5 * bounds.diagonal() * std::sqrt(1.0 + 1.0 / (narrow * narrow));

  const double side = std::ceil(2.0 * slope * distance / pixel_size);
  if (!choices.size && side > kMaxRasterExtent) {
    throw UsageError("--perspective: the image would be larger than " +
                     std::to_string(kMaxRasterExtent) +
                     " pixels; give --size or a larger --pixel-size");
  }
  const Extent extent =
      choices.size ? *choices.size : Extent{static_cast<int>(side), static_cast<int>(side)};
  Camera camera = frame_box(bounds, choices.direction, pixel_size, kMargin, choices.up).camera;
  const Vec4 center = camera.eye_from_world * Vec4(bounds.center(), 1.0);
  camera.eye_from_world[3].z -= distance + center.z;  // back along the line of sight
  camera.lens = Perspective{.fov_y = fov_y};
  return {fit_depth_planes(std::move(camera), bounds), extent,
          2.0 * slope * distance / extent.height};
}

/// Turns a pass on with its defaults, off, or leaves it as the method has it.
template <class Options>
void choose(std::optional<Options>& pass, const std::optional<bool>& choice) {
  if (choice && !*choice) pass.reset();
  if (choice && *choice && !pass) pass.emplace();
}

/// Sets an option of a pass, which must be on.
template <class Pass, class Value, class Member>
void set(std::optional<Pass>& pass, Member Pass::*member, const std::optional<Value>& value,
         const char* option, const char* needed) {
  if (!value) return;
  if (!pass) throw UsageError(std::string(option) + ": needs " + needed);
  (*pass).*member = *value;
}

void choose_passes(AddScan& command, const ScanChoices& choices, double pixel_size) {
  ScanRequest& scan = command.scan;
  choose(scan.back_side, choices.back_side);
  set(scan.back_side, &BackSideOptions::min_gap, choices.min_gap, "--min-gap", "--back-side");
  choose(scan.see_through, choices.see_through);
  choose(scan.plane_fit, choices.plane_fit);
  choose(command.vote, choices.vote);
  if (!scan.plane_fit) command.vote.reset();
  if (!scan.plane_fit && choices.vote == true) throw UsageError("--vote: needs --plane-fit");
  if (command.vote) command.vote->pixel_size = pixel_size;
  choose(scan.fill_holes, choices.fill_holes);
  choose(scan.median, choices.median);
  set(scan.median, &MedianFilterOptions::radius, choices.median_radius, "--median-radius",
      "--median");
  choose(scan.steep_cells, choices.steep_cells);
  set(scan.steep_cells, &SteepCellsOptions::min_cosine, choices.steep_cosine, "--steep-cosine",
      "--steep-cells");
  choose(scan.quality, choices.quality);
  if (choices.correspondence) scan.correspondence.method = *choices.correspondence;
  if (choices.erosions) scan.clean_mask.erosions = *choices.erosions;
  if (choices.dilations) scan.clean_mask.dilations = *choices.dilations;
  if (choices.max_edge) scan.triangulate.max_edge = *choices.max_edge;
  if (choices.stitch) command.stitch.method = *choices.stitch;
  if (choices.collapse_ratio) command.stitch.collapse_ratio = *choices.collapse_ratio;
}

}  // namespace

void add_scan_choices(CLI::App& command, ScanChoices& choices) {
  add_view_options(command, choices);
  add_parsed(command, "--method", choices.method,
             one_of<ReconstructMethod>(
                 {{"auto", ReconstructMethod::automatic}, {"paper", ReconstructMethod::paper}}),
             "Which passes run unless chosen below: auto, or paper: those of Kobbelt and Botsch "
             "2000 [auto]",
             "METHOD");
  add_pass_options(command, choices);
}

AddScan make_scan(const Scene& scene, const ScanChoices& choices) {
  if (choices.align && (choices.size || !choices.region.empty())) {
    throw UsageError(
        "--align: turns the image, whose size and pixels are then others; give neither "
        "--size nor --region");
  }
  const std::vector<Vec3> samples = evidence_points(scene);
  const Resolution wanted =
      choose_resolution(scene, samples, choices.pixel_size, std::nullopt, false);
  Framing framing = choices.perspective
                        ? frame_perspective(wanted.bounds, wanted.pixel_size, choices)
                        : frame_parallel(wanted.bounds, wanted.pixel_size, choices);
  // What depends on the pixel size follows the one that the image really has.
  const Resolution resolution =
      choose_resolution(scene, samples, framing.pixel_size, std::nullopt, false);
  const ScanRecipe recipe{.method = choices.method,
                          .bounds = resolution.bounds,
                          .pixel_size = resolution.pixel_size,
                          .vote_pixel_size = resolution.pixel_size,
                          .point_size = resolution.point_size,
                          .decimate = choices.decimate,
                          .has_points = scene.point_count() > 0};
  constexpr std::uint32_t kFirstView = 0;
  AddScan command = choices.only_new ? fill_scan(recipe, choices.direction, kFirstView)
                                     : planned_scan(recipe, choices.direction, kFirstView);
  command.scan.camera = std::move(framing.camera);
  command.scan.camera.clip_planes = choices.clip_planes;
  command.scan.extent = framing.extent;
  command.scan.region = choices.region;
  if (choices.point_size) command.scan.point_size = *choices.point_size;
  choose_passes(command, choices, resolution.pixel_size);
  return command;
}

AddScan aligned(AddScan command, const Scene& scene, Rasterizer& rasterizer,
                const Progress& progress) {
  Session session(scene, {}, SessionOptions{.history_bytes = 0});
  session.apply(command, rasterizer, progress);
  const auto camera = align_to_feature(session.last_scan()->image);
  if (!camera) {
    throw UsageError("--align: no sharp straight edge is seen from --direction");
  }
  command.scan.camera = camera->camera;
  command.scan.extent = camera->extent;
  return command;
}

}  // namespace rangezip::app

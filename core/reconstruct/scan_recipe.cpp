#include "core/reconstruct/scan_recipe.h"

#include <algorithm>
#include <cmath>

namespace rangezip {

namespace {

constexpr int kImageMargin = 4;  ///< pixels around the object, so that no pass meets the border

/// The places, with the surface around them that samples there are joined to.
Box shown_box(const ScanRecipe& recipe) {
  constexpr double kMargin = 6.0;  // pixels
  if (recipe.places.empty()) return recipe.bounds;
  Box box;
  for (const Sphere& place : recipe.places) {
    const Vec3 reach(place.radius + kMargin * recipe.pixel_size);
    box.add(place.center - reach);
    box.add(place.center + reach);
  }
  return box;
}

AddScan framed_scan(const ScanRecipe& recipe, const Vec3& toward_viewer, std::uint32_t view) {
  FramedCamera framed =
      frame_box(shown_box(recipe), toward_viewer, recipe.pixel_size, kImageMargin);
  AddScan command;
  command.scan.places = recipe.places;
  // What stands before the places hides what is in them.
  command.scan.camera = fit_depth_planes(std::move(framed.camera), recipe.bounds);
  command.scan.extent = framed.extent;
  command.scan.point_size = recipe.point_size;
  command.scan.triangulate = {.max_edge = 2.75, .max_slope_cosine = kCosine75Degrees};
  if (recipe.decimate) command.scan.decimate = DecimateOptions{.tolerance = *recipe.decimate};
  command.stitch.view = view;
  return command;
}

/// How far apart contours may be where they are joined, pixels: some gaps are wider than usual.
int bridge_reach(const ScanRecipe& recipe) {
  constexpr double kReachPerGap = 3.0;
  constexpr double kFarthest = 64.0;  // beyond, no pixel knows its neighbours
  const double reach = std::round(kReachPerGap * recipe.gap / recipe.pixel_size);
  return static_cast<int>(std::min(reach, kFarthest));
}

/// The passes of this project: plane-fit samples, local removal of what shines through, the
/// visibility vote, correspondence in a depth band, clear and fill.
AddScan automatic_scan(const ScanRecipe& recipe, const Vec3& toward_viewer, std::uint32_t view) {
  AddScan command = framed_scan(recipe, toward_viewer, view);
  if (recipe.has_points) {
    command.scan.see_through = SeeThroughOptions{};
    command.scan.plane_fit = PlaneFitOptions{};
    command.scan.fill_holes = FillHolesOptions{};
    command.scan.fill_holes->reach = bridge_reach(recipe);
    command.vote = vote_of(recipe);
  }
  command.stitch.method = StitchMethod::clear_and_fill;
  // Where the strip fails at a pixel it mostly does at the next ones: less leaves ragged borders.
  command.stitch.withdrawal = 2;
  return command;
}

/// The passes of the paper: z-buffer minimum, largest gap, averaged holes, median, ID buffer,
/// zippering [Kobbelt, Botsch 2000, 4].
AddScan paper_scan(const ScanRecipe& recipe, const Vec3& toward_viewer, std::uint32_t view) {
  AddScan command = framed_scan(recipe, toward_viewer, view);
  if (recipe.has_points) {
    command.scan.back_side = BackSideOptions{};
    command.scan.fill_holes = FillHolesOptions{};
    command.scan.median = MedianFilterOptions{};
  }
  command.scan.correspondence.method = CorrespondenceMethod::id_buffer;
  command.scan.smooth_quality = false;
  command.stitch.method = StitchMethod::zipper;
  return command;
}

AddScan base_scan(const ScanRecipe& recipe, const Vec3& toward_viewer, std::uint32_t view) {
  return recipe.method == ReconstructMethod::paper ? paper_scan(recipe, toward_viewer, view)
                                                   : automatic_scan(recipe, toward_viewer, view);
}

}  // namespace

std::optional<VoteOptions> vote_of(const ScanRecipe& recipe) {
  if (!recipe.has_points || recipe.one_sided || recipe.method == ReconstructMethod::paper)
    return std::nullopt;
  return VoteOptions{.pixel_size = recipe.vote_pixel_size};
}

AddScan planned_scan(const ScanRecipe& recipe, const Vec3& toward_viewer, std::uint32_t view) {
  constexpr std::size_t kMinPatchFaces = 40;
  AddScan command = base_scan(recipe, toward_viewer, view);
  command.scan.quality =
      QualityMaskOptions{.hysteresis = recipe.method == ReconstructMethod::paper ? 1.0 : 0.8};
  command.scan.triangulate.min_component = kMinPatchFaces;
  return command;
}

AddScan fill_scan(const ScanRecipe& recipe, const Vec3& toward_viewer, std::uint32_t view) {
  constexpr std::size_t kMinFillFaces = 3;
  AddScan command = base_scan(recipe, toward_viewer, view);
  command.scan.unmatched_only = true;
  command.scan.clean_mask = {.erosions = 0, .dilations = 0};
  command.scan.triangulate.min_component = kMinFillFaces;
  // An empty pixel may be a part of a hole there; other views fill what is none.
  if (!recipe.places.empty()) command.scan.fill_holes.reset();
  return command;
}

}  // namespace rangezip

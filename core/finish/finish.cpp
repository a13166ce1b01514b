#include "core/finish/finish.h"

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <numeric>
#include <optional>
#include <utility>
#include <vector>

#include "core/base/check_number.h"
#include "core/finish/air_bridges.h"
#include "core/finish/boundary_loops.h"
#include "core/finish/clean_topology.h"
#include "core/finish/coarsen.h"
#include "core/finish/components.h"
#include "core/finish/corner_table.h"
#include "core/finish/extend_border.h"
#include "core/finish/feature_cleanup.h"
#include "core/finish/fit_faces.h"
#include "core/finish/fit_radii.h"
#include "core/finish/fit_vertices.h"
#include "core/finish/fit_window.h"
#include "core/finish/hole_choice.h"
#include "core/finish/left_out_points.h"
#include "core/finish/local_sizes.h"
#include "core/finish/mark_around.h"
#include "core/finish/orient_pieces.h"
#include "core/finish/papered_faces.h"
#include "core/finish/point_grid.h"
#include "core/finish/point_sides.h"
#include "core/finish/regrow.h"
#include "core/finish/relax_border.h"
#include "core/finish/remesh.h"
#include "core/finish/repair.h"
#include "core/finish/separate.h"
#include "core/finish/settled_loops.h"
#include "core/finish/sharpen.h"
#include "core/finish/small_angles.h"
#include "core/finish/small_pieces.h"
#include "core/finish/take_back_losses.h"
#include "core/finish/thin_handles.h"
#include "core/finish/unfold.h"
#include "core/finish/unsupported_faces.h"
#include "core/finish/untangle.h"
#include "core/mesh/face_changes.h"
#include "core/mesh/self_intersection.h"

namespace rangezip {
namespace {

/// In h: about half the radius in which points around a vertex are looked for.
constexpr double kPointCell = 0.7;
/// In h: fits of a wider radius use mean points (PointGrid::thinned()).
constexpr double kThinnedFrom = 2.4;
/// Parts along each side of a cell, with a mean point each.
constexpr int kThinnedParts = 2;
/// In h: girth of handles that no object has, since scans resolve what is 2 h thick (over 6 h
/// around).
constexpr double kThinHandle = 5.5;
/// In h: the same across gaps that scans do not resolve: pillars of a pixel or two.
constexpr double kPillar = 6.5;
/// In h: girth of handles that the object does not have if points lie within.
constexpr double kFilledHandle = 9.0;
/// Between contours a window may span four gaps: two contours on both sides tell the bending.
constexpr double kWidestPerGap = 5.0;
constexpr int kRegrowRounds = 3;
constexpr std::size_t kMuchLeftOut = 500;  ///< one in so many points
constexpr double kFarInTheWay = 2.0;  ///< RegrowOptions::in_the_way, if growing parted something
constexpr int kHandleRounds = 6;      ///< of {cut, close}: paths that touch are cut one by one
/// Points a face: more tell hardly more, and take longer.
constexpr std::size_t kMostPoints = 24;
/// Times: with so many fewer triangles than the scans give, where they lie matters more than that
/// they have one shape.
constexpr std::size_t kFarFewer = 4;
/// Of the tolerance: the root mean square, where single places are about twice as far.
constexpr double kMeanOfTolerance = 0.5;
/// Of coarsened faces: long triangles stay long (20 degrees), and vertices on creases there.
constexpr double kCoarseSmallAngle = 0.342;
constexpr double kCoarseHold = 0.001;
/// Times: of more triangles than these all edges would be shorter than a quarter of what they are.
constexpr std::size_t kMostFiner = 16;
constexpr int kCoarsenRounds = 3;  ///< again, where triangles crossed
/// Of an edge: averaged over the points around a vertex, less than what a surface bulges that bends
/// by a tenth of a radian over a triangle.
constexpr double kHardlyNoise = 0.03;
/// In h: how far beyond the mesh points may matter.
constexpr double kRegionMargin = 4.0;
/// Of the time of a full finish of closed models: when parts of it begin.
constexpr double kGrowShare = 0.1;
constexpr double kHandlesShare = 0.25;
constexpr double kImproveShare = 0.3;
constexpr double kSharpenShare = 0.55;
constexpr double kFitShare = 0.8;

void check(const FinishOptions& options) {
  check_positive("finish: pixel_size", options.pixel_size);
  check_not_negative("finish: max_hole_perimeter", options.max_hole_perimeter);
  check_not_negative("finish: narrow_width", options.narrow_width);
  check_not_negative("finish: flat_tolerance", options.flat_tolerance);
  check_not_negative("finish: gap", options.gap);
}

using Pairs = std::vector<std::pair<std::uint32_t, std::uint32_t>>;

/// How fits to the surface and its triangles are to be made.
struct Scale {
  FitWindow fit;      ///< as wide at each place as noise, bending and density ask for
  ShareField sizes;   ///< of triangles
  double edge = 0.0;  ///< length of edges, model units, where the size is one
};

std::size_t count_loops(const TriangleMesh& mesh) {
  return boundary_loops(CornerTable(mesh.triangles, mesh.positions.size())).size();
}

/// Components of so many faces at least: scraps come and go.
std::size_t count_components(const TriangleMesh& mesh, std::size_t min_faces) {
  const std::vector<std::size_t> sizes =
      component_sizes(components_of(CornerTable(mesh.triangles, mesh.positions.size())));
  return static_cast<std::size_t>(std::count_if(
      sizes.begin(), sizes.end(), [&](std::size_t size) { return size >= min_faces; }));
}

/// What a repair would not drop for its size: of the rest nothing is to come back.
TriangleMesh without_small_pieces(TriangleMesh mesh, const FinishOptions& options) {
  const CornerTable table(mesh.triangles, mesh.positions.size());
  drop_small_components(mesh, table, components_of(table),
                        {options.min_component, options.pixel_size});
  return mesh;
}

/// What growing works with.
struct Growth {
  const TriangleMesh* clean;  ///< an earlier state in which nothing crosses; null: not known
  const SeenPoints& cloud;
  const PointGrid& points;  ///< the same
  const FinishOptions& options;
  const Progress& progress;
};

/// The pairs of faces that cross.
Pairs crossings_of(const TriangleMesh& mesh, const TriangleMesh* clean, const Progress& progress) {
  if (clean == nullptr) return self_intersections(mesh, progress);
  return self_intersections(mesh, find_face_changes(*clean, mesh).made, {}, progress);
}

/// Grows over what no scan has reached.
void grow(TriangleMesh& mesh, const Growth& growth, const RegrowOptions& grown,
          FinishReport& report) {
  const auto& [given, cloud, points, options, progress] = growth;
  if (!options.regrow) return;
  const GrowthReport regrown = regrow(mesh, cloud, points, grown, progress);
  report.regrown_faces += regrown.faces;
  report.grown_bodies += regrown.bodies;
}

/// Closes what growing has left open. Of an open sheet comes back what all that leaves out.
/// @param start before it grew; not needed for bodies
void close_grown(TriangleMesh& mesh, const TriangleMesh& start, const Pairs& crossing,
                 const Growth& growth, FinishReport& report) {
  const auto& [given, cloud, points, options, progress] = growth;
  repair(mesh, crossing, {}, points, options, report, progress);
  if (options.open_sheet) take_back_losses(mesh, start, &points, options.pixel_size, progress);
}

/// Points that a mesh leaves out, and its loops.
struct Lack {
  std::vector<Vec3> points;
  std::size_t loops = 0;
};

Lack lack_of(const TriangleMesh& mesh, const SeenPoints& cloud, double pixel_size) {
  return {left_out_points(cloud.points, mesh, kLeftOut * pixel_size), count_loops(mesh)};
}

/// With as many loops, more points left out are worse. More loops are, since between noisy walls a
/// front may join one to the other, but not if half of what was left out is there, and that is
/// much, as a tail or an ear that was cleared for the front.
bool is_worse(const Lack& lack, const Lack& before, std::size_t points) {
  const std::size_t left_out = lack.points.size(), left_out_before = before.points.size();
  if (lack.loops == before.loops) return left_out > left_out_before + kFewLeftOut;
  const bool is_much = left_out_before > points / kMuchLeftOut;
  const bool is_half_there = 2 * left_out < left_out_before;
  return lack.loops > before.loops && !(is_much && is_half_there);
}

/// Where a repair left something open, faces around have gone: there it grows again, unless that
/// makes it worse.
void grow_again(TriangleMesh& mesh, const Growth& growth, RegrowOptions grown,
                FinishReport& report) {
  const auto& [given, cloud, points, options, progress] = growth;
  const double h = options.pixel_size;
  Lack lack_before = lack_of(mesh, cloud, h);
  for (int round = 1; round < kRegrowRounds; ++round) {
    grown.left_out = &lack_before.points;
    const TriangleMesh clean = mesh;
    const FinishReport before = report;
    grow(mesh, growth, grown, report);
    const FaceChanges changes = find_face_changes(clean, mesh);
    if (changes.made.empty() && changes.gone.empty()) return;
    close_grown(mesh, clean, self_intersections(mesh, changes.made, {}, progress), growth, report);
    Lack lack = lack_of(mesh, cloud, h);
    if (is_worse(lack, lack_before, cloud.points.size())) {
      mesh = clean;
      report = before;
      return;
    }
    lack_before = std::move(lack);
  }
}

/// Grows over what no scan has reached, and closes what is left open.
/// @param in_the_way RegrowOptions::in_the_way
void grow_and_close(TriangleMesh& mesh, const Growth& growth, double in_the_way,
                    FinishReport& report) {
  const FinishOptions& options = growth.options;
  const RegrowOptions grown{.pixel_size = options.pixel_size,
                            .in_the_way = in_the_way,
                            .only_outwards = !options.narrow_gaps,
                            .is_body = !options.open_sheet};
  const TriangleMesh start = options.open_sheet ? mesh : TriangleMesh{};
  grow(mesh, growth, grown, report);
  close_grown(mesh, start, crossings_of(mesh, growth.clean, growth.progress), growth, report);
  if (options.regrow) grow_again(mesh, growth, grown, report);
}

/// The same; where that parts what was one body, as when the neck of a cavity is closed inside,
/// once more from farther around, if that leaves fewer pieces and no more loops.
void grow_in_one(TriangleMesh& mesh, const Growth& growth, FinishReport& report) {
  TriangleMesh start = mesh;
  const FinishReport before = report;
  grow_and_close(mesh, growth, RegrowOptions{}.in_the_way, report);
  if (report.regrown_faces == 0 || growth.options.open_sheet) return;
  const std::size_t scrap = growth.options.min_component;
  const std::size_t parts = count_components(mesh, scrap);
  if (parts <= count_components(start, scrap) + report.grown_bodies) return;
  TriangleMesh again = std::move(start);
  FinishReport report_again = before;
  grow_and_close(again, growth, kFarInTheWay, report_again);
  if (count_components(again, scrap) >= parts || count_loops(again) > count_loops(mesh)) return;
  mesh = std::move(again);
  report = report_again;
}

/// Cuts handles that seams made where sheets come close, and closes the holes. The other borders
/// of an open sheet have been looked at already.
void remove_thin_handles(TriangleMesh& mesh, const PointGrid& cloud, const FinishOptions& options,
                         FinishReport& report, const Progress& progress) {
  const double h = options.pixel_size;
  ThinHandleOptions thin{.max_girth = kThinHandle * h};
  if (options.narrow_gaps) {
    thin.gaps = {&cloud, h};
    thin.max_girth = kPillar * h;
  } else {
    thin.filled_girth = kFilledHandle * h;
    thin.cloud = {&cloud, h};
  }
  for (int round = 0; round < kHandleRounds; ++round) {
    progress.check_stop();
    const SettledLoops settled = options.open_sheet ? SettledLoops(mesh) : SettledLoops();
    const std::size_t cut = cut_thin_handles(mesh, thin, progress);
    if (cut == 0) return;
    report.cut_handles += cut;
    const TriangleMesh open = mesh;
    repair(mesh, {}, settled, cloud, options, report, progress);
    if (!options.narrow_gaps && !options.open_sheet)
      take_back_losses(mesh, open, nullptr, h, progress);
  }
}

std::vector<std::uint32_t> all_faces(const TriangleMesh& mesh) {
  std::vector<std::uint32_t> faces(mesh.triangles.size());
  std::iota(faces.begin(), faces.end(), 0U);
  return faces;
}

/// What untangling left sharp.
void mend_slivers(TriangleMesh& mesh, const PointGrid& cloud, const FinishOptions& options,
                  FinishReport& report, const Progress& progress) {
  const TriangleMesh clean = geometry_of(mesh);
  CornerTable table(mesh.triangles, mesh.positions.size());
  const FeatureCleanupReport mended = remove_slivers(table, mesh.positions);
  if (mended.collapsed_edges + mended.flipped_edges == 0) return;
  report.collapsed_edges += mended.collapsed_edges;
  report.flipped_edges += mended.flipped_edges;
  mesh.triangles = table.triangles();
  const std::vector<std::uint32_t> changed = find_face_changes(clean, mesh).made;
  separate(mesh, changed, cloud, options, report, progress);
}

/// Whether points have so little noise that faces, with edges of about this length, are nearer to
/// the surface if they are fitted to the points themselves. Not between contours.
bool are_points_exact(double noise, double edge, const FinishOptions& options) {
  return noise <= kHardlyNoise * edge && options.gap == 0.0;
}

/// Whether the mesh is made with the triangles of the scans first, and then coarsened.
bool is_to_coarsen(const TriangleMesh& mesh, const FinishOptions& options) {
  return options.flat_tolerance > 0.0 ||
         (options.triangles > 0 && mesh.triangles.size() > kFarFewer * options.triangles);
}

/// Coarsens without faces that cross: where they come, the triangles stay as they are.
/// @return faces that cross nevertheless
std::vector<std::uint32_t> coarsen_cleanly(TriangleMesh& mesh, CoarsenOptions options,
                                           FinishReport& report, const Progress& progress) {
  const TriangleMesh fine = mesh;
  options.is_kept.assign(fine.positions.size(), 0);
  for (int round = 0;; ++round) {
    const std::size_t collapsed = coarsen(mesh, options, progress);
    const Pairs crossing =
        self_intersections(mesh, find_face_changes(fine, mesh).made, {}, progress);
    if (crossing.empty() || round == kCoarsenRounds) {
      report.collapsed_edges += collapsed;
      return faces_of_pairs(crossing);
    }
    mark_around(mesh, crossing, fine.positions, options.is_kept);
    mesh = fine;
  }
}

/// Takes fits back where faces crossed. @return faces that still do
std::vector<std::uint32_t> fit_cleanly(TriangleMesh& mesh, std::vector<Vec3> points,
                                       const FitFacesOptions& options, FinishReport& report,
                                       const Progress& progress) {
  const std::vector<Vec3> positions = mesh.positions;
  fit_faces(mesh, std::move(points), options, progress);
  const UntangleReport untangled = take_back_crossing(mesh, positions, progress);
  report.untangled_pairs += untangled.crossed;
  return faces_of_pairs(untangled.left);
}

/// The faces to the points, if these have hardly any noise. After all that would undo it.
void fit_to_points(TriangleMesh& mesh, const PointGrid& cloud, const FinishOptions& options,
                   FinishReport& report, const Progress& progress) {
  if (!are_points_exact(report.noise, options.pixel_size, options)) return;
  const auto left = fit_cleanly(mesh, cloud.points(kMostPoints * mesh.triangles.size()),
                                {.reach = options.pixel_size}, report, progress);
  separate(mesh, left, cloud, options, report, progress);
}

/// As few triangles as are asked for, where they are nearest to the cloud.
void coarsen_to_cloud(TriangleMesh& mesh, const PointGrid& cloud, const FinishOptions& options,
                      FinishReport& report, const Progress& progress) {
  const std::size_t before = mesh.triangles.size();
  CoarsenOptions coarse{.triangles = options.triangles};
  if (options.triangles == 0)
    coarse.tolerance = kMeanOfTolerance * options.flat_tolerance * options.pixel_size;
  std::vector<std::uint32_t> left = coarsen_cleanly(mesh, coarse, report, progress);
  remove_unused_vertices(mesh);
  const std::size_t after = mesh.triangles.size();
  const double edge =
      options.pixel_size * std::sqrt(static_cast<double>(before) / static_cast<double>(after));
  if (are_points_exact(report.noise, edge, options)) {
    left = fit_cleanly(
        mesh, cloud.points(kMostPoints * after),
        {.reach = edge, .small_angle = kCoarseSmallAngle, .hold = kCoarseHold, .median_angle = 0.0},
        report, progress);
  }
  separate(mesh, left, cloud, options, report, progress);
  mend_slivers(mesh, cloud, options, report, progress);
}

void extend(TriangleMesh& mesh, const PointGrid& cloud, double smallest_angle,
            const FinishOptions& options, FinishReport& report, const Progress& progress) {
  const ExtendBorderReport extended = extend_border(mesh, cloud,
                                                    {.pixel_size = options.pixel_size,
                                                     .min_component = options.min_component,
                                                     .smallest_angle = smallest_angle},
                                                    progress);
  report.border_steps += extended.steps;
  report.dropped_components += extended.dropped.components;
  report.dropped_faces += extended.dropped.faces;
}

/// Well-shaped triangles on the surface of the cloud. @return RemeshReport::edge
double remesh_on_cloud(TriangleMesh& mesh, const PointGrid& cloud, const PointGrid& surface,
                       const RemeshOptions& options, FinishReport& report,
                       const Progress& progress) {
  sort_along_curve(mesh);
  const RemeshReport remeshed = remesh(mesh, cloud, surface, options, progress);
  report.split_edges = remeshed.split_edges;
  report.collapsed_edges = remeshed.collapsed_edges;
  report.flipped_edges = remeshed.flipped_edges;
  report.flattened_spikes = remeshed.flattened_spikes;
  remove_unused_vertices(mesh);
  sort_along_curve(mesh);
  return remeshed.edge;
}

bool is_wide_window(const FitWindow& fit, double pixel_size) {
  return fit.window.radius > kThinnedFrom * pixel_size;
}

Scale scale_for(const TriangleMesh& mesh, const PointGrid& cloud, const FinishOptions& options) {
  const double h = options.pixel_size;
  Scale scale{.fit = choose_fit_window(mesh, cloud, h)};
  FitWindow& fit = scale.fit;
  fit.window.widest = kWidestPerGap * options.gap;
  if (options.gap > 0.0) return scale;  // contours tell nothing of what lies between them
  if (options.follow_density) scale.sizes = local_sizes(mesh, cloud, h, fit.noise);
  fit.radii = is_wide_window(fit, h) ? local_fit_radii(mesh, cloud, fit.window, h) : scale.sizes;
  return scale;
}

/// Better triangles, closer to the cloud, of a mesh that is closed and clean.
void improve(TriangleMesh& mesh, const PointGrid& cloud, const FinishOptions& options,
             FinishReport& report, const Progress& progress) {
  const double h = options.pixel_size;
  const bool is_coarsened = is_to_coarsen(mesh, options);
  Scale scale = scale_for(mesh, cloud, options);
  const FitWindow& fit = scale.fit;
  report.noise = fit.noise;
  report.fit_radius = fit.window.radius;
  const bool is_wide = is_wide_window(fit, h);
  const PointGrid thinned = is_wide ? cloud.thinned(kThinnedParts) : PointGrid({}, Box{}, h);
  const PointGrid& surface = is_wide ? thinned : cloud;
  scale.edge = remesh_on_cloud(mesh, cloud, surface,
                               {.pixel_size = h,
                                .fit = fit,
                                .triangles = is_coarsened ? 0 : options.triangles,
                                .sizes = scale.sizes,
                                .rounds = options.relaxations},
                               report, progress);
  report.unfolded += unfold(mesh, cloud, {h, fit.noise}, progress);
  fit_vertices(mesh, surface, fit, progress);
  separate(mesh, all_faces(mesh), cloud, options, report, progress);
  progress.at("finish", kSharpenShare);
  if (options.snap_features) {
    sharpen(mesh, cloud, {.pixel_size = h, .fit = fit, .sizes = scale.sizes, .edge = scale.edge},
            options, report, progress);
  }
  mend_slivers(mesh, cloud, options, report, progress);
  extend(mesh, cloud, 0.0, options, report, progress);
  report.unfolded += unfold(mesh, cloud, {h, fit.noise}, progress);
  progress.at("finish", kFitShare);
  if (mesh.empty()) return;  // all of it was a scrap
  if (is_coarsened) {
    coarsen_to_cloud(mesh, cloud, options, report, progress);
  } else {
    if (relax_border(mesh, surface, fit, progress))
      extend(mesh, cloud, 0.0, options, report, progress);
    fit_to_points(mesh, cloud, options, report, progress);
    report.small_angles = mend_small_angles(mesh, cloud, h, progress).left;
    extend(mesh, cloud, kSmallAngle, options, report, progress);  // to what mending left beyond
  }
}

}  // namespace

FinishResult finish(TriangleMesh mesh, const SeenPoints& cloud, const FinishOptions& options,
                    const Progress& progress) {
  check(options);
  FinishResult result;
  if (mesh.empty()) return result;
  check_range("finish: triangles", static_cast<double>(options.triangles), 0.0,
              static_cast<double>(kMostFiner * mesh.triangles.size()));
  progress.at("finish", 0.0);
  const double h = options.pixel_size;
  std::optional<TriangleMesh> given;
  if (options.is_clean) given = geometry_of(mesh);
  PointGrid points(cloud.points, widened(bounds_of(mesh), kRegionMargin * h), kPointCell * h);
  clean_topology(mesh);
  result.report.turned_pieces = orient_pieces(mesh, h);
  progress.check_stop();
  if (result.report.turned_pieces > 0) close_joints(mesh, points, options, result.report, progress);
  if (!cloud.votes.empty()) result.report.papered_faces += drop_faces_in_air(mesh, points, h);
  progress.check_stop();
  result.report.papered_faces += drop_papered_faces(mesh, points, cloud, h);
  progress.check_stop();
  if (!cloud.votes.empty())
    result.report.papered_faces += drop_air_bridges(mesh, points, h, options.min_component);
  progress.at("finish", kGrowShare);
  const TriangleMesh before = without_small_pieces(mesh, options);
  grow_in_one(mesh, {given ? &*given : nullptr, cloud, points, options, progress}, result.report);
  given.reset();
  progress.at("finish", kHandlesShare);
  remove_thin_handles(mesh, points, options, result.report, progress);
  take_back_vanished(mesh, before, points, h, progress);
  zip_open_loops(mesh, points, options, result.report, progress);
  if (options.max_hole_perimeter == 0.0)
    result.report.papered_faces += drop_papered_faces(mesh, points, cloud, h, kSmallPerimeter * h);
  progress.at("finish", kImproveShare);
  if (options.method == FinishMethod::full && !mesh.empty()) {
    if (options.gap == 0.0) tell_sides(points, mesh, h);  // contours are too far apart for that
    improve(mesh, points, options, result.report, progress);
  }
  remove_unused_vertices(mesh);
  result.report.open_loops = count_loops(mesh);
  result.mesh = std::move(mesh);
  progress.at("finish", 1.0);
  return result;
}

}  // namespace rangezip

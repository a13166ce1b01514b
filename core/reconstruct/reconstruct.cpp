#include "core/reconstruct/reconstruct.h"

#include <algorithm>
#include <cmath>
#include <optional>
#include <string>
#include <utility>
#include <variant>

#include "core/base/check_number.h"
#include "core/base/error.h"
#include "core/base/parallel.h"
#include "core/base/progress_part.h"
#include "core/base/spread.h"
#include "core/finish/left_out_points.h"
#include "core/finish/regrow.h"
#include "core/mesh/self_intersection.h"
#include "core/plan/open_sheet.h"
#include "core/plan/outer_samples.h"
#include "core/plan/spacing.h"
#include "core/plan/view_planner.h"
#include "core/reconstruct/dense_places.h"
#include "core/reconstruct/lost_points.h"
#include "core/reconstruct/papered_holes.h"
#include "core/reconstruct/repeat_until_count_fits.h"
#include "core/reconstruct/resolution.h"
#include "core/reconstruct/scan_recipe.h"
#include "core/reconstruct/stage_clock.h"

namespace rangezip {

namespace {

constexpr int kFillRounds = 2;
constexpr int kFillViewsPerRound = 6;
/// Rounds of views of what is uncovered, as long as each leaves less than so much of it.
constexpr int kCoverRounds = 12;
constexpr int kCoverViewsPerRound = 12;
constexpr double kWorthwhile = 0.9;
/// Those of narrow gaps: faces across them that had to go come back with every round.
constexpr int kNarrowRounds = 2;
/// In h: the pixels of those views of narrow gaps, which h does not resolve.
constexpr double kCoverPixel = 0.5;
/// Rounds of views of papered holes; the second sees what the first left out, so many h away.
constexpr int kHoleRounds = 2;
constexpr double kLeftOutOfHole = 0.4;
constexpr double kMinNewInHoles = 30;          ///< points that such a view must add
constexpr std::size_t kHoleSamples = 200'000;  ///< drawn to plan them: what hides a place is large
/// In h: around a place so much more is scanned than was erased.
constexpr double kRescanMargin = 1.0;
/// In h: so far around what a re-scan has lost it is scanned as before, in so many rounds.
constexpr double kRecoverRadius = 2.0;
constexpr int kRecoverRounds = 2;
constexpr double kMinRecovered = 4;   ///< points that such a view must add
constexpr double kMinNewPoints = 40;  ///< that a view must add: fewer are a few pixels
/// Of the samples: less is left out by noise and in the pockets of real scans, where more views
/// make handles rather than surface.
constexpr double kUncoveredShare = 0.01;
constexpr double kUncoveredShareIfClean = 0.002;  ///< less is left to regrow()
/// Of the samples: of narrow gaps more is left out, whatever the views, than of deep pockets.
constexpr double kNarrowShare = 0.03;
constexpr std::size_t kJudgedSamples = 100'000;
constexpr std::size_t kCoverSamples = 2'000'000;  ///< drawn to plan views of what is uncovered
constexpr double kMinFillLoop = 6.0;          ///< pixel sides; shorter loops are left to the finish
constexpr std::size_t kMinPieceOfSheet = 12;  ///< faces: much of an open sheet lies apart
constexpr std::size_t kAreaSamples = 400'000;  ///< of polygons at most, to plan and to judge by

/// The share of the whole run at which each stage begins, from measured runs.
constexpr double kPlanShare = 0.02;
constexpr double kScanShare = 0.15;
constexpr double kFillShare = 0.40;
constexpr double kFinishShare = 0.50;
constexpr double kShareOfRest = 0.1;
constexpr double kCheckShare = 0.95;

void check_options(const Scene& scene, const ReconstructOptions& options) {
  if (scene.empty()) throw InvalidArgument("reconstruct: the scene must not be empty");
  if (options.views && *options.views < 1) {
    throw InvalidArgument("reconstruct: views must be at least 1, got " +
                          std::to_string(*options.views));
  }
  if (options.threads < 0) {
    throw InvalidArgument("reconstruct: threads must not be negative, got " +
                          std::to_string(options.threads));
  }
  check_not_negative("reconstruct: close_holes", options.close_holes);
  check_not_negative("reconstruct: decimate", options.decimate.value_or(0.0));
}

/// One automatic run. Every change to the mesh is a command of a Session, so the run can be
/// replayed; this class only decides which commands.
class Run {
 public:
  /// @param excess see choose_resolution()
  Run(const Scene& scene, Rasterizer& rasterizer, const ReconstructOptions& options, double excess,
      const Progress& progress)
      : scene_(scene),
        rasterizer_(rasterizer),
        options_(options),
        excess_(excess),
        progress_(progress),
        session_(scene, SessionOptions{.history_bytes = 0}) {}

  ReconstructResult result() {
    choose_resolution_and_views();
    scan_planned_views();
    scan_uncovered();
    scan_fill_views();
    rescan_dense_places();
    rescan_papered_holes();
    drop_unsupported_in_gaps();
    finish_mesh();
    check_result();
    return std::move(result_);
  }

 private:
  void apply(Command command, const Progress& progress) {
    const std::size_t number = result_.commands.size();
    if (std::holds_alternative<AddScan>(command)) result_.report.view_commands.push_back(number);
    if (std::holds_alternative<FinishMesh>(command)) result_.report.finish_command = number;
    result_.report.commands.push_back(session_.apply(command, rasterizer_, progress));
    result_.commands.push_back(std::move(command));
  }

  /// The points, then so many places on the polygons.
  void take_samples(std::size_t on_polygons) {
    samples_ = scene_.points();
    const std::vector<Vec3> places = area_samples(scene_, on_polygons);
    samples_.insert(samples_.end(), places.begin(), places.end());
  }

  void choose_resolution_and_views() {
    progress_.at("resolution", 0.0);
    take_samples(kAreaSamples);
    const bool is_finished_whole = options_.finish == FinishMethod::full;
    const Resolution resolution = choose_resolution(scene_, samples_, options_.pixel_size,
                                                    options_.triangles, is_finished_whole, excess_);
    recipe_ = {.method = options_.method,
               .bounds = resolution.bounds,
               .pixel_size = resolution.pixel_size,
               .vote_pixel_size = std::max(resolution.pixel_size, resolution.gap),
               .point_size = resolution.point_size,
               .gap = resolution.gap,
               .decimate = is_finished_whole ? std::nullopt : options_.decimate,
               .has_points = scene_.point_count() > 0};
    const std::span points = std::span(samples_).first(scene_.point_count());
    if (recipe_.has_points) recipe_.one_sided = is_open_sheet(rasterizer_, points);
    noise_ = resolution.noise;
    follows_density_ = resolution.follows_density;
    is_sparse_ = resolution.spacing > kSparseSpacing * recipe_.pixel_size &&
                 resolution.spacing <= kVerySparseSpacing * recipe_.pixel_size;
    is_clean_ = resolution.noise <= kMaxHoleNoise * recipe_.pixel_size;
    result_.report.pixel_size = recipe_.pixel_size;
    const std::size_t wanted = area_sample_count(scene_, recipe_.pixel_size);
    if (2 * wanted < kAreaSamples) take_samples(wanted);  // of much larger pixels than usual
    book("resolution");

    ViewPlanOptions plan_options{.one_sided = recipe_.one_sided};
    if (options_.views) plan_options.max_views = *options_.views;
    const ViewPlan plan = plan_views(rasterizer_, samples_, recipe_.pixel_size, plan_options,
                                     part_of(progress_, "plan views", kPlanShare, kScanShare));
    result_.report.views = plan.directions;
    result_.report.planned_views = plan.directions.size();
    if (!plan.coverage.empty()) result_.report.planned_coverage = plan.coverage.back();
    book("plan views");
  }

  void scan_planned_views() {
    const std::size_t count = result_.report.planned_views;
    for (std::size_t view = 0; view < count; ++view) {
      const double step = (kFillShare - kScanShare) / static_cast<double>(count);
      const double begin = kScanShare + step * static_cast<double>(view);
      apply(planned_scan(recipe_, result_.report.views[view], static_cast<std::uint32_t>(view)),
            part_of(progress_, "scan", begin, begin + step));
    }
    book("scan");
  }

  /// Samples of places farther from the mesh than a pixel side, out of kJudgedSamples.
  [[nodiscard]] std::vector<Vec3> uncovered_samples() const {
    std::vector<Vec3> chosen;
    for (const std::size_t index : spread_indices(samples_.size(), kJudgedSamples))
      chosen.push_back(samples_[index]);
    return left_out_points(chosen, *session_.mesh(), recipe_.pixel_size);
  }

  [[nodiscard]] double share_of(const std::vector<Vec3>& uncovered) const {
    return static_cast<double>(uncovered.size()) /
           static_cast<double>(std::min(samples_.size(), kJudgedSamples));
  }

  /// The plan was made for a part of the points in small images: what it overlooked, deep pockets
  /// and the walls of drilled holes above all, is looked for again with the points that are left.
  /// What these views do not reach either lies in narrow gaps, which need finer pixels. Not where
  /// the caller has said how many views there are to be.
  void scan_uncovered() {
    if (options_.views) return;
    std::vector<Vec3> uncovered = uncovered_samples();
    const double least_share = is_clean_ ? kUncoveredShareIfClean : kUncoveredShare;
    for (int round = 0; round < kCoverRounds && share_of(uncovered) >= least_share; ++round) {
      const double before = share_of(uncovered);
      if (!scan_points(uncovered, recipe_)) break;
      uncovered = uncovered_samples();
      if (share_of(uncovered) > kWorthwhile * before) break;
    }
    // Where contours lie apart every face is far from points, and none across a gap can be told.
    has_narrow_gaps_ = share_of(uncovered) >= kNarrowShare && recipe_.gap == 0.0;
    // Of polygons that may lie inside, where nothing is to grow.
    has_inside_ = has_narrow_gaps_ && scene_.triangle_count() > 0 &&
                  !are_outer(outer_samples(scene_, uncovered, progress_));
    if (has_narrow_gaps_) scan_narrow_gaps();
    book("uncovered");
  }

  void scan_narrow_gaps() {
    ScanRecipe recipe = recipe_;
    recipe.pixel_size = recipe.vote_pixel_size = kCoverPixel * recipe_.pixel_size;
    for (int round = 0; round < kNarrowRounds; ++round) {
      drop_unsupported();
      const std::vector<Vec3> uncovered = uncovered_samples();
      if (share_of(uncovered) < kUncoveredShare || !scan_points(uncovered, recipe)) break;
    }
  }

  /// @return whether there are views that show points of them
  bool scan_points(const std::vector<Vec3>& points, const ScanRecipe& recipe) {
    const std::vector<Vec3> directions = views_of(points, recipe, kCoverSamples, kMinNewPoints);
    scan_from(directions, recipe, fill_scan);
    return !directions.empty();
  }

  void drop_unsupported_in_gaps() {
    if (has_narrow_gaps_) drop_unsupported();
    book("unsupported");
  }

  /// Faces across gaps hide what lies in them, make handles, and join what is apart.
  void drop_unsupported() {
    apply(DropUnsupported{.pixel_size = recipe_.pixel_size},
          part_of(progress_, "fill views", fill_share_, fill_share_));
  }

  void scan_fill_views() {
    for (int round = 0; round < kFillRounds; ++round) {
      const std::vector<Vec3> directions =
          plan_fill_views(*session_.mesh(), kMinFillLoop * recipe_.pixel_size, kFillViewsPerRound);
      if (directions.empty()) break;
      scan_from(directions, recipe_, fill_scan);
    }
    book("fill views");
  }

  [[nodiscard]] bool is_plain_cloud() const {
    return scene_.triangle_count() == 0 && recipe_.gap == 0.0;
  }

  [[nodiscard]] bool may_add_views() const {
    return !options_.views && options_.method == ReconstructMethod::automatic;
  }

  /// Whether it is left to the cloud how fine scans are.
  [[nodiscard]] bool follows_density() const { return follows_density_ && is_plain_cloud(); }

  /// Where the cloud is denser, finer pixels [Kobbelt, Botsch 2000, Fig. 3]. What scans with the
  /// usual pixels made there goes first: it spans gaps that finer ones see through.
  void rescan_dense_places() {
    if (!follows_density()) return;
    const DensePlaces dense =
        find_dense_places(samples_, *session_.mesh(), recipe_.pixel_size, noise_);
    if (!dense.places.empty()) {
      const std::vector<Vec3> uncovered = uncovered_samples();
      const ScanRecipe recipe = erase_for_rescan(dense.places, dense.pixel_size);
      ViewPlanOptions plan_options;
      if (options_.views) plan_options.max_views = *options_.views;
      const ViewPlan plan =
          plan_views_of(rasterizer_, samples_, dense.points, recipe.pixel_size, plan_options,
                        part_of(progress_, "fill views", fill_share_, fill_share_));
      scan_from(plan.directions, recipe, planned_scan);
      const std::vector<Vec3> targets =
          left_out_points(dense.points, *session_.mesh(), recipe.pixel_size);
      if (may_add_views() && !targets.empty())
        scan_from(views_of(targets, recipe, kCoverSamples, kMinNewPoints), recipe, fill_scan);
      recover(uncovered, dense.places);
    }
    book("dense places");
  }

  /// Where scans have papered over holes, the mesh goes, and the places are scanned again with
  /// finer pixels. Last, since scans with the usual pixels would close the holes again. Where
  /// points are sparse, finer pixels see through walls, and the places are left to regrow() in the
  /// finish; but not beside narrow gaps, where the rim of a wall may be a gap's, and stays open.
  void rescan_papered_holes() {
    if (!may_add_views() || !is_plain_cloud() || !is_clean_) return;
    const double h = recipe_.pixel_size;
    std::optional<PaperedHoles> for_fronts;
    if (is_sparse_ && !has_narrow_gaps_ && options_.finish)
      for_fronts = find_holes_for_fronts(samples_, *session_.mesh(), h);
    const PaperedHoles holes =
        for_fronts ? std::move(*for_fronts)
                   : find_papered_holes(samples_, *session_.mesh(), {.pixel_size = h});
    if (holes.places.empty()) return;
    const std::vector<Vec3> uncovered = uncovered_samples();
    const ScanRecipe recipe = erase_for_rescan(holes.places, kCoverPixel * h);
    if (!for_fronts) scan_holes(holes, recipe, uncovered);
    book("papered holes");
  }

  /// @param uncovered uncovered_samples() before the mesh was taken off
  void scan_holes(const PaperedHoles& holes, const ScanRecipe& recipe,
                  const std::vector<Vec3>& uncovered) {
    std::vector<Vec3> targets = holes.points;
    for (int round = 0; round < kHoleRounds && !targets.empty(); ++round) {
      scan_from(views_of(targets, recipe, kHoleSamples, kMinNewInHoles), recipe, fill_scan);
      targets =
          left_out_points(holes.points, *session_.mesh(), kLeftOutOfHole * recipe_.pixel_size);
    }
    recover(uncovered, holes.places);
  }

  /// Takes the mesh off these places. @return how they are scanned again
  ScanRecipe erase_for_rescan(const std::vector<Sphere>& places, double pixel_size) {
    apply(ErasePlaces{places}, part_of(progress_, "fill views", fill_share_, fill_share_));
    ScanRecipe recipe = recipe_;
    recipe.pixel_size = pixel_size;
    recipe.places = places;
    for (Sphere& place : recipe.places)
      place.radius += kRescanMargin * recipe_.pixel_size;
    return recipe;
  }

  /// If finer pixels have found less than they took off, it is scanned with the usual ones again
  /// where they have lost much. Not elsewhere, nor where there are narrow gaps: these would be
  /// closed again.
  /// @param before uncovered_samples() before the mesh was taken off
  void recover(const std::vector<Vec3>& before, const std::vector<Sphere>& places) {
    if (!may_add_views() || has_narrow_gaps_) return;
    for (int round = 0; round < kRecoverRounds; ++round) {
      const std::vector<Vec3> after = uncovered_samples();
      if (after.size() <= before.size()) return;
      const std::vector<Vec3> lost = lost_points(places, before, after);
      if (lost.empty()) return;
      ScanRecipe recipe = recipe_;
      for (const Vec3& point : lost)
        recipe.places.push_back({point, kRecoverRadius * recipe_.pixel_size});
      scan_from(views_of(lost, recipe, kCoverSamples, kMinRecovered), recipe, fill_scan);
    }
  }

  /// Directions from which points are seen that the mesh leaves out.
  [[nodiscard]] std::vector<Vec3> views_of(const std::vector<Vec3>& targets,
                                           const ScanRecipe& recipe, std::size_t drawn,
                                           double min_new) {
    const ViewPlanOptions options{.max_views = kCoverViewsPerRound,
                                  .subset = drawn,
                                  .max_slope_cosine = kCosine75Degrees,
                                  .coverage = 1.0,
                                  .min_gain = min_new / static_cast<double>(targets.size()),
                                  .views_for_quality = 0};
    return plan_views_of(rasterizer_, samples_, targets, recipe.pixel_size, options,
                         part_of(progress_, "fill views", fill_share_, fill_share_))
        .directions;
  }

  using MakeScan = AddScan (*)(const ScanRecipe&, const Vec3&, std::uint32_t);

  /// Scans of an open sheet stay on the side of the first one.
  void scan_from(std::span<const Vec3> directions, const ScanRecipe& recipe, MakeScan make_scan) {
    for (const Vec3& direction : directions) {
      if (recipe_.one_sided && !(glm::dot(direction, result_.report.views[0]) > 0.0)) continue;
      const auto view = static_cast<std::uint32_t>(result_.report.views.size());
      // How many more there will be is not known: each takes a part of what is left.
      const double end = fill_share_ + kShareOfRest * (kFinishShare - fill_share_);
      apply(make_scan(recipe, direction, view), part_of(progress_, "fill views", fill_share_, end));
      fill_share_ = end;
      result_.report.views.push_back(direction);
    }
  }

  /// What tells faces across the air. Between contours all faces are.
  [[nodiscard]] std::optional<VoteOptions> vote_on_faces() const {
    return recipe_.gap == 0.0 ? vote_of(recipe_) : std::nullopt;
  }

  void finish_mesh() {
    if (options_.finish) {
      FinishMesh command;
      command.options.method = *options_.finish;
      command.options.pixel_size = recipe_.pixel_size;
      command.options.triangles = options_.triangles.value_or(0);
      command.options.flat_tolerance = options_.decimate.value_or(0.0);
      command.options.max_hole_perimeter = options_.close_holes;
      command.options.gap = recipe_.gap;
      command.options.narrow_gaps = has_narrow_gaps_;
      command.options.open_sheet = recipe_.one_sided;
      if (recipe_.one_sided) command.options.min_component = kMinPieceOfSheet;
      command.options.is_clean = true;  // every stitch was checked
      command.options.regrow = is_plain_cloud() || (scene_.point_count() == 0 && !has_inside_);
      command.options.follow_density = follows_density();
      command.options.snap_features = recipe_.gap == 0.0;  // between contours a bend looks sharp
      command.vote = vote_on_faces();
      apply(command, part_of(progress_, "finish", kFinishShare, kCheckShare));
    }
    book("finish");
  }

  void check_result() {
    progress_.at("check", kCheckShare);
    const auto outwards = session_.mesh();  // as the votes, and what is judged by them
    ReconstructReport& report = result_.report;
    if (!options_.scanners.empty()) {
      apply(TurnToScanners{options_.scanners}, part_of(progress_, kCheckShare, kCheckShare));
      report.turned_components = report.commands.back().turned_components;
    }
    const auto mesh = session_.mesh();
    SeenPoints seen{.points = samples_};
    if (const auto vote = vote_on_faces()) seen.votes = session_.votes(rasterizer_, *vote);
    run_side_by_side(
        [&] { report.self_intersections = self_intersections(*mesh, progress_).size(); },
        [&] {
          report.mesh = report_mesh(*mesh, progress_);
          report.coverage = report_coverage(seen, *outwards, recipe_.pixel_size);
          result_.mesh = *mesh;
        });
    book("check");
  }

  /// Books the time since the stage before.
  void book(const char* stage) {
    result_.report.stages.push_back(clock_.stage(stage));
    clock_ = StageClock();
  }

  const Scene& scene_;
  Rasterizer& rasterizer_;
  const ReconstructOptions& options_;
  double excess_;
  const Progress& progress_;
  ReconstructResult result_;
  StageClock clock_;
  Session session_;
  ScanRecipe recipe_;
  double noise_ = 0.0;              ///< of the points, model units
  bool follows_density_ = false;    ///< of the resolution
  bool is_sparse_ = false;          ///< the points: finer pixels see through, fronts grow over
  bool is_clean_ = true;            ///< enough to scan papered holes again
  double fill_share_ = kFillShare;  ///< of the progress, so far
  bool has_inside_ = false;         ///< polygons that no view reaches within others
  bool has_narrow_gaps_ = false;    ///< that the planned views did not reach
  std::vector<Vec3> samples_;       ///< points, then area samples of polygons
};

}  // namespace

ReconstructResult reconstruct(const Scene& scene, Rasterizer& rasterizer,
                              const ReconstructOptions& options, const Progress& progress) {
  check_options(scene, options);
  ReconstructResult result;
  const bool is_sized_by_pixels = options.triangles && options.finish != FinishMethod::full;
  run_with_threads(options.threads, [&] {
    const auto run = [&](double excess, const Progress& part) {
      return Run(scene, rasterizer, options, excess, part).result();
    };
    result = is_sized_by_pixels ? repeat_until_count_fits(run, *options.triangles, progress)
                                : run(1.0, progress);
  });
  progress.at("done", 1.0);
  return result;
}

}  // namespace rangezip

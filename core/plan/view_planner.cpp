#include "core/plan/view_planner.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <limits>
#include <numeric>
#include <string>

#include "core/base/check_number.h"
#include "core/base/error.h"
#include "core/base/parallel.h"
#include "core/base/spread.h"
#include "core/plan/directions.h"
#include "core/plan/front_sheet.h"
#include "core/plan/spacing.h"

namespace rangezip {

namespace {

/// How well a view samples a point: 0 not at all, else from kBarelySeen to 255 straight on.
using Quality = std::uint8_t;
constexpr double kBarelySeen = 40.0;
constexpr double kBestQuality = 255.0;

/// What is drawn and what is to be seen of it, floats about a local origin, and the small images
/// in which visibility is decided.
struct Subset {
  std::vector<Vec3f> positions;
  std::vector<Vec3f> targets;
  Mat4 world_from_item{1.0};
  Box bounds;
  double pixel_size = 0.0;
};

void check_arguments(std::span<const Vec3> points, std::span<const Vec3> targets, double pixel_size,
                     const ViewPlanOptions& options) {
  if (points.empty()) throw InvalidArgument("plan_views: points must not be empty");
  if (targets.empty()) throw InvalidArgument("plan_views: targets must not be empty");
  check_positive("plan_views: pixel_size", pixel_size);
  if (options.max_views < 1) {
    throw InvalidArgument("plan_views: max_views must be at least 1, got " +
                          std::to_string(options.max_views));
  }
  if (options.candidates < 1) {
    throw InvalidArgument("plan_views: candidates must be at least 1, got " +
                          std::to_string(options.candidates));
  }
  if (options.views_for_quality < 0) {
    throw InvalidArgument("plan_views: views_for_quality must not be negative, got " +
                          std::to_string(options.views_for_quality));
  }
  if (options.subset < 1) throw InvalidArgument("plan_views: subset must be at least 1, got 0");
  if (!(options.max_slope_cosine > 0.0 && options.max_slope_cosine < 1.0)) {
    throw InvalidArgument("plan_views: max_slope_cosine must lie in (0, 1), got " +
                          std::to_string(options.max_slope_cosine));
  }
}

/// Pixels that the subset covers without gaps, and no finer than those of the scans.
double planning_pixel_size(std::span<const Vec3> subset, double pixel_size) {
  constexpr std::size_t kFewestForSpacing = 100;
  if (subset.size() < kFewestForSpacing) return pixel_size;
  return std::max(pixel_size, closed_sheet_pixel_size(estimate_spacing(subset)));
}

/// Those in the box, which outliers are not: they need not be seen.
std::vector<Vec3> inside(const Box& box, std::span<const Vec3> points) {
  std::vector<Vec3> chosen;
  for (const Vec3& p : points) {
    Box with_point = box;
    with_point.add(p);
    if (with_point == box) chosen.push_back(p);
  }
  return chosen;
}

std::vector<Vec3f> about(const Vec3& origin, std::span<const Vec3> points) {
  std::vector<Vec3f> local;
  local.reserve(points.size());
  for (const Vec3& p : points)
    local.emplace_back(p - origin);
  return local;
}

std::vector<Vec3> spread_points(std::span<const Vec3> points, std::size_t wanted) {
  std::vector<Vec3> chosen;
  for (const std::size_t index : spread_indices(points.size(), wanted))
    chosen.push_back(points[index]);
  return chosen;
}

/// What is to be seen is what is drawn.
Subset choose_subset(std::span<const Vec3> points, double pixel_size, std::size_t wanted) {
  Subset subset;
  subset.bounds = robust_bounds(points);
  const Vec3 origin = subset.bounds.center();
  subset.world_from_item[3] = Vec4(origin, 1.0);
  const std::vector<Vec3> chosen = inside(subset.bounds, spread_points(points, wanted));
  subset.pixel_size = planning_pixel_size(chosen, pixel_size);
  subset.positions = about(origin, chosen);
  subset.targets = subset.positions;
  return subset;
}

std::vector<Vec3> candidate_directions(int count) {
  std::vector<Vec3> directions = sphere_directions(count);
  for (const Vec3& axis : {Vec3{1, 0, 0}, Vec3{0, 1, 0}, Vec3{0, 0, 1}}) {
    directions.push_back(axis);
    directions.push_back(-axis);
  }
  return directions;
}

/// The slope of the front sheet along one image axis, depth per pixel side. A silhouette on one
/// side does not count as slope.
float slope_between(float before, float here, float after) {
  constexpr float kUnknownSlope = 4.0F;  // 76 degrees: too steep to be seen well
  constexpr float kSilhouette = 4.0F;
  constexpr float kNone = std::numeric_limits<float>::infinity();
  const float to_before = std::abs(here - before);
  const float to_after = std::abs(after - here);
  if (before == kNone && after == kNone) return kUnknownSlope;
  if (before == kNone) return to_after;
  if (after == kNone) return to_before;
  if (std::max(to_before, to_after) > kSilhouette) return std::min(to_before, to_after);
  return 0.5F * std::abs(after - before);
}

/// A pixel's verdict on the points that fall into it.
struct PixelVerdict {
  float limit = -std::numeric_limits<float>::infinity();  ///< deepest that is seen, depth units
  Quality quality = 0;
};

/// Judges each pixel of a front sheet by its depth and tilt.
std::vector<PixelVerdict> judge_pixels(const Grid<std::uint32_t>& depth, float units_per_side,
                                       double max_slope_cosine) {
  // A point of the sheet lies behind the nearest one in its pixel by up to a pixel's slope.
  constexpr float kFlatDepth = 0.7F;
  constexpr float kDepthPerSlope = 0.8F;
  const auto width = static_cast<std::size_t>(depth.extent().width);
  const auto height = static_cast<std::size_t>(depth.extent().height);
  const std::span<const std::uint32_t> units = depth.pixels();
  const auto depth_at = [&](std::size_t pixel) {
    return units[pixel] == kNoDepth ? std::numeric_limits<float>::infinity()
                                    : static_cast<float>(units[pixel]) / units_per_side;
  };
  const double cosine_range = 1.0 - max_slope_cosine;

  std::vector<PixelVerdict> verdicts(units.size());
  for (std::size_t y = 1; y + 1 < height; ++y) {
    for (std::size_t x = 1; x + 1 < width; ++x) {
      const std::size_t pixel = y * width + x;
      if (units[pixel] == kNoDepth) continue;
      const float here = depth_at(pixel);
      const float slope_x = slope_between(depth_at(pixel - 1), here, depth_at(pixel + 1));
      const float slope_y = slope_between(depth_at(pixel - width), here, depth_at(pixel + width));
      const float slope = std::sqrt(slope_x * slope_x + slope_y * slope_y);
      const double cosine = 1.0 / std::sqrt(1.0 + static_cast<double>(slope) * slope);
      const double quality = (cosine - max_slope_cosine) / cosine_range;
      if (!(quality > 0.0)) continue;
      verdicts[pixel] = {
          (here + kFlatDepth + kDepthPerSlope * slope) * units_per_side,
          static_cast<Quality>(kBarelySeen + (kBestQuality - kBarelySeen) * quality)};
    }
  }
  return verdicts;
}

/// How well the view that drew `depth` samples each target.
std::vector<Quality> judge_points(const Subset& subset, const View& view,
                                  Grid<std::uint32_t>& depth, double max_slope_cosine) {
  constexpr double kSeeThroughDepth = 2.5;  // pixel sides
  const double units_per_side = subset.pixel_size * depth_units_per_length(view);
  close_front_sheet(depth, static_cast<std::uint32_t>(kSeeThroughDepth * units_per_side));
  const std::vector<PixelVerdict> verdicts =
      judge_pixels(depth, static_cast<float>(units_per_side), max_slope_cosine);

  const PointProjector project(view, subset.world_from_item);
  std::vector<Quality> qualities(subset.targets.size(), 0);
  for (std::size_t i = 0; i < qualities.size(); ++i) {
    const PointProjector::Place place = project(subset.targets[i]);
    if (place.pixel == PointProjector::kOutside) continue;
    const PixelVerdict& verdict = verdicts[place.pixel];
    if (place.depth <= verdict.limit) qualities[i] = verdict.quality;
  }
  return qualities;
}

/// qualities[candidate][point]. Drawing goes one by one, since there is one rasterizer; judging
/// goes in parallel.
std::vector<std::vector<Quality>> judge_candidates(Rasterizer& rasterizer, const Subset& subset,
                                                   std::span<const Vec3> directions,
                                                   const ViewPlanOptions& options,
                                                   const Progress& progress) {
  constexpr std::size_t kBatch = 16;
  constexpr int kMargin = 2;            // pixels: a slope needs neighbours
  constexpr double kGreedyShare = 0.1;  // of the planner's time
  const std::array<DrawItem, 1> items{
      DrawPoints{.positions = subset.positions, .world_from_item = subset.world_from_item}};
  std::vector<std::vector<Quality>> qualities(directions.size());
  std::array<Framebuffer, kBatch> buffers;
  for (std::size_t begin = 0; begin < directions.size(); begin += kBatch) {
    progress.at("plan views", (1.0 - kGreedyShare) * static_cast<double>(begin) /
                                  static_cast<double>(directions.size()));
    const std::size_t count = std::min(kBatch, directions.size() - begin);
    std::vector<View> views;
    for (std::size_t i = 0; i < count; ++i) {
      FramedCamera framed =
          frame_box(subset.bounds, directions[begin + i], subset.pixel_size, kMargin);
      views.emplace_back(std::move(framed.camera), framed.extent);
      rasterizer.render(views.back(), items, buffers[i]);
    }
    parallel_for(count, 1, [&](std::size_t first, std::size_t last) {
      for (std::size_t i = first; i < last; ++i) {
        qualities[begin + i] =
            judge_points(subset, views[i], buffers[i].depth, options.max_slope_cosine);
      }
    });
  }
  return qualities;
}

/// What a view is worth, in a fixed unit: for points not yet seen their quality and a bonus, for
/// seen ones a share of the improvement.
struct Worth {
  std::int64_t per_unseen = 20;
  std::int64_t per_improvement = 7;

  friend bool operator==(const Worth&, const Worth&) = default;
};
constexpr Worth kWholeWorth{};
constexpr Worth kCoverageOnly{.per_improvement = 0};

std::int64_t worth_of(std::span<const Quality> view, std::span<const Quality> best,
                      const Worth& worth) {
  constexpr std::int64_t kUnseenBonus = 60;
  std::int64_t unseen = 0;
  std::int64_t improvement = 0;
  for (std::size_t i = 0; i < view.size(); ++i) {
    const int gain = view[i] - best[i];
    if (gain <= 0) continue;
    (best[i] == 0 ? unseen : improvement) += gain + (best[i] == 0 ? kUnseenBonus : 0);
  }
  return worth.per_unseen * unseen + worth.per_improvement * improvement;
}

/// Picks views one by one. What a view is worth can only fall as others are taken, so its last
/// known worth is an upper bound, and few views are judged anew for each pick [Minoux 1978]. That
/// holds while `worth` stays or its parts fall from one pick to the next.
class Greedy {
 public:
  Greedy(const std::vector<std::vector<Quality>>& views, std::size_t points)
      : views_(views),
        bounds_(views.size(), std::numeric_limits<std::int64_t>::max()),
        best_(points, 0) {}

  /// Leaves a view out from now on: bounds only fall.
  void exclude(std::size_t view) { bounds_[view] = 0; }

  /// The view of the greatest worth, or views.size() if none is worth anything.
  [[nodiscard]] std::size_t pick(const Worth& worth) {
    std::vector<std::size_t> order(views_.size());
    std::iota(order.begin(), order.end(), std::size_t{0});
    std::stable_sort(order.begin(), order.end(),
                     [&](std::size_t a, std::size_t b) { return bounds_[a] > bounds_[b]; });
    std::int64_t greatest = 0;
    std::size_t picked = views_.size();
    for (const std::size_t view : order) {
      if (bounds_[view] <= greatest) break;
      bounds_[view] = worth_of(views_[view], best_, worth);
      if (bounds_[view] > greatest) {
        greatest = bounds_[view];
        picked = view;
      }
    }
    return picked;
  }

  /// The first view: of those that are worth nearly the most the one from farthest above.
  /// @param one_sided an open sheet, such as a terrain, looks about alike from both sides, and is
  ///     meant to face up (z), even where it is seen somewhat better from below
  [[nodiscard]] std::size_t pick_first(const Worth& worth, std::span<const Vec3> directions,
                                       bool one_sided) {
    constexpr std::int64_t kAlikePercent = 85;
    for (std::size_t view = 0; view < views_.size(); ++view)
      bounds_[view] = worth_of(views_[view], best_, worth);
    const std::size_t best = pick_highest(directions, Vec3(0.0));
    if (!one_sided || best == views_.size() || directions[best].z >= 0.0) return best;
    const std::size_t above = pick_highest(directions, -directions[best]);
    const bool is_alike =
        above != views_.size() && 100 * bounds_[above] >= kAlikePercent * bounds_[best];
    return is_alike ? above : best;
  }

  /// Points that the view sees and none before.
  [[nodiscard]] std::size_t newly_seen(std::size_t view) const {
    std::size_t count = 0;
    for (std::size_t i = 0; i < best_.size(); ++i) {
      count += views_[view][i] > 0 && best_[i] == 0 ? 1 : 0;
    }
    return count;
  }

  void take(std::size_t view) {
    for (std::size_t i = 0; i < best_.size(); ++i) {
      best_[i] = std::max(best_[i], views_[view][i]);
    }
  }

 private:
  /// Of the views from one side that are worth nearly the most of these the one from farthest above
  /// (z); views_.size() if none is worth anything.
  /// @param side less than 90 degrees from it; 0: all
  [[nodiscard]] std::size_t pick_highest(std::span<const Vec3> directions, const Vec3& side) const {
    constexpr std::int64_t kNearlyMostPercent = 95;
    const auto is_of_side = [&](std::size_t view) {
      return side == Vec3(0.0) || glm::dot(directions[view], side) > 0.0;
    };
    std::int64_t greatest = 0;
    for (std::size_t view = 0; view < views_.size(); ++view) {
      if (is_of_side(view)) greatest = std::max(greatest, bounds_[view]);
    }
    std::size_t picked = views_.size();
    for (std::size_t view = 0; view < views_.size() && greatest > 0; ++view) {
      if (!is_of_side(view) || 100 * bounds_[view] < kNearlyMostPercent * greatest) continue;
      if (picked == views_.size() || directions[view].z > directions[picked].z) picked = view;
    }
    return picked;
  }

  const std::vector<std::vector<Quality>>& views_;
  std::vector<std::int64_t> bounds_;
  std::vector<Quality> best_;  ///< of the views taken so far, per point
};

double reachable_share(const std::vector<std::vector<Quality>>& views, std::size_t points) {
  std::vector<Quality> any(points, 0);
  for (const std::vector<Quality>& view : views) {
    for (std::size_t i = 0; i < points; ++i)
      any[i] |= view[i];
  }
  const auto unseen = std::count(any.begin(), any.end(), Quality{0});
  return 1.0 - static_cast<double>(unseen) / static_cast<double>(points);
}

void exclude_other_side(Greedy& greedy, std::span<const Vec3> directions, const Vec3& first) {
  for (std::size_t view = 0; view < directions.size(); ++view) {
    if (!(glm::dot(directions[view], first) > 0.0)) greedy.exclude(view);
  }
}

ViewPlan plan_for(Rasterizer& rasterizer, const Subset& subset, const ViewPlanOptions& options,
                  const Progress& progress) {
  const std::vector<Vec3> directions = candidate_directions(options.candidates);
  const std::vector<std::vector<Quality>> qualities =
      judge_candidates(rasterizer, subset, directions, options, progress);

  const std::size_t count = subset.targets.size();
  const auto wanted = options.coverage * static_cast<double>(count);
  const auto min_new = options.min_gain * static_cast<double>(count);
  const auto views_for_quality = static_cast<std::size_t>(options.views_for_quality);
  ViewPlan plan{.reachable = reachable_share(qualities, count)};
  Greedy greedy(qualities, count);
  Worth worth = views_for_quality > 0 ? kWholeWorth : kCoverageOnly;
  std::size_t seen = 0;
  while (plan.directions.size() < static_cast<std::size_t>(options.max_views) &&
         static_cast<double>(seen) < wanted) {
    progress.check_stop();
    const std::size_t view = plan.directions.empty()
                                 ? greedy.pick_first(worth, directions, options.one_sided)
                                 : greedy.pick(worth);
    if (view == directions.size()) break;
    const std::size_t newly_seen = greedy.newly_seen(view);
    if (plan.directions.size() >= views_for_quality && static_cast<double>(newly_seen) < min_new) {
      if (worth == kCoverageOnly) break;
      worth = kCoverageOnly;
      continue;
    }
    seen += newly_seen;
    greedy.take(view);
    if (options.one_sided && plan.directions.empty()) {
      exclude_other_side(greedy, directions, directions[view]);
    }
    plan.directions.push_back(directions[view]);
    plan.coverage.push_back(static_cast<double>(seen) / static_cast<double>(count));
  }
  return plan;
}

}  // namespace

ViewPlan plan_views(Rasterizer& rasterizer, std::span<const Vec3> points, double pixel_size,
                    const ViewPlanOptions& options, const Progress& progress) {
  check_arguments(points, points, pixel_size, options);
  return plan_for(rasterizer, choose_subset(points, pixel_size, options.subset), options, progress);
}

ViewPlan plan_views_of(Rasterizer& rasterizer, std::span<const Vec3> points,
                       std::span<const Vec3> targets, double pixel_size,
                       const ViewPlanOptions& options, const Progress& progress) {
  check_arguments(points, targets, pixel_size, options);
  Subset subset = choose_subset(points, pixel_size, options.subset);
  subset.targets = about(subset.bounds.center(), inside(subset.bounds, targets));
  if (subset.targets.empty()) return {};
  return plan_for(rasterizer, subset, options, progress);
}

}  // namespace rangezip

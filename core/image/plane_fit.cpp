#include "core/image/plane_fit.h"

#include <algorithm>
#include <atomic>
#include <cmath>
#include <optional>
#include <string>

#include "core/base/error.h"
#include "core/base/parallel.h"
#include "core/image/depth_units.h"
#include "core/image/item_lookup.h"

namespace rangezip {

namespace {

/// Reach of the depth window from the sample, pixel sides: constant part and share of the slope.
/// The nearest of several points lies in front of the surface at the pixel centre, hence the
/// longer reach to the back; its cap keeps the next sheet out [measured on scans and on points
/// drawn from meshes].
constexpr double kFrontReach = 0.3;
constexpr double kFrontReachPerSlope = 0.6;
constexpr double kBackReach = 0.6;
constexpr double kBackReachPerSlope = 1.0;
constexpr double kMaxBackReach = 3.5;

constexpr double kSubpixels = 256.0;  ///< units of dx and dy in a pixel (R13)
constexpr double kUnitWeight = kSubpixels * kSubpixels;
constexpr std::int64_t kMaxShiftedDepth = std::int64_t{1} << 20U;  ///< bound of R13

double sum_of_slopes(const glm::dvec2& slope) {
  return std::abs(slope.x) + std::abs(slope.y);
}

/// Pixels whose sample comes from a point.
Mask pixels_won_by_points(const Framebuffer& framebuffer, std::span<const DrawItem> items,
                          const RangeImage& nearest) {
  const ItemLookup lookup(items);
  Mask mask(nearest.extent(), 0);
  for_each_row(nearest.extent().height, [&](int y) {
    for (Pixel p{0, y}; p.x < nearest.extent().width; ++p.x) {
      if (!nearest.has_sample(p) || framebuffer.id[p] == kNoPrimitive) continue;
      const std::size_t item = lookup.find(framebuffer.id[p]);
      if (item == ItemLookup::kNone) {
        throw InvalidArgument("fit_planes: ID " + std::to_string(framebuffer.id[p]) +
                              " belongs to no item");
      }
      if (std::holds_alternative<DrawPoints>(items[item])) mask[p] = 1;
    }
  });
  return mask;
}

/// The smallest shift that keeps every z of the window within the bound of R13.
int common_shift(const AccumulateWindow& window) {
  std::int64_t reach = 0;
  for (std::size_t i = 0; i < window.reference.pixels().size(); ++i) {
    const std::int64_t lower = window.band.lower.pixels()[i];
    const std::int64_t upper = window.band.upper.pixels()[i];
    const std::int64_t reference = window.reference.pixels()[i];
    if (lower <= upper) reach = std::max({reach, reference - lower, upper - reference});
  }
  int shift = 0;
  while ((reach >> shift) + 1 >= kMaxShiftedDepth)
    ++shift;
  return shift;
}

AccumulateWindow make_window(const RangeImage& nearest, const SlopeImage& slopes,
                             const Mask& fitted) {
  const View& view = nearest.view();
  AccumulateWindow window{.band = empty_band(view.extent()),
                          .reference = Grid<std::int32_t>(view.extent(), 0)};
  for_each_row(view.extent().height, [&](int y) {
    for (Pixel p{0, y}; p.x < view.extent().width; ++p.x) {
      if (fitted[p] == 0) continue;
      const double depth = nearest[p];
      const double size = nearest.pixel_size(p);
      const double slope = sum_of_slopes(slopes[p]);
      const double front = size * (kFrontReach + kFrontReachPerSlope * slope);
      const double back = size * std::min(kMaxBackReach, kBackReach + kBackReachPerSlope * slope);
      const DepthInterval interval = depth_interval(view, depth - front, depth + back);
      window.band.lower[p] = interval.lower;
      window.band.upper[p] = interval.upper;
      window.reference[p] = static_cast<std::int32_t>(std::lround(depth_units(view, depth)));
    }
  });
  window.shift = common_shift(window);
  return window;
}

/// z = height + slope . (dx, dy), in pixels and depth units.
struct FittedPlane {
  double height = 0.0;
  glm::dvec2 slope{0.0};
};

/// Weighted least squares with the slope pulled towards `expected`: the symmetric system
///   [ w     w_dx        w_dy      ] [height ]   [ w_z                   ]
///   [ w_dx  w_dx_dx+r   w_dx_dy   ] [slope.x] = [ w_z_dx + r expected.x ]
///   [ w_dy  w_dx_dy     w_dy_dy+r ] [slope.y]   [ w_z_dy + r expected.y ]
/// by elimination. Undefined (NaN) where ridge is 0 and the points determine no plane.
/// @param unit_z depth units of one unit of z
FittedPlane solve_plane(const PixelMoments& m, double unit_z, const glm::dvec2& expected,
                        double ridge_share) {
  const double w = static_cast<double>(m.w) / kUnitWeight;
  const glm::dvec2 w_d = glm::dvec2{static_cast<double>(m.w_dx), static_cast<double>(m.w_dy)} /
                         (kUnitWeight * kSubpixels);
  const double squares = kUnitWeight * kSubpixels * kSubpixels;
  const double ridge = ridge_share * (w + 1.0);
  const double xx = static_cast<double>(m.w_dx_dx) / squares + ridge;
  const double xy = static_cast<double>(m.w_dx_dy) / squares;
  const double yy = static_cast<double>(m.w_dy_dy) / squares + ridge;
  const double z = static_cast<double>(m.w_z) / kUnitWeight * unit_z;
  const glm::dvec2 zd = glm::dvec2{static_cast<double>(m.w_z_dx), static_cast<double>(m.w_z_dy)} /
                            (kUnitWeight * kSubpixels) * unit_z +
                        ridge * expected;

  const glm::dvec2 factor = w_d / w;
  const double a = xx - factor.x * w_d.x;
  const double b = xy - factor.x * w_d.y;
  const double c = yy - factor.y * w_d.y;
  const glm::dvec2 right = zd - factor * z;
  FittedPlane plane;
  plane.slope.y = (right.y - b / a * right.x) / (c - b / a * b);
  plane.slope.x = (right.x - b * plane.slope.y) / a;
  plane.height = (z - glm::dot(w_d, plane.slope)) / w;
  return plane;
}

struct FittedSample {
  double depth = 0.0;
  glm::dvec2 slope{0.0};
};

/// Depth units per pixel side at a depth, the first-order scale between window and eye.
double units_per_pixel_side(const View& view, double depth) {
  const Camera& camera = view.camera();
  const double range = camera.far_depth - camera.near_depth;
  const double per_length = view.is_perspective()
                                ? camera.far_depth * camera.near_depth / (depth * depth * range)
                                : 1.0 / range;
  return kDepthUnits * per_length * view.pixel_size(depth);
}

/// The plane's value at the pixel centre; empty where it is farther from the sample than the
/// points that it was made from can be.
std::optional<FittedSample> fitted_sample(const View& view, const PixelMoments& moments,
                                          const AccumulateWindow& window, Pixel pixel, double depth,
                                          const glm::dvec2& expected,
                                          const PlaneFitOptions& options) {
  const double side = units_per_pixel_side(view, depth);
  const double unit_z = std::ldexp(1.0, window.shift);
  const FittedPlane plane = solve_plane(moments, unit_z, expected * side, options.slope_ridge);
  // The shift rounds down, by half of unit_z - 1 on average.
  const double units = window.reference[pixel] + plane.height + 0.5 * (unit_z - 1.0);
  const double reach = 1.0 + sum_of_slopes(expected);
  if (!(std::abs(units - depth_units(view, depth)) <= reach * side)) return std::nullopt;

  FittedSample sample;
  sample.depth = view.depth_from_window_z(units / kDepthUnits);
  const glm::dvec2 slope = plane.slope / units_per_pixel_side(view, sample.depth);
  sample.slope = glm::clamp(slope, -kMaxSlope, kMaxSlope);
  return sample;
}

}  // namespace

PlaneFitResult fit_planes(Rasterizer& rasterizer, std::span<const DrawItem> items,
                          const Framebuffer& framebuffer, const RangeImage& nearest,
                          const SlopeImage& slopes, const PlaneFitOptions& options) {
  const View& view = nearest.view();
  if (slopes.extent() != view.extent() || framebuffer.id.extent() != view.extent()) {
    throw InvalidArgument("fit_planes: image, slopes and framebuffer must have the same extent");
  }
  PlaneFitResult result{.image = nearest, .slopes = slopes};
  const Mask fitted = pixels_won_by_points(framebuffer, items, nearest);
  const std::span<const std::uint8_t> pixels = fitted.pixels();
  if (std::find(pixels.begin(), pixels.end(), 1) == pixels.end()) return result;
  const AccumulateWindow window = make_window(nearest, slopes, fitted);
  Grid<PixelMoments> moments;
  rasterizer.accumulate(view, items, window, moments);

  std::atomic<std::size_t> inside{0};
  std::atomic<std::size_t> unsupported{0};
  for_each_row(view.extent().height, [&](int y) {
    for (Pixel p{0, y}; p.x < view.extent().width; ++p.x) {
      if (fitted[p] == 0) continue;
      if (moments[p].w_vote < 0) {
        result.image[p] = kNoSample;
        result.slopes[p] = {0.0, 0.0};
        ++inside;
      } else if (moments[p].w == 0) {
        ++unsupported;
      } else if (const auto sample =
                     fitted_sample(view, moments[p], window, p, nearest[p], slopes[p], options)) {
        result.image[p] = sample->depth;
        result.slopes[p] = sample->slope;
      }
    }
  });
  result.inside = inside;
  result.unsupported = unsupported;
  return result;
}

}  // namespace rangezip

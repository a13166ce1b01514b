#include "core/reconstruct/resolution.h"

#include <algorithm>
#include <cmath>
#include <string>

#include "core/base/check_number.h"
#include "core/base/error.h"
#include "core/plan/spacing.h"
#include "core/raster/rasterizer.h"

namespace rangezip {

namespace {

constexpr std::size_t kTrianglesOfPolygons = 100'000;
/// A pixel becomes two triangles of half its area each, stretched by the tilt of the surface to
/// the view that won it (measured on the models of the benchmarks: 1.1 on average).
constexpr double kTrianglesPerPixelArea = 2.0 / 1.1;
/// The same of clouds whose scans are the mesh: with what estimating the area by the spacing of
/// points, borders and seams cost. It depends on how the surface lies to the views: measured on
/// seven clouds, the mesh has 0.80 to 1.08 times as many triangles as were asked for, 0.97 on
/// average.
constexpr double kScannedPerPixelArea = 0.905 * kTrianglesPerPixelArea;
/// Of the spacing: finer pixels show nothing but what is made up between points, where they would
/// get four in each direction.
constexpr double kFinestOfSpacing = 0.25;
/// Of pixels than the edges of a mesh with fewer triangles, at most: scans of up to 64 times as
/// many show all that such a mesh can, and finer ones take longer.
constexpr double kFinerThanMesh = 8.0;
/// Times the side of the triangles asked for, a little less than what the finish can still split.
constexpr double kSplitByFinish = 3.5;
constexpr int kImageMargin = 16;  ///< pixels that framing and rounding may add

double pixel_size_for(double area, std::size_t triangles,
                      double per_pixel_area = kTrianglesPerPixelArea) {
  return std::sqrt(per_pixel_area * area / static_cast<double>(triangles));
}

/// @param area of the surface @param finest side of a pixel that still makes sense
void check_triangles(std::size_t triangles, double area, double finest) {
  const double most = std::floor(kScannedPerPixelArea * area / (finest * finest));
  if (static_cast<double>(triangles) <= most) return;
  throw InvalidArgument("reconstruct: triangles may be at most " +
                        std::to_string(static_cast<std::size_t>(std::max(most, 1.0))) +
                        " for this input, got " + std::to_string(triangles));
}

/// Points must be drawn larger where the pixel is so fine that one in four would stay empty.
int point_size_for(const Spacing& spacing, double pixel_size) {
  constexpr double kPixelPerSpacing = 1.2;
  constexpr double kLargest = 15.0;
  return static_cast<int>(
      std::clamp(std::ceil(kPixelPerSpacing * spacing.median / pixel_size), 1.0, kLargest));
}

/// The finest pixel at which an image of the box fits into the rasterizer from any direction.
double finest_pixel_size(const Box& bounds) {
  return bounds.diagonal() / static_cast<double>(kMaxRasterExtent - kImageMargin);
}

/// What the points or polygons ask for, or the number of triangles.
/// @param spacing absent if there are polygons only
/// @param finest_drawn the finest pixel that the rasterizer can draw
double demanded_pixel_size(const Scene& scene, std::span<const Vec3> samples,
                           const std::optional<Spacing>& spacing,
                           std::optional<std::size_t> triangles, bool is_remeshed, double excess,
                           double finest_drawn) {
  const double area = spacing
                          ? static_cast<double>(samples.size()) * spacing->median * spacing->median
                          : triangle_area(scene);
  const double own =
      spacing ? pixel_size_from_spacing(*spacing) : pixel_size_for(area, kTrianglesOfPolygons);
  if (!triangles) return own;
  check_triangles(*triangles, area,
                  std::max(finest_drawn, spacing ? kFinestOfSpacing * spacing->median : 0.0));
  const bool is_scanned = spacing && !is_remeshed;
  const double per_pixel_area = is_scanned ? kScannedPerPixelArea : kTrianglesPerPixelArea;
  const double demanded = pixel_size_for(area, *triangles, excess * per_pixel_area);
  const double finest = is_remeshed ? demanded / kFinerThanMesh : demanded;
  const double suitable = std::min(demanded, std::max(own, finest));
  if (!spacing || !is_uneven(*spacing) || !is_remeshed) return suitable;
  // Finer pixels would show nothing where points are sparse, and the median tells no area then.
  return std::max(suitable, std::min(own, kSplitByFinish * demanded));
}

}  // namespace

Resolution choose_resolution(const Scene& scene, std::span<const Vec3> samples,
                             std::optional<double> pixel_size, std::optional<std::size_t> triangles,
                             bool is_remeshed, double excess) {
  if (pixel_size) check_positive("reconstruct: pixel_size", *pixel_size);
  if (triangles && *triangles == 0) {
    throw InvalidArgument("reconstruct: triangles must be at least 1, got 0");
  }
  Resolution chosen;
  chosen.bounds = robust_bounds(samples);
  const bool has_points = scene.point_count() > 0;
  std::optional<Spacing> spacing;
  if (has_points) spacing = estimate_spacing(samples.first(scene.point_count()));

  if (pixel_size) {
    chosen.pixel_size = *pixel_size;
  } else {
    const double finest = finest_pixel_size(chosen.bounds);
    chosen.pixel_size = std::max(finest, demanded_pixel_size(scene, samples, spacing, triangles,
                                                             is_remeshed, excess, finest));
    chosen.follows_density =
        spacing && spacing->line_gap == 0.0 &&
        chosen.pixel_size <= std::max(finest, pixel_size_from_spacing(*spacing));
  }

  if (has_points) {
    chosen.point_size = point_size_for(*spacing, chosen.pixel_size);
    chosen.spacing = spacing->median;
    chosen.gap = spacing->gap;
    chosen.noise = spacing->noise;
  }
  return chosen;
}

}  // namespace rangezip

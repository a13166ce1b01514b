#pragma once

#include <cstddef>
#include <span>

#include "core/image/range_image.h"
#include "core/raster/rasterizer.h"

namespace rangezip {

struct PlaneFitOptions {
  double slope_ridge = 0.02;  ///< pull of the slope towards the estimate from the nearest samples,
                              ///< as a share of the weight; keeps few points from tilting wildly
};

struct PlaneFitResult {
  RangeImage image;
  SlopeImage slopes;
  std::size_t inside = 0;       ///< samples removed because the vote says they show an inside
  std::size_t unsupported = 0;  ///< samples kept as they were: no point in the window
};

/// Replaces each sample by the value at the pixel centre of the plane that fits the points of its
/// depth window best, weighted by a tent of one pixel: the z-buffer minimum is biased towards the
/// viewer by about a quarter pixel, the plane is not. The window reaches from the sample
/// h (0.3 + 0.6 g) to the front and min(3.5 h, h (0.6 + g)) to the back, h the pixel side,
/// g = |slope x| + |slope y|. Sums are the rasterizer's exact integers (R13), so the result is the
/// same on every backend.
///
/// Pixels whose mean vote is negative show the inside of a surface through a hole and lose their
/// sample (only if the items carry votes). Pixels won by a triangle keep its plane. A plane that
/// would leave the sample by more than 1 + g pixel sides is not taken: the sample stays as it is.
/// Cost: one pass of the rasterizer over the points.
///
/// @param nearest the range image of `framebuffer`, after any removal of samples
/// @param slopes estimate_slopes(nearest)
/// @param framebuffer what `nearest` was resolved from: tells points from triangles
/// @param items what was drawn
/// @throws InvalidArgument if extents differ or an ID belongs to no item.
[[nodiscard]] PlaneFitResult fit_planes(Rasterizer& rasterizer, std::span<const DrawItem> items,
                                        const Framebuffer& framebuffer, const RangeImage& nearest,
                                        const SlopeImage& slopes,
                                        const PlaneFitOptions& options = {});

}  // namespace rangezip

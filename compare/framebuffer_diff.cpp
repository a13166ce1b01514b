#include "compare/framebuffer_diff.h"

#include <algorithm>
#include <cmath>
#include <string>

#include "core/base/error.h"
#include "core/image/range_image.h"

namespace rangezip::compare {

namespace {

std::string text_of(Extent extent) {
  return std::to_string(extent.width) + " x " + std::to_string(extent.height);
}

void check_extents(const char* function, Extent reference, Extent candidate) {
  if (reference == candidate) return;
  throw InvalidArgument(std::string(function) + ": both must have the same extent, got " +
                        text_of(reference) + " and " + text_of(candidate));
}

/// Calls visit(pixel) for all pixels, bottom row first.
template <class Visit>
void for_each_pixel(Extent extent, const Visit& visit) {
  for (int y = 0; y < extent.height; ++y) {
    for (int x = 0; x < extent.width; ++x)
      visit(Pixel{x, y});
  }
}

/// Compares value by value; `step` is the size of a difference between two values not `empty`.
template <class T, class Step>
GridDiff compare_values(const char* function, const Grid<T>& reference, const Grid<T>& candidate,
                        T empty, const Step& step) {
  check_extents(function, reference.extent(), candidate.extent());
  GridDiff diff{.pixels = reference.extent().count()};
  for_each_pixel(reference.extent(), [&](Pixel pixel) {
    const T expected = reference[pixel];
    const T found = candidate[pixel];
    if (expected == found) return;
    ++diff.differences;
    if (!diff.first) diff.first = pixel;
    if (found == empty) {
      ++diff.missing;
    } else if (expected == empty) {
      ++diff.unexpected;
    } else {
      diff.largest_step = std::max(diff.largest_step, step(expected, found));
    }
  });
  return diff;
}

void count_drawn_pixel(std::uint32_t expected, std::uint32_t found, FramebufferDiff& diff) {
  if (expected == found) return;
  ++diff.depth_differences;
  const std::uint32_t step = expected > found ? expected - found : found - expected;
  diff.largest_depth_step = std::max(diff.largest_depth_step, step);
}

}  // namespace

FramebufferDiff compare_framebuffers(const Framebuffer& reference, const Framebuffer& candidate) {
  const Extent extent = reference.id.extent();
  for (const Extent other :
       {reference.depth.extent(), candidate.id.extent(), candidate.depth.extent()}) {
    check_extents("compare_framebuffers", extent, other);
  }
  FramebufferDiff diff{.pixels = extent.count()};
  for_each_pixel(extent, [&](Pixel pixel) {
    const PrimitiveId expected = reference.id[pixel];
    const PrimitiveId found = candidate.id[pixel];
    if (expected == found && reference.depth[pixel] == candidate.depth[pixel]) return;
    if (!diff.first) diff.first = pixel;
    if (expected != found && found == kNoPrimitive) {
      ++diff.missing;
    } else if (expected != found && expected == kNoPrimitive) {
      ++diff.unexpected;
    } else {
      if (expected != found) ++diff.id_differences;
      count_drawn_pixel(reference.depth[pixel], candidate.depth[pixel], diff);
    }
  });
  return diff;
}

GridDiff compare_depths(const Grid<double>& reference, const Grid<double>& candidate) {
  return compare_values("compare_depths", reference, candidate, kNoSample,
                        [](double a, double b) { return std::abs(a - b); });
}

GridDiff compare_ids(const Grid<PrimitiveId>& reference, const Grid<PrimitiveId>& candidate) {
  return compare_values("compare_ids", reference, candidate, kNoPrimitive,
                        [](PrimitiveId, PrimitiveId) { return 1.0; });
}

GridDiff compare_masks(const Mask& reference, const Mask& candidate) {
  return compare_values("compare_masks", reference, candidate, std::uint8_t{0},
                        [](double a, double b) { return std::abs(a - b); });
}

}  // namespace rangezip::compare

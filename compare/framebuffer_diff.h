#pragma once

#include <cstddef>
#include <cstdint>
#include <optional>

#include "core/base/grid.h"
#include "core/raster/framebuffer.h"

namespace rangezip::compare {

/// How two drawings of the same scene differ, pixel by pixel. Exact backends must give the same
/// bits, so there is no tolerance (docs/rasterization.md).
struct FramebufferDiff {
  std::size_t pixels = 0;                ///< compared
  std::size_t missing = 0;               ///< drawn in the reference only
  std::size_t unexpected = 0;            ///< drawn in the candidate only
  std::size_t id_differences = 0;        ///< drawn in both, another primitive won
  std::size_t depth_differences = 0;     ///< drawn in both, another depth
  std::uint32_t largest_depth_step = 0;  ///< of those, in units of 2^-24 of the depth range
  std::optional<Pixel> first;            ///< the first differing pixel, bottom row first

  [[nodiscard]] bool identical() const noexcept { return !first; }
};

/// Compares depth and ID of every pixel. A pixel counts as drawn if its ID is not kNoPrimitive; a
/// depth that is kNoDepth under a drawn ID, or the reverse, is a depth difference.
/// @throws InvalidArgument if the extents differ, or a framebuffer's two grids do.
[[nodiscard]] FramebufferDiff compare_framebuffers(const Framebuffer& reference,
                                                   const Framebuffer& candidate);

/// How two images of one kind (depths, IDs, masks) differ.
struct GridDiff {
  std::size_t pixels = 0;
  std::size_t differences = 0;  ///< pixels whose values are not equal
  std::size_t missing = 0;      ///< of those: empty in the candidate only
  std::size_t unexpected = 0;   ///< of those: empty in the reference only
  double largest_step = 0.0;    ///< of those that are empty in neither; of IDs: 1
  std::optional<Pixel> first;   ///< the first differing pixel, bottom row first

  [[nodiscard]] bool identical() const noexcept { return differences == 0; }
};

/// Depths in model units; kNoSample (infinity) is empty.
/// @throws InvalidArgument if the extents differ.
[[nodiscard]] GridDiff compare_depths(const Grid<double>& reference, const Grid<double>& candidate);

/// Primitive IDs; kNoPrimitive is empty.
/// @throws InvalidArgument if the extents differ.
[[nodiscard]] GridDiff compare_ids(const Grid<PrimitiveId>& reference,
                                   const Grid<PrimitiveId>& candidate);

/// Masks; 0 is empty.
/// @throws InvalidArgument if the extents differ.
[[nodiscard]] GridDiff compare_masks(const Mask& reference, const Mask& candidate);

}  // namespace rangezip::compare

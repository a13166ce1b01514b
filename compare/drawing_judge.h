#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <optional>
#include <span>

#include "compare/footprint.h"
#include "core/base/grid.h"
#include "core/raster/draw_item.h"
#include "core/raster/framebuffer.h"
#include "core/view/view.h"

namespace rangezip::compare {

/// What differs in a pixel. A depth that is kNoDepth under a drawn ID, or the reverse, counts as
/// `depth`.
enum class Difference : std::uint8_t {
  coverage,  ///< drawn in one of the two only
  id,        ///< another primitive
  depth,     ///< the same primitive at another depth
};
inline constexpr std::size_t kDifferences = 3;

/// Why it differs.
enum class Cause : std::uint8_t {
  edge,            ///< the centre lies so near an edge that rounding decides on which side
  depth_tie,       ///< both primitives cover it, so near to each other that rounding decides
  depth_rounding,  ///< the same primitive, its depth rounded differently
  depth_plane,     ///< a primitive so near the front or back plane that rounding decides
  unexplained,     ///< a defect
};
inline constexpr std::size_t kCauses = 5;

/// How often each happened; sums of several drawings make sense.
struct DrawingCounts {
  std::size_t pixels = 0;
  std::size_t covered = 0;    ///< drawn in the reference
  std::size_t identical = 0;  ///< the same depth and ID, or nothing in both
  std::array<std::array<std::size_t, kCauses>, kDifferences> different{};
  /// Pixels of Difference::depth by the size of the step in units (of 2^-24 of the depth range,
  /// which are the ulps of a depth): [k] counts those in [2^k, 2^(k+1)).
  std::array<std::size_t, kDepthBits> depth_steps{};
  std::uint32_t largest_depth_step = 0;

  [[nodiscard]] std::size_t of(Difference difference) const noexcept;
  [[nodiscard]] std::size_t of(Cause cause) const noexcept;
  [[nodiscard]] std::size_t different_pixels() const noexcept { return pixels - identical; }
  DrawingCounts& operator+=(const DrawingCounts& other) noexcept;
};

/// What one of the two drawings has in a pixel.
struct PixelContent {
  std::uint32_t depth = kNoDepth;
  PrimitiveId id = kNoPrimitive;
  /// Absent if nothing is drawn, or the ID belongs to no item.
  std::optional<SnappedPrimitive> primitive;
  PixelFit fit;  ///< of the primitive, within the tolerance
};

struct PixelDifference {
  Pixel pixel;
  Difference difference = Difference::coverage;
  Cause cause = Cause::unexplained;
  PixelContent reference;
  PixelContent candidate;
};

struct DrawingVerdict {
  DrawingCounts counts;
  /// 0 where the two are the same, else 1 + the Cause.
  Grid<std::uint8_t> causes;
  std::optional<PixelDifference> first;  ///< bottom row first
  std::optional<PixelDifference> first_unexplained;

  [[nodiscard]] bool identical() const noexcept { return counts.different_pixels() == 0; }
  [[nodiscard]] bool explained() const noexcept { return counts.of(Cause::unexplained) == 0; }
};

/// Judges two drawings of the same items under the same view, pixel by pixel. A difference is
/// explained if a renderer that keeps to the norm up to the tolerance may show the one, and another
/// such renderer the other: what is shown may cover the pixel at that depth, and nothing that must
/// cover it must be nearer. (Of equal depths the lower ID is the nearer, R9.) So without a
/// tolerance every difference is unexplained, and a fault of the reference is found as one of the
/// candidate is.
///
/// Costs a pass over the primitives if anything differs: O(primitives + pixels + the differing
/// pixels in the boxes of the primitives).
/// @param items what both were drawn from
/// @throws InvalidArgument if an extent is not that of the view, or tolerance.slope is less than
///     tolerance.edge or one of the three negative.
[[nodiscard]] DrawingVerdict judge_drawing(const View& view, std::span<const DrawItem> items,
                                           const Framebuffer& reference,
                                           const Framebuffer& candidate,
                                           const DrawingTolerance& tolerance = {});

}  // namespace rangezip::compare

#pragma once

#include <cstddef>
#include <cstdint>
#include <vector>

#include "core/raster/draw_item.h"
#include "core/raster/framebuffer.h"
#include "core/raster/row_transform.h"
#include "core/raster/split_triangle.h"
#include "core/view/view.h"

/// Which pixels a primitive may cover, and which it must, and at what depths, for a renderer that
/// rounds on its own. Written apart from the rasterizers, in integers that are wide enough, and
/// with the edges and planes of docs/rasterization.md.
namespace rangezip::compare {

/// How far a renderer's roundings may lie from those of the norm. All 0: not at all.
struct DrawingTolerance {
  int edge = 0;   ///< of a corner or a point, in x and in y, in 1/256 px
  int slope = 0;  ///< of the place where a triangle's depth is taken, in 1/256 px; at least
                  ///< `edge`, since a corner takes the plane along. So the steeper a
                  ///< triangle, the more its depth may differ
  std::int64_t depth = 0;  ///< beside that, in units of 2^-24 of the depth range

  friend bool operator==(const DrawingTolerance&, const DrawingTolerance&) = default;
};

/// For a driver that snaps to this many bits of a pixel. Edges: such a step, and 2/256 px for R3's
/// half unit and the floats before both. Depth: 16 units, which is a few roundings of floats up to
/// 1 in the driver and of floats up to 2^24 in R2, and a format of 2^24 - 1 steps.
/// @throws InvalidArgument unless subpixel_bits lies in 1..16
[[nodiscard]] DrawingTolerance driver_tolerance(int subpixel_bits);

/// A primitive on the window's integer grid.
struct SnappedPrimitive {
  PrimitiveId id = kNoPrimitive;
  int point_size = 0;                   ///< 0: a triangle
  SnappedPosition point;                ///< kRejected if the norm drops it
  std::vector<SnappedTriangle> pieces;  ///< of a triangle, after R8 and R11
  Facing facing = Facing::both;
};

/// An item with its positions snapped. Refers to the item.
struct SnappedItem {
  const DrawItem* item = nullptr;
  RowTransform rows;
  std::vector<SnappedPosition> positions;
};
[[nodiscard]] SnappedItem snap_item(const View& view, const DrawItem& item);

/// Primitive number `index` of the item, into `primitive`, whose memory is used again.
void get_primitive(const SnappedItem& item, std::size_t index, SnappedPrimitive& primitive);

/// Pixels first..last both ways; empty if first > last.
struct PixelBox {
  Pixel first{0, 0};
  Pixel last{-1, -1};
};

/// The pixels of the image that the primitive may cover, and perhaps some beside them.
[[nodiscard]] PixelBox reach_of(const SnappedPrimitive& primitive,
                                const DrawingTolerance& tolerance, Extent extent);

/// What a primitive may do to a pixel, whatever the roundings within the tolerance.
struct PixelFit {
  bool may_cover = false;    ///< for some of the roundings
  bool must_cover = false;   ///< for all of them
  std::int64_t nearest = 0;  ///< where it may cover: its depths there, in units, also some that lie
  std::int64_t farthest = 0;  ///< outside of the depth planes

  /// In any case drawn, unless something nearer is.
  [[nodiscard]] bool must_be_drawn() const noexcept {
    return must_cover && nearest >= 0 && farthest <= std::int64_t{kMaxDepth};
  }
};

/// Triangles: each corner moved by up to `edge` in x and in y. The pixel may be covered if a
/// triangle so moved has its centre, that is if the centre lies in the sum of the triangle and the
/// square [-edge, edge]^2; it must be if that square around its centre lies in the triangle. With 0
/// both are R6, ties included. The depth is that of the triangle's plane somewhere in the square
/// [-slope, slope]^2 around the centre, where the plane is as steep as corners moved by `slope`
/// make it: a triangle so thin that they may turn it over may have any depth. It may lie past the
/// depths of the corners by as much as it changes there, since drivers round edges and planes
/// apart. Points: the same for R5. Clip planes are those of R11, without a tolerance.
[[nodiscard]] PixelFit fit_of(const SnappedPrimitive& primitive, Pixel pixel,
                              const DrawingTolerance& tolerance);

}  // namespace rangezip::compare

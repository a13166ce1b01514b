#pragma once

#include <cstdint>
#include <span>
#include <variant>

#include "core/base/geometry.h"

namespace rangezip {

/// Number of a drawn point or triangle; all 32 bits count, unlike the 24 of an RGB colour.
using PrimitiveId = std::uint32_t;
inline constexpr PrimitiveId kNoPrimitive = 0xffff'ffffU;

/// A cloud of points, each drawn as a square of point_size x point_size pixels.
struct DrawPoints {
  std::span<const Vec3f> positions;
  Mat4 world_from_item{1.0};      ///< affine; the scan's registration, or an offset
  PrimitiveId first_id = 0;       ///< point i is drawn as first_id + i
  int point_size = 1;             ///< pixels, at least 1; larger ones close holes
  std::uint64_t content_key = 0;  ///< 0, or a number never used for other content: a backend may
                                  ///< keep its upload under it
  /// Per point: how surely this view sees its outside, in [-127, 127]; empty: no vote (all 0).
  /// Read by accumulate() only (R13).
  std::span<const std::int8_t> votes;
};

/// Which triangles are drawn, by the sign of their snapped area (R6): `front` are those whose
/// corners run counter-clockwise in the window. A triangle of no area is never drawn.
enum class Facing : std::uint8_t { both, front, back };

/// Triangles with shared corners.
struct DrawTriangles {
  std::span<const Vec3f> positions;
  std::span<const Triangle> triangles;
  Mat4 world_from_item{1.0};
  PrimitiveId first_id = 0;  ///< triangle i is drawn as first_id + i
  std::uint64_t content_key = 0;
  Facing facing = Facing::both;
};

/// Non-owning; what the spans refer to must outlive the call of render().
using DrawItem = std::variant<DrawPoints, DrawTriangles>;

/// IDs that an item uses: [first_id, first_id + count).
[[nodiscard]] inline std::size_t primitive_count(const DrawItem& item) noexcept {
  if (const auto* points = std::get_if<DrawPoints>(&item)) return points->positions.size();
  return std::get<DrawTriangles>(item).triangles.size();
}
[[nodiscard]] inline PrimitiveId first_id(const DrawItem& item) noexcept {
  return std::visit([](const auto& i) { return i.first_id; }, item);
}

}  // namespace rangezip

#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

#include "core/base/geometry.h"
#include "core/view/view.h"

namespace rangezip {

/// Four coefficients of R2's row product; the last is the constant term.
using Row = std::array<float, 4>;

/// From an item's positions to window integers (R1). Made once per item and view; every backend
/// computes with these very floats.
struct RowTransform {
  Row x{};  ///< 1/256 pixel (times w under a central projection)
  Row y{};
  Row z{};  ///< 2^-24 of the depth range (times w)
  Row w{};  ///< central projection only
  bool is_central = false;
  std::vector<Row> clip;  ///< one per clip plane: inside where the product is >= 0 (R11)
};

/// R1: camera, viewport and placement folded in double, rounded once to float.
[[nodiscard]] RowTransform make_row_transform(const View& view, const Mat4& world_from_item);

/// R2: the product, rounded after every operation.
[[nodiscard]] float row_product(const Row& row, const Vec3f& position);

/// A position on the window's integer grid: x, y in 1/256 pixel, z in 2^-24 of the depth range.
struct SnappedPosition {
  std::int32_t x = 0;
  std::int32_t y = 0;
  std::int32_t z = 0;

  friend bool operator==(const SnappedPosition&, const SnappedPosition&) = default;
};

/// Guard range of R3 and R4: |x|, |y| <= kGuardXY and |z| <= kGuardZ.
inline constexpr std::int32_t kGuardXY = 1 << 22;
inline constexpr std::int32_t kGuardZ = 1 << 25;

/// What takes the place of a position that has none. Its x is farther left than any point
/// reaches, so that drawing code may treat it as a point off screen, and far enough from the least
/// integer to be moved by a point's size.
inline constexpr SnappedPosition kRejected{-(1 << 30), 0, 0};
[[nodiscard]] constexpr bool is_rejected(const SnappedPosition& p) noexcept {
  return p.x == kRejected.x;
}

/// R3 or R4 for every position; kRejected for those that are not finite or outside of the guard
/// range. About 5 ns a position under a parallel projection.
/// @return number of rejected positions
/// @pre snapped.size() == positions.size()
std::size_t snap_positions(const RowTransform& rows, std::span<const Vec3f> positions,
                           std::span<SnappedPosition> snapped);

/// R11: also rejects the positions that lie outside of a clip plane.
void reject_clipped(const RowTransform& rows, std::span<const Vec3f> positions,
                    std::span<SnappedPosition> snapped);

}  // namespace rangezip

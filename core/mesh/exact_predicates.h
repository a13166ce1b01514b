#pragma once

#include "core/base/geometry.h"

namespace rangezip {

/// Signs of determinants of coordinates, computed without error: a floating-point filter first and,
/// where it cannot decide, sums of doubles that do not round (expansions) [Shewchuk 1997].
/// Exact while no product of three coordinate differences over- or underflows: differences that are
/// zero or between 1e-75 and 1e+75 in magnitude are always safe.

/// +1 if a, b, c turn to the left, -1 to the right, 0 if they lie on one line.
[[nodiscard]] int orientation_2d(const Vec2& a, const Vec2& b, const Vec2& c) noexcept;

/// +1 if d lies on the side of the plane abc from which a, b, c run clockwise (below), -1 on the
/// other side, 0 on the plane: the sign of det(a - d, b - d, c - d).
[[nodiscard]] int orientation_3d(const Vec3& a, const Vec3& b, const Vec3& c,
                                 const Vec3& d) noexcept;

/// True if the three points lie on one line, two or all of them equal included.
[[nodiscard]] bool are_collinear(const Vec3& a, const Vec3& b, const Vec3& c) noexcept;

}  // namespace rangezip

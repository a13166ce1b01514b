#pragma once

#include <vector>

#include "core/base/geometry.h"
#include "core/base/grid.h"
#include "core/view/view.h"

namespace rangezip::compare {

/// `count` parallel views of all of `bounds` from evenly spread directions (sphere_directions()),
/// the same on every machine. Each shows the sphere around the box, so all have one scale.
/// @throws InvalidArgument if count < 1, the bounds are empty or a point, or the extent is empty.
[[nodiscard]] std::vector<View> views_around(const Box& bounds, int count, Extent extent);

}  // namespace rangezip::compare

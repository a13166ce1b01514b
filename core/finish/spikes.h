#pragma once

#include <cstddef>
#include <cstdint>
#include <vector>

#include "core/base/geometry.h"
#include "core/finish/corner_table.h"
#include "core/finish/point_grid.h"

namespace rangezip {

/// Puts single vertices that stick out of a flat surrounding back into it: samples of outliers,
/// which no fit to the surface's points reaches. A vertex is a spike if it is more than half a
/// pixel over its neighbours' plane, more than twice as far as any of them, and if of the points of
/// the cloud around its foot no more are near its faces than near that plane. Inside of real tips
/// there are no points. Cost: linear.
/// @param pixel_size h, model units
/// @return number of vertices moved
std::size_t flatten_spikes(std::vector<Vec3>& positions, const CornerTable& table,
                           const PointGrid& cloud, double pixel_size);

}  // namespace rangezip

#pragma once

#include <cstddef>

#include "core/raster/draw_item.h"
#include "core/raster/row_transform.h"
#include "raster_cpu/key_buffer.h"
#include "raster_cpu/simd_kernels.h"

namespace rangezip {

/// Whether the item's points lie in an order in which most fall close to the one before: along a
/// scan line, a curve. Judged by up to 256 pairs.
[[nodiscard]] bool neighbours_fall_close(const RowTransform& rows,
                                         std::span<const Vec3f> positions);

/// Draws the points begin..end-1 of an item as squares (R2-R5, R9, R11, R12).
/// @param kernels null: the scalar code, which is the norm
/// @return number of points rejected by R3 or R4
std::size_t draw_points(const DrawPoints& points, const RowTransform& rows, std::size_t begin,
                        std::size_t end, const DrawTarget& target, const SimdKernels* kernels);

}  // namespace rangezip

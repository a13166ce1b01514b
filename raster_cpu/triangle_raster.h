#pragma once

#include <cstddef>
#include <span>

#include "core/raster/draw_item.h"
#include "core/raster/row_transform.h"
#include "raster_cpu/key_buffer.h"
#include "raster_cpu/simd_kernels.h"

namespace rangezip {

/// Draws the triangles begin..end-1 of an item (R6-R9, R11, R12).
/// @param kernels null: the scalar code, which is the norm
/// @param snapped the item's positions after snap_positions() and reject_clipped()
/// @return number of triangles dropped because a corner is not finite (R8)
std::size_t draw_triangles(const DrawTriangles& item, const RowTransform& rows,
                           std::span<const SnappedPosition> snapped, std::size_t begin,
                           std::size_t end, const DrawTarget& target, const SimdKernels* kernels);

}  // namespace rangezip

#pragma once

#include <cstddef>
#include <cstdint>
#include <span>
#include <string>
#include <vector>

#include "core/raster/draw_item.h"
#include "core/raster/row_transform.h"
#include "raster_cpu/band_layout.h"
#include "raster_cpu/fragment.h"
#include "raster_cpu/key_buffer.h"
#include "raster_cpu/point_bins.h"
#include "raster_cpu/point_moments.h"
#include "raster_cpu/tile.h"
#include "raster_cpu/triangle_setup.h"

namespace rangezip {

/// What a kernel did with the first points of a span; the rest, less than a vector, is the
/// caller's.
struct KernelReport {
  std::size_t processed = 0;
  std::size_t rejected = 0;  ///< by R3 or R4
};

/// The inner loops for one set of vector instructions. Each gives the bits of the scalar code that
/// it stands for.
struct SimdKernels {
  std::string name;  ///< "AVX3", "AVX2", ... as Highway calls the set

  /// R2-R4 and R11: as snap_positions() and reject_clipped().
  KernelReport (*snap)(const RowTransform& rows, std::span<const Vec3f> positions,
                       std::span<SnappedPosition> snapped) = nullptr;
  /// R2-R5, R9, R11, R12 for points of one pixel: as draw_points().
  KernelReport (*draw_single_pixels)(const RowTransform& rows, std::span<const Vec3f> positions,
                                     PrimitiveId first_id, const DrawTarget& target) = nullptr;
  /// R2-R4, R11: sorts the points that R13 sums into bins, by moment_cell.h.
  /// @param votes one a point, or empty. @return number rejected by R3 or R4
  std::size_t (*bin_moments)(const RowTransform& rows, std::span<const Vec3f> positions,
                             std::span<const std::int8_t> votes, Extent extent,
                             PointBins& bins) = nullptr;
  /// R13 for entries of bin `bin`, in the pixel rows `rows`: as add_moments().
  void (*add_moments)(std::span<const BinEntry> entries, std::size_t bin, PixelRange rows,
                      const MomentTarget& target) = nullptr;
  /// R2-R5 and R11 for points of size 1 to kMaxBinnedSize: sorts those that are to be drawn into
  /// bins. @return number rejected by R3 or R4. @pre at most kMaxRun positions
  std::size_t (*bin_points)(const RowTransform& rows, std::span<const Vec3f> positions, int size,
                            const BandLayout& layout, PointBins& bins) = nullptr;
  /// R9 and R12: draws fragments that bin_points() made.
  void (*draw_fragments)(std::span<const PointBins::Run> runs, Tile& tile) = nullptr;
  /// As unpack_keys(), for an image that the cache cannot hold: it is not read before it is
  /// written.
  void (*unpack_past_cache)(std::span<const PixelKey> keys, std::uint32_t* depth,
                            PrimitiveId* id) = nullptr;
  /// R6, R7, R9, R12: draws those of the triangles begin..end-1 of an item that cover a few pixels
  /// at most, and puts the numbers of those that are left to the caller into `left`.
  /// @return how many it looked at: whole vectors
  /// @pre 3 * snapped.size() < 2^31
  std::size_t (*draw_tiny_triangles)(const DrawTriangles& item,
                                     std::span<const SnappedPosition> snapped, std::size_t begin,
                                     std::size_t end, const DrawTarget& target,
                                     std::vector<std::size_t>& left) = nullptr;
  /// R6, R7, R9 for a triangle that fits_double(), without a band. Reads and writes back up to
  /// kKeyPadding keys past the last pixel.
  void (*fill_box)(const TriangleSetup& triangle, PrimitiveId id,
                   const DrawTarget& target) = nullptr;
  /// The same for a triangle of any size whose depths are all drawn.
  void (*fill_spans)(const TriangleSetup& triangle, PrimitiveId id,
                     const DrawTarget& target) = nullptr;
};

/// The sets of instructions that this machine has, the widest first. Found out once.
[[nodiscard]] const std::vector<SimdKernels>& simd_kernels();

/// Each adds its kernels for one set of instructions, by Highway's number of it; nothing if it was
/// not compiled. For simd_kernels().
void add_point_kernels(std::size_t target, SimdKernels& kernels);
void add_moment_kernels(std::size_t target, SimdKernels& kernels);
void add_triangle_kernels(std::size_t target, SimdKernels& kernels);
void add_box_kernels(std::size_t target, SimdKernels& kernels);
void add_span_kernels(std::size_t target, SimdKernels& kernels);

}  // namespace rangezip

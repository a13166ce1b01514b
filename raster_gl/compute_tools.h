#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <span>

#include "core/raster/row_transform.h"
#include "raster_gl/gl_kernels.h"
#include "raster_gl/upload_cache.h"

namespace rangezip {

/// How the kernels of a context are made and fed.
struct ComputeSetup {
  std::size_t block_bytes = 0;    ///< of one buffer, at most
  bool has_atomic_int64 = false;  ///< one pass instead of two
  bool wide_rows = false;         ///< R2 in double precision
  bool outside_only = false;      ///< draw only the triangles that fixed functions leave out
};

/// What the parts of the compute strategy share; all of it outlives them.
struct ComputeTools {
  const GlDevice& device;
  Kernels& kernels;
  UploadCache& uploads;
  ComputeSetup setup;

  /// So many elements of this size fit into one buffer; a multiple of four, at least four.
  [[nodiscard]] std::size_t chunk_of(std::size_t bytes_each) const noexcept;
};

/// The numbers that kernels count (Counter).
class KernelCounters {
 public:
  explicit KernelCounters(const GlDevice& device) : buffer_(device) {}

  /// Sets all to 0 and lets kernels count here.
  void restart(const Kernels& kernels);
  /// Waits for the kernels.
  [[nodiscard]] std::array<std::uint32_t, kCounters> read() const;

 private:
  GlBuffer buffer_;
};

/// The rows of R1 for kernels that snap positions.
class SnapRows {
 public:
  explicit SnapRows(const GlDevice& device) : clip_rows_(device) {}

  void upload(const RowTransform& rows);
  /// What a program must be made for to snap by them.
  [[nodiscard]] ShaderVariant variant(const ComputeSetup& setup) const noexcept;
  /// Lets `program`, of that variant, snap `positions` by these rows.
  void bind(const Kernels& kernels, const GlProgram& program, const GlBuffer& positions) const;
  /// Snaps all of `positions` into `snapped`, as PlacedPosition. Those that R3 or R4 rejects, and
  /// those outside of the viewport, are counted if `is_counting`.
  /// @throws BackendError if the device fails
  void snap(const ComputeTools& tools, std::span<const Vec3f> positions, const UploadKey& key,
            GlBuffer& snapped, bool is_counting = false) const;

 private:
  std::array<std::array<std::uint32_t, 4>, 4> rows_{};  ///< the bits of x, y, z, w
  GlBuffer clip_rows_;
  std::uint32_t clip_planes_ = 0;
  bool is_central_ = false;
};

}  // namespace rangezip

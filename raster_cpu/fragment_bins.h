#pragma once

#include <array>
#include <cstdint>
#include <memory>
#include <span>
#include <vector>

#include "core/base/grid.h"
#include "core/raster/draw_item.h"
#include "raster_cpu/fixed_point.h"

namespace rangezip {

/// Largest size of the points that go through bins: small beside a band.
inline constexpr int kMaxBinnedSize = 5;

/// How an image is cut into bands of whole rows. Each is drawn in a tile of its own: its pixels and
/// a margin around them, which takes what hangs over the band and is dropped. So nothing is clipped
/// while a tile is drawn, and it stays in the second-level cache: 512 KB, up to 2 MB where the
/// image is wide and the margin makes the band high.
struct BandLayout {
  Extent extent;
  int margin = 0;     ///< pixels on every side
  int rows_log2 = 0;  ///< rows of a band; the last one may have less

  [[nodiscard]] int rows() const { return 1 << rows_log2; }
  [[nodiscard]] int count() const { return (extent.height + rows() - 1) >> rows_log2; }
  [[nodiscard]] int stride() const { return extent.width + 2 * margin; }
  [[nodiscard]] std::size_t tile_pixels() const {
    return static_cast<std::size_t>(stride()) * static_cast<std::size_t>(rows() + 2 * margin);
  }
  /// Rows of the image in a band.
  [[nodiscard]] PixelRange rows_of(int band) const {
    return on_screen({band << rows_log2, ((band + 1) << rows_log2) - 1}, extent.height);
  }
  /// Place in the tile of a pixel in row `row` of its band.
  [[nodiscard]] std::size_t in_tile(int x, int row) const {
    return static_cast<std::size_t>(row + margin) * static_cast<std::size_t>(stride()) +
           static_cast<std::size_t>(x + margin);
  }
};

/// For points up to `point_size` pixels wide. @pre 1 <= point_size <= kMaxBinnedSize
[[nodiscard]] BandLayout make_band_layout(Extent extent, int point_size);

/// A point in a band: the place of its lower left pixel in the tile, its depth, and its number in
/// the run that it belongs to, from the highest bit down.
using Fragment = std::uint64_t;
inline constexpr int kRunBits = 22;
inline constexpr int kFragmentDepthBits = 24;
/// Points that a run may have.
inline constexpr std::size_t kMaxRun = std::size_t{1} << kRunBits;
/// Pixels that a tile may have.
inline constexpr std::size_t kMaxTilePixels = std::size_t{1}
                                              << (64 - kRunBits - kFragmentDepthBits);

[[nodiscard]] constexpr std::size_t tile_pixel(Fragment f) noexcept {
  return f >> (kRunBits + kFragmentDepthBits);
}
[[nodiscard]] constexpr std::uint32_t depth_of(Fragment f) noexcept {
  return static_cast<std::uint32_t>(f >> kRunBits) & ((1U << kFragmentDepthBits) - 1U);
}
[[nodiscard]] constexpr std::uint32_t number_in_run(Fragment f) noexcept {
  return static_cast<std::uint32_t>(f) & ((1U << kRunBits) - 1U);
}

/// Fragments of one thread, sorted by bands while they are made: 8 bytes each, in blocks of a page
/// that a bin takes as it grows. The memory is kept from image to image.
class FragmentBins {
 public:
  /// Points of one item, in the order of their IDs.
  struct Run {
    std::span<const Fragment> fragments;
    PrimitiveId first_id = 0;  ///< of the point with number 0
    int point_size = 1;
  };

  /// Forgets all fragments.
  void reset(std::size_t bins);

  /// Until end_run(), what is written are points of size `point_size`, number 0 of which is drawn
  /// as `first_id`.
  void begin_run(PrimitiveId first_id, int point_size);
  void end_run();

  /// Where each bin takes its next fragment. Who fills a block must call grow().
  [[nodiscard]] Fragment** cursors() { return cursors_.data(); }
  [[nodiscard]] static bool is_block_full(const Fragment* cursor) {
    return reinterpret_cast<std::uintptr_t>(cursor) % sizeof(Block) == 0;
  }
  /// Gives a bin whose block is full, up to `end`, a new one. @return its cursor
  Fragment* grow(std::size_t bin, const Fragment* end);

  [[nodiscard]] std::span<const Run> runs(std::size_t bin) const { return runs_[bin]; }
  /// Fragments in ended runs.
  [[nodiscard]] std::size_t size() const { return size_; }

 private:
  struct alignas(4096) Block {
    std::array<Fragment, 512> fragments;
  };
  static constexpr std::size_t kSlabBlocks = 256;

  Fragment* take_block();
  void close(std::size_t bin, const Fragment* end);

  std::vector<std::unique_ptr<Block[]>> slabs_;
  std::size_t blocks_used_ = 0;
  std::vector<Fragment*> cursors_;
  std::vector<const Fragment*> begins_;  ///< of each bin's present run
  std::vector<std::vector<Run>> runs_;
  PrimitiveId first_id_ = 0;
  int point_size_ = 1;
  std::size_t size_ = 0;
};

}  // namespace rangezip

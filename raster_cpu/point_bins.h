#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <memory>
#include <span>
#include <vector>

#include "core/raster/draw_item.h"

namespace rangezip {

/// A point in a bin, packed by who bins and unpacked by who draws.
using BinEntry = std::uint64_t;

/// Entries of one thread, sorted into bins while they are made: 8 bytes each, in blocks of a page
/// that a bin takes as it grows. The memory is kept from image to image.
class PointBins {
 public:
  /// Points of one item, in the order of their IDs.
  struct Run {
    std::span<const BinEntry> entries;
    PrimitiveId first_id = 0;  ///< of the point with number 0
    int point_size = 1;
  };

  /// Forgets all entries.
  void reset(std::size_t bins);

  /// For points that are to be drawn: until end_run(), they are of size `point_size`, and number 0
  /// is drawn as `first_id`. (Those that are to be summed have no numbers.)
  void begin_run(PrimitiveId first_id, int point_size);
  /// Puts what was written since the last call into runs.
  void end_run();

  /// Where each bin takes its next entry. Who fills a block must call grow().
  [[nodiscard]] BinEntry** cursors() { return cursors_.data(); }
  [[nodiscard]] static bool is_block_full(const BinEntry* cursor) {
    return reinterpret_cast<std::uintptr_t>(cursor) % sizeof(Block) == 0;
  }
  /// Gives a bin whose block is full, up to `end`, a new one. @return its cursor
  BinEntry* grow(std::size_t bin, const BinEntry* end);

  [[nodiscard]] std::span<const Run> runs(std::size_t bin) const { return runs_[bin]; }

 private:
  struct alignas(4096) Block {
    std::array<BinEntry, 512> entries;
  };
  static constexpr std::size_t kSlabBlocks = 256;

  BinEntry* take_block();
  void close(std::size_t bin, const BinEntry* end);

  std::vector<std::unique_ptr<Block[]>> slabs_;
  std::size_t blocks_used_ = 0;
  std::vector<BinEntry*> cursors_;
  std::vector<const BinEntry*> begins_;  ///< of each bin's present run
  std::vector<std::vector<Run>> runs_;
  PrimitiveId first_id_ = 0;
  int point_size_ = 1;
};

}  // namespace rangezip

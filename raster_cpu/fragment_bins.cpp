#include "raster_cpu/fragment_bins.h"

#include <cassert>

namespace rangezip {

BandLayout make_band_layout(Extent extent, int point_size) {
  constexpr std::size_t kWantedPixels = std::size_t{1} << 16;
  BandLayout layout{.extent = extent, .margin = point_size - 1, .rows_log2 = 0};
  const auto next = [&] {
    BandLayout higher = layout;
    ++higher.rows_log2;
    return higher;
  };
  // High bands where the margin is wide: points that hang over are drawn twice.
  while (layout.rows() < 4 * layout.margin || next().tile_pixels() <= kWantedPixels) {
    if (layout.rows() >= extent.height) break;
    layout = next();
  }
  assert(layout.tile_pixels() <= kMaxTilePixels);
  return layout;
}

void FragmentBins::reset(std::size_t bins) {
  blocks_used_ = 0;
  size_ = 0;
  cursors_.resize(bins);
  begins_.resize(bins);
  runs_.resize(bins);
  for (std::size_t bin = 0; bin < bins; ++bin) {
    runs_[bin].clear();
    begins_[bin] = cursors_[bin] = take_block();
  }
}

void FragmentBins::begin_run(PrimitiveId first_id, int point_size) {
  first_id_ = first_id;
  point_size_ = point_size;
}

void FragmentBins::end_run() {
  for (std::size_t bin = 0; bin < cursors_.size(); ++bin) {
    close(bin, cursors_[bin]);
    begins_[bin] = cursors_[bin];
  }
}

Fragment* FragmentBins::grow(std::size_t bin, const Fragment* end) {
  close(bin, end);
  begins_[bin] = cursors_[bin] = take_block();
  return cursors_[bin];
}

Fragment* FragmentBins::take_block() {
  if (blocks_used_ == slabs_.size() * kSlabBlocks)
    slabs_.push_back(std::make_unique_for_overwrite<Block[]>(kSlabBlocks));
  const std::size_t block = blocks_used_++;
  return slabs_[block / kSlabBlocks][block % kSlabBlocks].fragments.data();
}

void FragmentBins::close(std::size_t bin, const Fragment* end) {
  if (end == begins_[bin]) return;
  const std::span fragments(begins_[bin], end);
  runs_[bin].push_back({.fragments = fragments, .first_id = first_id_, .point_size = point_size_});
  size_ += fragments.size();
}

}  // namespace rangezip

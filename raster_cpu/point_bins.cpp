#include "raster_cpu/point_bins.h"

namespace rangezip {

void PointBins::reset(std::size_t bins) {
  blocks_used_ = 0;
  cursors_.resize(bins);
  begins_.resize(bins);
  runs_.resize(bins);
  for (std::size_t bin = 0; bin < bins; ++bin) {
    runs_[bin].clear();
    begins_[bin] = cursors_[bin] = take_block();
  }
}

void PointBins::begin_run(PrimitiveId first_id, int point_size) {
  first_id_ = first_id;
  point_size_ = point_size;
}

void PointBins::end_run() {
  for (std::size_t bin = 0; bin < cursors_.size(); ++bin) {
    close(bin, cursors_[bin]);
    begins_[bin] = cursors_[bin];
  }
}

BinEntry* PointBins::grow(std::size_t bin, const BinEntry* end) {
  close(bin, end);
  begins_[bin] = cursors_[bin] = take_block();
  return cursors_[bin];
}

BinEntry* PointBins::take_block() {
  if (blocks_used_ == slabs_.size() * kSlabBlocks)
    slabs_.push_back(std::make_unique_for_overwrite<Block[]>(kSlabBlocks));
  const std::size_t block = blocks_used_++;
  return slabs_[block / kSlabBlocks][block % kSlabBlocks].entries.data();
}

void PointBins::close(std::size_t bin, const BinEntry* end) {
  if (end == begins_[bin]) return;
  const std::span entries(begins_[bin], end);
  runs_[bin].push_back({.entries = entries, .first_id = first_id_, .point_size = point_size_});
}

}  // namespace rangezip

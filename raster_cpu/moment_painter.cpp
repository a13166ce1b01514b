#include "raster_cpu/moment_painter.h"

#include <algorithm>
#include <numeric>

#include "core/base/parallel.h"
#include "raster_cpu/moment_cell.h"

namespace rangezip {

MomentPainter::MomentPainter(const View& view, const AccumulateWindow& window,
                             const SimdKernels* kernels, MomentMemory& memory,
                             Grid<PixelMoments>& out)
    : view_(view), kernels_(kernels), memory_(memory) {
  const Extent extent = view.extent();
  out.reset(extent);
  memory.counts.assign(extent.count(), 0);
  target_ = {.extent = extent, .window = &window, .moments = out.pixels(), .counts = memory.counts};
}

DrawReport MomentPainter::draw(std::span<const DrawItem> items) {
  if (kernels_ != nullptr) {
    memory_.bins.resize(static_cast<std::size_t>(thread_count()));
    for (PointBins& bins : memory_.bins)
      bins.reset(cell_bins(target_.extent));
  }
  for (const DrawItem& item : items) {
    const auto* points = std::get_if<DrawPoints>(&item);
    if (points == nullptr) continue;
    const RowTransform rows = make_row_transform(view_, points->world_from_item);
    kernels_ != nullptr ? add_binned(*points, rows) : add_plainly(*points, rows);
  }
  if (pending_ > 0) draw_bins();
  return report_;
}

/// Calls add(rows) for rows of pixels that lie in the bins' rows of cells.
template <class Add>
void MomentPainter::for_each_share_of_rows(const Add& add) const {
  const auto height = static_cast<std::size_t>(target_.extent.height);
  const auto threads = static_cast<std::size_t>(thread_count());
  const std::size_t share = (height + threads - 1) / threads;
  const std::size_t grain = (share + kCellRows - 1) / kCellRows * kCellRows;
  parallel_for(height, grain, [&](std::size_t begin, std::size_t end) {
    add(PixelRange{static_cast<int>(begin), static_cast<int>(end) - 1});
  });
}

void MomentPainter::add_plainly(const DrawPoints& points, const RowTransform& rows) {
  constexpr std::size_t kChunk = std::size_t{1} << 16;
  for (std::size_t at = 0; at < points.positions.size(); at += kChunk) {
    const auto positions =
        points.positions.subspan(at, std::min(kChunk, points.positions.size() - at));
    memory_.snapped.resize(positions.size());
    report_.dropped_points += snap_positions(rows, positions, memory_.snapped);
    reject_clipped(rows, positions, memory_.snapped);
    for_each_share_of_rows([&](PixelRange share) {
      for (std::size_t i = 0; i < positions.size(); ++i) {
        if (is_rejected(memory_.snapped[i])) continue;
        const int vote = points.votes.empty() ? 0 : points.votes[at + i];
        add_moments(memory_.snapped[i], vote, share, target_);
      }
    });
  }
}

void MomentPainter::add_binned(const DrawPoints& points, const RowTransform& rows) {
  // At 8 bytes a point, as much memory as the sums take.
  const std::size_t capacity =
      std::max(memory_.batch, target_.extent.count() * sizeof(PixelMoments) / sizeof(BinEntry));
  const std::size_t parts = memory_.bins.size();
  for (std::size_t at = 0; at < points.positions.size();) {
    if (pending_ == capacity) draw_bins();
    const std::size_t count = std::min(capacity - pending_, points.positions.size() - at);
    std::vector<std::size_t> rejected(parts);
    parallel_for(parts, 1, [&](std::size_t first, std::size_t last) {
      for (std::size_t part = first; part < last; ++part) {
        const std::size_t from = at + count * part / parts;
        const std::size_t size = at + count * (part + 1) / parts - from;
        const auto votes = points.votes.empty() ? points.votes : points.votes.subspan(from, size);
        rejected[part] = kernels_->bin_moments(rows, points.positions.subspan(from, size), votes,
                                               target_.extent, memory_.bins[part]);
        memory_.bins[part].end_run();
      }
    });
    report_.dropped_points += std::reduce(rejected.begin(), rejected.end());
    pending_ += count;
    at += count;
  }
}

void MomentPainter::draw_bins() {
  for_each_share_of_rows([&](PixelRange rows) {
    // Cells of row y count for the pixel rows y - 1 and y.
    for (int bin = rows.first / kCellRows; bin <= (rows.last + 1) / kCellRows; ++bin) {
      const auto number = static_cast<std::size_t>(bin);
      for (const PointBins& bins : memory_.bins) {
        for (const PointBins::Run& run : bins.runs(number))
          kernels_->add_moments(run.entries, number, rows, target_);
      }
    }
  });
  for (PointBins& bins : memory_.bins)
    bins.reset(cell_bins(target_.extent));
  pending_ = 0;
}

}  // namespace rangezip

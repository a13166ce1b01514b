#include "raster_cpu/binned_points.h"

#include <algorithm>
#include <atomic>
#include <numeric>

#include "core/base/parallel.h"
#include "raster_cpu/unpack.h"

namespace rangezip {

void BinnedPoints::begin(Extent extent, int largest, const DepthBand* depths,
                         const SimdKernels& kernels) {
  kernels_ = &kernels;
  depths_ = depths;
  layout_ = make_band_layout(extent, largest);
  const auto threads = static_cast<std::size_t>(thread_count());
  bins_.resize(threads);
  tiles_.resize(threads);
  forget();
}

void BinnedPoints::forget() {
  pending_ = 0;
  for (PointBins& bins : bins_)
    bins.reset(static_cast<std::size_t>(layout_.count()));
}

std::size_t BinnedPoints::room() const {
  return std::min(kMaxRun, std::max(batch_, layout_.extent.count()) - pending_);
}

std::size_t BinnedPoints::add(const DrawPoints& points, const RowTransform& rows, std::size_t begin,
                              std::size_t end) {
  const std::size_t parts = bins_.size();
  std::vector<std::size_t> rejected(parts);
  parallel_for(parts, 1, [&](std::size_t first, std::size_t last) {
    for (std::size_t part = first; part < last; ++part) {
      const std::size_t from = begin + (end - begin) * part / parts;
      const std::size_t to = begin + (end - begin) * (part + 1) / parts;
      bins_[part].begin_run(points.first_id + static_cast<PrimitiveId>(from), points.point_size);
      rejected[part] = kernels_->bin_points(rows, points.positions.subspan(from, to - from),
                                            points.point_size, layout_, bins_[part]);
      bins_[part].end_run();
    }
  });
  pending_ += end - begin;
  return std::reduce(rejected.begin(), rejected.end());
}

template <class Store>
void BinnedPoints::draw_bands(std::span<const PixelKey> under, const Store& store) {
  std::atomic<int> next{0};
  parallel_for(tiles_.size(), 1, [&](std::size_t first, std::size_t last) {
    for (std::size_t part = first; part < last; ++part) {
      Tile& tile = tiles_[part];
      for (int band = next++; band < layout_.count(); band = next++) {
        tile.load(layout_, band, under, depths_);
        for (const PointBins& bins : bins_)
          kernels_->draw_fragments(bins.runs(static_cast<std::size_t>(band)), tile);
        store(tile);
      }
    }
  });
  forget();
}

void BinnedPoints::draw(std::span<const PixelKey> under, std::span<PixelKey> out) {
  draw_bands(under, [&](const Tile& tile) { tile.store(out); });
}

void BinnedPoints::draw(std::span<const PixelKey> under, Framebuffer& out) {
  set_extent(out, layout_.extent);
  draw_bands(under, [&](const Tile& tile) {
    tile.unpack([&](std::span<const PixelKey> keys, std::size_t first) {
      unpack_into_image(keys, first, kernels_, out);
    });
  });
}

}  // namespace rangezip

#include "raster_cpu/scene_painter.h"

#include <algorithm>
#include <array>
#include <functional>
#include <numeric>

#include "core/base/parallel.h"
#include "raster_cpu/point_raster.h"
#include "raster_cpu/triangle_raster.h"
#include "raster_cpu/unpack.h"

namespace rangezip {

/// How one item is drawn.
struct ScenePainter::Step {
  const DrawItem* item = nullptr;
  RowTransform rows;
  bool is_binned = false;
};

namespace {

/// In how many layers so many primitives are drawn. A layer must be worth its clearing and merging.
/// Their number cannot show: the minimum of the keys does not depend on the order (R9).
std::size_t layer_count(std::size_t primitives, Extent extent) {
  constexpr std::size_t kLeastPrimitives = std::size_t{1} << 16;
  const std::size_t worthwhile = primitives / std::max(kLeastPrimitives, extent.count() / 2);
  return std::clamp<std::size_t>(worthwhile, 1, static_cast<std::size_t>(thread_count()));
}

std::size_t blocks_in(std::size_t count, std::size_t grain) {
  return (count + grain - 1) / grain;
}

/// R2-R4 and R11. @return number rejected by R3 or R4
std::size_t snap(const RowTransform& rows, std::span<const Vec3f> positions,
                 std::span<SnappedPosition> snapped, const SimdKernels* kernels) {
  KernelReport done;
  if (kernels != nullptr) done = kernels->snap(rows, positions, snapped);
  const auto from = positions.subspan(done.processed);
  const auto to = snapped.subspan(done.processed);
  done.rejected += snap_positions(rows, from, to);
  reject_clipped(rows, from, to);
  return done.rejected;
}

/// The same by several threads.
std::size_t snap_in_parallel(const RowTransform& rows, std::span<const Vec3f> positions,
                             std::span<SnappedPosition> snapped, const SimdKernels* kernels) {
  constexpr std::size_t kGrain = std::size_t{1} << 14;
  std::vector<std::size_t> rejected(blocks_in(positions.size(), kGrain));
  parallel_for(positions.size(), kGrain, [&](std::size_t begin, std::size_t end) {
    const auto from = positions.subspan(begin, end - begin);
    const auto to = snapped.subspan(begin, end - begin);
    rejected[begin / kGrain] = snap(rows, from, to, kernels);
  });
  return std::reduce(rejected.begin(), rejected.end());
}

constexpr std::size_t kBlock = 512;  ///< pixels whose keys stay in the first-level cache

/// Calls work(first pixel, number of pixels) for all blocks of an image, by several threads.
template <class Work>
void for_each_block(std::size_t pixels, const Work& work) {
  constexpr std::size_t kGrain = std::size_t{1} << 16;
  parallel_for(pixels, kGrain, [&](std::size_t begin, std::size_t end) {
    for (std::size_t at = begin; at < end; at += kBlock)
      work(at, std::min(kBlock, end - at));
  });
}

/// Keeps the smaller key of every pixel in `onto`, and empties those of the layer, from `at` on.
/// Where nothing was drawn, as on most of the layer of a part of a mesh, it only looks.
void merge_and_empty(std::span<PixelKey> onto, KeyLayer& layer, std::size_t at) {
  const std::span<PixelKey> from = std::span(layer.keys).subspan(at, onto.size());
  if (std::reduce(from.begin(), from.end(), kEmptyPixel, std::bit_and<>()) == kEmptyPixel) return;
  merge_keys(onto, from);
  std::ranges::fill(from, kEmptyPixel);
}

}  // namespace

ScenePainter::ScenePainter(const View& view, const DepthBand* depths, const SimdKernels* kernels,
                           PainterMemory& memory)
    : view_(view), depths_(depths), kernels_(kernels), memory_(memory) {}

std::vector<ScenePainter::Step> ScenePainter::plan(std::span<const DrawItem> items) const {
  // An image whose keys the second-level cache holds needs no bins, and few points are not worth
  // them; but squares are drawn faster in tiles, where nothing is clipped.
  constexpr std::size_t kCachedPixels = std::size_t{1} << 16;
  constexpr std::size_t kLeastPoints = 128;
  std::vector<Step> steps;
  for (const DrawItem& item : items) {
    Step& step = steps.emplace_back();
    step.item = &item;
    step.rows = std::visit(
        [&](const auto& i) { return make_row_transform(view_, i.world_from_item); }, item);
    const auto* points = std::get_if<DrawPoints>(&item);
    if (points == nullptr || kernels_ == nullptr || points->point_size > kMaxBinnedSize ||
        points->positions.size() < kLeastPoints) {
      continue;
    }
    step.is_binned =
        points->point_size > 1 || (view_.extent().count() > kCachedPixels &&
                                   !neighbours_fall_close(step.rows, points->positions));
  }
  return steps;
}

DrawReport ScenePainter::draw(std::span<const DrawItem> items, Framebuffer& out) {
  const std::vector<Step> steps = plan(items);
  std::size_t layered = 0;
  int largest = 0;
  for (const Step& step : steps) {
    if (step.is_binned) {
      largest = std::max(largest, std::get<DrawPoints>(*step.item).point_size);
    } else {
      layered += primitive_count(*step.item);
    }
  }
  if (layered > 0 || largest == 0) begin_layers(layer_count(layered, view_.extent()));
  for (const Step& step : steps) {
    if (!step.is_binned) draw_layered(step);
  }
  if (largest == 0) {
    unpack_layers(out);
    return report_;
  }
  memory_.binned.begin(view_.extent(), largest, depths_, *kernels_);
  for (const Step& step : steps) {
    if (step.is_binned) bin_points(std::get<DrawPoints>(*step.item), step.rows);
  }
  memory_.binned.draw(merge_layers(), out);
  return report_;
}

void ScenePainter::draw_layered(const Step& step) {
  if (const auto* triangles = std::get_if<DrawTriangles>(step.item)) {
    draw_triangles(*triangles, step.rows);
  } else {
    draw_points(std::get<DrawPoints>(*step.item), step.rows);
  }
}

void ScenePainter::begin_layers(std::size_t count) {
  layers_ = count;
  auto& layers = memory_.layers;
  layers.resize(std::max(layers.size(), count));
  const std::size_t keys = view_.extent().count() + kKeyPadding;
  parallel_for(count, 1, [&](std::size_t first, std::size_t last) {
    for (KeyLayer& layer : std::span(layers).subspan(first, last - first)) {
      if (!layer.is_empty) layer.keys.clear();
      layer.keys.resize(std::max(layer.keys.size(), keys), kEmptyPixel);
      layer.is_empty = false;
    }
  });
}

/// All layers as one; empty if there is none.
std::span<const PixelKey> ScenePainter::merge_layers() {
  if (layers_ == 0) return {};
  const std::span<PixelKey> merged(memory_.layers[0].keys.data(), view_.extent().count());
  for_each_block(merged.size(), [&](std::size_t at, std::size_t count) {
    for (std::size_t layer = 1; layer < layers_; ++layer)
      merge_and_empty(merged.subspan(at, count), memory_.layers[layer], at);
  });
  end_layers(1);
  layers_ = 1;
  return merged;
}

/// merge_layers() and unpack_keys() in one, after which the layers are empty.
void ScenePainter::unpack_layers(Framebuffer& out) {
  set_extent(out, view_.extent());
  for_each_block(view_.extent().count(), [&](std::size_t at, std::size_t count) {
    std::array<PixelKey, kBlock> block;
    const std::span<PixelKey> merged = std::span(block).first(count);
    std::ranges::fill(merged, kEmptyPixel);
    for (std::size_t layer = 0; layer < layers_; ++layer)
      merge_and_empty(merged, memory_.layers[layer], at);
    unpack_into_image(merged, at, kernels_, out);
  });
  end_layers(0);
}

/// The layers from `first` on are empty again.
void ScenePainter::end_layers(std::size_t first) {
  for (KeyLayer& layer : std::span(memory_.layers).subspan(first, layers_ - first))
    layer.is_empty = true;
}

/// Draws the k-th part of `count` primitives into the k-th layer. @return what was dropped
template <class Draw>
std::size_t ScenePainter::draw_parts(std::size_t count, const Draw& draw) {
  std::vector<std::size_t> dropped(layers_);
  parallel_for(layers_, 1, [&](std::size_t first, std::size_t last) {
    for (std::size_t layer = first; layer < last; ++layer) {
      const DrawTarget target{
          .extent = view_.extent(),
          .keys = std::span(memory_.layers[layer].keys).first(view_.extent().count()),
          .band = depths_};
      dropped[layer] = draw(count * layer / layers_, count * (layer + 1) / layers_, target);
    }
  });
  return std::reduce(dropped.begin(), dropped.end());
}

void ScenePainter::draw_points(const DrawPoints& points, const RowTransform& rows) {
  report_.dropped_points += draw_parts(
      points.positions.size(), [&](std::size_t begin, std::size_t end, const DrawTarget& target) {
        return rangezip::draw_points(points, rows, begin, end, target, kernels_);
      });
}

void ScenePainter::draw_triangles(const DrawTriangles& item, const RowTransform& rows) {
  auto& scratch = memory_.snapped;
  if (scratch.size() < item.positions.size()) scratch.resize(item.positions.size());
  const auto snapped = std::span(scratch).first(item.positions.size());
  snap_in_parallel(rows, item.positions, snapped, kernels_);
  report_.dropped_triangles += draw_parts(
      item.triangles.size(), [&](std::size_t begin, std::size_t end, const DrawTarget& target) {
        return rangezip::draw_triangles(item, rows, snapped, begin, end, target, kernels_);
      });
}

void ScenePainter::bin_points(const DrawPoints& points, const RowTransform& rows) {
  BinnedPoints& binned = memory_.binned;
  for (std::size_t at = 0; at < points.positions.size();) {
    if (binned.room() == 0) flush_bins();
    const std::size_t count = std::min(binned.room(), points.positions.size() - at);
    report_.dropped_points += binned.add(points, rows, at, at + count);
    at += count;
  }
}

/// Draws what is in the bins into the first layer.
void ScenePainter::flush_bins() {
  const std::span<const PixelKey> under = merge_layers();
  if (layers_ == 0) begin_layers(1);
  memory_.binned.draw(under, memory_.layers[0].keys);
}

}  // namespace rangezip

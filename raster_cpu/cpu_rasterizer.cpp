#include "raster_cpu/cpu_rasterizer.h"

#include <algorithm>
#include <vector>

#include "core/base/error.h"
#include "core/base/parallel.h"
#include "raster_cpu/fixed_point.h"
#include "raster_cpu/point_moments.h"
#include "raster_cpu/scene_painter.h"
#include "raster_cpu/simd_kernels.h"

namespace rangezip {

namespace {

constexpr std::string_view kScalar = "scalar";

std::size_t blocks_in(std::size_t count, std::size_t grain) {
  return (count + grain - 1) / grain;
}

}  // namespace

/// Memory that is kept from call to call.
struct CpuRasterizer::Workspace {
  PainterMemory painter;
  std::vector<std::uint32_t> counts;
  RowBins bins;
};

std::vector<std::string> cpu_instructions() {
  std::vector<std::string> names;
  for (const SimdKernels& kernels : simd_kernels())
    names.push_back(kernels.name);
  names.emplace_back(kScalar);
  return names;
}

CpuRasterizer::CpuRasterizer() : CpuRasterizer(cpu_instructions().front()) {}

CpuRasterizer::CpuRasterizer(std::string_view instructions)
    : workspace_(std::make_unique<Workspace>()) {
  if (instructions == kScalar) return;
  for (const SimdKernels& kernels : simd_kernels()) {
    if (kernels.name == instructions) kernels_ = &kernels;
  }
  if (kernels_ == nullptr) {
    throw InvalidArgument("CpuRasterizer: this machine has no instructions named \"" +
                          std::string(instructions) + "\"");
  }
}

CpuRasterizer::~CpuRasterizer() = default;

RasterizerInfo CpuRasterizer::info() const {
  return {.name = "cpu",
          .max_extent = {kMaxRasterExtent, kMaxRasterExtent},
          .max_point_size = kMaxPointSize,
          .subpixel_bits = kSubpixelBits,
          .reproducible = true};
}

DrawReport CpuRasterizer::draw(const View& view, std::span<const DrawItem> items,
                               const DepthBand* band, Framebuffer& out) {
  return ScenePainter(view, band, kernels_, workspace_->painter).draw(items, out);
}

DrawReport CpuRasterizer::do_render(const View& view, std::span<const DrawItem> items,
                                    Framebuffer& out) {
  return draw(view, items, nullptr, out);
}

DrawReport CpuRasterizer::do_render_in_band(const View& view, std::span<const DrawItem> items,
                                            const DepthBand& band, Framebuffer& out) {
  return draw(view, items, &band, out);
}

DrawReport CpuRasterizer::do_accumulate(const View& view, std::span<const DrawItem> items,
                                        const AccumulateWindow& window, Grid<PixelMoments>& out) {
  const Extent extent = view.extent();
  out.reset(extent);
  workspace_->counts.assign(extent.count(), 0);
  const MomentTarget target{
      .extent = extent, .window = &window, .moments = out.pixels(), .counts = workspace_->counts};
  // Private sums per thread would cost 80 bytes a pixel each. Instead all threads snap a chunk of
  // points, which are sorted by rows of pixels, and then each thread adds to rows of its own.
  constexpr std::size_t kChunk = std::size_t{1} << 20;
  const auto bins = blocks_in(static_cast<std::size_t>(extent.height), RowBins::kRows);
  const std::size_t bins_per_thread = blocks_in(bins, static_cast<std::size_t>(thread_count()));
  DrawReport report;
  for (const DrawItem& item : items) {
    const auto* points = std::get_if<DrawPoints>(&item);
    if (points == nullptr) continue;
    const RowTransform rows = make_row_transform(view, points->world_from_item);
    for (std::size_t at = 0; at < points->positions.size(); at += kChunk) {
      const std::size_t count = std::min(kChunk, points->positions.size() - at);
      workspace_->painter.snapped.resize(std::max(workspace_->painter.snapped.size(), count));
      const auto snapped = std::span(workspace_->painter.snapped).first(count);
      report.dropped_points +=
          snap_in_parallel(rows, points->positions.subspan(at, count), snapped, kernels_);
      const auto votes = points->votes.empty() ? points->votes : points->votes.subspan(at, count);
      workspace_->bins.fill(snapped, votes, extent);
      parallel_for(bins, bins_per_thread, [&](std::size_t begin, std::size_t end) {
        const int first = static_cast<int>(begin) * RowBins::kRows;
        const int last = std::min(static_cast<int>(end) * RowBins::kRows, extent.height);
        const bool has_vectors = kernels_ != nullptr && kernels_->add_moments != nullptr;
        const auto add = has_vectors ? kernels_->add_moments : &add_moments;
        add(workspace_->bins.touching(first, last), {first, last - 1}, target);
      });
    }
  }
  return report;
}

}  // namespace rangezip

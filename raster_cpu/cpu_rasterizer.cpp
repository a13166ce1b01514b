#include "raster_cpu/cpu_rasterizer.h"

#include <vector>

#include "core/base/error.h"
#include "raster_cpu/fixed_point.h"
#include "raster_cpu/moment_painter.h"
#include "raster_cpu/scene_painter.h"
#include "raster_cpu/simd_kernels.h"

namespace rangezip {

namespace {

constexpr std::string_view kScalar = "scalar";

}  // namespace

/// Memory that is kept from call to call.
struct CpuRasterizer::Workspace {
  PainterMemory painter;
  MomentMemory moments;
};

std::vector<std::string> cpu_instructions() {
  std::vector<std::string> names;
  for (const SimdKernels& kernels : simd_kernels())
    names.push_back(kernels.name);
  names.emplace_back(kScalar);
  return names;
}

CpuRasterizer::CpuRasterizer() : CpuRasterizer(cpu_instructions().front()) {}

CpuRasterizer::CpuRasterizer(std::string_view instructions, std::size_t batch)
    : workspace_(std::make_unique<Workspace>()) {
  if (batch == 0) throw InvalidArgument("CpuRasterizer: batch must be at least 1");
  workspace_->painter.binned.set_batch(batch);
  workspace_->moments.batch = batch;
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
  return MomentPainter(view, window, kernels_, workspace_->moments, out).draw(items);
}

}  // namespace rangezip

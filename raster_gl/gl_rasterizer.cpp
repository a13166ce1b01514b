#include "raster_gl/gl_rasterizer.h"

#include <algorithm>
#include <utility>

#include "raster_gl/compute_moments.h"
#include "raster_gl/compute_painter.h"

namespace rangezip {

namespace {

ComputeSetup setup_of(const GlDevice& device, const GlOptions& options) {
  const std::size_t most = device.block_bytes();
  return {.block_bytes = options.block_bytes == 0 ? most : std::min(options.block_bytes, most),
          .has_atomic_int64 = device.has_atomic_int64()};
}

}  // namespace

/// Everything that lives in the context.
struct GlRasterizer::State {
  GlDevice device;
  Kernels kernels{device};
  UploadCache uploads;
  ComputeTools tools;
  ComputePainter painter{tools};
  ComputeMoments moments{tools};

  State(const CurrentContext& current, const GlOptions& options)
      : device(current),
        uploads(device, options.cache_bytes),
        tools{device, kernels, uploads, setup_of(device, options)} {}
};

GlRasterizer::GlRasterizer(std::unique_ptr<GlContext> context, const GlOptions& options)
    : context_(std::move(context)) {
  const CurrentContext current(*context_);
  state_ = std::make_unique<State>(current, options);
}

GlRasterizer::~GlRasterizer() {
  const CurrentContext current(*context_);
  state_.reset();
}

RasterizerInfo GlRasterizer::info() const {
  return {.name = "gl:" + context_->name() + ", " + state_->device.renderer(),
          .max_extent = {kMaxRasterExtent, kMaxRasterExtent},
          .max_point_size = kMaxPointSize,
          .subpixel_bits = 8,
          .reproducible = true};
}

std::size_t GlRasterizer::uploads() const {
  return state_->uploads.uploads();
}

DrawReport GlRasterizer::do_render(const View& view, std::span<const DrawItem> items,
                                   Framebuffer& out) {
  const CurrentContext current(*context_);
  return state_->painter.draw(view, items, nullptr, out);
}

DrawReport GlRasterizer::do_render_in_band(const View& view, std::span<const DrawItem> items,
                                           const DepthBand& band, Framebuffer& out) {
  const CurrentContext current(*context_);
  return state_->painter.draw(view, items, &band, out);
}

DrawReport GlRasterizer::do_accumulate(const View& view, std::span<const DrawItem> items,
                                       const AccumulateWindow& window, Grid<PixelMoments>& out) {
  const CurrentContext current(*context_);
  return state_->moments.add(view, items, window, out);
}

}  // namespace rangezip

#include "raster_gl/gl_rasterizer.h"

#include <algorithm>
#include <utility>
#include <vector>

#include "core/base/error.h"
#include "raster_gl/compute_moments.h"
#include "raster_gl/compute_painter.h"
#include "raster_gl/self_test.h"

namespace rangezip {

namespace {

/// The ways to compute the rules, the fastest first; which of them a driver does right, a test
/// tells.
std::vector<ComputeSetup> setups_for(const GlDevice& device, const GlOptions& options) {
  const std::size_t most = device.block_bytes();
  const std::size_t bytes = options.block_bytes == 0 ? most : std::min(options.block_bytes, most);
  std::vector<ComputeSetup> setups;
  for (const bool wide_rows : {false, true}) {
    if (options.wide_rows && !wide_rows) continue;
    for (const bool has_atomic_int64 : {true, false}) {
      if (has_atomic_int64 && !device.has_atomic_int64()) continue;
      setups.push_back({bytes, has_atomic_int64, wide_rows});
    }
  }
  return setups;
}

/// One way of drawing in a context.
struct Painters {
  ComputeTools tools;
  ComputePainter painter{tools};
  ComputeMoments moments{tools};
};

/// Everything that lives in the context.
struct Objects {
  GlDevice device;
  Kernels kernels{device};
  UploadCache uploads;
  std::unique_ptr<Painters> painters;

  Objects(const CurrentContext& current, const GlOptions& options)
      : device(current), uploads(device, options.cache_bytes) {}

  void use(const ComputeSetup& setup) {
    painters = std::make_unique<Painters>(ComputeTools{device, kernels, uploads, setup});
  }
};

}  // namespace

struct GlRasterizer::State {
  std::unique_ptr<GlContext> context;
  std::unique_ptr<Objects> objects;

  State(std::unique_ptr<GlContext> owned, const GlOptions& options) : context(std::move(owned)) {
    const CurrentContext current(*context);
    objects = std::make_unique<Objects>(current, options);
  }
  ~State() {
    try {
      const CurrentContext current(*context);
      objects.reset();
    } catch (const BackendError&) {
      // A context that is lost takes its objects along.
      static_cast<void>(objects.release());
    }
  }
  State(const State&) = delete;
  State& operator=(const State&) = delete;

  void use(const ComputeSetup& setup) const {
    const CurrentContext current(*context);
    objects->use(setup);
  }
};

GlRasterizer::GlRasterizer(std::unique_ptr<GlContext> context, const GlOptions& options)
    : state_(std::make_unique<State>(std::move(context), options)) {
  std::string broken;
  for (const ComputeSetup& setup : setups_for(state_->objects->device, options)) {
    state_->use(setup);
    const auto rule = find_broken_rule(*this);
    if (!rule) return;
    broken = *rule;
  }
  throw BackendError("OpenGL (" + state_->objects->device.renderer() + ") breaks rule " + broken);
}

GlRasterizer::~GlRasterizer() = default;

RasterizerInfo GlRasterizer::info() const {
  return {.name = "gl:" + state_->context->name() + ", " + state_->objects->device.renderer(),
          .max_extent = {kMaxRasterExtent, kMaxRasterExtent},
          .max_point_size = kMaxPointSize,
          .subpixel_bits = 8,
          .reproducible = true};
}

std::size_t GlRasterizer::uploads() const {
  return state_->objects->uploads.uploads();
}

DrawReport GlRasterizer::do_render(const View& view, std::span<const DrawItem> items,
                                   Framebuffer& out) {
  const CurrentContext current(*state_->context);
  return state_->objects->painters->painter.draw(view, items, nullptr, out);
}

DrawReport GlRasterizer::do_render_in_band(const View& view, std::span<const DrawItem> items,
                                           const DepthBand& band, Framebuffer& out) {
  const CurrentContext current(*state_->context);
  return state_->objects->painters->painter.draw(view, items, &band, out);
}

DrawReport GlRasterizer::do_accumulate(const View& view, std::span<const DrawItem> items,
                                       const AccumulateWindow& window, Grid<PixelMoments>& out) {
  const CurrentContext current(*state_->context);
  return state_->objects->painters->moments.add(view, items, window, out);
}

}  // namespace rangezip

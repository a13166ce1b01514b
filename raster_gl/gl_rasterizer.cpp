#include "raster_gl/gl_rasterizer.h"

#include <algorithm>
#include <utility>
#include <variant>
#include <vector>

#include "core/base/error.h"
#include "raster_gl/compute_moments.h"
#include "raster_gl/compute_painter.h"
#include "raster_gl/fixed_painter.h"
#include "raster_gl/native_painter.h"
#include "raster_gl/self_test.h"

namespace rangezip {

namespace {

/// A way to draw.
struct Candidate {
  GlStrategy strategy = GlStrategy::compute;
  ComputeSetup setup;
};

/// The ways to draw by a strategy, the fastest first; which of them a driver does right, a test
/// tells.
void add_candidates(const GlDevice& device, const GlOptions& options, GlStrategy strategy,
                    std::vector<Candidate>& candidates) {
  const std::size_t most = device.block_bytes();
  const std::size_t bytes = options.block_bytes == 0 ? most : std::min(options.block_bytes, most);
  for (const bool wide_rows : {false, true}) {
    if (options.wide_rows && !wide_rows) continue;
    for (const bool has_atomic_int64 : {true, false}) {
      if (has_atomic_int64 && !device.has_atomic_int64()) continue;
      candidates.push_back({strategy, {bytes, has_atomic_int64, wide_rows}});
    }
  }
}

std::vector<Candidate> candidates_for(const GlDevice& device, const GlOptions& options) {
  std::vector<Candidate> candidates;
  if (options.strategy != GlStrategy::automatic) {
    add_candidates(device, options, options.strategy, candidates);
    return candidates;
  }
  add_candidates(device, options, GlStrategy::compute, candidates);
  add_candidates(device, options, GlStrategy::fixed_function, candidates);
  return candidates;
}

using Painter = std::variant<ComputePainter, FixedPainter, NativePainter>;

/// One way to draw, at work.
struct Painters {
  GlStrategy strategy;
  ComputeTools tools;
  ComputeMoments moments{tools};
  std::unique_ptr<Painter> painter;

  explicit Painters(GlStrategy chosen, const ComputeTools& shared)
      : strategy(chosen), tools(shared) {
    switch (strategy) {
      case GlStrategy::automatic:
      case GlStrategy::compute:
        painter = std::make_unique<Painter>(std::in_place_type<ComputePainter>, tools);
        return;
      case GlStrategy::fixed_function:
        painter = std::make_unique<Painter>(std::in_place_type<FixedPainter>, tools);
        return;
      case GlStrategy::native:
        painter = std::make_unique<Painter>(std::in_place_type<NativePainter>, tools);
        return;
    }
  }
};

/// Everything that lives in the context.
struct Objects {
  GlDevice device;
  Kernels kernels{device};
  UploadCache uploads;
  std::unique_ptr<Painters> painters;

  Objects(const CurrentContext& current, const GlOptions& options)
      : device(current, options.phase_observer), uploads(device, options.cache_bytes) {}

  void use(const Candidate& candidate) {
    painters = std::make_unique<Painters>(candidate.strategy,
                                          ComputeTools{device, kernels, uploads, candidate.setup});
  }
};

}  // namespace

std::string name_of(GlStrategy strategy) {
  switch (strategy) {
    case GlStrategy::automatic:
      return "automatic";
    case GlStrategy::compute:
      return "compute";
    case GlStrategy::fixed_function:
      return "fixed_function";
    case GlStrategy::native:
      break;
  }
  return "native";
}

GlStrategy gl_strategy(const std::string& name) {
  std::string known;
  for (const GlStrategy strategy : {GlStrategy::automatic, GlStrategy::compute,
                                    GlStrategy::fixed_function, GlStrategy::native}) {
    if (name == name_of(strategy)) return strategy;
    known += (known.empty() ? "" : ", ") + name_of(strategy);
  }
  throw InvalidArgument("gl_strategy: there is no strategy '" + name + "'; known: " + known);
}

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

  void use(const Candidate& candidate) const {
    const CurrentContext current(*context);
    objects->use(candidate);
  }

  DrawReport draw(const View& view, std::span<const DrawItem> items, const DepthBand* band,
                  Framebuffer& out) const {
    const CurrentContext current(*context);
    return std::visit([&](auto& painter) { return painter.draw(view, items, band, out); },
                      *objects->painters->painter);
  }
};

GlRasterizer::GlRasterizer(std::unique_ptr<GlContext> context, const GlOptions& options)
    : state_(std::make_unique<State>(std::move(context), options)) {
  const GlDevice& device = state_->objects->device;
  std::string reason;
  for (const Candidate& candidate : candidates_for(device, options)) {
    try {
      state_->use(candidate);
      if (candidate.strategy == GlStrategy::native) return;
      const auto rule = find_broken_rule(*this);
      if (!rule) return;
      reason = "OpenGL (" + device.renderer() + ") breaks rule " + *rule;
    } catch (const BackendError& error) {
      reason = error.what();
    }
  }
  throw BackendError(reason);
}

GlRasterizer::~GlRasterizer() = default;

RasterizerInfo GlRasterizer::info() const {
  const GlDevice& device = state_->objects->device;
  const ComputeSetup& setup = state_->objects->painters->tools.setup;
  std::string how = name_of(strategy());
  if (strategy() == GlStrategy::compute && setup.has_atomic_int64) how += " in one pass";
  if (setup.wide_rows) how += ", rows in double";
  return {.name = "gl:" + state_->context->name() + ", " + device.renderer() + ", OpenGL " +
                  device.version() + ", " + how,
          .max_extent = {kMaxRasterExtent, kMaxRasterExtent},
          .max_point_size = kMaxPointSize,
          .subpixel_bits = 8,
          .reproducible = strategy() != GlStrategy::native};
}

GlStrategy GlRasterizer::strategy() const noexcept {
  return state_->objects->painters->strategy;
}

std::size_t GlRasterizer::uploads() const {
  return state_->objects->uploads.uploads();
}

DrawReport GlRasterizer::do_render(const View& view, std::span<const DrawItem> items,
                                   Framebuffer& out) {
  return state_->draw(view, items, nullptr, out);
}

DrawReport GlRasterizer::do_render_in_band(const View& view, std::span<const DrawItem> items,
                                           const DepthBand& band, Framebuffer& out) {
  return state_->draw(view, items, &band, out);
}

DrawReport GlRasterizer::do_accumulate(const View& view, std::span<const DrawItem> items,
                                       const AccumulateWindow& window, Grid<PixelMoments>& out) {
  const CurrentContext current(*state_->context);
  return state_->objects->painters->moments.add(view, items, window, out);
}

}  // namespace rangezip

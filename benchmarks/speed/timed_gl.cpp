#include "benchmarks/speed/timed_gl.h"

#include "raster_gl/context_list.h"

namespace rangezip::benchmark {

/// Adds what passes to the phase that runs.
class TimedGl::Clock {
 public:
  void start() {
    parts_ = {{"host", {}}, {"upload", {}}, {"draw", {}}, {"read", {}}};
    running_ = "host";
    since_ = seconds_since_start();
  }

  void enter(GlPhase phase) {
    stop();
    running_ = name_of(phase);
    since_ = seconds_since_start();
  }

  void stop() {
    const Seconds taken = seconds_since_start() - since_;
    Seconds& sum = parts_[running_];
    sum = {sum.cpu + taken.cpu, sum.wall + taken.wall};
  }

  [[nodiscard]] const Parts& parts() const noexcept { return parts_; }

 private:
  static const char* name_of(GlPhase phase) {
    if (phase == GlPhase::upload) return "upload";
    return phase == GlPhase::draw ? "draw" : "read";
  }

  Parts parts_;
  const char* running_ = "host";
  Seconds since_;
};

namespace {

/// Uploads that are kept: some scenes of 10 million points, or one of 100 million.
constexpr std::size_t kCacheBytes = std::size_t{3} << 29;

}  // namespace

TimedGl::TimedGl(const std::string& context, GlStrategy strategy)
    : clock_(std::make_unique<Clock>()),
      rasterizer_(
          make_gl_context(context),
          {.strategy = strategy,
           .cache_bytes = kCacheBytes,
           .phase_observer = [clock = clock_.get()](GlPhase phase) { clock->enter(phase); }}) {}

TimedGl::~TimedGl() = default;

GlStrategy TimedGl::strategy() const noexcept {
  return rasterizer_.strategy();
}

const Framebuffer& TimedGl::render(const View& view, const DrawItem& item) {
  clock_->start();
  rasterizer_.render(view, {&item, 1}, image_);
  clock_->stop();
  return image_;
}

Parts TimedGl::parts() const {
  return clock_->parts();
}

}  // namespace rangezip::benchmark

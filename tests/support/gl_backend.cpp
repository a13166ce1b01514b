#include "tests/support/gl_backend.h"

#define CATCH_CONFIG_EXTERNAL_INTERFACES
#include <catch2/catch.hpp>
#include <map>

#include "raster_gl/context_list.h"
#include "raster_gl/gl_rasterizer.h"

namespace rangezip {

namespace {

class SharedRasterizer final : public Rasterizer {
 public:
  explicit SharedRasterizer(Rasterizer& shared) : shared_(shared) {}
  [[nodiscard]] RasterizerInfo info() const override { return shared_.info(); }

 private:
  DrawReport do_render(const View& view, std::span<const DrawItem> items,
                       Framebuffer& out) override {
    return shared_.render(view, items, out);
  }
  DrawReport do_render_in_band(const View& view, std::span<const DrawItem> items,
                               const DepthBand& band, Framebuffer& out) override {
    return shared_.render_in_band(view, items, band, out);
  }
  DrawReport do_accumulate(const View& view, std::span<const DrawItem> items,
                           const AccumulateWindow& window, Grid<PixelMoments>& out) override {
    return shared_.accumulate(view, items, window, out);
  }

  Rasterizer& shared_;
};

std::map<std::string, std::unique_ptr<GlRasterizer>>& started_rasterizers() {
  static std::map<std::string, std::unique_ptr<GlRasterizer>> started;
  return started;
}

/// Ends the rasterizers with the last test: at the end of the process Mesa may be gone already.
struct EndOfRasterizers : Catch::TestEventListenerBase {
  using TestEventListenerBase::TestEventListenerBase;
  void testRunEnded(const Catch::TestRunStats& /*stats*/) override {
    started_rasterizers().clear();
  }
};

}  // namespace

CATCH_REGISTER_LISTENER(EndOfRasterizers)

std::unique_ptr<Rasterizer> make_shared_gl(const std::string& name) {
  std::unique_ptr<GlRasterizer>& shared = started_rasterizers()[name];
  if (shared == nullptr) {
    const std::size_t blank = name.find(' ');
    shared = std::make_unique<GlRasterizer>(
        make_gl_context(name.substr(0, blank)),
        GlOptions{.strategy = blank == std::string::npos ? GlStrategy::automatic
                                                         : gl_strategy(name.substr(blank + 1))});
  }
  return std::make_unique<SharedRasterizer>(*shared);
}

}  // namespace rangezip

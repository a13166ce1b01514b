#include "tests/support/gl_backend.h"

#define CATCH_CONFIG_EXTERNAL_INTERFACES
#include <catch2/catch.hpp>
#include <map>
#include <sstream>

#include "core/base/error.h"
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

std::unique_ptr<GlRasterizer> start(const std::string& name) {
  std::istringstream words(name);
  std::string context, strategy = "automatic", wish;
  words >> context >> strategy >> wish;
  auto rasterizer = std::make_unique<GlRasterizer>(make_gl_context(context),
                                                   GlOptions{.strategy = gl_strategy(strategy)});
  if (wish == "one_pass" && rasterizer->info().name.find("one pass") == std::string::npos) {
    throw BackendError(rasterizer->info().name + ": takes two passes");
  }
  return rasterizer;
}

}  // namespace

CATCH_REGISTER_LISTENER(EndOfRasterizers)

std::unique_ptr<Rasterizer> make_shared_gl(const std::string& name) {
  std::unique_ptr<GlRasterizer>& shared = started_rasterizers()[name];
  if (shared == nullptr) shared = start(name);
  return std::make_unique<SharedRasterizer>(*shared);
}

}  // namespace rangezip

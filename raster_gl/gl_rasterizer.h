#pragma once

#include <cstddef>
#include <cstdint>
#include <memory>
#include <string>

#include "core/raster/rasterizer.h"
#include "raster_gl/gl_context.h"
#include "raster_gl/gl_phase.h"

namespace rangezip {

/// How OpenGL is used. All but `native` are exact, or do not start.
enum class GlStrategy : std::uint8_t {
  automatic,       ///< the first of the next two that keeps all rules
  compute,         ///< everything by compute kernels, in integers
  fixed_function,  ///< coverage and depth test by OpenGL's own rasterization, sums by kernels
  native,          ///< as any program of OpenGL: near to the rules, for comparison only
};

[[nodiscard]] std::string name_of(GlStrategy strategy);
/// The strategy of a name. @throws InvalidArgument if there is none (the text lists them)
[[nodiscard]] GlStrategy gl_strategy(const std::string& name);

struct GlOptions {
  GlStrategy strategy = GlStrategy::automatic;
  /// Bytes of one buffer that a shader may see; larger scenes and images are drawn in parts.
  /// 0: what the driver allows.
  std::size_t block_bytes = 0;
  /// Bytes of uploads that are kept for items with a content key.
  std::size_t cache_bytes = std::size_t{1} << 30;
  /// R2 in double precision, also where floats do it right: for tests.
  bool wide_rows = false;
  /// For measurements: told the phases of every drawing, also of those at the start. The device is
  /// waited for between them, which takes time; if this is empty, it is not.
  GlPhaseObserver phase_observer;
};

/// Draws with OpenGL 4.5 the bits of docs/rasterization.md, hence those of CpuRasterizer (but for
/// the strategy `native`). Test scenes at the start show that the driver keeps every rule. The
/// context is current during a call only; calls may come from any thread, one at a time. Must end
/// before the process does: no static object, for Mesa takes its contexts down at exit.
class GlRasterizer final : public Rasterizer {
 public:
  /// @throws BackendError if the context lacks what is needed (docs/determinism.md), or if a test
  ///     drawing breaks a rule; the text names it.
  explicit GlRasterizer(std::unique_ptr<GlContext> context, const GlOptions& options = {});
  ~GlRasterizer() override;

  /// Not `reproducible` with the strategy `native`.
  [[nodiscard]] RasterizerInfo info() const override;

  /// The one in use; never `automatic`.
  [[nodiscard]] GlStrategy strategy() const noexcept;

  /// Uploads of positions and corners so far: what is kept is not uploaded again.
  [[nodiscard]] std::size_t uploads() const;

 private:
  DrawReport do_render(const View& view, std::span<const DrawItem> items,
                       Framebuffer& out) override;
  DrawReport do_render_in_band(const View& view, std::span<const DrawItem> items,
                               const DepthBand& band, Framebuffer& out) override;
  DrawReport do_accumulate(const View& view, std::span<const DrawItem> items,
                           const AccumulateWindow& window, Grid<PixelMoments>& out) override;

  struct State;
  std::unique_ptr<State> state_;
};

}  // namespace rangezip

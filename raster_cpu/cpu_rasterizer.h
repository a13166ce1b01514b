#pragma once

#include <memory>
#include <string>
#include <string_view>
#include <vector>

#include "core/raster/rasterizer.h"

namespace rangezip {

struct SimdKernels;

/// The sets of vector instructions that this machine has for drawing, the widest first, then
/// "scalar": plain code, which is the norm that the others keep bit for bit.
[[nodiscard]] std::vector<std::string> cpu_instructions();

/// The reference: docs/rasterization.md in code, the same bits everywhere. Uses the threads of the
/// enclosing run_with_threads(); the image never depends on their number.
///
/// Keeps its working memory from call to call, per pixel of the largest image so far: 8 bytes, times
/// the threads that draw where triangles, large points or points in a local order are drawn; 8 bytes
/// (but at least 32 MB) for small points in any order; for accumulate() at most the 80 bytes of its
/// result, and 4. Triangles take 12 bytes a corner of the largest item.
class CpuRasterizer final : public Rasterizer {
 public:
  CpuRasterizer();  ///< with the widest instructions of this machine
  /// @param instructions one of cpu_instructions(). @throws InvalidArgument for another
  explicit CpuRasterizer(std::string_view instructions);
  ~CpuRasterizer() override;

  [[nodiscard]] RasterizerInfo info() const override;

 private:
  DrawReport do_render(const View& view, std::span<const DrawItem> items,
                       Framebuffer& out) override;
  DrawReport do_render_in_band(const View& view, std::span<const DrawItem> items,
                               const DepthBand& band, Framebuffer& out) override;
  DrawReport do_accumulate(const View& view, std::span<const DrawItem> items,
                           const AccumulateWindow& window, Grid<PixelMoments>& out) override;

  DrawReport draw(const View& view, std::span<const DrawItem> items, const DepthBand* band,
                  Framebuffer& out);

  const SimdKernels* kernels_ = nullptr;  ///< null: scalar
  struct Workspace;
  std::unique_ptr<Workspace> workspace_;
};

}  // namespace rangezip

#pragma once

#include <cstddef>
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
/// Keeps its working memory from call to call. Drawing takes 8 bytes a pixel (times the threads
/// that draw, for large scenes), 12 bytes a corner of the largest item, and for small points 8 to
/// 16 bytes each of as many as there are pixels, or 2^22; accumulate() 84 bytes a pixel, at least
/// 32 MB where there are so many points. Each thread takes up to 12 MB besides, in the largest
/// images.
class CpuRasterizer final : public Rasterizer {
 public:
  CpuRasterizer();  ///< with the widest instructions of this machine
  /// @param instructions one of cpu_instructions()
  /// @param batch so many points at least are sorted before they are drawn, at 8 to 16 bytes each;
  ///     less memory and more passes over the image with a smaller one. It cannot show.
  /// @throws InvalidArgument for other instructions, and for a batch of 0
  explicit CpuRasterizer(std::string_view instructions, std::size_t batch = std::size_t{1} << 22U);
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

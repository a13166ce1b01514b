#pragma once

#include <array>
#include <cstdint>
#include <optional>
#include <string>

#include "tests/support/raster_scenes.h"

/// Random scenes without end, drawn by all three operations and compared in every pixel.
/// benchmarks/robustness runs many of them, the tests a few.
namespace rangezip::fuzz {

/// What the operations of a rasterizer give for a case.
struct Drawings {
  Framebuffer image;
  Framebuffer banded;
  Grid<PixelMoments> sums;  ///< empty if the case has no window
  std::array<DrawReport, 3> reports;
};

/// A scene, the arguments of the operations, and what the reference makes of them.
struct Case {
  std::string family;
  bool is_large = false;
  RasterScene scene;
  DepthBand band;
  std::optional<AccumulateWindow> window;  ///< none for images of more than 2^20 pixels
  Drawings expected;

  /// Pixels that one rasterizer's drawings are compared in.
  [[nodiscard]] std::size_t pixels() const;
  /// Those of them that hold something.
  [[nodiscard]] std::size_t covered() const;
  [[nodiscard]] std::size_t primitives() const;
};

/// Case number `index` of the run with this seed: one of 200 is large (large_scenes.h), the
/// others go through the families of raster_scenes.h in turn. The reference draws in one thread.
[[nodiscard]] Case make_case(std::uint64_t seed, std::uint64_t index, Rasterizer& reference);

/// All operations of `rasterizer`, with the threads of the caller.
void draw(Rasterizer& rasterizer, const Case& drawn, Drawings& out);

/// How a rasterizer's drawings differ from those of the reference.
struct Difference {
  std::string operation;
  std::size_t pixels = 0;  ///< that differ in this operation; 0 if only the report does
  std::string text;        ///< the first pixel with both values
};

/// The first operation that differs, if any.
[[nodiscard]] std::optional<Difference> find_difference(const Case& drawn, const Drawings& found);

}  // namespace rangezip::fuzz

#pragma once

#include <cstddef>
#include <memory>
#include <string>

#include "core/raster/draw_item.h"
#include "core/view/view.h"

namespace rangezip::benchmark {

/// Draws as any program of OpenGL would, with GL_POINTS and GL_TRIANGLES, a depth test and the IDs
/// as colours, by Mesa's software renderer OSMesa on the calling thread. What it draws is close to
/// the rules of docs/rasterization.md, not equal; it is here to be measured.
class NativeGl {
 public:
  /// @throws BackendError if there is no OSMesa.
  NativeGl();
  ~NativeGl();
  NativeGl(const NativeGl&) = delete;
  NativeGl& operator=(const NativeGl&) = delete;

  [[nodiscard]] std::string renderer() const;

  /// Makes `item` what draw() draws: its positions and corners go to buffers of OpenGL once, here.
  void load(const View& view, const DrawItem& item);

  /// Clears the image, draws, waits for the end.
  void draw();

  /// Pixels of the image in which something was drawn.
  [[nodiscard]] std::size_t covered_pixels() const;

 private:
  struct State;
  std::unique_ptr<State> state_;
};

}  // namespace rangezip::benchmark

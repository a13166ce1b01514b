#pragma once

#include <memory>
#include <string>

#include "benchmarks/speed/measure.h"
#include "raster_gl/gl_rasterizer.h"

namespace rangezip::benchmark {

/// Draws with OpenGL and knows what the phases of the last drawing took: "host" (before the first),
/// "upload", "draw", "read". The device is waited for between them.
class TimedGl {
 public:
  /// @param context a name of make_gl_context()
  /// @throws BackendError as GlRasterizer, or without the context
  TimedGl(const std::string& context, GlStrategy strategy);
  ~TimedGl();
  TimedGl(const TimedGl&) = delete;
  TimedGl& operator=(const TimedGl&) = delete;

  [[nodiscard]] GlStrategy strategy() const noexcept;

  /// Draws into memory that stays from call to call.
  const Framebuffer& render(const View& view, const DrawItem& item);

  /// Of the last drawing.
  [[nodiscard]] Parts parts() const;

 private:
  class Clock;

  std::unique_ptr<Clock> clock_;
  GlRasterizer rasterizer_;
  Framebuffer image_;
};

}  // namespace rangezip::benchmark

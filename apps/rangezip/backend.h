#pragma once

#include <memory>
#include <string>
#include <vector>

#include "core/raster/rasterizer.h"

namespace rangezip::app {

/// The names that make_rasterizer() takes, separated by commas.
[[nodiscard]] std::string known_backends();

/// The names of strategies that make_rasterizer() takes, separated by commas.
[[nodiscard]] std::string known_strategies();

/// Whether a backend draws with OpenGL, and so by a strategy.
[[nodiscard]] bool is_gl(const std::string& name);

/// @param name "cpu"; "gl" for the first OpenGL that starts, or "gl:CONTEXT" with a name of
///     raster_gl/context_list.h. Software renderers take the threads of the enclosing
///     run_with_threads(), unless LP_NUM_THREADS is set.
/// @param strategy how OpenGL draws, a name of raster_gl/gl_rasterizer.h; "": the first that is
///     exact here. For backends with is_gl() only.
/// @throws BackendError if there is no such backend or strategy (the text lists the known ones), if
///     the backend has no strategies, or if it cannot start.
[[nodiscard]] std::unique_ptr<Rasterizer> make_rasterizer(const std::string& name,
                                                          const std::string& strategy = "");

/// A backend on this machine.
struct BackendStatus {
  std::string name;
  bool works = false;
  std::string text;  ///< what draws, or why it does not start
};

/// Starts every backend that may be here, and says what became of it.
[[nodiscard]] std::vector<BackendStatus> try_backends();

}  // namespace rangezip::app

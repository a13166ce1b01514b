#pragma once

#include <memory>
#include <string>
#include <vector>

#include "core/raster/rasterizer.h"

namespace rangezip::app {

/// The names that make_rasterizer() takes, separated by commas.
[[nodiscard]] std::string known_backends();

/// @param name "cpu"; "gl" for the first OpenGL that starts, or "gl:CONTEXT" with a name of
///     raster_gl/context_list.h. Software renderers take the threads of the enclosing
///     run_with_threads(), unless LP_NUM_THREADS is set.
/// @throws BackendError if there is no such backend (the text lists the known ones), or if it
///     cannot start.
[[nodiscard]] std::unique_ptr<Rasterizer> make_rasterizer(const std::string& name);

/// A backend on this machine.
struct BackendStatus {
  std::string name;
  bool works = false;
  std::string text;  ///< what draws, or why it does not start
};

/// Starts every backend that may be here, and says what became of it.
[[nodiscard]] std::vector<BackendStatus> try_backends();

}  // namespace rangezip::app

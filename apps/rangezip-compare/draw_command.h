#pragma once

#include <filesystem>
#include <iosfwd>
#include <optional>
#include <string>
#include <vector>

#include "compare/footprint.h"
#include "core/base/grid.h"
#include "core/base/progress.h"

namespace rangezip::compare {

struct DrawCommand {
  std::vector<std::filesystem::path> inputs;
  std::vector<std::string> backends;  ///< the first is the reference
  /// Each OpenGL backend is drawn with each of them; empty: with the first that is exact there.
  std::vector<std::string> strategies;
  int views = 6;  ///< from evenly spread directions
  Extent size{512, 512};
  int point_size = 1;                            ///< pixels
  std::optional<std::filesystem::path> view_of;  ///< a session: the view of its first scan instead
  /// A drawing of that view by another program, judged too; both or none.
  std::optional<std::filesystem::path> depth;
  std::optional<std::filesystem::path> ids;
  /// For all but exact backends; absent: driver_tolerance() of the backend's subpixel bits, or 8.
  std::optional<DrawingTolerance> tolerance;
  std::optional<std::filesystem::path> json;    ///< the figures as JSON
  std::optional<std::filesystem::path> images;  ///< folder for a picture of each difference
};

/// Draws the same views of the inputs with each backend and prints how the drawings differ from
/// those of the first. Where both backends are exact (reproducible) no difference is allowed,
/// otherwise none that roundings do not explain (drawing_judge.h).
/// @return true if nothing differs that must not
/// @throws UsageError if options contradict each other, IoError if a file cannot be read,
///     OutputError if one cannot be written, BackendError if a backend is unknown or fails,
///     Cancelled (which is asked between views).
bool run_draw_command(const DrawCommand& command, std::ostream& out, const Progress& progress);

}  // namespace rangezip::compare

#pragma once

#include <cstddef>
#include <string>
#include <vector>

#include "core/reconstruct/reconstruct.h"

namespace rangezip::app {

/// A step of a run after which the mesh had more handles than before, or fewer.
struct HandleChange {
  std::string by;  ///< "view 12" (from 0 on, as in the report), "finish", "erasing faces"
  std::ptrdiff_t handles = 0;
};

/// In the order of the run: which stitch made a handle, and what removed one.
[[nodiscard]] std::vector<HandleChange> handle_changes(const ReconstructReport& report);

/// "5: view 3 +4, view 12 +2, finish -1", the longest lists cut short; empty without any.
[[nodiscard]] std::string handles_text(const ReconstructReport& report);

}  // namespace rangezip::app

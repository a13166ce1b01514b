#pragma once

#include <string_view>

#include "core/base/progress.h"

namespace rangezip {

/// The part [begin, end] of the caller's progress bar, by the same stages.
[[nodiscard]] inline Progress part_of(const Progress& whole, double begin, double end) {
  Progress part{.stop = whole.stop};
  if (whole.report) {
    part.report = [report = whole.report, begin, end](std::string_view stage, double share) {
      report(stage, begin + share * (end - begin));
    };
  }
  return part;
}

/// The same, all of it as one stage.
/// @param stage a literal: it is kept
[[nodiscard]] inline Progress part_of(const Progress& whole, const char* stage, double begin,
                                      double end) {
  Progress named{.stop = whole.stop};
  if (whole.report) {
    named.report = [report = whole.report, stage](std::string_view, double share) {
      report(stage, share);
    };
  }
  return part_of(named, begin, end);
}

}  // namespace rangezip

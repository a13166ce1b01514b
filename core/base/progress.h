#pragma once

#include <functional>
#include <stop_token>
#include <string_view>

#include "core/base/error.h"

namespace rangezip {

/// How a long operation talks to its caller. The default does nothing.
struct Progress {
  /// Called with the name of the current stage and the share done of the whole, rising in [0, 1].
  std::function<void(std::string_view stage, double share)> report;
  std::stop_token stop;  ///< when it is set, the operation throws Cancelled

  void at(std::string_view stage, double share) const {
    if (report) report(stage, share);
    check_stop();
  }

  /// @throws Cancelled if the caller asked for the end.
  void check_stop() const {
    if (stop.stop_requested()) throw Cancelled("cancelled by the caller");
  }
};

}  // namespace rangezip

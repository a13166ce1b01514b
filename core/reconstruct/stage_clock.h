#pragma once

#include <chrono>
#include <ctime>
#include <string>
#include <utility>

#include "core/reconstruct/reconstruct.h"

namespace rangezip {

/// Wall and processor time since it was made.
class StageClock {
 public:
  [[nodiscard]] StageTime stage(std::string name) const {
    const std::chrono::duration<double> wall = std::chrono::steady_clock::now() - wall_start_;
    const double cpu = static_cast<double>(std::clock() - cpu_start_) / CLOCKS_PER_SEC;
    return {std::move(name), wall.count(), cpu};
  }

 private:
  std::chrono::steady_clock::time_point wall_start_ = std::chrono::steady_clock::now();
  std::clock_t cpu_start_ = std::clock();
};

}  // namespace rangezip

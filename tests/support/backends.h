#pragma once

#include <algorithm>
#include <functional>
#include <memory>
#include <string>
#include <vector>

#include "raster_cpu/cpu_rasterizer.h"

namespace rangezip {

/// A rasterizer under test. What a test asserts of one it asserts of all.
struct Backend {
  std::string name;
  std::function<std::unique_ptr<Rasterizer>()> make;
};

/// Every exact backend that this build has; the first is the reference.
inline std::vector<Backend> all_backends() {
  std::vector<Backend> backends;
  std::vector<std::string> instructions = cpu_instructions();
  std::rotate(instructions.begin(), instructions.end() - 1, instructions.end());
  for (const std::string& name : instructions) {
    backends.push_back({"cpu " + name, [name] { return std::make_unique<CpuRasterizer>(name); }});
  }
  // Many passes over an image, each of which must add to the ones before.
  const std::string widest = cpu_instructions().front();
  backends.push_back({"cpu " + widest + " in small batches",
                      [widest] { return std::make_unique<CpuRasterizer>(widest, 1000); }});
  return backends;
}

}  // namespace rangezip

#pragma once

#include <algorithm>
#include <cstdlib>
#include <functional>
#include <memory>
#include <string>
#include <vector>

#include "raster_cpu/cpu_rasterizer.h"
#ifdef RANGEZIP_WITH_GL
#include "tests/support/gl_backend.h"
#endif

namespace rangezip {

/// A rasterizer under test. What a test asserts of one it asserts of all.
struct Backend {
  std::string name;
  std::function<std::unique_ptr<Rasterizer>()> make;
  bool uses_threads = true;  ///< of the caller; then their number is worth a test
};

/// Every set of instructions of CpuRasterizer; the first is the reference, scalar code.
inline std::vector<Backend> cpu_backends() {
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

/// What this run of a test program is about: the CPU's backends; or, with the environment variable
/// RANGEZIP_TEST_GL set to a context ("osmesa") and perhaps a strategy ("osmesa compute"), the
/// reference and that one.
inline std::vector<Backend> all_backends() {
  std::vector<Backend> backends = cpu_backends();
#ifdef RANGEZIP_WITH_GL
  if (const char* const gl = std::getenv("RANGEZIP_TEST_GL")) {
    backends.resize(1);
    const std::string name = gl;
    backends.push_back({"gl " + name, [name] { return make_shared_gl(name); }, false});
  }
#endif
  return backends;
}

}  // namespace rangezip

#include "apps/rangezip/backend.h"

#include "core/base/error.h"
#include "raster_cpu/cpu_rasterizer.h"

namespace rangezip::app {

std::string known_backends() {
  return "cpu";
}

std::unique_ptr<Rasterizer> make_rasterizer(const std::string& name) {
  if (name == "cpu") return std::make_unique<CpuRasterizer>();
  throw BackendError("there is no backend '" + name + "'; known: " + known_backends());
}

}  // namespace rangezip::app

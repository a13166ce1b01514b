#include "apps/rangezip/backend.h"

#include <string_view>

#include "core/base/error.h"
#include "raster_cpu/cpu_rasterizer.h"

namespace rangezip::app {

namespace {

constexpr std::string_view kCpuWith = "cpu:";

/// cpu:NAME, with one set of vector instructions.
std::unique_ptr<Rasterizer> make_cpu(const std::string& name) {
  try {
    return std::make_unique<CpuRasterizer>(std::string_view(name).substr(kCpuWith.size()));
  } catch (const InvalidArgument&) {
    throw BackendError("there is no backend '" + name + "'; known: " + known_backends());
  }
}

}  // namespace

std::string known_backends() {
  std::string names = "cpu";
  for (const std::string& instructions : cpu_instructions())
    names += ", " + std::string(kCpuWith) + instructions;
  return names;
}

std::unique_ptr<Rasterizer> make_rasterizer(const std::string& name) {
  if (name == "cpu") return std::make_unique<CpuRasterizer>();
  if (name.starts_with(kCpuWith)) return make_cpu(name);
  throw BackendError("there is no backend '" + name + "'; known: " + known_backends());
}

}  // namespace rangezip::app

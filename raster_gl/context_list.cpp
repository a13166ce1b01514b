#include "raster_gl/context_list.h"

#include <charconv>
#include <optional>
#include <string_view>

#include "core/base/error.h"
#include "raster_gl/egl_context.h"
#include "raster_gl/osmesa_context.h"

namespace rangezip {

namespace {

constexpr std::string_view kDevicePrefix = "egl:";

/// N of "egl:N".
std::optional<int> device_of(std::string_view name) {
  if (name.substr(0, kDevicePrefix.size()) != kDevicePrefix) return std::nullopt;
  const std::string_view digits = name.substr(kDevicePrefix.size());
  int device = 0;
  const auto [end, error] = std::from_chars(digits.data(), digits.data() + digits.size(), device);
  if (error != std::errc() || end != digits.data() + digits.size()) return std::nullopt;
  return device;
}

std::unique_ptr<GlContext> make_first_egl_context() {
  try {
    return make_egl_device_context(0);
  } catch (const BackendError& no_device) {
    try {
      return make_egl_surfaceless_context();
    } catch (const BackendError& no_surfaceless) {
      throw BackendError(std::string(no_device.what()) + "; " + no_surfaceless.what());
    }
  }
}

std::unique_ptr<GlContext> make_first_context() {
  try {
    return make_first_egl_context();
  } catch (const BackendError& no_egl) {
    try {
      return make_osmesa_context();
    } catch (const BackendError& no_osmesa) {
      throw BackendError(std::string(no_egl.what()) + "; " + no_osmesa.what());
    }
  }
}

}  // namespace

std::string known_gl_contexts() {
  return "osmesa, egl, egl:N, egl:surfaceless";
}

std::unique_ptr<GlContext> make_gl_context(const std::string& name) {
  if (name.empty()) return make_first_context();
  if (name == "osmesa") return make_osmesa_context();
  if (name == "egl") return make_first_egl_context();
  if (name == "egl:surfaceless") return make_egl_surfaceless_context();
  if (const auto device = device_of(name)) return make_egl_device_context(*device);
  throw BackendError("there is no OpenGL context '" + name + "'; known: " + known_gl_contexts());
}

std::vector<std::string> list_gl_contexts() {
  std::vector<std::string> names;
  int devices = 0;
  try {
    devices = count_egl_devices();
  } catch (const BackendError&) {
    // Then "egl:surfaceless" says why.
  }
  names.reserve(static_cast<std::size_t>(devices) + 2);
  for (int device = 0; device < devices; ++device)
    names.push_back(std::string(kDevicePrefix) + std::to_string(device));
  names.emplace_back("egl:surfaceless");
  names.emplace_back("osmesa");
  return names;
}

}  // namespace rangezip

#include "apps/rangezip/backend.h"

#include <cstdlib>
#include <string_view>

#include "core/base/error.h"
#include "core/base/parallel.h"
#include "raster_cpu/cpu_rasterizer.h"
#ifdef RANGEZIP_WITH_GL
#include "raster_gl/context_list.h"
#include "raster_gl/gl_rasterizer.h"
#endif

namespace rangezip::app {

namespace {

#ifdef RANGEZIP_WITH_GL

constexpr const char* kKnownGl = "gl, gl:osmesa, gl:egl, gl:egl:N, gl:egl:surfaceless";
constexpr const char* kKnownStrategies = "compute, fixed_function, native";

GlStrategy strategy_of(const std::string& name) {
  try {
    return name.empty() ? GlStrategy::automatic : gl_strategy(name);
  } catch (const InvalidArgument&) {
    throw BackendError("there is no strategy '" + name + "'; known: " + kKnownStrategies);
  }
}

std::unique_ptr<Rasterizer> make_gl_rasterizer(const std::string& context,
                                               const std::string& strategy) {
  const GlOptions options{.strategy = strategy_of(strategy)};
  // Mesa asks when its first context starts.
  constexpr int kKeepIfSet = 0;
  setenv("LP_NUM_THREADS", std::to_string(thread_count()).c_str(), kKeepIfSet);
  return std::make_unique<GlRasterizer>(make_gl_context(context), options);
}

std::vector<std::string> gl_backends() {
  std::vector<std::string> names;
  for (const std::string& context : list_gl_contexts())
    names.push_back("gl:" + context);
  return names;
}

#else

constexpr const char* kKnownGl = "no gl (this program was built without OpenGL)";
constexpr const char* kKnownStrategies = "none (this program was built without OpenGL)";

std::unique_ptr<Rasterizer> make_gl_rasterizer(const std::string& /*context*/,
                                               const std::string& /*strategy*/) {
  throw BackendError("this program was built without OpenGL (RANGEZIP_WITH_GL=OFF); known: cpu");
}

std::vector<std::string> gl_backends() {
  return {"gl"};
}

#endif

BackendStatus try_backend(const std::string& name) {
  try {
    return {.name = name, .works = true, .text = make_rasterizer(name)->info().name};
  } catch (const BackendError& error) {
    return {.name = name, .works = false, .text = error.what()};
  }
}

constexpr std::string_view kCpuWith = "cpu:";
constexpr std::string_view kGl = "gl";
constexpr std::string_view kGlWith = "gl:";

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
  return names + ", " + kKnownGl;
}

std::string known_strategies() {
  return kKnownStrategies;
}

bool is_gl(const std::string& name) {
  return name == kGl || (name.size() > kGlWith.size() && name.starts_with(kGlWith));
}

std::unique_ptr<Rasterizer> make_rasterizer(const std::string& name, const std::string& strategy) {
  if (is_gl(name)) {
    return make_gl_rasterizer(name == kGl ? "" : name.substr(kGlWith.size()), strategy);
  }
  if (!strategy.empty()) {
    throw BackendError("the backend '" + name + "' has no strategies; those with OpenGL have");
  }
  if (name == "cpu") return std::make_unique<CpuRasterizer>();
  if (name.starts_with(kCpuWith)) return make_cpu(name);
  throw BackendError("there is no backend '" + name + "'; known: " + known_backends());
}

std::vector<BackendStatus> try_backends() {
  std::vector<BackendStatus> all{
      {.name = "cpu", .works = true, .text = "cpu, " + cpu_instructions().front()}};
  for (const std::string& name : gl_backends())
    all.push_back(try_backend(name));
  return all;
}

}  // namespace rangezip::app

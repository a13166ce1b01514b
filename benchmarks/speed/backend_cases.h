#pragma once

#include <memory>
#include <string>
#include <vector>

#include "benchmarks/speed/measure.h"
#include "benchmarks/speed/raster_scenes.h"
#include "benchmarks/speed/timed_gl.h"

namespace rangezip::benchmark {

/// What every backend draws. Refers to the points or triangles that it was made of.
struct Scene {
  nlohmann::ordered_json name;
  View view;
  DrawItem item;
};
[[nodiscard]] Scene make_scene(const Cloud& cloud, int point_size, int size);
[[nodiscard]] Scene make_scene(const Field& field, double pixels, int size);

/// An OpenGL context with every strategy that starts in it.
struct GlBackend {
  std::string context;   ///< as make_gl_context() takes it
  std::string renderer;  ///< GL_RENDERER
  std::string version;   ///< GL_VERSION
  bool is_software = false;
  bool is_by_wall = false;  ///< rates: of a device, or of a software renderer with threads
  std::vector<std::unique_ptr<TimedGl>> rasterizers;
};

/// The CPU rasterizer with one thread, and with all.
[[nodiscard]] std::vector<Case> cpu_cases(const Scene& scene);

/// A strategy with the scene's content kept on the device, and with nothing kept. Draws it once, so
/// that the content is there and shaders are compiled.
/// @throws Error if an exact strategy gives another image than the CPU rasterizer
[[nodiscard]] std::vector<Case> gl_cases(const Scene& scene, const GlBackend& backend, TimedGl& gl);

}  // namespace rangezip::benchmark

// The same drawing by whichever rasterizer the user names. The pipeline takes a Rasterizer& and
// never asks which one it is; a program makes one and passes it on:
//   chosen_backend [NAME]        default: the environment variable RANGEZIP_BACKEND, else cpu
// NAME is cpu, or where the library has raster_gl also gl, gl:osmesa, gl:egl ...
#include <algorithm>
#include <cstdlib>
#include <exception>
#include <iostream>
#include <memory>
#include <string>

#include "core/base/error.h"
#include "core/scene/scene.h"
#include "raster_cpu/cpu_rasterizer.h"
#ifdef WITH_RASTER_GL
#include "raster_gl/context_list.h"
#include "raster_gl/gl_rasterizer.h"
#endif

namespace {

std::unique_ptr<rangezip::Rasterizer> make_rasterizer(const std::string& name) {
  if (name == "cpu") return std::make_unique<rangezip::CpuRasterizer>();
  std::string known = "cpu";
#ifdef WITH_RASTER_GL
  // "gl" is the first context that starts here; "gl:egl" the one called "egl".
  if (name == "gl" || name.starts_with("gl:")) {
    return std::make_unique<rangezip::GlRasterizer>(
        rangezip::make_gl_context(name == "gl" ? "" : name.substr(3)));
  }
  known += ", gl, gl: and one of " + rangezip::known_gl_contexts();
#endif
  throw rangezip::BackendError("unknown backend '" + name + "'; known: " + known);
}

std::string chosen_name(int argc, char** argv) {
  if (argc > 1) return argv[1];
  const char* from_environment = std::getenv("RANGEZIP_BACKEND");
  return from_environment != nullptr ? from_environment : "cpu";
}

// The unit square, facing the viewer.
rangezip::Scene square() {
  rangezip::TriangleSoup soup;
  soup.positions = {{0, 0, 0}, {1, 0, 0}, {1, 1, 0}, {0, 1, 0}};
  soup.triangles = {{0, 1, 2}, {0, 2, 3}};
  rangezip::Scene scene;
  scene.add(std::make_shared<const rangezip::TriangleSoup>(std::move(soup)));
  return scene;
}

}  // namespace

int main(int argc, char** argv) try {
  const std::unique_ptr<rangezip::Rasterizer> rasterizer = make_rasterizer(chosen_name(argc, argv));
  const rangezip::RasterizerInfo info = rasterizer->info();
  std::cout << info.name << ": up to " << info.max_extent.width << " x " << info.max_extent.height
            << " pixels" << (info.reproducible ? ", the same bits everywhere" : "") << '\n';

  const rangezip::Scene scene = square();
  const rangezip::FramedCamera framed =
      rangezip::frame_box(scene.bounds(), {0.0, 0.0, 1.0}, 1.0 / 64.0);
  const rangezip::View view{framed.camera, framed.extent};
  const rangezip::Framebuffer drawn = rasterizer->render(view, scene.draw_items());

  const auto covered = std::ranges::count_if(
      drawn.id.pixels(), [](rangezip::PrimitiveId id) { return id != rangezip::kNoPrimitive; });
  std::cout << covered << " pixels covered of " << 64 * 64 << " expected\n";
  return covered == 64 * 64 ? 0 : 1;
} catch (const std::exception& error) {
  std::cerr << "chosen_backend: " << error.what() << '\n';
  return 1;
}

#include "raster_gl/gl_kernels.h"

#include <algorithm>

namespace rangezip {

namespace {

std::string source_of(Kernel kernel, const ShaderVariant& variant) {
  switch (kernel) {
    case Kernel::fill:
      return shader_text::fill();
    case Kernel::snap_positions:
      return shader_text::snap_positions(variant);
    case Kernel::draw_points:
      return shader_text::draw_points(variant);
    case Kernel::draw_single_points:
      return shader_text::draw_single_points(variant);
    case Kernel::classify_triangles:
      return shader_text::classify_triangles(variant);
    case Kernel::draw_small_triangles:
      return shader_text::draw_small_triangles(variant);
    case Kernel::draw_tiles:
      return shader_text::draw_tiles(variant);
    case Kernel::split_keys:
      return shader_text::split_keys();
    case Kernel::sum_points:
      break;
  }
  return shader_text::sum_points(variant);
}

const char* name_of(Kernel kernel) {
  switch (kernel) {
    case Kernel::fill:
      return "fill";
    case Kernel::snap_positions:
      return "snap_positions";
    case Kernel::draw_points:
      return "draw_points";
    case Kernel::draw_single_points:
      return "draw_single_points";
    case Kernel::classify_triangles:
      return "classify_triangles";
    case Kernel::draw_small_triangles:
      return "draw_small_triangles";
    case Kernel::draw_tiles:
      return "draw_tiles";
    case Kernel::split_keys:
      return "split_keys";
    case Kernel::sum_points:
      break;
  }
  return "sum_points";
}

}  // namespace

std::string kernel_definitions() {
  std::string text;
  const auto define = [&](const char* name, std::uint32_t value) {
    text += "#define " + std::string(name) + " " + std::to_string(value) + "\n";
  };
#define RANGEZIP_GL_DEFINE(binding, name) define(#name, static_cast<GLuint>(Binding::binding));
  RANGEZIP_GL_BINDINGS(RANGEZIP_GL_DEFINE)
#undef RANGEZIP_GL_DEFINE
  define("REJECTED_POINTS", static_cast<std::uint32_t>(Counter::rejected_points));
  define("REJECTED_TRIANGLES", static_cast<std::uint32_t>(Counter::rejected_triangles));
  define("TILE_COUNT", static_cast<std::uint32_t>(Counter::tiles));
  define("OUTSIDE_POSITIONS", static_cast<std::uint32_t>(Counter::outside_positions));
  define("FULL_PIXEL", static_cast<std::uint32_t>(Counter::full_pixel));
  define("PLACE_INSIDE", static_cast<std::uint32_t>(Place::inside));
  define("PLACE_OUTSIDE", static_cast<std::uint32_t>(Place::outside));
  define("PLACE_REJECTED", static_cast<std::uint32_t>(Place::rejected));
  define("MOST_POINTS", kMostPointsPerPixel);
  return text;
}

const GlProgram& Kernels::get(Kernel kernel, const ShaderVariant& variant) {
  const std::pair key(kernel, variant);
  const auto found = programs_.find(key);
  if (found != programs_.end()) return found->second;
  GlProgram program(device_, name_of(kernel), {{GL_COMPUTE_SHADER, source_of(kernel, variant)}});
  return programs_.emplace(key, std::move(program)).first->second;
}

void Kernels::fill(const GlBuffer& buffer, std::size_t bytes, std::uint32_t value) {
  const std::size_t count = (bytes + GlBuffer::kGranule - 1) / GlBuffer::kGranule;
  const GlProgram& program = get(Kernel::fill, {});
  bind(Binding::depths, buffer);
  program.set("count", static_cast<unsigned>(count));
  program.set("value", static_cast<unsigned>(value));
  dispatch(program, groups_of(count, kPointGroup));
}

void Kernels::dispatch(const GlProgram& program, std::size_t groups) const {
  if (groups == 0) return;
  constexpr std::size_t kMostGroups = 65'535;  // that OpenGL promises, in each dimension
  const GlFunctions& gl = device_.gl();
  const std::size_t rows = (groups + kMostGroups - 1) / kMostGroups;
  gl.UseProgram(program.name());
  gl.DispatchCompute(static_cast<GLuint>(std::min(groups, kMostGroups)), static_cast<GLuint>(rows),
                     1);
  gl.MemoryBarrier(GL_SHADER_STORAGE_BARRIER_BIT | GL_BUFFER_UPDATE_BARRIER_BIT);
}

void Kernels::bind(Binding binding, const GlBuffer& buffer) const {
  device_.gl().BindBufferBase(GL_SHADER_STORAGE_BUFFER, static_cast<GLuint>(binding),
                              buffer.name());
}

}  // namespace rangezip

#include "raster_gl/shader_parts.h"
#include "raster_gl/gl_kernels.h"

namespace rangezip::shader_text {

namespace {

constexpr const char* kVersion = R"(#version 450 core
#extension GL_ARB_gpu_shader_int64 : require
)";

constexpr const char* kInvocation = R"(
layout(local_size_x = GROUP_SIZE) in;
uniform uint count;  // points, positions, triangles or tiles

// Groups are numbered through, however a dispatch spreads them over two dimensions.
uint group() { return gl_WorkGroupID.y * gl_NumWorkGroups.x + gl_WorkGroupID.x; }
uint invocation() { return group() * gl_WorkGroupSize.x + gl_LocalInvocationID.x; }
)";

constexpr const char* kFragment = R"(
layout(location = 0) out uint winner;
uniform int width;
uniform int first_row;
#if HAS_BAND
layout(std430, binding = LOWER) readonly buffer Lower { int lower[]; };
layout(std430, binding = UPPER) readonly buffer Upper { int upper[]; };
#endif

// R12 at the fragment's pixel.
bool is_in_band(int depth) {
#if HAS_BAND
  uint pixel = uint(gl_FragCoord.y) * uint(width) + uint(gl_FragCoord.x);
  return depth >= lower[pixel] && depth <= upper[pixel];
#else
  return true;
#endif
}
)";

std::string define(const char* name, int value) {
  return "#define " + std::string(name) + " " + std::to_string(value) + "\n";
}

}  // namespace

std::string kernel_beginning(const ShaderVariant& variant, std::size_t group_size) {
  std::string text = kVersion;
  if (variant.pass == DrawPass::key) text += "#extension GL_NV_shader_atomic_int64 : require\n";
  text += define("GROUP_SIZE", static_cast<int>(group_size));
  text += define("PASS_DEPTH", static_cast<int>(DrawPass::depth));
  text += define("PASS_WINNER", static_cast<int>(DrawPass::winner));
  text += define("PASS_KEY", static_cast<int>(DrawPass::key));
  text += define("PASS", static_cast<int>(variant.pass));
  text += define("ATOMIC_INT64", variant.pass == DrawPass::key ? 1 : 0);
  text += define("HAS_BAND", variant.has_band ? 1 : 0);
  text += define("OUTSIDE_ONLY", variant.outside_only ? 1 : 0);
  text += define("WIDE_ROWS", variant.wide_rows ? 1 : 0);
  text += define("IS_CENTRAL", variant.is_central ? 1 : 0);
  text += define("HAS_CLIP_PLANES", variant.has_clip_planes ? 1 : 0);
  return text + kernel_definitions() + kInvocation;
}

std::string hardware_beginning(const ShaderVariant& variant) {
  std::string text = kVersion;
  text += define("VIEWPORT_MARGIN", kViewportMargin);
  text += define("VIEWPORT_SIZE", kViewportSize);
  text += define("HAS_BAND", variant.has_band ? 1 : 0);
  text += define("HAS_CLIP_PLANES", variant.has_clip_planes ? 1 : 0);
  return text + kernel_definitions();
}

std::string fragment_output() {
  return kFragment;
}

}  // namespace rangezip::shader_text

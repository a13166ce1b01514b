#include "raster_gl/shader_parts.h"

namespace rangezip::shader_text {

namespace {

constexpr const char* kNativeVertex = R"(
layout(std430, binding = POSITIONS) readonly buffer Positions { float positions[]; };
#if HAS_CLIP_PLANES
layout(std430, binding = CLIP_ROWS) readonly buffer Planes { vec4 planes[]; };
uniform uint clip_planes;
out float gl_ClipDistance[8];
#endif
uniform mat4 clip_from_item;
uniform uint first_id;
uniform int point_size;
layout(location = 0) flat out uint id;

void main() {
  uint i = 3u * uint(gl_VertexID);
  vec4 position = vec4(positions[i], positions[i + 1u], positions[i + 2u], 1.0);
#if HAS_CLIP_PLANES
  for (uint plane = 0u; plane < 8u; ++plane) {
    gl_ClipDistance[plane] = plane < clip_planes ? dot(planes[plane], position) : 1.0;
  }
#endif
  id = first_id + uint(gl_VertexID);
  gl_PointSize = float(point_size);
  gl_Position = clip_from_item * position;
}
)";

constexpr const char* kNativeFragment = R"(
#if OF_POINTS
layout(location = 0) flat in uint id;
#else
uniform uint first_id;
#endif
void main() {
  if (!is_in_band(int(gl_FragCoord.z * 16777216.0))) discard;
#if OF_POINTS
  winner = id;
#else
  winner = first_id + uint(gl_PrimitiveID);
#endif
}
)";

}  // namespace

std::string native_vertex(const ShaderVariant& variant) {
  return hardware_beginning(variant) + kNativeVertex;
}
std::string native_fragment(const ShaderVariant& variant, bool of_points) {
  return hardware_beginning(variant) + "#define OF_POINTS " + (of_points ? "1\n" : "0\n") +
         fragment_output() + kNativeFragment;
}

}  // namespace rangezip::shader_text

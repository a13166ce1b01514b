#include "raster_gl/shader_parts.h"

namespace rangezip::shader_text {

namespace {

constexpr const char* kFixedVertex = R"(
layout(std430, binding = SNAPPED) readonly buffer Snapped { ivec4 snapped[]; };

// A place in 1/256 pixel and a depth, as OpenGL takes them; no operation rounds.
vec4 clip_position(ivec2 at, int depth) {
  vec2 in_viewport = vec2(at + 256 * VIEWPORT_MARGIN) * (2.0 / float(256 * VIEWPORT_SIZE));
  return vec4(in_viewport - 1.0, float(depth) * (1.0 / 16777216.0), 1.0);
}

const vec4 NOWHERE = vec4(4.0, 4.0, 4.0, 1.0);
)";

// R5: the square is given by its middle, so that all of its sides lie half a pixel away from every
// pixel centre.
constexpr const char* kFixedPointVertex = R"(
uniform int point_size;
uniform uint first_id;
layout(location = 0) flat out uint id;

void main() {
  ivec4 p = snapped[gl_VertexID];
  ivec2 first = (p.xy - 128 * (point_size - 1)) >> 8;
  bool is_drawn = p.w != PLACE_REJECTED && uint(p.z) <= 0xffffffu;
  id = first_id + uint(gl_VertexID);
  gl_PointSize = float(point_size);
  gl_Position = is_drawn ? clip_position(256 * first + 128 * point_size, p.z) : NOWHERE;
}
)";

constexpr const char* kFixedPointFragment = R"(
layout(location = 0) flat in uint id;
void main() {
  if (!is_in_band(int(gl_FragCoord.z * 16777216.0))) discard;
  winner = id;
}
)";

// The depth only has to pass OpenGL's clipping: the fragment brings its own. It is computed from
// the corners, which every vertex brings along.
constexpr const char* kFixedTriangleVertex = R"(
layout(std430, binding = CORNERS) readonly buffer Corners { uint corners[]; };
uniform uint first_id;
layout(location = 0) flat out ivec3 corner_a;
layout(location = 1) flat out ivec3 corner_b;
layout(location = 2) flat out ivec3 corner_c;
layout(location = 3) flat out uint id;

void main() {
  uint triangle = uint(gl_VertexID) / 3u;
  uint first = 3u * triangle;
  ivec4 a = snapped[corners[first]];
  ivec4 b = snapped[corners[first + 1u]];
  ivec4 c = snapped[corners[first + 2u]];
  ivec4 p = uint(gl_VertexID) == first ? a : uint(gl_VertexID) == first + 1u ? b : c;
  bool is_drawn = max(a.w, max(b.w, c.w)) == PLACE_INSIDE;
  gl_Position = is_drawn ? clip_position(p.xy, clamp(p.z, 0, 0xffffff)) : NOWHERE;
  corner_a = a.xyz;
  corner_b = b.xyz;
  corner_c = c.xyz;
  id = first_id + triangle;
}
)";

constexpr const char* kFixedTriangleFragment = R"(
layout(location = 0) flat in ivec3 corner_a;
layout(location = 1) flat in ivec3 corner_b;
layout(location = 2) flat in ivec3 corner_c;
layout(location = 3) flat in uint id;

void main() {
  ivec2 at = (ivec2(gl_FragCoord.xy) + ivec2(0, first_row)) * 256 + 128;
  int64_t area = edge(corner_a.xy, corner_b.xy, corner_c.xy);
  int64_t eb = edge(corner_c.xy, corner_a.xy, at);
  int64_t ec = edge(corner_a.xy, corner_b.xy, at);
  if (area < 0L) {
    area = -area;
    eb = -eb;
    ec = -ec;
  }
  int z_min = min(corner_a.z, min(corner_b.z, corner_c.z));
  ivec3 z = ivec3(corner_a.z, corner_b.z, corner_c.z) - z_min;
  int64_t remainder;
  int depth = z_min + divide(area - eb - ec, eb, ec, area, z, remainder);
  if (uint(depth) > 0xffffffu || !is_in_band(depth)) discard;
  winner = id;
  gl_FragDepth = float(depth) * (1.0 / 16777216.0);
}
)";

}  // namespace

std::string fixed_point_vertex() {
  return hardware_beginning({}) + kFixedVertex + kFixedPointVertex;
}
std::string fixed_point_fragment(const ShaderVariant& variant) {
  return hardware_beginning(variant) + fragment_output() + kFixedPointFragment;
}
std::string fixed_triangle_vertex() {
  return hardware_beginning({}) + kFixedVertex + kFixedTriangleVertex;
}
std::string fixed_triangle_fragment(const ShaderVariant& variant) {
  return hardware_beginning(variant) + fragment_output() + depth_division() +
         kFixedTriangleFragment;
}

}  // namespace rangezip::shader_text

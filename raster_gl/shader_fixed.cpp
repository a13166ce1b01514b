#include "raster_gl/shader_parts.h"

namespace rangezip::shader_text {

namespace {

constexpr const char* kFixedVertex = R"(
layout(std430, binding = SNAPPED) readonly buffer Snapped { int snapped[]; };

// A place in 1/256 pixel and a depth, as OpenGL takes them; no operation rounds.
vec4 clip_position(ivec2 at, int depth) {
  vec2 in_viewport = vec2(at + 256 * VIEWPORT_MARGIN) * (2.0 / float(256 * VIEWPORT_SIZE));
  return vec4(in_viewport - 1.0, float(depth) * (1.0 / 16777216.0), 1.0);
}

const vec4 OUTSIDE = vec4(4.0, 4.0, 4.0, 1.0);
)";

// R5: the square is given by its middle, so that all of its sides lie half a pixel away from every
// pixel centre.
constexpr const char* kFixedPointVertex = R"(
uniform int point_size;
uniform uint first_id;
layout(location = 0) flat out uint id;

void main() {
  uint i = 3u * uint(gl_VertexID);
  ivec3 p = ivec3(snapped[i], snapped[i + 1u], snapped[i + 2u]);
  ivec2 first = (p.xy - 128 * (point_size - 1)) >> 8;
  bool is_drawn = p.x != REJECTED_X && uint(p.z) <= 0xffffffu;
  id = first_id + uint(gl_VertexID);
  gl_PointSize = float(point_size);
  gl_Position = is_drawn ? clip_position(256 * first + 128 * point_size, p.z) : OUTSIDE;
}
)";

constexpr const char* kFixedPointFragment = R"(
layout(location = 0) flat in uint id;
void main() {
  if (!is_in_band(int(gl_FragCoord.z * 16777216.0))) discard;
  winner = id;
}
)";

constexpr const char* kCorners = R"(
layout(std430, binding = CORNERS) readonly buffer Corners { uint corners[]; };

ivec3 corner(uint i) {
  uint at = 3u * corners[i];
  return ivec3(snapped[at], snapped[at + 1u], snapped[at + 2u]);
}
)";

// The depth only has to pass OpenGL's clipping: the fragment brings its own.
constexpr const char* kFixedTriangleVertex = R"(
uniform uint all_inside;

void main() {
  uint first = uint(gl_VertexID) / 3u * 3u;
  ivec3 p = corner(uint(gl_VertexID));
  bool is_drawn = all_inside != 0u || (is_inside(corner(first)) && is_inside(corner(first + 1u)) &&
                                       is_inside(corner(first + 2u)));
  gl_Position = is_drawn ? clip_position(p.xy, clamp(p.z, 0, 0xffffff)) : OUTSIDE;
}
)";

constexpr const char* kFixedTriangleFragment = R"(
layout(std430, binding = SNAPPED) readonly buffer Snapped { int snapped[]; };
)";

// R7. Corners lie within 2^22 of each other: the numerator takes two digits of base 2^13.
constexpr const char* kFixedTriangleMain = R"(
uniform uint first_id;

int64_t edge(ivec2 from, ivec2 to, ivec2 at) {
  return int64_t(to.x - from.x) * int64_t(at.y - from.y) -
         int64_t(to.y - from.y) * int64_t(at.x - from.x);
}

int divide(int64_t eb, int64_t ec, int64_t area, ivec3 z) {
  int64_t ea = area - eb - ec;
  ivec3 high = z >> 13;
  ivec3 low = z & 8191;
  int64_t n = ea * int64_t(high.x) + eb * int64_t(high.y) + ec * int64_t(high.z);
  int64_t q = n / area;
  int64_t rest = (n - q * area) << 13;
  rest += ea * int64_t(low.x) + eb * int64_t(low.y) + ec * int64_t(low.z);
  return (int(q) << 13) + int(rest / area);
}

void main() {
  uint triangle = uint(gl_PrimitiveID);
  ivec3 a = corner(3u * triangle);
  ivec3 b = corner(3u * triangle + 1u);
  ivec3 c = corner(3u * triangle + 2u);
  ivec2 at = (ivec2(gl_FragCoord.xy) + ivec2(0, first_row)) * 256 + 128;
  int64_t area = edge(a.xy, b.xy, c.xy);
  int64_t eb = edge(c.xy, a.xy, at);
  int64_t ec = edge(a.xy, b.xy, at);
  if (area == 0L) discard;
  if (area < 0L) {
    area = -area;
    eb = -eb;
    ec = -ec;
  }
  int z_min = min(a.z, min(b.z, c.z));
  int depth = z_min + divide(eb, ec, area, ivec3(a.z, b.z, c.z) - z_min);
  if (uint(depth) > 0xffffffu || !is_in_band(depth)) discard;
  winner = first_id + triangle;
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
  return hardware_beginning({}) + kFixedVertex + kCorners + inside_viewport() +
         kFixedTriangleVertex;
}
std::string fixed_triangle_fragment(const ShaderVariant& variant) {
  return hardware_beginning(variant) + fragment_output() + kFixedTriangleFragment + kCorners +
         kFixedTriangleMain;
}

}  // namespace rangezip::shader_text

#include "raster_gl/hardware_text.h"

#include "raster_gl/gl_kernels.h"

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

constexpr const char* kBand = R"(
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

constexpr const char* kNativeVertex = R"(
layout(std430, binding = POSITIONS) readonly buffer Positions { float positions[]; };
layout(std430, binding = CORNERS) readonly buffer Corners { uint corners[]; };
layout(std430, binding = ROWS) readonly buffer Planes { vec4 planes[]; };
uniform mat4 clip_from_item;
uniform uint has_corners;
uniform uint clip_planes;
uniform uint first_id;
uniform int point_size;
layout(location = 0) flat out uint id;
out float gl_ClipDistance[8];

void main() {
  uint i = 3u * (has_corners != 0u ? corners[gl_VertexID] : uint(gl_VertexID));
  vec4 position = vec4(positions[i], positions[i + 1u], positions[i + 2u], 1.0);
  for (uint plane = 0u; plane < 8u; ++plane) {
    gl_ClipDistance[plane] = plane < clip_planes ? dot(planes[plane], position) : 1.0;
  }
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

std::string prelude(const ShaderVariant& variant) {
  std::string text =
      "#version 450 core\n"
      "#extension GL_ARB_gpu_shader_int64 : require\n";
  const auto define = [&](const char* name, int value) {
    text += "#define " + std::string(name) + " " + std::to_string(value) + "\n";
  };
  define("VIEWPORT_MARGIN", kViewportMargin);
  define("VIEWPORT_SIZE", kViewportSize);
  define("HAS_BAND", variant.has_band ? 1 : 0);
  return text + kernel_definitions() + "const int REJECTED_X = -(1 << 30);\n";
}

}  // namespace

std::string fixed_point_vertex() {
  return prelude({}) + kFixedVertex + kFixedPointVertex;
}
std::string fixed_point_fragment(const ShaderVariant& variant) {
  return prelude(variant) + kBand + kFixedPointFragment;
}
std::string fixed_triangle_vertex() {
  return prelude({}) + kFixedVertex + kCorners + inside_viewport() + kFixedTriangleVertex;
}
std::string fixed_triangle_fragment(const ShaderVariant& variant) {
  return prelude(variant) + kBand + kFixedTriangleFragment + kCorners + kFixedTriangleMain;
}
std::string native_vertex() {
  return prelude({}) + kNativeVertex;
}
std::string native_fragment(const ShaderVariant& variant, bool of_points) {
  return prelude(variant) + "#define OF_POINTS " + (of_points ? "1\n" : "0\n") + kBand +
         kNativeFragment;
}

}  // namespace rangezip::shader_text

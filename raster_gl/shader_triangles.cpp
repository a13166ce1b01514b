#include "raster_gl/gl_kernels.h"
#include "raster_gl/shader_parts.h"

namespace rangezip::shader_text {

namespace {

constexpr const char* kTriangle = R"(
layout(std430, binding = SNAPPED) readonly buffer Snapped { ivec4 snapped[]; };
layout(std430, binding = CORNERS) readonly buffer Corners { uint corners[]; };
layout(std430, binding = IDS) readonly buffer Ids { uint ids[]; };  // of the pieces of triangles
uniform uint first_triangle;
uniform uint first_id;
uniform uint has_ids;
uniform int facing;  // 0 both, 1 front, -1 back

const int SMALL = 32 * 256;   // in boxes below this edges fit in 32 bits
const int SMALL_PIXELS = 64;  // that one invocation visits
const ivec2 TILE = ivec2(256, 64);

struct Corners3 { ivec4 a, b, c; };  // x, y, z, place

// Counter-clockwise, with the pixels [lowest, highest] of its box.
struct Setup { ivec3 a, b, c; int64_t area; ivec2 lowest, highest; bool is_small; };

Corners3 corners_of(uint triangle) {
  uint at = 3u * (first_triangle + triangle);
  return Corners3(snapped[corners[at]], snapped[corners[at + 1u]], snapped[corners[at + 2u]]);
}

bool has_rejected(Corners3 t) {
  return max(t.a.w, max(t.b.w, t.c.w)) == PLACE_REJECTED;
}

uint id_of(uint triangle) { return has_ids != 0u ? ids[triangle] : first_id + triangle; }

// R6; false if nothing is drawn.
bool set_up(Corners3 t, out Setup s) {
#if OUTSIDE_ONLY
  if (max(t.a.w, max(t.b.w, t.c.w)) == PLACE_INSIDE) return false;
#endif
  ivec3 least = min(t.a.xyz, min(t.b.xyz, t.c.xyz));
  ivec3 most = max(t.a.xyz, max(t.b.xyz, t.c.xyz));
  // Pixels whose centres lie in the box; the shift rounds down.
  s.lowest = max((least.xy + 127) >> 8, ivec2(0, first_row));
  s.highest = min((most.xy - 128) >> 8, ivec2(width - 1, first_row + row_count - 1));
  if (any(greaterThan(s.lowest, s.highest))) return false;
  if (most.z < 0 || least.z > int(MAX_DEPTH)) return false;
  ivec2 ab = t.b.xy - t.a.xy;
  ivec2 ac = t.c.xy - t.a.xy;
  int64_t area = int64_t(ab.x) * int64_t(ac.y) - int64_t(ab.y) * int64_t(ac.x);
  if (area == 0L || (facing > 0 && area < 0L) || (facing < 0 && area > 0L)) return false;
  s.a = t.a.xyz;
  s.b = area > 0L ? t.b.xyz : t.c.xyz;
  s.c = area > 0L ? t.c.xyz : t.b.xyz;
  s.area = area > 0L ? area : -area;
  ivec2 pixels = s.highest - s.lowest + 1;
  s.is_small = all(lessThan(most.xy - least.xy, ivec2(SMALL))) &&
               pixels.x <= SMALL_PIXELS && pixels.y <= SMALL_PIXELS &&
               pixels.x * pixels.y <= SMALL_PIXELS;
  return true;
}

// R6's tie rule: the least value of the edge's function that is inside.
int least_inside(ivec2 from, ivec2 to) {
  ivec2 d = to - from;
  return d.y < 0 || (d.y == 0 && d.x > 0) ? 0 : 1;
}
)";

constexpr const char* kClassify = R"(
layout(std430, binding = COUNTERS) buffer Counters { uint counters[]; };
layout(std430, binding = REJECTED) writeonly buffer Rejected { uint rejected[]; };
layout(std430, binding = TILES) writeonly buffer Tiles { uvec2 tiles[]; };
uniform uint tile_capacity;

void main() {
  uint triangle = invocation();
  if (triangle >= count) return;
  Corners3 t = corners_of(triangle);
  if (has_rejected(t)) {
    rejected[atomicAdd(counters[REJECTED_TRIANGLES], 1u)] = triangle;
    return;
  }
  Setup s;
  if (!set_up(t, s) || s.is_small) return;
  ivec2 blocks = (s.highest - s.lowest) / TILE + 1;
  uint needed = uint(blocks.x * blocks.y);
  uint first = atomicAdd(counters[TILE_COUNT], needed);
  for (uint i = 0u; i < needed && first + i < tile_capacity; ++i) {
    tiles[first + i] = uvec2(triangle, i);
  }
}
)";

}  // namespace

std::string triangle_setup() {
  return kTriangle;
}

std::string classify_triangles(const ShaderVariant& variant) {
  return kernel_beginning(variant, kTriangleGroup) + plotting() + triangle_setup() + kClassify;
}

}  // namespace rangezip::shader_text

#include "raster_gl/gl_kernels.h"
#include "raster_gl/shader_parts.h"

namespace rangezip::shader_text {

namespace {

// R5 for points of size 1, the bulk of a large cloud. An invocation takes several and reads what
// all of their pixels hold before it changes one: so the memory is waited for once.
constexpr const char* kSinglePoints = R"(
layout(std430, binding = COUNTERS) buffer Counters { uint counters[]; };
uniform uint first_id;
uniform uint is_counting;

bool is_on_screen(ivec2 at) {
  return uint(at.x) < uint(width) && uint(at.y - first_row) < uint(row_count);
}

void main() {
  uint first = SINGLE_POINTS * invocation();
  uint pixels[SINGLE_POINTS];
  int depths_of[SINGLE_POINTS];
  for (uint i = 0u; i < SINGLE_POINTS; ++i) {
    bool is_there = first + i < count;
    bool rejected, clipped;
    ivec3 p = snap(min(first + i, count - 1u), rejected, clipped);
    if (is_there && rejected && is_counting != 0u) atomicAdd(counters[REJECTED_POINTS], 1u);
    ivec2 at = p.xy >> 8;
    bool is_drawn = is_there && !rejected && !clipped && is_on_screen(at);
    pixels[i] = is_drawn ? pixel_at(at.x, at.y) : 0u;
    depths_of[i] = is_drawn ? p.z : -1;  // before the near plane: never in depth
  }
  Found found[SINGLE_POINTS];
  for (uint i = 0u; i < SINGLE_POINTS; ++i) found[i] = look(pixels[i]);
  for (uint i = 0u; i < SINGLE_POINTS; ++i) {
    if (is_in_depth(pixels[i], depths_of[i])) {
      settle(pixels[i], depths_of[i], first_id + first + i, found[i]);
    }
  }
}
)";

}  // namespace

std::string draw_single_points(const ShaderVariant& variant) {
  return kernel_beginning(variant, kPointGroup) + snapping() + plotting() + kSinglePoints;
}

}  // namespace rangezip::shader_text

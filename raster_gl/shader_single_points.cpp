#include "raster_gl/gl_kernels.h"
#include "raster_gl/shader_parts.h"

namespace rangezip::shader_text {

namespace {

// R5 for points of size 1, the bulk of a large cloud: as draw_points(), without blocks,
// lanes and branches, which cost software renderers a quarter of the time.
constexpr const char* kSinglePoints = R"(
layout(std430, binding = COUNTERS) buffer Counters { uint counters[]; };
uniform uint first_id;
uniform uint is_counting;

bool is_on_screen(ivec2 at) {
  return uint(at.x) < uint(width) && uint(at.y - first_row) < uint(row_count);
}

void main() {
  uint point = invocation();
  bool is_there = point < count;
  bool rejected, clipped;
  ivec3 p = snap(min(point, count - 1u), rejected, clipped);
  if (is_there && rejected && is_counting != 0u) atomicAdd(counters[REJECTED_POINTS], 1u);
  ivec2 at = p.xy >> 8;
  bool is_drawn = is_there && !rejected && !clipped && is_on_screen(at);
  plot_at(is_drawn ? pixel_at(at.x, at.y) : 0u, is_drawn ? p.z : -1, first_id + point);
}
)";

}  // namespace

std::string draw_single_points(const ShaderVariant& variant) {
  return kernel_beginning(variant, kPointGroup) + snapping() + plotting() + kSinglePoints;
}

}  // namespace rangezip::shader_text

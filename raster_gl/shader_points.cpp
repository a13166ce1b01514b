#include "raster_gl/gl_kernels.h"
#include "raster_gl/shader_parts.h"

namespace rangezip::shader_text {

namespace {

constexpr const char* kPoints = R"(
layout(std430, binding = COUNTERS) buffer Counters { uint counters[]; };
uniform uint first_id;
uniform int point_size;
uniform uint lanes;  // invocations that share a point
uniform uint is_counting;

void main() {
  uint point = invocation() / lanes;
  uint lane = invocation() % lanes;
  if (point >= count) return;
  bool rejected, clipped;
  ivec3 p = snap(point, rejected, clipped);
  if (rejected && is_counting != 0u && lane == 0u) atomicAdd(counters[REJECTED_POINTS], 1u);
  if (rejected || clipped) return;
  // R5, and what is on screen.
  ivec2 first = (p.xy - 128 * (point_size - 1)) >> 8;
  ivec2 lowest = max(first, ivec2(0, first_row));
  ivec2 size = min(first + point_size, ivec2(width, first_row + row_count)) - lowest;
  if (size.x <= 0 || size.y <= 0) return;
  uint pixels = uint(size.x) * uint(size.y);
  for (uint i = lane; i < pixels; i += lanes) {
    ivec2 at = lowest + ivec2(i % uint(size.x), i / uint(size.x));
    plot(at.x, at.y, p.z, first_id + point);
  }
}
)";

}  // namespace

std::string draw_points(const ShaderVariant& variant) {
  return kernel_beginning(variant, kPointGroup) + snapping() + plotting() + kPoints;
}

}  // namespace rangezip::shader_text

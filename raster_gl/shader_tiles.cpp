#include "raster_gl/gl_kernels.h"
#include "raster_gl/shader_parts.h"

namespace rangezip::shader_text {

namespace {

// One group a tile of a large triangle, one invocation a row of it: the row's covered span by
// division, then quotient and remainder of R7 from pixel to pixel.
constexpr const char* kTiles = R"(
layout(std430, binding = TILES) readonly buffer Tiles { uvec2 tiles[]; };

// The part of the columns [span.x, span.y] where margin + step * (x - span.x) >= 0.
ivec2 inside_edge(ivec2 span, int64_t margin, int64_t steps) {
  int64_t last = int64_t(span.y - span.x);
  if (steps == 0L) return margin >= 0L ? span : ivec2(0, -1);
  if (steps > 0L) {
    int64_t enter = margin >= 0L ? 0L : (steps - 1L - margin) / steps;
    return ivec2(span.x + int(min(enter, last + 1L)), span.y);
  }
  int64_t leave = margin < 0L ? -1L : margin / -steps;
  return ivec2(span.x, span.x + int(min(leave, last)));
}

void main() {
  if (group() >= count) return;
  uvec2 tile = tiles[group()];
  Setup s;
  if (!set_up(corners_of(tile.x), s)) return;
  uint columns = uint((s.highest.x - s.lowest.x) / TILE.x + 1);
  ivec2 first = s.lowest + ivec2(tile.y % columns, tile.y / columns) * TILE;
  int y = first.y + int(gl_LocalInvocationID.x);
  if (y > s.highest.y) return;
  ivec2 span = ivec2(first.x, min(first.x + TILE.x - 1, s.highest.x));
  ivec2 from[3] = ivec2[3](s.b.xy, s.c.xy, s.a.xy);
  ivec2 to[3] = ivec2[3](s.c.xy, s.a.xy, s.b.xy);
  for (int i = 0; i < 3; ++i) {
    int64_t e = edge(from[i], to[i], ivec2(span.x, y) * 256 + 128);
    int64_t steps = int64_t(from[i].y - to[i].y) * 256L;
    span = inside_edge(span, e - int64_t(least_inside(from[i], to[i])), steps);
    if (span.x > span.y) return;
  }
  int z_min = min(s.a.z, min(s.b.z, s.c.z));
  ivec3 z = ivec3(s.a.z, s.b.z, s.c.z) - z_min;
  int64_t e[3];
  int64_t numerator_step = 0L;
  for (int i = 0; i < 3; ++i) {
    e[i] = edge(from[i], to[i], ivec2(span.x, y) * 256 + 128);
    numerator_step += int64_t(from[i].y - to[i].y) * 256L * int64_t(z[i]);
  }
  int64_t remainder;
  int depth = z_min + divide(e[0], e[1], e[2], s.area, z, remainder);
  int64_t depth_step = numerator_step / s.area;
  int64_t remainder_step = numerator_step - depth_step * s.area;
  if (remainder_step < 0L) {
    depth_step -= 1L;
    remainder_step += s.area;
  }
  uint id = id_of(tile.x);
  for (int x = span.x; x <= span.y; ++x) {
    plot(x, y, depth, id);
    depth += int(depth_step);
    remainder += remainder_step;
    if (remainder >= s.area) {
      remainder -= s.area;
      depth += 1;
    }
  }
}
)";

}  // namespace

std::string draw_tiles(const ShaderVariant& variant) {
  return kernel_beginning(variant, kTriangleGroup) + plotting() + triangle_setup() +
         depth_division() + kTiles;
}

}  // namespace rangezip::shader_text

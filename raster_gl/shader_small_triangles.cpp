#include "raster_gl/gl_kernels.h"
#include "raster_gl/shader_parts.h"

namespace rangezip::shader_text {

namespace {

// In a small box A < 2^27 and the numerator of R7 stays below 2^53: exact in double. The candidate
// is put right by its remainder, so a division that is one off does no harm.
constexpr const char* kSmallTriangles = R"(
int edge(ivec2 from, ivec2 to, ivec2 at) {
  return (to.x - from.x) * (at.y - from.y) - (to.y - from.y) * (at.x - from.x);
}

void main() {
  uint triangle = invocation();
  if (triangle >= count) return;
  Corners3 t = corners_of(triangle);
  Setup s;
  if (has_rejected(t) || !set_up(t, s) || !s.is_small) return;
  uint id = id_of(triangle);
  ivec3 least = ivec3(least_inside(s.b.xy, s.c.xy), least_inside(s.c.xy, s.a.xy),
                      least_inside(s.a.xy, s.b.xy));
  int z_min = min(s.a.z, min(s.b.z, s.c.z));
  dvec3 z = dvec3(s.a.z - z_min, s.b.z - z_min, s.c.z - z_min);
  double area = double(int(s.area));
  for (int y = s.lowest.y; y <= s.highest.y; ++y) {
    for (int x = s.lowest.x; x <= s.highest.x; ++x) {
      ivec2 at = ivec2(x, y) * 256 + 128;
      ivec3 e = ivec3(edge(s.b.xy, s.c.xy, at), edge(s.c.xy, s.a.xy, at),
                      edge(s.a.xy, s.b.xy, at));
      if (any(lessThan(e, least))) continue;
      precise double numerator = double(e.x) * z.x + double(e.y) * z.y + double(e.z) * z.z;
      precise double q = floor(numerator / area);
      precise double remainder = numerator - q * area;
      if (remainder < 0.0LF) {
        q -= 1.0LF;
      } else if (remainder >= area) {
        q += 1.0LF;
      }
      plot(x, y, z_min + int(q), id);
    }
  }
}
)";

}  // namespace

std::string draw_small_triangles(const ShaderVariant& variant) {
  return kernel_beginning(variant, kTriangleGroup) + plotting() + triangle_setup() +
         kSmallTriangles;
}

}  // namespace rangezip::shader_text

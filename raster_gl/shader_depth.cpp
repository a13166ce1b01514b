#include "raster_gl/shader_parts.h"

namespace rangezip::shader_text {

namespace {

// The candidate is computed in double from numbers that are not negative, each rounded: it is below
// 2^26 and off by less than 2^-20, so its floor is at most one off. What remains then lies in
// (-area, 2 area), so that 64 bits hold it, whatever the products lost above them.
constexpr const char* kDepth = R"(
int64_t edge(ivec2 from, ivec2 to, ivec2 at) {
  return int64_t(to.x - from.x) * int64_t(at.y - from.y) -
         int64_t(to.y - from.y) * int64_t(at.x - from.x);
}

// R7 above the least corner, for edges that add up to the area, none of them negative, and corner
// depths from 0 to 2^26.
int divide(int64_t ea, int64_t eb, int64_t ec, int64_t area, ivec3 z, out int64_t remainder) {
  double numerator =
      double(ea) * double(z.x) + double(eb) * double(z.y) + double(ec) * double(z.z);
  int quotient = int(floor(numerator / double(area)));
  remainder = ea * int64_t(z.x) + eb * int64_t(z.y) + ec * int64_t(z.z) -
              int64_t(quotient) * area;
  if (remainder < 0L) {
    quotient -= 1;
    remainder += area;
  } else if (remainder >= area) {
    quotient += 1;
    remainder -= area;
  }
  return quotient;
}
)";

}  // namespace

std::string depth_division() {
  return kDepth;
}

}  // namespace rangezip::shader_text

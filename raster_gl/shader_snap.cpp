#include "raster_gl/gl_kernels.h"
#include "raster_gl/shader_parts.h"

namespace rangezip::shader_text {

namespace {

// The numbers of R2: floats where the driver keeps denormals, else doubles that are rounded to the
// precision of floats by hand. Of two floats the product is exact in double, and the sum, rounded
// twice, is that rounded once (53 >= 2 * 24 + 2).
constexpr const char* kNumbers = R"(
#if WIDE_ROWS
#define number double

number to_number(uint bits) {
  uint exponent = bitfieldExtract(bits, 23, 8);
  uint fraction = bitfieldExtract(bits, 0, 23);
  if (exponent == 0u) {
    double value = double(fraction) * packDouble2x32(uvec2(0u, (1023u - 149u) << 20));
    return (bits >> 31) != 0u ? -value : value;
  }
  uint wide = exponent == 255u ? 2047u : exponent + (1023u - 127u);
  return packDouble2x32(uvec2(fraction << 29, (bits & 0x80000000u) | wide << 20 | fraction >> 3));
}

number rounded(number value) {
  const double least_normal = packDouble2x32(uvec2(0u, (1023u - 126u) << 20));
  if (abs(value) < least_normal) {
    // Doubles around this one are the least float apart.
    precise double unit = packDouble2x32(uvec2(0u, (1023u - 149u + 52u) << 20 | 0x80000u));
    precise double sum = value + unit;
    precise double difference = sum - unit;
    return difference;
  }
  uvec2 bits = unpackDouble2x32(value);
  uint low = bits.x + 0x0fffffffu + (bits.x >> 29 & 1u);
  if (low < bits.x) bits.y += 1u;
  bits.x = low & 0xe0000000u;
  if ((bits.y & 0x7fffffffu) >= (1023u + 128u) << 20 && (bits.y & 0x7ff00000u) != 0x7ff00000u) {
    bits = uvec2(0u, (bits.y & 0x80000000u) | 0x7ff00000u);
  }
  return packDouble2x32(bits);
}
#else
#define number float
number to_number(uint bits) { return uintBitsToFloat(bits); }
number rounded(number value) { return value; }
#endif
)";

constexpr const char* kSnap = R"(
layout(std430, binding = POSITIONS) readonly buffer Positions { uint positions[]; };
uniform uvec4 rows[4];  // R1: x, y, z, w, as the bits of floats
#if HAS_CLIP_PLANES
layout(std430, binding = CLIP_ROWS) readonly buffer ClipRows { uvec4 clip_rows[]; };
uniform uint clip_planes;
#endif

// R2: every operation is rounded on its own.
number rounded_product(number a, number b) {
  precise number exact = a * b;
  return rounded(exact);
}

number rounded_sum(number a, number b) {
  precise number exact = a + b;
  return rounded(exact);
}

number row_product(uvec4 row, number x, number y, number z) {
  number xy = rounded_sum(rounded_product(to_number(row.x), x),
                          rounded_product(to_number(row.y), y));
  number xyz = rounded_sum(xy, rounded_product(to_number(row.z), z));
  return rounded_sum(xyz, to_number(row.w));
}

#if IS_CENTRAL
// R4: floor(v / w + 1/2) of the exact quotient. The candidate is at most one off; both products
// are exact.
int round_quotient(double v, double w) {
  precise double q = floor(v / w + 0.5LF);
  precise double below = (2.0LF * q - 1.0LF) * w;
  precise double above = (2.0LF * q + 1.0LF) * w;
  if (2.0LF * v < below) {
    q -= 1.0LF;
  } else if (2.0LF * v >= above) {
    q += 1.0LF;
  }
  return int(q);
}
#endif

// Position number i on the window's grid by R3 or R4; `rejected` if they reject it, `clipped` if R11
// does.
ivec3 snap(uint i, out bool rejected, out bool clipped) {
  number px = to_number(positions[3u * i]);
  number py = to_number(positions[3u * i + 1u]);
  number pz = to_number(positions[3u * i + 2u]);
  clipped = false;
#if HAS_CLIP_PLANES
  for (uint plane = 0u; plane < clip_planes; ++plane) {
    clipped = clipped || !(row_product(clip_rows[plane], px, py, pz) >= number(0.0));
  }
#endif
  number x = row_product(rows[0], px, py, pz);
  number y = row_product(rows[1], px, py, pz);
  number z = row_product(rows[2], px, py, pz);
  // Written so that NaN is rejected.
#if IS_CENTRAL
  double w = double(row_product(rows[3], px, py, pz));
  const double least = packDouble2x32(uvec2(0u, (1023u - 64u) << 20));
  const double greatest = packDouble2x32(uvec2(0u, (1023u + 64u) << 20));
  double max_xy = 4194304.0LF * w;
  rejected = !(w >= least && w <= greatest && abs(double(x)) <= max_xy &&
               abs(double(y)) <= max_xy && abs(double(z)) <= 33554432.0LF * w);
  if (rejected) return ivec3(0);
  return ivec3(round_quotient(double(x), w), round_quotient(double(y), w),
               round_quotient(double(z), w));
#else
  rejected = !(abs(x) <= number(4194304.0) && abs(y) <= number(4194304.0) &&
               abs(z) <= number(33554432.0));
  if (rejected) return ivec3(0);
  return ivec3(int(roundEven(x)), int(roundEven(y)), int(roundEven(z)));
#endif
}
)";

constexpr const char* kSnapMain = R"(
layout(std430, binding = SNAPPED) writeonly buffer Snapped { ivec4 snapped[]; };
layout(std430, binding = COUNTERS) buffer Counters { uint counters[]; };
uniform uint is_counting;

void main() {
  uint i = invocation();
  if (i >= count) return;
  bool rejected, clipped;
  ivec3 p = snap(i, rejected, clipped);
  int place = rejected || clipped ? PLACE_REJECTED : is_inside(p.xy) ? PLACE_INSIDE : PLACE_OUTSIDE;
  snapped[i] = ivec4(p, place);
  if (is_counting == 0u) return;
  if (rejected) atomicAdd(counters[REJECTED_POINTS], 1u);
  if (place != PLACE_INSIDE) atomicAdd(counters[OUTSIDE_POSITIONS], 1u);
}
)";

/// is_inside(): whether the hardware draws a triangle of such corners whole, unclipped.
std::string inside_viewport() {
  constexpr int kFirst = -256 * kViewportMargin;
  constexpr int kLast = 256 * (kViewportSize - kViewportMargin);
  return "bool is_inside(ivec2 p) {\n  return all(greaterThan(p, ivec2(" + std::to_string(kFirst) +
         "))) && all(lessThan(p, ivec2(" + std::to_string(kLast) + ")));\n}\n";
}

}  // namespace

std::string snapping() {
  return std::string(kNumbers) + kSnap;
}

std::string snap_positions(const ShaderVariant& variant) {
  return kernel_beginning(variant, kPointGroup) + snapping() + inside_viewport() + kSnapMain;
}

}  // namespace rangezip::shader_text

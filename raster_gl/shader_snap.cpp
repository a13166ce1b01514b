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
layout(std430, binding = ROWS) readonly buffer Rows { uint rows[]; };  // x, y, z, w, clip planes
uniform uint is_central;
uniform uint clip_planes;

// R2: every operation is rounded on its own.
number row_product(uint row, number x, number y, number z) {
  precise number mx = rounded(to_number(rows[4u * row]) * x);
  precise number my = rounded(to_number(rows[4u * row + 1u]) * y);
  precise number mz = rounded(to_number(rows[4u * row + 2u]) * z);
  precise number xy = rounded(mx + my);
  precise number xyz = rounded(xy + mz);
  precise number sum = rounded(xyz + to_number(rows[4u * row + 3u]));
  return sum;
}

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

// Position number i on the window's grid by R3 or R4; `rejected` if they reject it.
ivec3 snap(uint i, out bool rejected, out bool clipped) {
  number px = to_number(positions[3u * i]);
  number py = to_number(positions[3u * i + 1u]);
  number pz = to_number(positions[3u * i + 2u]);
  clipped = false;
  for (uint plane = 0u; plane < clip_planes; ++plane) {
    clipped = clipped || !(row_product(4u + plane, px, py, pz) >= number(0.0));  // R11
  }
  number x = row_product(0u, px, py, pz);
  number y = row_product(1u, px, py, pz);
  number z = row_product(2u, px, py, pz);
  // Written so that NaN is rejected.
  if (is_central == 0u) {
    rejected = !(abs(x) <= number(4194304.0) && abs(y) <= number(4194304.0) &&
                 abs(z) <= number(33554432.0));
    if (rejected) return ivec3(REJECTED_X, 0, 0);
    return ivec3(int(roundEven(x)), int(roundEven(y)), int(roundEven(z)));
  }
  double w = double(row_product(3u, px, py, pz));
  const double least = packDouble2x32(uvec2(0u, (1023u - 64u) << 20));
  const double greatest = packDouble2x32(uvec2(0u, (1023u + 64u) << 20));
  double max_xy = 4194304.0LF * w;
  rejected = !(w >= least && w <= greatest && abs(double(x)) <= max_xy &&
               abs(double(y)) <= max_xy && abs(double(z)) <= 33554432.0LF * w);
  if (rejected) return ivec3(REJECTED_X, 0, 0);
  return ivec3(round_quotient(double(x), w), round_quotient(double(y), w),
               round_quotient(double(z), w));
}
)";

constexpr const char* kSnapMain = R"(
layout(std430, binding = SNAPPED) writeonly buffer Snapped { int snapped[]; };
layout(std430, binding = COUNTERS) buffer Counters { uint counters[]; };
uniform uint is_counting;

void main() {
  uint i = invocation();
  if (i >= count) return;
  bool rejected, clipped;
  ivec3 p = snap(i, rejected, clipped);
  if (rejected && is_counting != 0u) atomicAdd(counters[REJECTED_POINTS], 1u);
  snapped[3u * i] = clipped ? REJECTED_X : p.x;
  snapped[3u * i + 1u] = p.y;
  snapped[3u * i + 2u] = p.z;
}
)";

}  // namespace

std::string snapping() {
  return std::string(kNumbers) + kSnap;
}

std::string snap_positions(const ShaderVariant& variant) {
  return kernel_beginning(variant, kPointGroup) + snapping() + kSnapMain;
}

}  // namespace rangezip::shader_text

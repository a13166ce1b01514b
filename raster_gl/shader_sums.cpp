#include "raster_gl/gl_kernels.h"
#include "raster_gl/shader_parts.h"

namespace rangezip::shader_text {

namespace {

constexpr const char* kSums = R"(
layout(std430, binding = VOTES) readonly buffer Votes { uint votes[]; };  // four bytes a number
layout(std430, binding = LOWER) readonly buffer Lower { int lower[]; };
layout(std430, binding = UPPER) readonly buffer Upper { int upper[]; };
layout(std430, binding = REFERENCE) readonly buffer Reference { int reference[]; };
#if ATOMIC_INT64
layout(std430, binding = SUMS) buffer Sums { int64_t sums[]; };
#else
layout(std430, binding = SUMS) buffer Sums { uint sums[]; };  // low half, high half
#endif
layout(std430, binding = COUNTS) buffer Counts { uint counts[]; };
layout(std430, binding = COUNTERS) buffer Counters { uint counters[]; };
uniform int width;
uniform int first_row;
uniform int row_count;
uniform int shift;
uniform uint has_votes;
uniform uint is_counting;

void add(uint sum, int64_t value) {
  if (value == 0L) return;
#if ATOMIC_INT64
  atomicAdd(sums[sum], value);
#else
  uvec2 halves = unpackUint2x32(uint64_t(value));
  uint old = atomicAdd(sums[2u * sum], halves.x);
  uint carry = old + halves.x < old ? 1u : 0u;
  if (halves.y + carry != 0u) atomicAdd(sums[2u * sum + 1u], halves.y + carry);
#endif
}

// R13 at one pixel, `from_center` away.
void add_terms(uint pixel, ivec2 from_center, int64_t z, int vote) {
  ivec2 tent = 256 - abs(from_center);
  int64_t w = int64_t(tent.x * tent.y);
  int64_t dx = int64_t(from_center.x);
  int64_t dy = int64_t(from_center.y);
  uint first = 10u * pixel;
  add(first, w);
  add(first + 1u, w * dx);
  add(first + 2u, w * dy);
  add(first + 3u, w * dx * dx);
  add(first + 4u, w * dx * dy);
  add(first + 5u, w * dy * dy);
  add(first + 6u, w * z);
  add(first + 7u, w * z * dx);
  add(first + 8u, w * z * dy);
  add(first + 9u, w * int64_t(vote));
}

void main() {
  uint point = invocation();
  if (point >= count) return;
  bool rejected, clipped;
  ivec3 p = snap(point, rejected, clipped);
  if (rejected && is_counting != 0u) atomicAdd(counters[REJECTED_POINTS], 1u);
  if (rejected || clipped || p.z < 0 || p.z > 0xffffff) return;
  int vote = has_votes == 0u
                 ? 0
                 : bitfieldExtract(int(votes[point / 4u]), int(8u * (point % 4u)), 8);
  ivec2 nearest = (p.xy - 128) >> 8;  // the lower left one of up to four
  for (int i = 0; i < 4; ++i) {
    ivec2 at = nearest + ivec2(i & 1, i >> 1);
    ivec2 from_center = p.xy - (at * 256 + 128);
    if (from_center.x == -256 || from_center.y == -256) continue;  // no weight
    if (at.x < 0 || at.x >= width || at.y < first_row || at.y >= first_row + row_count) continue;
    uint pixel = uint(at.y - first_row) * uint(width) + uint(at.x);
    if (p.z < lower[pixel] || p.z > upper[pixel]) continue;
    if (atomicAdd(counts[pixel], 1u) == MOST_POINTS) atomicMax(counters[FULL_PIXEL], pixel + 1u);
    add_terms(pixel, from_center, int64_t((p.z - reference[pixel]) >> shift), vote);
  }
}
)";

}  // namespace

std::string sum_points(const ShaderVariant& variant) {
  return kernel_beginning(variant, kPointGroup) + snapping() + kSums;
}

}  // namespace rangezip::shader_text

#include "raster_gl/shader_parts.h"

namespace rangezip::shader_text {

namespace {

constexpr const char* kPlot = R"(
uniform int width;
uniform int first_row;  // of the part of the image that is drawn
uniform int row_count;
const uint MAX_DEPTH = 0xffffffu;

#if HAS_BAND
layout(std430, binding = LOWER) readonly buffer Lower { int lower[]; };
layout(std430, binding = UPPER) readonly buffer Upper { int upper[]; };
#endif
#if PASS == PASS_KEY
layout(std430, binding = DEPTHS) buffer Keys { uint64_t keys[]; };
#else
layout(std430, binding = DEPTHS) buffer Depths { uint depths[]; };
layout(std430, binding = WINNERS) buffer Winners { uint winners[]; };
#endif

// A fragment at column x, row y; what lies outside of the planes or of the band is dropped.
void plot(int x, int y, int depth, uint id) {
  if (uint(depth) > MAX_DEPTH) return;
  uint pixel = uint(y - first_row) * uint(width) + uint(x);
#if HAS_BAND
  if (depth < lower[pixel] || depth > upper[pixel]) return;
#endif
  // Reading first spares most of the atomic operations; an old value only costs one more.
#if PASS == PASS_KEY
  uint64_t key = uint64_t(depth) << 32 | uint64_t(id);
  if (key < keys[pixel]) atomicMin(keys[pixel], key);
#elif PASS == PASS_DEPTH
  if (uint(depth) < depths[pixel]) atomicMin(depths[pixel], uint(depth));
#else
  if (uint(depth) == depths[pixel]) atomicMin(winners[pixel], id);
#endif
}
)";

}  // namespace

std::string plotting() {
  return kPlot;
}

}  // namespace rangezip::shader_text

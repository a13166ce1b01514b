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
#define Found uint64_t
#else
layout(std430, binding = DEPTHS) buffer Depths { uint depths[]; };
layout(std430, binding = WINNERS) buffer Winners { uint winners[]; };
#define Found uint
#endif

uint pixel_at(int x, int y) { return uint(y - first_row) * uint(width) + uint(x); }

// Whether a fragment lies between the planes, and in the band.
bool is_in_depth(uint pixel, int depth) {
#if HAS_BAND
  return uint(depth) <= MAX_DEPTH && depth >= lower[pixel] && depth <= upper[pixel];
#else
  return uint(depth) <= MAX_DEPTH;
#endif
}

// What a pixel holds. To read it first spares most of the atomic operations; an old value only costs
// one more.
Found look(uint pixel) {
#if PASS == PASS_KEY
  return keys[pixel];
#else
  return depths[pixel];
#endif
}

// R9, for what look() found.
void settle(uint pixel, int depth, uint id, Found found) {
#if PASS == PASS_KEY
  uint64_t key = uint64_t(depth) << 32 | uint64_t(id);
  if (key < found) atomicMin(keys[pixel], key);
#elif PASS == PASS_DEPTH
  if (uint(depth) < found) atomicMin(depths[pixel], uint(depth));
#else
  if (uint(depth) == found) atomicMin(winners[pixel], id);
#endif
}

// A fragment at column x, row y.
void plot(int x, int y, int depth, uint id) {
  uint pixel = pixel_at(x, y);
  if (is_in_depth(pixel, depth)) settle(pixel, depth, id, look(pixel));
}
)";

}  // namespace

std::string plotting() {
  return kPlot;
}

}  // namespace rangezip::shader_text

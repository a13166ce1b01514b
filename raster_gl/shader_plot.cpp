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

uint pixel_at(int x, int y) { return uint(y - first_row) * uint(width) + uint(x); }

// Whether a fragment lies between the planes, and in the band.
bool is_in_depth(uint pixel, int depth) {
#if HAS_BAND
  return uint(depth) <= MAX_DEPTH && depth >= lower[pixel] && depth <= upper[pixel];
#else
  return uint(depth) <= MAX_DEPTH;
#endif
}

// A fragment at a pixel of the part (R9); a depth of -1 draws nothing. To read first what the pixel
// holds spares most of the atomic operations; an old value only costs one more.
void plot_at(uint pixel, int depth, uint id) {
#if PASS == PASS_KEY
  uint64_t found = keys[pixel];
  uint64_t key = uint64_t(depth) << 32 | uint64_t(id);
  if (is_in_depth(pixel, depth) && key < found) atomicMin(keys[pixel], key);
#elif PASS == PASS_DEPTH
  uint found = depths[pixel];
  if (is_in_depth(pixel, depth) && uint(depth) < found) atomicMin(depths[pixel], uint(depth));
#else
  uint found = depths[pixel];
  if (is_in_depth(pixel, depth) && uint(depth) == found) atomicMin(winners[pixel], id);
#endif
}

// At column x, row y.
void plot(int x, int y, int depth, uint id) { plot_at(pixel_at(x, y), depth, id); }
)";

}  // namespace

std::string plotting() {
  return kPlot;
}

}  // namespace rangezip::shader_text

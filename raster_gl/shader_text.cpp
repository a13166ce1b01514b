#include "raster_gl/shader_text.h"

#include "raster_gl/gl_kernels.h"
#include "raster_gl/hardware_text.h"

namespace rangezip::shader_text {

namespace {

constexpr const char* kInvocation = R"(
layout(local_size_x = GROUP_SIZE) in;
uniform uint count;  // points, positions, triangles or tiles

// Groups are numbered through, however a dispatch spreads them over two dimensions.
uint group() { return gl_WorkGroupID.y * gl_NumWorkGroups.x + gl_WorkGroupID.x; }
uint invocation() { return group() * gl_WorkGroupSize.x + gl_LocalInvocationID.x; }

const int REJECTED_X = -(1 << 30);  // in place of the x of a position that is rejected
)";

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
  if (uint(depth) == depths[pixel] && id < winners[pixel]) atomicMin(winners[pixel], id);
#endif
}
)";

constexpr const char* kPoints = R"(
layout(std430, binding = COUNTERS) buffer Counters { uint counters[]; };
uniform uint first_id;
uniform int point_size;
uniform uint lanes;  // invocations that share a point
uniform uint is_counting;

void main() {
#if SINGLE_PIXELS
  uint point = invocation();
  uint lane = 0u;
#else
  uint point = invocation() / lanes;
  uint lane = invocation() % lanes;
#endif
  if (point >= count) return;
  bool rejected, clipped;
  ivec3 p = snap(point, rejected, clipped);
  if (rejected && is_counting != 0u && lane == 0u) atomicAdd(counters[REJECTED_POINTS], 1u);
  if (rejected || clipped) return;
  // R5, and what is on screen.
#if SINGLE_PIXELS
  ivec2 at = p.xy >> 8;
  if (uint(at.x) < uint(width) && uint(at.y - first_row) < uint(row_count)) {
    plot(at.x, at.y, p.z, first_id + point);
  }
#else
  ivec2 first = (p.xy - 128 * (point_size - 1)) >> 8;
  ivec2 lowest = max(first, ivec2(0, first_row));
  ivec2 size = min(first + point_size, ivec2(width, first_row + row_count)) - lowest;
  if (size.x <= 0 || size.y <= 0) return;
  uint pixels = uint(size.x) * uint(size.y);
  for (uint i = lane; i < pixels; i += lanes) {
    ivec2 at = lowest + ivec2(i % uint(size.x), i / uint(size.x));
    plot(at.x, at.y, p.z, first_id + point);
  }
#endif
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

constexpr const char* kTriangle = R"(
layout(std430, binding = SNAPPED) readonly buffer Snapped { int snapped[]; };
layout(std430, binding = CORNERS) readonly buffer Corners { uint corners[]; };
layout(std430, binding = IDS) readonly buffer Ids { uint ids[]; };  // of the pieces of triangles
uniform uint first_triangle;
uniform uint first_id;
uniform uint has_ids;
uniform int facing;  // 0 both, 1 front, -1 back

const int SMALL = 32 * 256;   // in boxes below this edges fit in 32 bits
const int SMALL_PIXELS = 64;  // that one invocation visits
const ivec2 TILE = ivec2(256, 64);

struct Corners3 { ivec3 a, b, c; };

// Counter-clockwise, with the pixels [lowest, highest] of its box.
struct Setup { ivec3 a, b, c; int64_t area; ivec2 lowest, highest; bool is_small; };

ivec3 corner(uint i) {
  uint at = 3u * corners[i];
  return ivec3(snapped[at], snapped[at + 1u], snapped[at + 2u]);
}

Corners3 corners_of(uint triangle) {
  uint at = 3u * (first_triangle + triangle);
  return Corners3(corner(at), corner(at + 1u), corner(at + 2u));
}

bool has_rejected(Corners3 t) {
  return t.a.x == REJECTED_X || t.b.x == REJECTED_X || t.c.x == REJECTED_X;
}

uint id_of(uint triangle) { return has_ids != 0u ? ids[triangle] : first_id + triangle; }

// R6; false if nothing is drawn.
bool set_up(Corners3 t, out Setup s) {
#if OUTSIDE_ONLY
  // Pieces, which have IDs of their own, are never left to the hardware.
  if (has_ids == 0u && is_inside(t.a) && is_inside(t.b) && is_inside(t.c)) return false;
#endif
  ivec3 least = min(t.a, min(t.b, t.c));
  ivec3 most = max(t.a, max(t.b, t.c));
  // Pixels whose centres lie in the box; the shift rounds down.
  s.lowest = max((least.xy + 127) >> 8, ivec2(0, first_row));
  s.highest = min((most.xy - 128) >> 8, ivec2(width - 1, first_row + row_count - 1));
  if (any(greaterThan(s.lowest, s.highest))) return false;
  if (most.z < 0 || least.z > int(MAX_DEPTH)) return false;
  ivec2 ab = t.b.xy - t.a.xy;
  ivec2 ac = t.c.xy - t.a.xy;
  int64_t area = int64_t(ab.x) * int64_t(ac.y) - int64_t(ab.y) * int64_t(ac.x);
  if (area == 0L || (facing > 0 && area < 0L) || (facing < 0 && area > 0L)) return false;
  s.a = t.a;
  s.b = area > 0L ? t.b : t.c;
  s.c = area > 0L ? t.c : t.b;
  s.area = area > 0L ? area : -area;
  ivec2 pixels = s.highest - s.lowest + 1;
  s.is_small = all(lessThan(most.xy - least.xy, ivec2(SMALL))) &&
               pixels.x <= SMALL_PIXELS && pixels.y <= SMALL_PIXELS &&
               pixels.x * pixels.y <= SMALL_PIXELS;
  return true;
}

// R6's tie rule: the least value of the edge's function that is inside.
int least_inside(ivec2 from, ivec2 to) {
  ivec2 d = to - from;
  return d.y < 0 || (d.y == 0 && d.x > 0) ? 0 : 1;
}
)";

constexpr const char* kClassify = R"(
layout(std430, binding = COUNTERS) buffer Counters { uint counters[]; };
layout(std430, binding = REJECTED) writeonly buffer Rejected { uint rejected[]; };
layout(std430, binding = TILES) writeonly buffer Tiles { uvec2 tiles[]; };
uniform uint tile_capacity;

void main() {
  uint triangle = invocation();
  if (triangle >= count) return;
  Corners3 t = corners_of(triangle);
  if (has_rejected(t)) {
    rejected[atomicAdd(counters[REJECTED_TRIANGLES], 1u)] = triangle;
    return;
  }
  Setup s;
  if (!set_up(t, s) || s.is_small) return;
  ivec2 blocks = (s.highest - s.lowest) / TILE + 1;
  uint needed = uint(blocks.x * blocks.y);
  uint first = atomicAdd(counters[TILE_COUNT], needed);
  for (uint i = 0u; i < needed && first + i < tile_capacity; ++i) {
    tiles[first + i] = uvec2(triangle, i);
  }
}
)";

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

// One group a tile of a large triangle, one invocation a row of it: the row's covered span by
// division, then quotient and remainder of R7 from pixel to pixel.
constexpr const char* kTiles = R"(
layout(std430, binding = TILES) readonly buffer Tiles { uvec2 tiles[]; };

int64_t edge(ivec2 from, ivec2 to, ivec2 at) {
  return int64_t(to.x - from.x) * int64_t(at.y - from.y) -
         int64_t(to.y - from.y) * int64_t(at.x - from.x);
}

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

// R7's quotient and remainder by two digits of base 2^13.
void divide(int64_t e[3], int z[3], int64_t area, out int quotient, out int64_t remainder) {
  int64_t high = 0L;
  int64_t low = 0L;
  for (int i = 0; i < 3; ++i) {
    high += e[i] * int64_t(z[i] >> 13);
    low += e[i] * int64_t(z[i] & 8191);
  }
  int64_t high_quotient = high / area;
  low += (high - high_quotient * area) << 13;
  int64_t low_quotient = low / area;
  quotient = (int(high_quotient) << 13) + int(low_quotient);
  remainder = low - low_quotient * area;
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
  int z[3] = int[3](s.a.z - z_min, s.b.z - z_min, s.c.z - z_min);
  int64_t e[3];
  int64_t numerator_step = 0L;
  for (int i = 0; i < 3; ++i) {
    e[i] = edge(from[i], to[i], ivec2(span.x, y) * 256 + 128);
    numerator_step += int64_t(from[i].y - to[i].y) * 256L * int64_t(z[i]);
  }
  int depth;
  int64_t remainder;
  divide(e, z, s.area, depth, remainder);
  depth += z_min;
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

constexpr const char* kOutside = R"(
layout(std430, binding = COUNTERS) buffer Counters { uint counters[]; };

void main() {
  uint triangle = invocation();
  if (triangle >= count) return;
  Corners3 t = corners_of(triangle);
  if (is_inside(t.a) && is_inside(t.b) && is_inside(t.c)) return;
  atomicAdd(counters[OUTSIDE_TRIANGLES], 1u);
}
)";

constexpr const char* kSums = R"(
layout(std430, binding = VOTES) readonly buffer Votes { uint votes[]; };  // four bytes a number
layout(std430, binding = LOWER) readonly buffer Lower { int lower[]; };
layout(std430, binding = UPPER) readonly buffer Upper { int upper[]; };
layout(std430, binding = REFERENCE) readonly buffer Reference { int reference[]; };
#if ATOMIC_INT64
layout(std430, binding = SUMS) buffer Sums { uint64_t sums[]; };
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
  atomicAdd(sums[sum], uint64_t(value));
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

std::string define(const char* name, int value) {
  return "#define " + std::string(name) + " " + std::to_string(value) + "\n";
}

std::string prelude(const ShaderVariant& variant, std::size_t group_size) {
  std::string text =
      "#version 450 core\n"
      "#extension GL_ARB_gpu_shader_int64 : require\n";
  if (variant.pass == DrawPass::key) text += "#extension GL_NV_shader_atomic_int64 : require\n";
  text += define("GROUP_SIZE", static_cast<int>(group_size));
  text += define("PASS_DEPTH", static_cast<int>(DrawPass::depth));
  text += define("PASS_WINNER", static_cast<int>(DrawPass::winner));
  text += define("PASS_KEY", static_cast<int>(DrawPass::key));
  text += define("PASS", static_cast<int>(variant.pass));
  text += define("ATOMIC_INT64", variant.pass == DrawPass::key ? 1 : 0);
  text += define("HAS_BAND", variant.has_band ? 1 : 0);
  text += define("SINGLE_PIXELS", variant.single_pixels ? 1 : 0);
  text += define("OUTSIDE_ONLY", variant.outside_only ? 1 : 0);
  text += define("WIDE_ROWS", variant.wide_rows ? 1 : 0);
  text += kernel_definitions();
  return text;
}

}  // namespace

std::string snap_positions(const ShaderVariant& variant) {
  return prelude(variant, kPointGroup) + kInvocation + kNumbers + kSnap + kSnapMain;
}
std::string draw_points(const ShaderVariant& variant) {
  return prelude(variant, kPointGroup) + kInvocation + kNumbers + kSnap + kPlot + kPoints;
}
std::string classify_triangles(const ShaderVariant& variant) {
  return prelude(variant, kTriangleGroup) + kInvocation + kPlot + inside_viewport() + kTriangle +
         kClassify;
}
std::string draw_small_triangles(const ShaderVariant& variant) {
  return prelude(variant, kTriangleGroup) + kInvocation + kPlot + inside_viewport() + kTriangle +
         kSmallTriangles;
}
std::string draw_tiles(const ShaderVariant& variant) {
  return prelude(variant, kTriangleGroup) + kInvocation + kPlot + inside_viewport() + kTriangle +
         kTiles;
}
std::string sum_points(const ShaderVariant& variant) {
  return prelude(variant, kPointGroup) + kInvocation + kNumbers + kSnap + kSums;
}

std::string count_outside(const ShaderVariant& variant) {
  return prelude(variant, kTriangleGroup) + kInvocation + kPlot + inside_viewport() + kTriangle +
         kOutside;
}

std::string inside_viewport() {
  return "bool is_inside(ivec3 p) {\n" +
         ("  return all(greaterThan(p.xy, ivec2(" + std::to_string(-256 * kViewportMargin)) +
         "))) && all(lessThan(p.xy, ivec2(" +
         std::to_string(256 * (kViewportSize - kViewportMargin)) + ")));\n}\n";
}

}  // namespace rangezip::shader_text

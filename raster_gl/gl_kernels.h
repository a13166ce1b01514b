#pragma once

#include <cstdint>
#include <map>
#include <string>
#include <utility>

#include "raster_gl/gl_buffer.h"
#include "raster_gl/gl_program.h"
#include "raster_gl/shader_text.h"

namespace rangezip {

/// The buffers of the compute kernels: X(binding, name in GLSL).
#define RANGEZIP_GL_BINDINGS(X)                                                                   \
  X(positions, POSITIONS) /* 3 floats a position */                                               \
  X(clip_rows, CLIP_ROWS) /* R11: 4 floats a clip plane */                                        \
  X(snapped, SNAPPED)     /* 4 integers a position: x, y, z, Place */                             \
  X(corners, CORNERS)     /* 3 indices a triangle */                                              \
  X(ids, IDS)             /* one a triangle, for pieces */                                        \
  X(rejected, REJECTED)   /* triangles with a rejected corner, in any order */                    \
  X(tiles, TILES)         /* of large triangles: number of the triangle, number of the tile */    \
  X(counters, COUNTERS)   /* see Counter */                                                       \
  X(depths, DEPTHS)       /* one a pixel; 64-bit keys where depth and ID are drawn in one pass */ \
  X(winners, WINNERS)     /* IDs, one a pixel; of keys that were split, the depths after them */  \
  X(lower, LOWER)         /* band of depths, one a pixel */                                       \
  X(upper, UPPER)                                                                                 \
  X(reference, REFERENCE) /* R13, one a pixel */                                                  \
  X(votes, VOTES)         /* one byte a point */                                                  \
  X(sums, SUMS)           /* PixelMoments, one a pixel */                                         \
  X(counts, COUNTS)       /* points summed, one a pixel */

enum class Binding : GLuint {
#define RANGEZIP_GL_BINDING(binding, name) binding,
  RANGEZIP_GL_BINDINGS(RANGEZIP_GL_BINDING)
#undef RANGEZIP_GL_BINDING
};

/// Numbers that the kernels count.
enum class Counter : std::uint8_t {
  rejected_points,     ///< by R3 or R4
  rejected_triangles,  ///< with a corner that is rejected
  tiles,               ///< that large triangles need, whether there was room or not
  outside_positions,   ///< that are not Place::inside
  full_pixel,          ///< 1 + number of a pixel that has more points than R13 allows, or 0
};
inline constexpr std::size_t kCounters = 5;

/// Where a snapped position lies.
enum class Place : std::int32_t {
  inside,    ///< of the viewport (kViewportSize): the hardware draws triangles of such corners
  outside,   ///< but within the guard range
  rejected,  ///< by R3, R4 or R11; it has no place
};

/// A position that kernels or the host have snapped, as it lies in the device's memory.
struct PlacedPosition {
  std::int32_t x = 0;
  std::int32_t y = 0;
  std::int32_t z = 0;
  Place place = Place::inside;
};

/// Most points that one pixel may sum (R13).
inline constexpr std::uint32_t kMostPointsPerPixel = 1U << 19U;

/// Invocations of a group: of kernels whose invocations take a point or a position, and of those
/// that take a triangle or a row of a tile.
inline constexpr std::size_t kPointGroup = 256;
inline constexpr std::size_t kTriangleGroup = 64;
[[nodiscard]] constexpr std::size_t groups_of(std::size_t invocations, std::size_t group) noexcept {
  return (invocations + group - 1) / group;
}

/// The names above as GLSL sees them.
[[nodiscard]] std::string kernel_definitions();

/// A step of drawing or summing.
enum class Kernel : std::uint8_t {
  fill,                  ///< copies of a number
  snap_positions,        ///< R2-R4, R11 for the corners of triangles
  draw_points,           ///< R2-R5, R11, R12: snaps and plots
  draw_single_points,    ///< the same for points of size 1
  classify_triangles,    ///< R6: lists rejected triangles, and the tiles of large ones
  draw_small_triangles,  ///< R6, R7: one invocation a triangle of up to 64 pixels
  draw_tiles,            ///< R6, R7: 64 invocations a tile of 256 x 64 pixels
  split_keys,            ///< IDs, then depths, of a part's keys
  sum_points,            ///< R13
};

/// The compute programs, each compiled when it is first used.
class Kernels {
 public:
  explicit Kernels(const GlDevice& device) : device_(device) {}

  /// @throws BackendError if the driver refuses it
  [[nodiscard]] const GlProgram& get(Kernel kernel, const ShaderVariant& variant);

  /// Sets the first `bytes` of a buffer to copies of `value`, and some of those after them, up
  /// to 16. By a kernel, for drivers may take a hundred times as long (glClearNamedBufferSubData).
  /// What was bound as Binding::depths is so no more. @pre they are there
  /// @throws BackendError as get()
  void fill(const GlBuffer& buffer, std::size_t bytes, std::uint32_t value);

  /// Runs `groups` groups of a kernel's invocations, and has what comes after see what they wrote.
  void dispatch(const GlProgram& program, std::size_t groups) const;

  void bind(Binding binding, const GlBuffer& buffer) const;

 private:
  const GlDevice& device_;
  std::map<std::pair<Kernel, ShaderVariant>, GlProgram> programs_;
};

}  // namespace rangezip

#pragma once

#include <cstdint>
#include <string>
#include <vector>

#include "core/raster/rasterizer.h"
#include "tests/support/shapes.h"

/// Random scenes that go looking for the corners of the drawing rules.
namespace rangezip {

/// A view with something to draw, and the memory behind it.
struct RasterScene {
  View view;
  std::vector<std::vector<Vec3f>> positions;
  std::vector<std::vector<Triangle>> corners;
  std::vector<std::vector<std::int8_t>> votes;
  std::vector<DrawItem> items;
};

/// What is special about the scenes of a family.
enum class SceneFamily : std::uint8_t {
  lattice_points,     ///< on pixel centres, corners and borders, few depths: ties
  scattered_points,   ///< anywhere, also off screen, of any size, some not finite
  central_points,     ///< a perspective view
  lattice_triangles,  ///< corners on pixel centres and corners
  tiny_triangles,     ///< less than a pixel
  slivers,            ///< long and a few 1/256 px wide
  wide_triangles,     ///< thousands of pixels, steep in depth
  plane_crossing,     ///< through the near and far planes
  duplicates,         ///< the same triangles again, rotated and turned over
  shared_edges,       ///< a jittered grid of triangles
  central_triangles,  ///< a perspective view
  mixed_and_clipped,  ///< points and triangles under clip planes
  point_sizes,        ///< every small size and 31 and 255, also with centres off screen
  image_shapes,       ///< single pixels, single rows and columns, odd widths
  guard_range,        ///< at its ends, just inside and just outside; +-7000 px
  near_the_eye,       ///< a perspective view at the ends of R4's range of w, and behind the eye
  denormals,          ///< numbers that vanish where the processor flushes them to zero
  central_lattice,    ///< a perspective view with quotients that are exact halves (R4)
};
inline constexpr int kSceneFamilies = 18;

[[nodiscard]] std::string name_of(SceneFamily family);

[[nodiscard]] RasterScene make_raster_scene(SceneFamily family, std::uint64_t seed);

/// A random band around the depths of `image`, some pixels with nothing in it.
[[nodiscard]] DepthBand random_band(const Framebuffer& image, std::uint64_t seed);

}  // namespace rangezip

#pragma once

#include <cstdint>
#include <string>

#include "tests/support/raster_scenes.h"

/// Random scenes that are worth splitting among threads, in images of many tiles: what goes wrong
/// where the parts of a drawing meet.
namespace rangezip {

/// What is special about a large scene.
enum class LargeScene : std::uint8_t {
  cloud,      ///< points of one pixel in random order, in items of very different sizes
  clustered,  ///< nearly all points in one corner of the image
  splats,     ///< points of every size, few of them large
  mesh,       ///< shared edges, corners on the lattice, few depths
  soup,       ///< triangles from below a pixel to thousands of pixels
  central,    ///< points and triangles in perspective, some behind the eye
  layers,     ///< the same points and triangles in several items: the ID decides
};
inline constexpr int kLargeScenes = 7;

[[nodiscard]] std::string name_of(LargeScene kind);

/// About `primitives` points and triangles, of the same bits everywhere.
[[nodiscard]] RasterScene make_large_scene(LargeScene kind, Extent extent, int primitives,
                                           std::uint64_t seed);

}  // namespace rangezip

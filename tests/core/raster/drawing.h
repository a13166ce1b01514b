#pragma once

#include <array>
#include <map>
#include <vector>

#include <catch2/catch.hpp>

#include "tests/support/backends.h"
#include "tests/support/lattice.h"

/// Small images drawn by every backend.
namespace rangezip::drawing {

inline constexpr Extent kExtent{48, 40};
inline const std::vector<Triangle> kOneFace{{0, 1, 2}};

/// Runs `body` with a fresh rasterizer of every backend.
template <class Body>
void for_each_backend(const Body& body) {
  for (const Backend& backend : all_backends()) {
    CAPTURE(backend.name);
    const auto rasterizer = backend.make();
    body(*rasterizer);
  }
}

inline Framebuffer draw(Rasterizer& rasterizer, const std::vector<DrawItem>& items,
                        Extent extent = kExtent) {
  return rasterizer.render(lattice::view(extent), items);
}

/// Number of pixels that each id won.
inline std::map<PrimitiveId, int> pixels_of_ids(const Framebuffer& image) {
  std::map<PrimitiveId, int> count;
  for (const PrimitiveId id : image.id.pixels()) {
    if (id != kNoPrimitive) ++count[id];
  }
  return count;
}

/// One triangle with its corners in pixels.
inline std::vector<Vec3f> corners_at(std::array<Vec2, 3> at, std::array<float, 3> z) {
  std::vector<Vec3f> corners;
  for (std::size_t i = 0; i < 3; ++i)
    corners.emplace_back(lattice::px(at[i].x), lattice::px(at[i].y), z[i]);
  return corners;
}

}  // namespace rangezip::drawing

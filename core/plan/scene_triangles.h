#pragma once

#include <variant>

#include "core/base/geometry.h"
#include "core/scene/scene.h"

namespace rangezip {

/// The corners of a triangle in world space.
struct TriangleCorners {
  Vec3 a, b, c;
};

/// Calls visit(TriangleCorners) for each triangle of the scene, in order of addition.
template <class Visitor>
void for_each_triangle(const Scene& scene, const Visitor& visit) {
  for (const DrawItem& item : scene.draw_items()) {
    const auto* soup = std::get_if<DrawTriangles>(&item);
    if (soup == nullptr) continue;
    const auto world = [&](std::uint32_t corner) {
      return Vec3(soup->world_from_item * Vec4(Vec3(soup->positions[corner]), 1.0));
    };
    for (const Triangle& t : soup->triangles)
      visit(TriangleCorners{world(t[0]), world(t[1]), world(t[2])});
  }
}

}  // namespace rangezip

#pragma once

#include <span>
#include <unordered_map>
#include <vector>

#include "core/raster/draw_item.h"

namespace rangezip {

/// Some triangles of an item with only the positions that they need.
struct GatheredTriangles {
  std::vector<Vec3f> positions;
  std::vector<Triangle> triangles;
};

/// For items with more positions than a buffer holds: the triangles [begin, end) by themselves.
[[nodiscard]] inline GatheredTriangles gather(const DrawTriangles& item, std::size_t begin,
                                              std::size_t end) {
  GatheredTriangles gathered;
  std::unordered_map<std::uint32_t, std::uint32_t> place_of;
  for (const Triangle& triangle : item.triangles.subspan(begin, end - begin)) {
    Triangle& copy = gathered.triangles.emplace_back();
    for (std::size_t corner = 0; corner < 3; ++corner) {
      const auto next = static_cast<std::uint32_t>(gathered.positions.size());
      const auto [found, is_new] = place_of.try_emplace(triangle[corner], next);
      if (is_new) gathered.positions.push_back(item.positions[triangle[corner]]);
      copy[corner] = found->second;
    }
  }
  return gathered;
}

}  // namespace rangezip

#pragma once

#include <cstddef>
#include <cstdint>
#include <vector>

#include "core/finish/corner_table.h"

namespace rangezip {

/// The component of each face, joined over shared edges, numbered from 0 in order of their first
/// face; deleted faces get CornerTable::kNone. O(faces).
/// @param joins (corner) whether the edge of a half-edge that is not at the boundary joins its two
///     faces; the same for both half-edges
template <class Joins>
[[nodiscard]] std::vector<std::uint32_t> components_of(const CornerTable& table,
                                                       const Joins& joins) {
  std::vector<std::uint32_t> component(table.face_count(), CornerTable::kNone);
  std::vector<std::uint32_t> open;
  std::uint32_t count = 0;
  for (std::uint32_t seed = 0; seed < component.size(); ++seed) {
    if (component[seed] != CornerTable::kNone || table.is_deleted(seed)) continue;
    component[seed] = count;
    open.push_back(seed);
    while (!open.empty()) {
      const std::uint32_t face = open.back();
      open.pop_back();
      for (std::uint32_t c = 3 * face; c < 3 * face + 3; ++c) {
        const std::uint32_t other = table.across(c);
        if (other == CornerTable::kNone || component[other / 3] != CornerTable::kNone) continue;
        if (!joins(c)) continue;
        component[other / 3] = count;
        open.push_back(other / 3);
      }
    }
    ++count;
  }
  return component;
}

/// The same, joined over all edges.
[[nodiscard]] inline std::vector<std::uint32_t> components_of(const CornerTable& table) {
  return components_of(table, [](std::uint32_t) { return true; });
}

/// How many faces each component has; deleted ones do not count.
[[nodiscard]] inline std::vector<std::size_t> component_sizes(
    const std::vector<std::uint32_t>& component) {
  std::vector<std::size_t> sizes;
  for (const std::uint32_t c : component) {
    if (c == CornerTable::kNone) continue;
    if (c >= sizes.size()) sizes.resize(c + 1, 0);
    ++sizes[c];
  }
  return sizes;
}

}  // namespace rangezip

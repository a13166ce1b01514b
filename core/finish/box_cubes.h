#pragma once

#include <algorithm>
#include <cstdint>
#include <utility>
#include <vector>

#include "core/base/cubes.h"
#include "core/base/geometry.h"

namespace rangezip {

/// What has a box, by the cubes of a grid that the boxes meet.
class BoxCubes {
 public:
  /// @param origin moves along with the mesh: so do the cubes
  BoxCubes(const Vec3& origin, double side) : origin_(origin), per_side_(1.0 / side) {}

  void add(const Box& box, std::uint32_t id) {
    for_each(box, [&](const Cube& cube) { entries_.emplace_back(cube, id); });
  }
  void sort() {
    std::sort(entries_.begin(), entries_.end());
    entries_.erase(std::unique(entries_.begin(), entries_.end()), entries_.end());
  }
  /// Those whose boxes meet a cube that this one meets, rising. @pre sort()
  [[nodiscard]] std::vector<std::uint32_t> near(const Box& box) const {
    std::vector<std::uint32_t> ids;
    for_each(box, [&](const Cube& cube) {
      auto entry = std::lower_bound(entries_.begin(), entries_.end(), Entry(cube, 0));
      for (; entry != entries_.end() && entry->first == cube; ++entry)
        ids.push_back(entry->second);
    });
    std::sort(ids.begin(), ids.end());
    ids.erase(std::unique(ids.begin(), ids.end()), ids.end());
    return ids;
  }

 private:
  using Entry = std::pair<Cube, std::uint32_t>;

  [[nodiscard]] Cube cube_at(const Vec3& place) const {
    const Vec3 cube = glm::floor((place - origin_) * per_side_);
    return {static_cast<std::int64_t>(cube.x), static_cast<std::int64_t>(cube.y),
            static_cast<std::int64_t>(cube.z)};
  }
  template <class Visit>
  void for_each(const Box& box, const Visit& visit) const {
    const Cube lower = cube_at(box.lower), upper = cube_at(box.upper);
    for (std::int64_t x = lower[0]; x <= upper[0]; ++x) {
      for (std::int64_t y = lower[1]; y <= upper[1]; ++y) {
        for (std::int64_t z = lower[2]; z <= upper[2]; ++z)
          visit({x, y, z});
      }
    }
  }

  Vec3 origin_;
  double per_side_;
  std::vector<Entry> entries_;
};

}  // namespace rangezip

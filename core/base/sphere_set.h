#pragma once

#include <span>
#include <vector>

#include "core/base/cubes.h"
#include "core/base/sphere.h"

namespace rangezip {

/// Spheres to ask whether one of them holds a point. Made in O(n log n); a question costs O(log n)
/// and the spheres near the point, as long as none is far larger than most.
class SphereSet {
 public:
  /// @pre finite, with positive radii
  explicit SphereSet(std::span<const Sphere> spheres);

  [[nodiscard]] bool contains(const Vec3& point) const noexcept;

 private:
  struct Entry {
    Cube cube;
    Sphere sphere;
  };

  Box bounds_;
  double side_ = 1.0;  ///< of the cubes: no sphere reaches into more than two along an axis
  std::vector<Entry> entries_;  ///< by cube
};

}  // namespace rangezip

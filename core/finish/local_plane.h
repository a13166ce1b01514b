#pragma once

#include "core/base/geometry.h"

namespace rangezip {

/// The plane through weighted points that leaves the least squares of distances.
struct LocalPlane {
  Vec3 center{0.0};            ///< weighted mean of the points
  Vec3 normal{0.0, 0.0, 1.0};  ///< unit, either side
  double thickness = 0.0;      ///< mean square distance from the plane: the smallest eigenvalue of
                               ///< the covariance
  double width = 0.0;          ///< the same along the plane where it is narrower: the middle one
};

/// Sums over points from which the plane follows; order of addition matters for the last bits.
class PlaneSums {
 public:
  void add(const Vec3& p, double weight) noexcept {
    weight_ += weight;
    const Vec3 q = weight * p;
    sum_ += q;
    xx_ += q.x * p.x;
    yy_ += q.y * p.y;
    zz_ += q.z * p.z;
    xy_ += q.x * p.y;
    yz_ += q.y * p.z;
    zx_ += q.z * p.x;
    ++count_;
  }
  [[nodiscard]] int count() const noexcept { return count_; }

  /// @pre positive weight in all
  [[nodiscard]] LocalPlane plane() const noexcept;

 private:
  double weight_ = 0.0;
  Vec3 sum_{0.0};
  double xx_ = 0.0, yy_ = 0.0, zz_ = 0.0, xy_ = 0.0, yz_ = 0.0, zx_ = 0.0;
  int count_ = 0;
};

}  // namespace rangezip

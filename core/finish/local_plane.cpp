#include "core/finish/local_plane.h"

#include <algorithm>

#include "core/base/symmetric_eigen.h"

namespace rangezip {

LocalPlane PlaneSums::plane() const noexcept {
  LocalPlane plane;
  plane.center = sum_ / weight_;
  const Vec3& c = plane.center;
  const double w = 1.0 / weight_;
  const double xy = xy_ * w - c.x * c.y, yz = yz_ * w - c.y * c.z, zx = zx_ * w - c.z * c.x;
  const SymmetricEigen covariance = eigen_of_symmetric(Mat3{
      {xx_ * w - c.x * c.x, xy, zx}, {xy, yy_ * w - c.y * c.y, yz}, {zx, yz, zz_ * w - c.z * c.z}});
  plane.normal = covariance.vectors[0];
  plane.thickness = std::max(0.0, covariance.values[0]);
  plane.width = std::max(0.0, covariance.values[1]);
  return plane;
}

}  // namespace rangezip

#include "core/finish/local_plane.h"

#include <algorithm>
#include <array>
#include <cmath>

namespace rangezip {
namespace {

/// A symmetric 3 x 3 matrix that rotations make diagonal, and the product of the rotations.
struct Diagonalizer {
  double m[3][3];
  double axes[3][3] = {{1.0, 0.0, 0.0}, {0.0, 1.0, 0.0}, {0.0, 0.0, 1.0}};  ///< columns

  /// Makes m[p][q] zero [Golub, Van Loan 1996, 8.4].
  void rotate(int p, int q) {
    if (m[p][q] == 0.0) return;
    const double theta = (m[q][q] - m[p][p]) / (2.0 * m[p][q]);
    const double t =
        (theta >= 0.0 ? 1.0 : -1.0) / (std::abs(theta) + std::sqrt(theta * theta + 1.0));
    const double c = 1.0 / std::sqrt(t * t + 1.0);
    const double s = t * c;
    const int r = 3 - p - q;
    const double shift = t * m[p][q];
    m[p][p] -= shift;
    m[q][q] += shift;
    m[p][q] = m[q][p] = 0.0;
    const double rp = m[r][p], rq = m[r][q];
    m[r][p] = m[p][r] = c * rp - s * rq;
    m[r][q] = m[q][r] = s * rp + c * rq;
    for (auto& row : axes) {
      const double a = row[p], b = row[q];
      row[p] = c * a - s * b;
      row[q] = s * a + c * b;
    }
  }
};

}  // namespace

LocalPlane PlaneSums::plane() const noexcept {
  LocalPlane plane;
  plane.center = sum_ / weight_;
  const Vec3& c = plane.center;
  const double w = 1.0 / weight_;
  const double xy = xy_ * w - c.x * c.y, yz = yz_ * w - c.y * c.z, zx = zx_ * w - c.z * c.x;
  Diagonalizer d{{{xx_ * w - c.x * c.x, xy, zx},
                  {xy, yy_ * w - c.y * c.y, yz},
                  {zx, yz, zz_ * w - c.z * c.z}}};
  // Convergence is quadratic: the off-diagonal part is below rounding after four sweeps.
  constexpr int kSweeps = 4;
  for (int sweep = 0; sweep < kSweeps; ++sweep) {
    d.rotate(0, 1);
    d.rotate(0, 2);
    d.rotate(1, 2);
  }
  std::array<int, 3> order{0, 1, 2};
  std::stable_sort(order.begin(), order.end(), [&](int i, int j) { return d.m[i][i] < d.m[j][j]; });
  const int least = order[0];
  plane.normal = {d.axes[0][least], d.axes[1][least], d.axes[2][least]};
  plane.thickness = std::max(0.0, d.m[least][least]);
  plane.width = std::max(0.0, d.m[order[1]][order[1]]);
  return plane;
}

}  // namespace rangezip

#include "core/base/symmetric_eigen.h"

#include <algorithm>
#include <array>
#include <cmath>

namespace rangezip {

namespace {

/// A symmetric matrix that rotations make diagonal, and the product of the rotations.
struct Diagonalizer {
  Mat3 m;
  Mat3 axes{1.0};  ///< columns

  /// Makes m[p][q] zero by a rotation in the plane of the axes p and q.
  void rotate(int p, int q) noexcept {
    if (m[p][q] == 0.0) return;
    const double theta = (m[q][q] - m[p][p]) / (2.0 * m[p][q]);
    const double root = std::abs(theta) + std::sqrt(theta * theta + 1.0);
    const double tangent = (theta >= 0.0 ? 1.0 : -1.0) / root;
    const double cosine = 1.0 / std::sqrt(tangent * tangent + 1.0);
    const double sine = tangent * cosine;
    const int r = 3 - p - q;
    const double shift = tangent * m[p][q];
    const double rp = m[r][p], rq = m[r][q];
    m[p][p] -= shift;
    m[q][q] += shift;
    m[p][q] = m[q][p] = 0.0;
    m[r][p] = m[p][r] = cosine * rp - sine * rq;
    m[r][q] = m[q][r] = sine * rp + cosine * rq;
    const Vec3 a = axes[p], b = axes[q];
    axes[p] = cosine * a - sine * b;
    axes[q] = sine * a + cosine * b;
  }
};

}  // namespace

SymmetricEigen eigen_of_symmetric(const Mat3& matrix) noexcept {
  Diagonalizer d{.m = matrix};
  // Convergence is at least quadratic: what is off the diagonal is below rounding after four.
  constexpr int kSweeps = 4;
  for (int sweep = 0; sweep < kSweeps; ++sweep) {
    d.rotate(0, 1);
    d.rotate(0, 2);
    d.rotate(1, 2);
  }
  std::array<int, 3> order{0, 1, 2};
  std::stable_sort(order.begin(), order.end(), [&](int i, int j) { return d.m[i][i] < d.m[j][j]; });
  const auto [least, middle, most] = order;
  return {.values = {d.m[least][least], d.m[middle][middle], d.m[most][most]},
          .vectors = {d.axes[least], d.axes[middle], d.axes[most]}};
}

}  // namespace rangezip

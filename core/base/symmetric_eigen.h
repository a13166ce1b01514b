#pragma once

#include "core/base/geometry.h"

namespace rangezip {

/// Eigenvalues of a symmetric 3 x 3 matrix, ascending, and unit eigenvectors that are orthogonal to
/// each other: `vectors[i]` (a column) belongs to `values[i]`, either way round.
struct SymmetricEigen {
  Vec3 values{0.0};
  Mat3 vectors{1.0};
};

/// By Jacobi rotations [Golub, Van Loan 2013, 8.5], which need square roots only, so that the bits
/// are the same on every machine. Values are right to about 1e-15 of the largest one by size;
/// those of a diagonal matrix are exact, and equal ones keep the order that they have there.
/// An entry that is not finite makes the result meaningless. Cost: O(1), about 12 rotations.
/// @pre `matrix` is symmetric bit for bit
[[nodiscard]] SymmetricEigen eigen_of_symmetric(const Mat3& matrix) noexcept;

}  // namespace rangezip

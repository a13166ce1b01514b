#include "core/base/symmetric_eigen.h"

#include <algorithm>
#include <cmath>

#include <catch2/catch.hpp>

#include "tests/support/shapes.h"

namespace rangezip {
namespace {

/// Largest entry by size.
double size_of(const Mat3& m) {
  double size = 0.0;
  for (int i = 0; i < 3; ++i) {
    for (int j = 0; j < 3; ++j)
      size = std::max(size, std::abs(m[i][j]));
  }
  return size;
}

/// Holds the result against what eigenvalues and eigenvectors are.
void check_is_eigen(const Mat3& matrix, const SymmetricEigen& eigen) {
  const double tolerance = 4e-15 * size_of(matrix);
  CHECK(eigen.values[0] <= eigen.values[1]);
  CHECK(eigen.values[1] <= eigen.values[2]);
  for (int i = 0; i < 3; ++i) {
    const Vec3 rest = matrix * eigen.vectors[i] - eigen.values[i] * eigen.vectors[i];
    CHECK(glm::length(rest) <= tolerance);
  }
  const double trace = matrix[0][0] + matrix[1][1] + matrix[2][2];
  CHECK(std::abs(eigen.values[0] + eigen.values[1] + eigen.values[2] - trace) <= tolerance);
  CHECK(size_of(glm::transpose(eigen.vectors) * eigen.vectors - Mat3(1.0)) <= 4e-15);
}

Mat3 symmetric(double xx, double yy, double zz, double xy, double yz, double zx) {
  return Mat3{{xx, xy, zx}, {xy, yy, yz}, {zx, yz, zz}};
}

TEST_CASE("a diagonal matrix gives its entries in order, and the axes", "[base]") {
  const SymmetricEigen eigen = eigen_of_symmetric(symmetric(7.0, -2.0, 0.5, 0, 0, 0));
  CHECK(eigen.values == Vec3{-2.0, 0.5, 7.0});
  CHECK(eigen.vectors == Mat3{{0, 1, 0}, {0, 0, 1}, {1, 0, 0}});
  const SymmetricEigen equal = eigen_of_symmetric(Mat3(3.0));
  CHECK(equal.values == Vec3{3.0});
  CHECK(equal.vectors == Mat3(1.0));
  CHECK(eigen_of_symmetric(Mat3(0.0)).values == Vec3{0.0});
}

TEST_CASE("a block of two has eigenvalues from the quadratic formula", "[base]") {
  // (3, 4; 4, -3) turns by the half angle of (3, 4, 5).
  const Mat3 matrix = symmetric(3.0, -3.0, 1.0, 4.0, 0, 0);
  const SymmetricEigen eigen = eigen_of_symmetric(matrix);
  check_is_eigen(matrix, eigen);
  CHECK(glm::distance(eigen.values, Vec3{-5.0, 1.0, 5.0}) < 4e-15);
  CHECK(std::abs(glm::dot(eigen.vectors[0], Vec3{1, -2, 0})) == Approx(std::sqrt(5.0)));
  CHECK(std::abs(glm::dot(eigen.vectors[2], Vec3{2, 1, 0})) == Approx(std::sqrt(5.0)));
}

TEST_CASE("the second difference has eigenvalues 2 - sqrt 2, 2 and 2 + sqrt 2", "[base]") {
  const Mat3 matrix = symmetric(2.0, 2.0, 2.0, -1.0, -1.0, 0.0);
  const SymmetricEigen eigen = eigen_of_symmetric(matrix);
  check_is_eigen(matrix, eigen);
  const double root = std::sqrt(2.0);
  CHECK(glm::distance(eigen.values, Vec3{2.0 - root, 2.0, 2.0 + root}) < 4e-15);
  CHECK(std::abs(glm::dot(eigen.vectors[0], Vec3{0.5, root / 2.0, 0.5})) == Approx(1.0));
}

TEST_CASE("an outer product has one eigenvalue, its direction's square", "[base]") {
  shapes::Random random(1);
  for (int i = 0; i < 1000; ++i) {
    const Vec3 normal = random.direction();
    const Vec3 v = random.between(0.1, 10.0) * normal;
    const Mat3 matrix = glm::outerProduct(v, v);
    const SymmetricEigen eigen = eigen_of_symmetric(matrix);
    check_is_eigen(matrix, eigen);
    CHECK(eigen.values[2] == Approx(glm::dot(v, v)).epsilon(1e-14));
    CHECK(std::abs(eigen.values[0]) + std::abs(eigen.values[1]) <= 4e-15 * glm::dot(v, v));
    CHECK(std::abs(glm::dot(eigen.vectors[2], normal)) == Approx(1.0).epsilon(1e-14));
  }
}

TEST_CASE("random matrices, flat, thin or with all but equal values, are solved", "[base]") {
  shapes::Random random(2);
  for (const double flatness : {1.0, 1e-3, 1e-8, 1e-14, 0.0}) {
    CAPTURE(flatness);
    for (const double base : {0.0, 1.0}) {
      for (int i = 0; i < 500; ++i) {
        // Steps of `flatness` between the values, above 0 or above 1.
        const Vec3 u = random.direction();
        const Vec3 v = glm::normalize(glm::cross(u, random.direction()));
        const double step = random.between(-1.0, 1.0);
        const Mat3 matrix = base * Mat3(1.0) + glm::outerProduct(u, u) +
                            (flatness * step) * glm::outerProduct(v, v);
        check_is_eigen(matrix, eigen_of_symmetric(matrix));
      }
    }
  }
}

TEST_CASE("scaling by a power of two scales the values and keeps the vectors", "[base]") {
  shapes::Random random(3);
  for (int i = 0; i < 200; ++i) {
    const auto any = [&] { return random.between(-1.0, 1.0); };
    const Mat3 matrix = symmetric(any(), any(), any(), any(), any(), any());
    const SymmetricEigen eigen = eigen_of_symmetric(matrix);
    check_is_eigen(matrix, eigen);
    const SymmetricEigen larger = eigen_of_symmetric(0x1p40 * matrix);
    CHECK(larger.values == 0x1p40 * eigen.values);
    CHECK(larger.vectors == eigen.vectors);
  }
}

}  // namespace
}  // namespace rangezip

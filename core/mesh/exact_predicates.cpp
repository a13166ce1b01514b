#include "core/mesh/exact_predicates.h"

#include <array>
#include <cmath>
#include <cstddef>
#include <limits>

namespace rangezip {
namespace {

/// Half an ulp of 1: the relative error of one rounding.
constexpr double kRounding = std::numeric_limits<double>::epsilon() / 2.0;
/// Error bounds of the plain evaluation relative to the sum of the magnitudes of all products
/// [Shewchuk 1997, figures 21 and 22: bounds A].
constexpr double kError2d = (3.0 + 16.0 * kRounding) * kRounding;
constexpr double kError3d = (7.0 + 56.0 * kRounding) * kRounding;
/// 2^27 + 1 cuts a double into two halves of 26 bits [Dekker 1971].
constexpr double kSplitter = 134217729.0;

/// A sum and its rounding error: value = high + low exactly.
struct TwoTerms {
  double high;
  double low;
};

TwoTerms exact_sum(double a, double b) {
  const double sum = a + b;
  const double b_virtual = sum - a;
  const double a_virtual = sum - b_virtual;
  return {sum, (a - a_virtual) + (b - b_virtual)};
}

TwoTerms split(double a) {
  const double scaled = kSplitter * a;
  const double high = scaled - (scaled - a);
  return {high, a - high};
}

TwoTerms exact_product(double a, double b) {
  const double product = a * b;
  const TwoTerms x = split(a);
  const TwoTerms y = split(b);
  const double error = ((product - x.high * y.high) - x.low * y.high) - x.high * y.low;
  return {product, x.low * y.low - error};
}

/// A sum of doubles that do not overlap, in increasing magnitude and without zeros; the sign is
/// that of the last one.
template <std::size_t kCapacity>
struct Expansion {
  std::array<double, kCapacity> terms;
  std::size_t size = 0;

  void push(double term) {
    if (term != 0.0) terms[size++] = term;
  }
  /// Adds any number (GROW-EXPANSION with zeros left out). The expansions here are short.
  void grow(double carry) {
    const std::size_t count = size;
    size = 0;
    for (std::size_t i = 0; i < count; ++i) {
      const TwoTerms s = exact_sum(carry, terms[i]);
      push(s.low);
      carry = s.high;
    }
    push(carry);
  }
  [[nodiscard]] int sign() const {
    if (size == 0) return 0;
    return terms[size - 1] > 0.0 ? 1 : -1;
  }
};

/// a - b without error.
Expansion<2> difference(double a, double b) {
  const TwoTerms d = exact_sum(a, -b);
  Expansion<2> result;
  result.push(d.low);
  result.push(d.high);
  return result;
}

template <std::size_t kA, std::size_t kB>
Expansion<kA + kB> sum(const Expansion<kA>& a, const Expansion<kB>& b) {
  Expansion<kA + kB> result;
  for (std::size_t i = 0; i < a.size; ++i)
    result.push(a.terms[i]);
  for (std::size_t j = 0; j < b.size; ++j)
    result.grow(b.terms[j]);
  return result;
}

/// The products of all pairs of terms, summed.
template <std::size_t kA, std::size_t kB>
Expansion<2 * kA * kB> product(const Expansion<kA>& a, const Expansion<kB>& b) {
  Expansion<2 * kA * kB> result;
  for (std::size_t i = 0; i < a.size; ++i) {
    for (std::size_t j = 0; j < b.size; ++j) {
      const TwoTerms p = exact_product(a.terms[i], b.terms[j]);
      result.grow(p.low);
      result.grow(p.high);
    }
  }
  return result;
}

template <std::size_t kA>
Expansion<kA> negated(Expansion<kA> a) {
  for (std::size_t i = 0; i < a.size; ++i)
    a.terms[i] = -a.terms[i];
  return a;
}

/// ax by - ay bx without error.
Expansion<16> cross(const Expansion<2>& ax, const Expansion<2>& ay, const Expansion<2>& bx,
                    const Expansion<2>& by) {
  return sum(product(ax, by), negated(product(ay, bx)));
}

int exact_orientation_2d(const Vec2& a, const Vec2& b, const Vec2& c) {
  return cross(difference(a.x, c.x), difference(a.y, c.y), difference(b.x, c.x),
               difference(b.y, c.y))
      .sign();
}

int exact_orientation_3d(const Vec3& a, const Vec3& b, const Vec3& c, const Vec3& d) {
  const Expansion<2> ax = difference(a.x, d.x), ay = difference(a.y, d.y);
  const Expansion<2> bx = difference(b.x, d.x), by = difference(b.y, d.y);
  const Expansion<2> cx = difference(c.x, d.x), cy = difference(c.y, d.y);
  const auto a_part = product(cross(bx, by, cx, cy), difference(a.z, d.z));
  const auto b_part = product(cross(cx, cy, ax, ay), difference(b.z, d.z));
  const auto c_part = product(cross(ax, ay, bx, by), difference(c.z, d.z));
  return sum(sum(a_part, b_part), c_part).sign();
}

/// The sign of a computed determinant if it is certain, else 2.
constexpr int kUncertain = 2;
int filtered_sign(double determinant, double bound) {
  if (determinant > bound) return 1;
  if (determinant < -bound) return -1;
  return bound == 0.0 ? 0 : kUncertain;  // every product is zero
}

}  // namespace

int orientation_2d(const Vec2& a, const Vec2& b, const Vec2& c) noexcept {
  const double left = (a.x - c.x) * (b.y - c.y);
  const double right = (a.y - c.y) * (b.x - c.x);
  const int sign = filtered_sign(left - right, kError2d * (std::abs(left) + std::abs(right)));
  return sign != kUncertain ? sign : exact_orientation_2d(a, b, c);
}

int orientation_3d(const Vec3& a, const Vec3& b, const Vec3& c, const Vec3& d) noexcept {
  const Vec3 ad = a - d;
  const Vec3 bd = b - d;
  const Vec3 cd = c - d;
  const double bc_left = bd.x * cd.y, bc_right = cd.x * bd.y;
  const double ca_left = cd.x * ad.y, ca_right = ad.x * cd.y;
  const double ab_left = ad.x * bd.y, ab_right = bd.x * ad.y;
  const double determinant =
      ad.z * (bc_left - bc_right) + bd.z * (ca_left - ca_right) + cd.z * (ab_left - ab_right);
  const double magnitude = (std::abs(bc_left) + std::abs(bc_right)) * std::abs(ad.z) +
                           (std::abs(ca_left) + std::abs(ca_right)) * std::abs(bd.z) +
                           (std::abs(ab_left) + std::abs(ab_right)) * std::abs(cd.z);
  const int sign = filtered_sign(determinant, kError3d * magnitude);
  return sign != kUncertain ? sign : exact_orientation_3d(a, b, c, d);
}

bool are_collinear(const Vec3& a, const Vec3& b, const Vec3& c) noexcept {
  return orientation_2d({a.x, a.y}, {b.x, b.y}, {c.x, c.y}) == 0 &&
         orientation_2d({a.y, a.z}, {b.y, b.z}, {c.y, c.z}) == 0 &&
         orientation_2d({a.z, a.x}, {b.z, b.x}, {c.z, c.x}) == 0;
}

}  // namespace rangezip

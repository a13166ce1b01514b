#include "core/finish/edge_lengths.h"

#include <algorithm>
#include <cmath>
#include <cstdint>

#include "core/base/parallel.h"
#include "core/finish/vertex_geometry.h"

namespace rangezip {
namespace {

constexpr double kLargestRatio = 1.6;   // to the mean, both ways
constexpr double kLeastBending = 0.02;  // radians over an edge
constexpr int kSmoothings = 4;
constexpr double kSmoothing = 0.5;  // of the way to the mean of the neighbours
constexpr int kScalings = 4;
constexpr std::size_t kPerBlock = 4096;

/// x^(-1/3) of a positive number, by operations that are the same in every mathematical library.
double inverse_cube_root(double x) {
  int exponent = 0;
  const double fraction = std::frexp(x, &exponent);  // [0.5, 1)
  const int third = (exponent + (exponent > 0 ? 2 : 0)) / 3;
  const double rest = std::ldexp(fraction, exponent - 3 * third);  // [1/8, 1)
  double root = 1.0;
  constexpr int kSteps = 8;
  for (int i = 0; i < kSteps; ++i)  // Newton's, from below
    root *= (4.0 - rest * root * root * root) / 3.0;
  return std::ldexp(root, -third);
}

double bounded(double length) {
  return std::clamp(length, 1.0 / kLargestRatio, kLargestRatio);
}

/// The unit in which the bounded lengths give as many triangles, of area as their squares, as
/// length 1 everywhere.
double unit_of(const CornerTable& table, const std::vector<Vec3>& positions,
               const std::vector<double>& lengths) {
  std::vector<double> sizes(table.face_count(), 0.0);
  parallel_for(sizes.size(), kPerBlock, [&](std::size_t begin, std::size_t end) {
    for (auto f = static_cast<std::uint32_t>(begin); f < end; ++f) {
      if (!table.is_deleted(f)) sizes[f] = glm::length(face_area_vector(table, positions, f));
    }
  });
  std::vector<double> squares(lengths.size());
  double unit = 1.0;
  for (int i = 0; i < kScalings; ++i) {
    parallel_for(squares.size(), kPerBlock, [&](std::size_t begin, std::size_t end) {
      for (std::size_t v = begin; v < end; ++v) {
        const double length = bounded(lengths[v] / unit);
        squares[v] = 3.0 * length * length;
      }
    });
    double area = 0.0, triangles = 0.0;
    for (std::uint32_t f = 0; f < sizes.size(); ++f) {
      if (table.is_deleted(f)) continue;
      area += sizes[f];
      for (const std::uint32_t v : table.triangle(f))
        triangles += sizes[f] / squares[v];
    }
    if (!(area > 0.0)) return unit;
    unit *= std::sqrt(area / triangles);
  }
  return unit;
}

}  // namespace

std::vector<double> relative_edge_lengths(const CornerTable& table,
                                          const std::vector<Vec3>& positions,
                                          const std::vector<SurfaceFit>& fits, double length) {
  std::vector<double> lengths(positions.size(), 0.0);
  parallel_for(fits.size(), kPerBlock, [&](std::size_t begin, std::size_t end) {
    for (std::size_t v = begin; v < end; ++v) {
      const double bending = fits[v].is_found ? frobenius_norm(fits[v].bending) * length : 0.0;
      lengths[v] = inverse_cube_root(std::max(bending, kLeastBending));
    }
  });
  for (int i = 0; i < kSmoothings; ++i)
    lengths = smoothed(table, lengths, kSmoothing);
  const double unit = unit_of(table, positions, lengths);
  for (double& value : lengths)
    value = bounded(value / unit);
  return lengths;
}

}  // namespace rangezip

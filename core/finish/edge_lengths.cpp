#include "core/finish/edge_lengths.h"

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <utility>

#include "core/finish/vertex_geometry.h"

namespace rangezip {
namespace {

constexpr double kExponent = 1.0 / 3.0;
constexpr double kLargestRatio = 1.6;   // to the mean, both ways
constexpr double kLeastBending = 0.02;  // radians over an edge
constexpr int kSmoothings = 4;
constexpr int kScalings = 4;

double frobenius(const Mat3& m) {
  return std::sqrt(glm::dot(m[0], m[0]) + glm::dot(m[1], m[1]) + glm::dot(m[2], m[2]));
}

/// Each value goes half-way to the mean of its neighbours'.
void smooth(const CornerTable& table, std::vector<double>& values) {
  std::vector<double> next = values;
  for (std::uint32_t v = 0; v < values.size(); ++v) {
    double sum = 0.0;
    int count = 0;
    table.for_each_neighbor(v, [&](std::uint32_t w) {
      sum += values[w];
      ++count;
    });
    if (count > 0) next[v] = 0.5 * (values[v] + sum / count);
  }
  values = std::move(next);
}

/// The length of a logarithm over the logarithm of the mean.
double bounded_length(double logarithm, double mean) {
  const double most = std::log(kLargestRatio);
  return std::exp(std::clamp(logarithm - mean, -most, most));
}

/// The logarithm of the mean for which the triangles, of area as the squared length, are as many as
/// with length 1.
double scale_of(const CornerTable& table, const std::vector<Vec3>& positions,
                const std::vector<double>& logarithms) {
  double mean = 0.0;
  for (int i = 0; i < kScalings; ++i) {
    double area = 0.0, triangles = 0.0;
    for (std::uint32_t f = 0; f < table.face_count(); ++f) {
      if (table.is_deleted(f)) continue;
      const double size = glm::length(face_area_vector(table, positions, f));
      area += size;
      for (const std::uint32_t v : table.triangle(f)) {
        const double length = bounded_length(logarithms[v], mean);
        triangles += size / (3.0 * length * length);
      }
    }
    if (!(area > 0.0)) return mean;
    mean -= 0.5 * std::log(triangles / area);
  }
  return mean;
}

}  // namespace

std::vector<double> relative_edge_lengths(const CornerTable& table,
                                          const std::vector<Vec3>& positions,
                                          const std::vector<SurfaceFit>& fits, double length) {
  std::vector<double> logarithms(positions.size(), 0.0);
  for (std::size_t v = 0; v < fits.size(); ++v) {
    const double bending = fits[v].is_found ? frobenius(fits[v].bending) * length : 0.0;
    logarithms[v] = -kExponent * std::log(std::max(bending, kLeastBending));
  }
  for (int i = 0; i < kSmoothings; ++i)
    smooth(table, logarithms);
  const double mean = scale_of(table, positions, logarithms);
  for (double& value : logarithms)
    value = bounded_length(value, mean);
  return logarithms;
}

}  // namespace rangezip

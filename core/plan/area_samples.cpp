#include <algorithm>
#include <cmath>

#include "core/plan/scene_triangles.h"
#include "core/plan/spacing.h"

namespace rangezip {

namespace {

constexpr std::size_t kLeastSamples = 20'000;
constexpr std::size_t kMostSamples = 4'000'000;
constexpr std::size_t kSamplesIfNoPixels = 200'000;
constexpr double kSamplesPerPixel = 8.0;

/// 0 for a triangle with a corner that is not finite.
double area_of(const TriangleCorners& triangle) {
  const double twice = glm::length(area_vector(triangle.a, triangle.b, triangle.c));
  return std::isfinite(twice) ? 0.5 * twice : 0.0;
}

/// The fractional part of `index` times the golden ratio, exactly: consecutive ones are spread
/// evenly over [0, 1).
double golden_fraction(std::uint64_t index) {
  constexpr std::uint64_t kGolden = 0x9e37'79b9'7f4a'7c15U;  // 2^64 (sqrt(5) - 1) / 2
  constexpr double kUnit = 1.0 / 9007199254740992.0;         // 2^-53
  return static_cast<double>((index * kGolden) >> 11U) * kUnit;
}

}  // namespace

double triangle_area(const Scene& scene) {
  double area = 0.0;
  for_each_triangle(scene, [&](const TriangleCorners& triangle) { area += area_of(triangle); });
  return area;
}

std::size_t area_sample_count(const Scene& scene, double pixel_size) {
  if (!(pixel_size > 0.0)) return kSamplesIfNoPixels;
  const double wanted = kSamplesPerPixel * triangle_area(scene) / (pixel_size * pixel_size);
  if (!(wanted < static_cast<double>(kMostSamples))) return kMostSamples;
  return std::max(kLeastSamples, static_cast<std::size_t>(wanted));
}

std::vector<Vec3> area_samples(const Scene& scene, std::size_t count) {
  const double total = triangle_area(scene);
  std::vector<Vec3> samples;
  if (!(total > 0.0) || !std::isfinite(total) || count == 0) return samples;
  samples.reserve(count);

  // Sample i stands at (i + 1/2) / count of the area, the triangles laid end to end. Its place
  // within its triangle is one coordinate, the golden fraction of i the other: a lattice that
  // leaves no large gap in a large triangle.
  const double area_of_sample = total / static_cast<double>(count);
  double begin = 0.0;
  for_each_triangle(scene, [&](const TriangleCorners& triangle) {
    const double area = area_of(triangle);
    const double end = begin + area;
    while (samples.size() < count) {
      const double stand = (static_cast<double>(samples.size()) + 0.5) * area_of_sample;
      if (!(stand < end)) break;
      const double toward_side = std::sqrt((stand - begin) / area);  // uniform in area
      const double along_side = golden_fraction(samples.size());
      const Vec3 on_side = triangle.b + along_side * (triangle.c - triangle.b);
      samples.push_back(triangle.a + toward_side * (on_side - triangle.a));
    }
    begin = end;
  });
  return samples;
}

}  // namespace rangezip

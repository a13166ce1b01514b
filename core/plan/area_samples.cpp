#include <cmath>
#include <variant>

#include "core/plan/spacing.h"

namespace rangezip {

namespace {

struct Corners {
  Vec3 a, b, c;

  /// 0 for a triangle with a corner that is not finite.
  [[nodiscard]] double area() const {
    const double twice = glm::length(area_vector(a, b, c));
    return std::isfinite(twice) ? 0.5 * twice : 0.0;
  }
};

/// Calls visit(corners) for each triangle of the scene, in world space.
template <class Visitor>
void for_each_triangle(const Scene& scene, const Visitor& visit) {
  for (const DrawItem& item : scene.draw_items()) {
    const auto* soup = std::get_if<DrawTriangles>(&item);
    if (soup == nullptr) continue;
    const auto world = [&](std::uint32_t corner) {
      return Vec3(soup->world_from_item * Vec4(Vec3(soup->positions[corner]), 1.0));
    };
    for (const Triangle& t : soup->triangles) {
      visit(Corners{world(t[0]), world(t[1]), world(t[2])});
    }
  }
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
  for_each_triangle(scene, [&](const Corners& triangle) { area += triangle.area(); });
  return area;
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
  for_each_triangle(scene, [&](const Corners& triangle) {
    const double area = triangle.area();
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

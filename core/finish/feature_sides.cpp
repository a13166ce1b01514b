#include "core/finish/feature_sides.h"

#include <algorithm>
#include <array>
#include <cmath>

#include "core/base/solve.h"

namespace rangezip {
namespace {

constexpr double kSameSide = 0.9;    // cosine: 25 degrees
constexpr double kMinShare = 0.03;   // of the weight of all surfaces
constexpr double kMinVolume = 0.02;  // squared, of the unit normals' parallelepiped
constexpr int kSteps = 3;            // of Newton's method: bending is small
constexpr std::size_t kMaxSides = 3;

struct Group {
  FeatureSide sum;
  Vec3 normal;  // of the mean so far
  double height;
};

void add(FeatureSide& sum, const FeatureSide& surface) {
  sum.height.constant += surface.weight * surface.height.constant;
  sum.height.slope += surface.weight * surface.height.slope;
  sum.height.bending += surface.weight * surface.height.bending;
  sum.weight += surface.weight;
}

FeatureSide mean_of(const FeatureSide& sum) {
  const double share = 1.0 / sum.weight;
  return {{share * sum.height.constant, share * sum.height.slope, share * sum.height.bending},
          sum.weight};
}

}  // namespace

std::vector<FeatureSide> sides_of(std::vector<FeatureSide> surfaces, double step) {
  std::stable_sort(surfaces.begin(), surfaces.end(),
                   [](const FeatureSide& a, const FeatureSide& b) { return a.weight > b.weight; });
  std::vector<Group> groups;
  double weight = 0.0;
  for (const FeatureSide& surface : surfaces) {
    const Vec3 normal = unit_or_z(surface.height.slope);
    const auto is_same = [&](const Group& group) {
      return glm::dot(normal, group.normal) > kSameSide &&
             std::abs(surface.height.constant - group.height) < step;
    };
    auto group = std::find_if(groups.begin(), groups.end(), is_same);
    if (group == groups.end()) group = groups.insert(group, Group{});
    add(group->sum, surface);
    const FeatureSide mean = mean_of(group->sum);
    group->normal = unit_or_z(mean.height.slope);
    group->height = mean.height.constant;
    weight += surface.weight;
  }
  std::vector<FeatureSide> sides;
  for (const Group& group : groups) {
    if (group.sum.weight > kMinShare * weight) sides.push_back(mean_of(group.sum));
  }
  std::stable_sort(sides.begin(), sides.end(),
                   [](const FeatureSide& a, const FeatureSide& b) { return a.weight > b.weight; });
  return sides;
}

std::optional<Vec3> meeting_place(std::span<const FeatureSide> sides) {
  if (sides.size() > kMaxSides) return std::nullopt;
  Vec3 place{0.0};
  for (int step = 0; step < kSteps; ++step) {
    std::array<Vec3, kMaxSides> slopes{};
    Mat3 products(1.0);
    Vec3 wanted{0.0};
    for (std::size_t i = 0; i < sides.size(); ++i) {
      const auto row = static_cast<int>(i);
      slopes[i] = sides[i].height.slope_at(place);
      const double length = glm::length(slopes[i]);
      if (!(length > 0.0)) return std::nullopt;
      slopes[i] /= length;
      wanted[row] = glm::dot(slopes[i], place) - sides[i].height.at(place) / length;
      for (std::size_t j = 0; j <= i; ++j) {
        const auto column = static_cast<int>(j);
        products[row][column] = products[column][row] = glm::dot(slopes[i], slopes[j]);
      }
    }
    const std::optional<Vec3> shares = solve(products, wanted, kMinVolume);
    if (!shares) return std::nullopt;
    place = shares->x * slopes[0] + shares->y * slopes[1] + shares->z * slopes[2];
  }
  return place;
}

}  // namespace rangezip

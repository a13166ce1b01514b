#include "core/reconstruct/lost_points.h"

#include <algorithm>
#include <cstddef>
#include <iterator>

namespace rangezip {
namespace {

constexpr std::size_t kManyMore = 4;  ///< times as many points: what a re-scan has lost

std::vector<Vec3> points_in(const Sphere& place, std::span<const Vec3> points) {
  std::vector<Vec3> inside;
  std::copy_if(points.begin(), points.end(), std::back_inserter(inside),
               [&](const Vec3& p) { return place.contains(p); });
  return inside;
}

}  // namespace

std::vector<Vec3> lost_points(std::span<const Sphere> places, std::span<const Vec3> before,
                              std::span<const Vec3> after) {
  std::vector<Vec3> lost;
  for (const Sphere& place : places) {
    const std::vector<Vec3> was = points_in(place, before);
    const std::vector<Vec3> is = points_in(place, after);
    if (is.size() <= kManyMore * was.size()) continue;
    std::copy_if(is.begin(), is.end(), std::back_inserter(lost),
                 [&](const Vec3& p) { return std::find(was.begin(), was.end(), p) == was.end(); });
  }
  return lost;
}

}  // namespace rangezip

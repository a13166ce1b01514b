#include "core/io/repeated_points.h"

#include <algorithm>
#include <tuple>

#include "core/base/spread.h"

namespace rangezip {
namespace {

constexpr std::size_t kLookedAt = 4096;
constexpr std::size_t kRepeated = 41;  // of these: one in a hundred

bool is_less(const Vec3f& a, const Vec3f& b) {
  return std::tie(a.x, a.y, a.z) < std::tie(b.x, b.y, b.z);
}

/// Sorted.
std::vector<Vec3f> repeated_places(const std::vector<Vec3f>& points) {
  std::vector<Vec3f> some;
  for (const std::size_t i : spread_indices(points.size(), kLookedAt))
    some.push_back(points[i]);
  std::sort(some.begin(), some.end(), is_less);
  std::vector<Vec3f> repeated;
  for (auto begin = some.begin(); begin != some.end();) {
    const auto end = std::upper_bound(begin, some.end(), *begin, is_less);
    if (end - begin >= static_cast<std::ptrdiff_t>(kRepeated)) repeated.push_back(*begin);
    begin = end;
  }
  return repeated;
}

}  // namespace

std::size_t drop_repeated_points(std::vector<Vec3f>& points) {
  const std::vector<Vec3f> places = repeated_places(points);
  if (places.empty()) return 0;
  std::vector<bool> is_there(places.size(), false);
  return std::erase_if(points, [&](const Vec3f& point) {
    const auto place = std::lower_bound(places.begin(), places.end(), point, is_less);
    if (place == places.end() || is_less(point, *place)) return false;
    const bool is_first = !is_there[static_cast<std::size_t>(place - places.begin())];
    is_there[static_cast<std::size_t>(place - places.begin())] = true;
    return !is_first;
  });
}

}  // namespace rangezip

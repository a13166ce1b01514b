#include "core/stitch/withdraw.h"

#include <algorithm>
#include <cstdint>
#include <limits>
#include <utility>
#include <vector>

#include "core/base/grid.h"
#include "core/raster/rasterizer.h"

namespace rangezip {

namespace {

/// Counts places in boxes of pixels by a table of sums over all boxes from the lower left corner.
class PlaceCounter {
 public:
  /// @param first, last corners of the box within which places are counted
  PlaceCounter(std::span<const Pixel> places, Pixel first, Pixel last)
      : first_(first), sums_({last.x - first.x + 2, last.y - first.y + 2}, 0) {
    for (const Pixel p : places) {
      const Pixel local{p.x - first.x + 1, p.y - first.y + 1};
      if (local.x >= 1 && local.y >= 1 && sums_.extent().contains(local)) ++sums_[local];
    }
    for (int y = 1; y < sums_.extent().height; ++y) {
      for (int x = 1; x < sums_.extent().width; ++x)
        sums_[{x, y}] += sums_[{x - 1, y}] + sums_[{x, y - 1}] - sums_[{x - 1, y - 1}];
    }
  }

  [[nodiscard]] bool has_place_near(Pixel p, int radius) const {
    const Pixel low = inside({p.x - radius - 1, p.y - radius - 1});
    const Pixel high = inside({p.x + radius, p.y + radius});
    return sums_[high] + sums_[low] != sums_[{low.x, high.y}] + sums_[{high.x, low.y}];
  }

 private:
  [[nodiscard]] Pixel inside(Pixel p) const {
    return {std::clamp(p.x - first_.x + 1, 0, sums_.extent().width - 1),
            std::clamp(p.y - first_.y + 1, 0, sums_.extent().height - 1)};
  }

  Pixel first_;
  Grid<std::uint32_t> sums_;
};

/// The box around some pixels. @pre there are some
std::pair<Pixel, Pixel> box_of(std::span<const Pixel> pixels) {
  Pixel first = pixels.front();
  Pixel last = first;
  for (const Pixel p : pixels) {
    first = {std::min(first.x, p.x), std::min(first.y, p.y)};
    last = {std::max(last.x, p.x), std::max(last.y, p.y)};
  }
  return {first, last};
}

}  // namespace

Patch withdraw_near(const Patch& patch, std::span<const Pixel> places, int radius) {
  if (patch.pixels.empty()) return patch;
  const auto [first, last] = box_of(patch.pixels);
  const PlaceCounter counter(places, {first.x - radius, first.y - radius},
                             {last.x + radius, last.y + radius});

  constexpr std::uint32_t kUnused = std::numeric_limits<std::uint32_t>::max();
  std::vector<std::uint32_t> number(patch.pixels.size(), kUnused);
  Patch rest;
  for (const Triangle& t : patch.mesh.triangles) {
    const bool goes = std::any_of(t.begin(), t.end(), [&](std::uint32_t v) {
      return counter.has_place_near(patch.pixels[v], radius);
    });
    if (goes) continue;
    rest.mesh.triangles.push_back(t);
    for (const std::uint32_t v : t)
      number[v] = 0;
  }
  for (std::size_t v = 0; v < number.size(); ++v) {
    if (number[v] == kUnused) continue;
    number[v] = static_cast<std::uint32_t>(rest.pixels.size());
    rest.pixels.push_back(patch.pixels[v]);
    rest.mesh.positions.push_back(patch.mesh.positions[v]);
    if (!patch.mesh.sources.empty()) rest.mesh.sources.push_back(patch.mesh.sources[v]);
  }
  for (Triangle& t : rest.mesh.triangles) {
    for (std::uint32_t& v : t)
      v = number[v];
  }
  return rest;
}

Patch withdraw_locally(const Patch& patch, std::span<const Pixel> places, int radius) {
  if (patch.pixels.empty()) return patch;
  const auto [first, last] = box_of(patch.pixels);
  const PlaceCounter of_patch(patch.pixels, first, last);
  const int farthest = 2 * kMaxRasterExtent;  // places farther than this can wait for others
  Patch rest = patch;
  std::vector<Pixel> left(places.begin(), places.end());
  for (; radius < farthest && !left.empty(); radius *= 2) {
    const auto far = std::stable_partition(
        left.begin(), left.end(), [&](Pixel p) { return of_patch.has_place_near(p, radius); });
    rest = withdraw_near(rest, {left.begin(), far}, radius);
    left.erase(left.begin(), far);
  }
  return rest;
}

}  // namespace rangezip

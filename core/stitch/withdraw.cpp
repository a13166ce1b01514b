#include "core/stitch/withdraw.h"

#include <algorithm>
#include <array>
#include <cstdint>
#include <utility>
#include <vector>

#include "core/base/grid.h"
#include "core/raster/rasterizer.h"
#include "core/stitch/pixel_box.h"

namespace rangezip {

namespace {

/// Counts places in boxes of pixels by a table of sums over all boxes from the lower left corner.
class PlaceCounter {
 public:
  /// @param box within which places are counted
  PlaceCounter(std::span<const Pixel> places, const PixelBox& box)
      : first_(box.first), sums_({box.extent().width + 1, box.extent().height + 1}, 0) {
    for (const Pixel p : places) {
      const Pixel local{p.x - first_.x + 1, p.y - first_.y + 1};
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

/// Takes the triangles near places out of the cells; false if there are none.
bool clear_near(GridCells& cells, const PixelBox& box, const PlaceCounter& places, int radius) {
  bool any = false;
  for (int y = box.first.y; y < box.last.y; ++y) {
    for (Pixel cell{box.first.x, y}; cell.x < box.last.x; ++cell.x) {
      for (const std::uint8_t which : {kLowerTriangle, kUpperTriangle}) {
        if ((cells[cell] & which) == 0) continue;
        const std::array<Pixel, 3> corners = grid_triangle(cell, cells[cell], which);
        const bool goes = std::any_of(corners.begin(), corners.end(), [&](Pixel corner) {
          return places.has_place_near(corner, radius);
        });
        if (!goes) continue;
        cells[cell] = static_cast<std::uint8_t>(cells[cell] & ~which);
        any = true;
      }
    }
  }
  return any;
}

}  // namespace

Patch withdraw_near(const RangeImage& image, const Patch& patch, std::span<const Pixel> places,
                    int radius) {
  if (patch.pixels.empty()) return patch;
  const PixelBox box = box_around(patch.pixels);
  const PlaceCounter counter(places, box.widened(radius));
  GridCells cells = patch.cells;
  if (!clear_near(cells, box, counter, radius)) return patch;
  Patch rest = patch_from_cells(image, std::move(cells));
  if (patch.mesh.sources.empty()) return rest;
  for (const std::uint32_t v : numbers_in(patch, rest.pixels))
    rest.mesh.sources.push_back(patch.mesh.sources[v]);
  return rest;
}

Patch withdraw_locally(const RangeImage& image, const Patch& patch, std::span<const Pixel> places,
                       int radius) {
  if (patch.pixels.empty()) return patch;
  const PlaceCounter of_patch(patch.pixels, box_around(patch.pixels));
  const int farthest = 2 * kMaxRasterExtent;  // places farther than this can wait for others
  Patch rest = patch;
  std::vector<Pixel> left(places.begin(), places.end());
  for (; radius < farthest && !left.empty(); radius = wider(radius)) {
    const auto far = std::stable_partition(
        left.begin(), left.end(), [&](Pixel p) { return of_patch.has_place_near(p, radius); });
    rest = withdraw_near(image, rest, {left.begin(), far}, radius);
    left.erase(left.begin(), far);
  }
  return rest;
}

std::vector<std::uint32_t> numbers_in(const Patch& patch, std::span<const Pixel> pixels) {
  const auto is_before = [](Pixel a, Pixel b) { return a.y != b.y ? a.y < b.y : a.x < b.x; };
  std::vector<std::uint32_t> numbers;
  numbers.reserve(pixels.size());
  std::uint32_t v = 0;
  for (const Pixel p : pixels) {
    while (v < patch.pixels.size() && is_before(patch.pixels[v], p))
      ++v;
    const bool is_there = v < patch.pixels.size() && patch.pixels[v] == p;
    numbers.push_back(is_there ? v : kNotInPatch);
  }
  return numbers;
}

}  // namespace rangezip

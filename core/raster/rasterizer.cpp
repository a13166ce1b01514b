#include "core/raster/rasterizer.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <string>
#include <vector>

#include "core/base/error.h"
#include "core/base/parallel.h"

namespace rangezip {

namespace {

std::string to_text(Extent extent) {
  return std::to_string(extent.width) + " x " + std::to_string(extent.height);
}

/// Where an argument stands, for the text of an error: "render: item 3".
std::string at_item(const char* function, std::size_t index) {
  return std::string(function) + ": item " + std::to_string(index);
}

void check_view(const char* function, const View& view, const RasterizerInfo& info) {
  const Extent extent = view.extent();
  if (extent.width > info.max_extent.width || extent.height > info.max_extent.height) {
    throw InvalidArgument(std::string(function) + ": the extent of the view must not exceed " +
                          to_text(info.max_extent) + " with " + info.name + ", got " +
                          to_text(extent));
  }
}

void check_placement(const std::string& where, const Mat4& m) {
  bool good = m[0][3] == 0.0 && m[1][3] == 0.0 && m[2][3] == 0.0 && m[3][3] == 1.0;
  for (int column = 0; column < 4; ++column) {
    for (int row = 0; row < 3; ++row)
      good = good && std::isfinite(m[column][row]);
  }
  if (!good) throw InvalidArgument(where + ": world_from_item must be finite and affine");
}

void check_points(const std::string& where, const DrawPoints& points, const RasterizerInfo& info) {
  check_placement(where, points.world_from_item);
  if (points.point_size < 1 || points.point_size > info.max_point_size) {
    throw InvalidArgument(where + ": point_size must lie in 1.." +
                          std::to_string(info.max_point_size) + ", got " +
                          std::to_string(points.point_size));
  }
  if (!points.votes.empty() && points.votes.size() != points.positions.size()) {
    throw InvalidArgument(where + ": " + std::to_string(points.votes.size()) +
                          " votes were given for " + std::to_string(points.positions.size()) +
                          " points");
  }
}

std::uint32_t largest_corner(std::span<const Triangle> triangles) {
  std::array<std::uint32_t, 3> most{};  // one a corner: they do not wait for each other
  for (const Triangle& t : triangles) {
    for (std::size_t corner = 0; corner < 3; ++corner)
      most[corner] = std::max(most[corner], t[corner]);
  }
  return std::max({most[0], most[1], most[2]});
}

std::uint32_t largest_corner_in_parallel(std::span<const Triangle> triangles) {
  constexpr std::size_t kGrain = std::size_t{1} << 16;
  std::vector<std::uint32_t> largest((triangles.size() + kGrain - 1) / kGrain);
  parallel_for(triangles.size(), kGrain, [&](std::size_t begin, std::size_t end) {
    largest[begin / kGrain] = largest_corner(triangles.subspan(begin, end - begin));
  });
  return largest.empty() ? 0 : *std::max_element(largest.begin(), largest.end());
}

void check_triangles(const std::string& where, const DrawTriangles& item) {
  check_placement(where, item.world_from_item);
  const std::uint32_t largest = largest_corner_in_parallel(item.triangles);
  if (!item.triangles.empty() && largest >= item.positions.size()) {
    throw InvalidArgument(where + ": corner index " + std::to_string(largest) +
                          " is out of range; the item has " +
                          std::to_string(item.positions.size()) + " positions");
  }
}

void check_items(const char* function, std::span<const DrawItem> items,
                 const RasterizerInfo& info) {
  std::uint64_t next_id = 0;
  for (std::size_t i = 0; i < items.size(); ++i) {
    const std::string where = at_item(function, i);
    if (const auto* points = std::get_if<DrawPoints>(&items[i])) {
      check_points(where, *points, info);
    } else {
      check_triangles(where, std::get<DrawTriangles>(items[i]));
    }
    const std::uint64_t first = first_id(items[i]);
    const std::uint64_t count = primitive_count(items[i]);
    if (first < next_id) {
      throw InvalidArgument(where + ": ids must ascend from item to item; first_id is " +
                            std::to_string(first) + ", the items before it use ids up to " +
                            std::to_string(next_id - 1));
    }
    if (count > kNoPrimitive - first) {
      throw InvalidArgument(where + ": ids must stay below 2^32 - 1; first_id is " +
                            std::to_string(first) + " for " + std::to_string(count) +
                            " primitives");
    }
    next_id = first + count;
  }
}

void check_extent(const char* function, const char* grid, Extent extent, const View& view) {
  if (extent == view.extent()) return;
  throw InvalidArgument(std::string(function) + ": " + grid + " must have the view's extent " +
                        to_text(view.extent()) + ", got " + to_text(extent));
}

void check_band(const char* function, const DepthBand& band, const View& view) {
  check_extent(function, "band.lower", band.lower.extent(), view);
  check_extent(function, "band.upper", band.upper.extent(), view);
}

/// The bounds that keep R13's sums inside int64.
void check_window(const AccumulateWindow& window, const View& view) {
  check_band("accumulate", window.band, view);
  check_extent("accumulate", "reference", window.reference.extent(), view);
  constexpr int kMaxShift = 8;
  if (window.shift < 0 || window.shift > kMaxShift) {
    throw InvalidArgument("accumulate: shift must lie in 0..8, got " +
                          std::to_string(window.shift));
  }
  constexpr std::int64_t kMaxOffset = std::int64_t{1} << 20;
  const auto lower = window.band.lower.pixels();
  const auto upper = window.band.upper.pixels();
  const auto reference = window.reference.pixels();
  for (std::size_t i = 0; i < reference.size(); ++i) {
    // Only depths between the planes are summed, so only that part of the band must fit.
    const std::int64_t nearest = std::max(lower[i], 0);
    const std::int64_t farthest = std::min(upper[i], static_cast<std::int32_t>(kMaxDepth));
    if (nearest > farthest) continue;
    const std::int64_t least = (nearest - reference[i]) >> window.shift;
    const std::int64_t most = (farthest - reference[i]) >> window.shift;
    if (least > -kMaxOffset && most < kMaxOffset) continue;
    const auto width = static_cast<std::size_t>(view.extent().width);
    throw InvalidArgument(
        "accumulate: depths of the band, measured from reference and shifted by " +
        std::to_string(window.shift) + ", must lie within (-2^20, 2^20); at pixel (" +
        std::to_string(i % width) + ", " + std::to_string(i / width) + ") they are " +
        std::to_string(least) + " to " + std::to_string(most));
  }
}

}  // namespace

DrawReport Rasterizer::render(const View& view, std::span<const DrawItem> items, Framebuffer& out) {
  const RasterizerInfo limits = info();
  check_view("render", view, limits);
  check_items("render", items, limits);
  return do_render(view, items, out);
}

Framebuffer Rasterizer::render(const View& view, std::span<const DrawItem> items) {
  Framebuffer out;
  render(view, items, out);
  return out;
}

DrawReport Rasterizer::render_in_band(const View& view, std::span<const DrawItem> items,
                                      const DepthBand& band, Framebuffer& out) {
  const RasterizerInfo limits = info();
  check_view("render_in_band", view, limits);
  check_items("render_in_band", items, limits);
  check_band("render_in_band", band, view);
  return do_render_in_band(view, items, band, out);
}

DrawReport Rasterizer::accumulate(const View& view, std::span<const DrawItem> items,
                                  const AccumulateWindow& window, Grid<PixelMoments>& out) {
  const RasterizerInfo limits = info();
  check_view("accumulate", view, limits);
  check_items("accumulate", items, limits);
  check_window(window, view);
  return do_accumulate(view, items, window, out);
}

}  // namespace rangezip

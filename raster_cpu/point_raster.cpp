#include "raster_cpu/point_raster.h"

#include <algorithm>
#include <array>
#include <cstdlib>

#include "raster_cpu/fixed_point.h"

namespace rangezip {

namespace {

/// Points that are snapped before they are drawn; their positions stay in the first-level cache.
constexpr std::size_t kBlock = 512;

bool is_in_depth_range(std::int32_t z) {
  return static_cast<std::uint32_t>(z) <= kMaxDepth;
}

/// One pixel a point: the whole cost of a large cloud, so the tests are few and unsigned
/// (a negative pixel number is a large one).
template <class Accept>
void draw_single_pixels(std::span<const SnappedPosition> points, PrimitiveId first_id,
                        const DrawTarget& target, const Accept& accept) {
  const auto width = static_cast<std::uint32_t>(target.extent.width);
  const auto height = static_cast<std::uint32_t>(target.extent.height);
  PixelKey* const keys = target.keys.data();
  for (std::size_t i = 0; i < points.size(); ++i) {
    const SnappedPosition& p = points[i];
    const auto x = static_cast<std::uint32_t>(p.x >> kSubpixelBits);
    const auto y = static_cast<std::uint32_t>(p.y >> kSubpixelBits);
    if (x >= width || y >= height || !is_in_depth_range(p.z)) continue;
    const std::size_t pixel = std::size_t{y} * width + x;
    if (!accept(pixel, p.z)) continue;
    const PixelKey key =
        make_key(static_cast<std::uint32_t>(p.z), first_id + static_cast<PrimitiveId>(i));
    keys[pixel] = std::min(keys[pixel], key);
  }
}

template <class Accept>
void draw_squares(std::span<const SnappedPosition> points, PrimitiveId first_id, int size,
                  const DrawTarget& target, const Accept& accept) {
  for (std::size_t i = 0; i < points.size(); ++i) {
    const SnappedPosition& p = points[i];
    if (is_rejected(p) || !is_in_depth_range(p.z)) continue;
    const PixelRange columns = on_screen(covered_by_point(p.x, size), target.extent.width);
    const PixelRange rows = on_screen(covered_by_point(p.y, size), target.extent.height);
    const PixelKey key =
        make_key(static_cast<std::uint32_t>(p.z), first_id + static_cast<PrimitiveId>(i));
    for (int y = rows.first; y <= rows.last; ++y) {
      const std::size_t row = target.extent.index({0, y});
      for (int x = columns.first; x <= columns.last; ++x) {
        const std::size_t pixel = row + static_cast<std::size_t>(x);
        if (accept(pixel, p.z)) target.keys[pixel] = std::min(target.keys[pixel], key);
      }
    }
  }
}

/// Whether two positions lie within a few cache lines of each other.
bool are_close(const SnappedPosition& a, const SnappedPosition& b) {
  constexpr std::int32_t kNear = 8 * kSubpixels;
  return !is_rejected(a) && !is_rejected(b) && std::abs(a.x - b.x) < kNear &&
         std::abs(a.y - b.y) < kNear;
}

}  // namespace

bool neighbours_fall_close(const RowTransform& rows, std::span<const Vec3f> positions) {
  if (positions.size() < 3) return true;
  const std::size_t pairs = std::min<std::size_t>(256, positions.size() - 1);
  std::size_t close = 0;
  for (std::size_t pair = 0; pair < pairs; ++pair) {
    const std::size_t at = (positions.size() - 2) * pair / (pairs - 1);
    std::array<SnappedPosition, 2> snapped;
    snap_positions(rows, positions.subspan(at, 2), snapped);
    close += are_close(snapped[0], snapped[1]) ? 1 : 0;
  }
  return close > pairs / 2;
}

std::size_t draw_points(const DrawPoints& points, const RowTransform& rows, std::size_t begin,
                        std::size_t end, const DrawTarget& target, const SimdKernels* kernels) {
  std::size_t rejected = 0;
  if (kernels != nullptr && points.point_size == 1) {
    const auto positions = points.positions.subspan(begin, end - begin);
    const PrimitiveId first_id = points.first_id + static_cast<PrimitiveId>(begin);
    const auto report = kernels->draw_single_pixels(rows, positions, first_id, target);
    begin += report.processed;
    rejected += report.rejected;
  }
  std::array<SnappedPosition, kBlock> buffer;
  for (std::size_t at = begin; at < end; at += kBlock) {
    const auto positions = points.positions.subspan(at, std::min(kBlock, end - at));
    const auto snapped = std::span(buffer).first(positions.size());
    rejected += snap_positions(rows, positions, snapped);
    reject_clipped(rows, positions, snapped);
    const PrimitiveId id = points.first_id + static_cast<PrimitiveId>(at);
    with_acceptance(target, [&](const auto& accept) {
      if (points.point_size == 1) {
        draw_single_pixels(snapped, id, target, accept);
      } else {
        draw_squares(snapped, id, points.point_size, target, accept);
      }
    });
  }
  return rejected;
}

}  // namespace rangezip

#include "core/mask/mask.h"

#include <algorithm>
#include <cmath>
#include <string>

#include "core/base/error.h"
#include "core/base/parallel.h"
#include "core/base/sphere_set.h"

namespace rangezip {

namespace {

/// How many pixel centres of row y, counted from the left, lie left of the edge from p to q.
/// The edge crosses the row. A centre on the edge is not left of it, so it belongs to what lies
/// on the right.
int centres_left_of(const Vec2& p, const Vec2& q, double y, int width) {
  const Vec2& lower = p.y < q.y ? p : q;
  const Vec2& upper = p.y < q.y ? q : p;
  const auto is_left = [&](int x) {
    return (upper.x - lower.x) * (y - lower.y) - (upper.y - lower.y) * (x + 0.5 - lower.x) > 0.0;
  };
  // The crossing is only a first guess: the side of each centre is decided by the sign above.
  const double crossing =
      lower.x + (upper.x - lower.x) * ((y - lower.y) / (upper.y - lower.y)) - 0.5;
  // Written so that an undefined guess, from corners of astronomic size, becomes 0.
  int count = crossing > 0.0
                  ? static_cast<int>(std::min(std::ceil(crossing), static_cast<double>(width)))
                  : 0;
  while (count > 0 && !is_left(count - 1))
    --count;
  while (count < width && is_left(count))
    ++count;
  return count;
}

}  // namespace

Mask full_mask(Extent extent) {
  return Mask(extent, 1);
}

Mask sample_mask(const RangeImage& image) {
  Mask mask(image.extent(), 0);
  std::transform(image.depth().pixels().begin(), image.depth().pixels().end(),
                 mask.pixels().begin(),
                 [](double depth) { return static_cast<std::uint8_t>(depth != kNoSample); });
  return mask;
}

Mask mask_of_places(const RangeImage& image, std::span<const Sphere> places) {
  const SphereSet set(places);
  Mask mask(image.extent(), 0);
  for_each_row(image.extent().height, [&](int y) {
    for (Pixel p{0, y}; p.x < image.extent().width; ++p.x) {
      if (!image.has_sample(p)) continue;
      mask[p] = set.contains(image.position(p)) ? 1 : 0;
    }
  });
  return mask;
}

Mask mask_from_lasso(Extent extent, std::span<const Vec2> lasso) {
  if (lasso.size() < 3) {
    throw InvalidArgument("mask_from_lasso: a polygon needs at least 3 corners, got " +
                          std::to_string(lasso.size()));
  }
  for (std::size_t i = 0; i < lasso.size(); ++i) {
    if (!std::isfinite(lasso[i].x) || !std::isfinite(lasso[i].y)) {
      throw InvalidArgument("mask_from_lasso: corner " + std::to_string(i) + " is not finite");
    }
  }
  Mask mask(extent, 0);
  for_each_row(extent.height, [&](int row) {
    const double y = row + 0.5;
    const std::span<std::uint8_t> pixels = mask.row(row);
    // Each crossing toggles all centres on its left: mark where the run ends, then sum from the
    // right.
    bool inside = false;
    for (std::size_t i = 0; i < lasso.size(); ++i) {
      const Vec2& p = lasso[i];
      const Vec2& q = lasso[(i + 1) % lasso.size()];
      if ((p.y <= y) == (q.y <= y)) continue;
      const int count = centres_left_of(p, q, y, extent.width);
      if (count > 0) pixels[static_cast<std::size_t>(count) - 1] ^= 1U;
    }
    for (std::size_t x = pixels.size(); x-- > 0;) {
      inside ^= pixels[x] != 0;
      pixels[x] = inside ? 1 : 0;
    }
  });
  return mask;
}

}  // namespace rangezip

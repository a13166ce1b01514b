#include "tests/support/raster_oracle.h"

#include <array>
#include <cmath>
#include <optional>
#include <tuple>
#include <vector>

#include "core/raster/row_transform.h"
#include "core/raster/split_triangle.h"

namespace rangezip::oracle {

namespace {

__extension__ using Wide = __int128;

Wide floor_of(Wide numerator, Wide denominator) {
  if (denominator < 0) {
    numerator = -numerator;
    denominator = -denominator;
  }
  const Wide quotient = numerator / denominator;
  return numerator % denominator < 0 ? quotient - 1 : quotient;
}

/// A finite float as mantissa * 2^exponent.
struct Binary {
  Wide mantissa = 0;
  int exponent = 0;
};

Binary binary_of(float value) {
  int exponent = 0;
  const double fraction = std::frexp(static_cast<double>(value), &exponent);
  return {static_cast<Wide>(std::ldexp(fraction, 24)), exponent - 24};
}

struct Ratio {
  Wide numerator = 0;
  Wide denominator = 1;
};

/// a / b exactly, if their exponents are near enough; else a ratio that rounds alike (to 0).
Ratio ratio_of(float a, float b) {
  const Binary x = binary_of(a);
  const Binary y = binary_of(b);
  const int shift = x.exponent - y.exponent;
  if (shift >= 0) return {x.mantissa << shift, y.mantissa};
  if (shift < -80) return {x.mantissa < 0 ? -1 : (x.mantissa > 0 ? 1 : 0), Wide{1} << 60};
  return {x.mantissa, y.mantissa << -shift};
}

// R2. Products of two floats are exact in double, and so is one rounding of a sum of two: the
// casts round once to float, whatever the compiler does with the double operation.
float times(float a, float b) {
  return static_cast<float>(static_cast<double>(a) * static_cast<double>(b));
}
float plus(float a, float b) {
  return static_cast<float>(static_cast<double>(a) + static_cast<double>(b));
}
float row_value(const Row& row, const Vec3f& p, const Mistakes& mistakes) {
  const auto kept = [&](float v) {
    return mistakes.denormals_are_zero && std::fpclassify(v) == FP_SUBNORMAL ? 0.0F : v;
  };
  return plus(
      plus(plus(times(row[0], kept(p.x)), times(row[1], kept(p.y))), times(row[2], kept(p.z))),
      row[3]);
}

/// R3: nearest integer, ties to even.
Wide round_half_even(float value) {
  const Ratio r = ratio_of(value, 1.0F);
  const Wide below = floor_of(r.numerator, r.denominator);
  const Wide twice_rest = 2 * (r.numerator - below * r.denominator);
  if (twice_rest == r.denominator) return below % 2 == 0 ? below : below + 1;
  return twice_rest > r.denominator ? below + 1 : below;
}

/// R4: floor(a / w + 1/2).
Wide round_half_up(float a, float w, const Mistakes& mistakes) {
  if (mistakes.quotient_in_float) return static_cast<Wide>(std::floor(a / w + 0.5F));
  const Ratio r = ratio_of(a, w);
  if (mistakes.halves_go_down) return -floor_of(r.denominator - 2 * r.numerator, 2 * r.denominator);
  return floor_of(2 * r.numerator + r.denominator, 2 * r.denominator);
}

struct Corner {
  Wide x = 0;
  Wide y = 0;
  Wide z = 0;
};

std::optional<Corner> snap(const RowTransform& rows, const Vec3f& p, const Mistakes& mistakes) {
  const float x = row_value(rows.x, p, mistakes);
  const float y = row_value(rows.y, p, mistakes);
  const float z = row_value(rows.z, p, mistakes);
  const float w = rows.is_central ? row_value(rows.w, p, mistakes) : 1.0F;
  if (!std::isfinite(x) || !std::isfinite(y) || !std::isfinite(z) || !std::isfinite(w)) return {};
  if (w < 0x1p-64F || w > 0x1p64F) return {};
  // In double the products with a power of two are exact.
  const double limit = 4194304.0 * static_cast<double>(w);
  if (std::fabs(static_cast<double>(x)) > limit || std::fabs(static_cast<double>(y)) > limit ||
      std::fabs(static_cast<double>(z)) > 8.0 * limit) {
    return {};
  }
  if (!rows.is_central) return Corner{round_half_even(x), round_half_even(y), round_half_even(z)};
  return Corner{round_half_up(x, w, mistakes), round_half_up(y, w, mistakes),
                round_half_up(z, w, mistakes)};
}

bool is_clipped(const RowTransform& rows, const Vec3f& p, const Mistakes& mistakes) {
  for (const Row& plane : rows.clip) {
    if (!(row_value(plane, p, mistakes) >= 0.0F)) return true;
  }
  return false;
}

bool is_in_band(const DepthBand& band, Pixel pixel, Wide depth, const Mistakes& mistakes) {
  if (mistakes.band_is_open) return band.lower[pixel] < depth && depth < band.upper[pixel];
  return band.lower[pixel] <= depth && depth <= band.upper[pixel];
}

/// An image under construction.
struct Canvas {
  const View& view;
  const DepthBand* band;
  const Mistakes& mistakes;
  Framebuffer image;

  void put(Pixel pixel, Wide depth, PrimitiveId id) {
    if (depth < 0 || depth >= (Wide{1} << 24)) return;
    if (band != nullptr && !is_in_band(*band, pixel, depth, mistakes)) return;
    const auto d = static_cast<std::uint32_t>(depth);
    const std::uint32_t old = image.depth[pixel];
    const bool lower_id =
        mistakes.ties_go_to_higher_id && old == d ? id > image.id[pixel] : id < image.id[pixel];
    if (d < old || (d == old && lower_id)) {
      image.depth[pixel] = d;
      image.id[pixel] = id;
    }
  }

  template <class Body>
  void for_each_pixel(const Body& body) const {
    for (int y = 0; y < view.extent().height; ++y) {
      for (int x = 0; x < view.extent().width; ++x)
        body(Pixel{x, y});
    }
  }
};

void draw(Canvas& canvas, const DrawPoints& item) {
  const RowTransform rows = make_row_transform(canvas.view, item.world_from_item);
  const Wide size = item.point_size;
  const Wide lean = canvas.mistakes.points_lean_left ? 1 : 0;
  for (std::size_t i = 0; i < item.positions.size(); ++i) {
    const auto p = snap(rows, item.positions[i], canvas.mistakes);
    if (!p || is_clipped(rows, item.positions[i], canvas.mistakes)) continue;
    const Wide left = floor_of(p->x - 128 * (size - 1) - lean, 256);
    const Wide below = floor_of(p->y - 128 * (size - 1) - lean, 256);
    const PrimitiveId id = item.first_id + static_cast<PrimitiveId>(i);
    canvas.for_each_pixel([&](Pixel pixel) {
      if (pixel.x < left || pixel.x >= left + size) return;
      if (pixel.y < below || pixel.y >= below + size) return;
      canvas.put(pixel, p->z, id);
    });
  }
}

using Corners = std::array<Corner, 3>;

/// Twice the signed area of (a, b, p).
Wide area_of(const Corner& a, const Corner& b, Wide px, Wide py) {
  return (b.x - a.x) * (py - a.y) - (b.y - a.y) * (px - a.x);
}

/// R6's tie rule, said in another way: a sample moved from the centre by an infinitely small step
/// to the right and a still smaller one upwards is never on an edge.
bool is_inside(const Corner& a, const Corner& b, Wide px, Wide py, Wide orientation,
               const Mistakes& mistakes) {
  const Wide step = mistakes.other_edges_own_ties ? -orientation : orientation;
  const std::array<Wide, 3> terms{orientation * area_of(a, b, px, py), step * -(b.y - a.y),
                                  step * (b.x - a.x)};
  return terms > std::array<Wide, 3>{0, 0, 0};
}

void draw_triangle(Canvas& canvas, const Corners& c, PrimitiveId id, Facing facing) {
  const Wide area = area_of(c[0], c[1], c[2].x, c[2].y);
  if (area == 0) return;
  if (facing == Facing::front && area < 0) return;
  if (facing == Facing::back && area > 0) return;
  const Wide orientation = area > 0 ? 1 : -1;
  canvas.for_each_pixel([&](Pixel pixel) {
    const Wide px = 256 * pixel.x + 128;
    const Wide py = 256 * pixel.y + 128;
    Wide weighted = 0;
    for (std::size_t i = 0; i < 3; ++i) {
      const Corner& from = c[(i + 1) % 3];
      const Corner& to = c[(i + 2) % 3];
      if (!is_inside(from, to, px, py, orientation, canvas.mistakes)) return;
      weighted += area_of(from, to, px, py) * c[i].z;
    }
    const Wide depth = canvas.mistakes.depth_rounds_to_nearest
                           ? floor_of(2 * weighted + area, 2 * area)
                           : floor_of(weighted, area);
    canvas.put(pixel, depth, id);
  });
}

Corner corner_of(const SnappedPosition& p) {
  return {p.x, p.y, p.z};
}

void draw(Canvas& canvas, const DrawTriangles& item) {
  const RowTransform rows = make_row_transform(canvas.view, item.world_from_item);
  for (std::size_t i = 0; i < item.triangles.size(); ++i) {
    const PrimitiveId id = item.first_id + static_cast<PrimitiveId>(i);
    std::array<Vec3f, 3> positions;
    Corners corners;
    bool is_whole = true;
    for (std::size_t k = 0; k < 3; ++k) {
      positions[k] = item.positions[item.triangles[i][k]];
      const auto p = snap(rows, positions[k], canvas.mistakes);
      is_whole = is_whole && p && !is_clipped(rows, positions[k], canvas.mistakes);
      if (p) corners[k] = *p;
    }
    if (is_whole) {
      draw_triangle(canvas, corners, id, item.facing);
      continue;
    }
    std::vector<SnappedTriangle> pieces;
    if (!split_triangle(rows, positions, pieces)) continue;
    for (const auto& [a, b, c] : pieces) {
      draw_triangle(canvas, {corner_of(a), corner_of(b), corner_of(c)}, id, item.facing);
    }
  }
}

/// R13's shift rounds down.
Wide shifted(Wide offset, int shift, const Mistakes& mistakes) {
  const Wide unit = Wide{1} << shift;
  return mistakes.shift_rounds_to_zero ? offset / unit : floor_of(offset, unit);
}

void add(PixelMoments& sums, std::int64_t dx, std::int64_t dy, std::int64_t z, std::int64_t vote) {
  const std::int64_t w = (256 - std::abs(dx)) * (256 - std::abs(dy));
  sums.w += w;
  sums.w_dx += w * dx;
  sums.w_dy += w * dy;
  sums.w_dx_dx += w * dx * dx;
  sums.w_dx_dy += w * dx * dy;
  sums.w_dy_dy += w * dy * dy;
  sums.w_z += w * z;
  sums.w_z_dx += w * z * dx;
  sums.w_z_dy += w * z * dy;
  sums.w_vote += w * vote;
}

}  // namespace

Framebuffer render(const View& view, std::span<const DrawItem> items, const DepthBand* band,
                   const Mistakes& mistakes) {
  Canvas canvas{view, band, mistakes, make_framebuffer(view.extent())};
  for (const DrawItem& item : items) {
    std::visit([&](const auto& drawn) { draw(canvas, drawn); }, item);
  }
  return canvas.image;
}

Grid<PixelMoments> accumulate(const View& view, std::span<const DrawItem> items,
                              const AccumulateWindow& window, const Mistakes& mistakes) {
  Grid<PixelMoments> sums(view.extent());
  for (const DrawItem& item : items) {
    const auto* points = std::get_if<DrawPoints>(&item);
    if (points == nullptr) continue;
    const RowTransform rows = make_row_transform(view, points->world_from_item);
    for (std::size_t i = 0; i < points->positions.size(); ++i) {
      const auto p = snap(rows, points->positions[i], mistakes);
      if (!p || is_clipped(rows, points->positions[i], mistakes)) continue;
      if (p->z < 0 || p->z >= (Wide{1} << 24)) continue;
      for (int y = 0; y < view.extent().height; ++y) {
        for (int x = 0; x < view.extent().width; ++x) {
          const auto dx = static_cast<std::int64_t>(p->x - (256 * x + 128));
          const auto dy = static_cast<std::int64_t>(p->y - (256 * y + 128));
          const Pixel pixel{x, y};
          if (std::abs(dx) >= 256 || std::abs(dy) >= 256) continue;
          if (!is_in_band(window.band, pixel, p->z, mistakes)) continue;
          const Wide z = shifted(p->z - window.reference[pixel], window.shift, mistakes);
          add(sums[pixel], dx, dy, static_cast<std::int64_t>(z),
              points->votes.empty() ? 0 : points->votes[i]);
        }
      }
    }
  }
  return sums;
}

}  // namespace rangezip::oracle

#pragma once

#include <algorithm>
#include <cstdint>

namespace rangezip {

/// Points of the image plane as the stitcher sees it: whole steps of 2^-14 px from the CENTRE of
/// pixel (0, 0), x right and y up, so that every sample lies on the grid. Coordinates keep within
/// kGridLimit (16384 px), which makes every predicate below exact.
struct GridPoint {
  std::int64_t x = 0;
  std::int64_t y = 0;

  friend bool operator==(const GridPoint&, const GridPoint&) = default;
};

inline constexpr int kGridBits = 14;
inline constexpr std::int64_t kGridStep = std::int64_t{1} << kGridBits;  ///< one pixel
inline constexpr std::int64_t kGridLimit = std::int64_t{1} << 28;

__extension__ using Int128 = __int128;

/// Twice the signed area of abc: positive if counter-clockwise, 0 if collinear. |result| < 2^60.
[[nodiscard]] constexpr std::int64_t orientation(const GridPoint& a, const GridPoint& b,
                                                 const GridPoint& c) noexcept {
  return (b.x - a.x) * (c.y - a.y) - (b.y - a.y) * (c.x - a.x);
}

/// Dot product of b - a and c - a; for collinear points its sign tells the side of a.
[[nodiscard]] constexpr std::int64_t dot_at(const GridPoint& a, const GridPoint& b,
                                            const GridPoint& c) noexcept {
  return (b.x - a.x) * (c.x - a.x) + (b.y - a.y) * (c.y - a.y);
}

/// Whether d lies strictly inside the circle around the counter-clockwise triangle abc. The
/// determinant is below 2^121: 59 bits a squared distance, 60 an area, three of their products.
[[nodiscard]] constexpr bool in_circle(const GridPoint& a, const GridPoint& b, const GridPoint& c,
                                       const GridPoint& d) noexcept {
  const GridPoint da{a.x - d.x, a.y - d.y};
  const GridPoint db{b.x - d.x, b.y - d.y};
  const GridPoint dc{c.x - d.x, c.y - d.y};
  const auto square = [](const GridPoint& p) { return Int128{p.x * p.x + p.y * p.y}; };
  const auto cross = [](const GridPoint& p, const GridPoint& q) { return p.x * q.y - p.y * q.x; };
  return square(da) * cross(db, dc) + square(db) * cross(dc, da) + square(dc) * cross(da, db) > 0;
}

/// Whether p lies in the box of segment ab, given that the three are collinear: on the segment.
[[nodiscard]] constexpr bool is_between(const GridPoint& a, const GridPoint& b,
                                        const GridPoint& p) noexcept {
  return std::min(a.x, b.x) <= p.x && p.x <= std::max(a.x, b.x) && std::min(a.y, b.y) <= p.y &&
         p.y <= std::max(a.y, b.y);
}

/// Whether the segments ab and cd have a point in common, end points included.
[[nodiscard]] constexpr bool segments_touch(const GridPoint& a, const GridPoint& b,
                                            const GridPoint& c, const GridPoint& d) noexcept {
  const std::int64_t abc = orientation(a, b, c);
  const std::int64_t abd = orientation(a, b, d);
  const std::int64_t cda = orientation(c, d, a);
  const std::int64_t cdb = orientation(c, d, b);
  if (((abc < 0 && abd > 0) || (abc > 0 && abd < 0)) &&
      ((cda < 0 && cdb > 0) || (cda > 0 && cdb < 0))) {
    return true;
  }
  return (abc == 0 && is_between(a, b, c)) || (abd == 0 && is_between(a, b, d)) ||
         (cda == 0 && is_between(c, d, a)) || (cdb == 0 && is_between(c, d, b));
}

/// Whether the segments from one `tip` to a and to b run over each other.
[[nodiscard]] constexpr bool segments_overlap_at(const GridPoint& tip, const GridPoint& a,
                                                 const GridPoint& b) noexcept {
  return orientation(tip, a, b) == 0 && dot_at(tip, a, b) > 0;
}

}  // namespace rangezip

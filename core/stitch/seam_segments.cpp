#include "core/stitch/seam_segments.h"

#include <algorithm>

#include "core/base/grid.h"

namespace rangezip {

namespace {

struct CellBox {
  Pixel first, last;

  [[nodiscard]] std::int64_t cells() const {
    return std::int64_t{last.x - first.x + 1} * (last.y - first.y + 1);
  }
};

/// Box of the cells, of 2^bits grid steps, that contain the two points.
CellBox box_of(const GridPoint& a, const GridPoint& b, int bits) {
  const auto cell_of = [bits](std::int64_t x) { return static_cast<int>(x >> bits); };
  return {{cell_of(std::min(a.x, b.x)), cell_of(std::min(a.y, b.y))},
          {cell_of(std::max(a.x, b.x)), cell_of(std::max(a.y, b.y))}};
}

CellBox box_of(std::span<const SeamSegment> segments, std::span<const GridPoint> points, int bits) {
  CellBox all = box_of(points[segments[0][0]], points[segments[0][1]], bits);
  for (const SeamSegment& s : segments) {
    const CellBox box = box_of(points[s[0]], points[s[1]], bits);
    all.first = {std::min(all.first.x, box.first.x), std::min(all.first.y, box.first.y)};
    all.last = {std::max(all.last.x, box.last.x), std::max(all.last.y, box.last.y)};
  }
  return all;
}

/// Lists of segments, one for each cell of the image plane that they pass.
class Buckets {
 public:
  explicit Buckets(const CellBox& box)
      : origin_(box.first),
        heads_({box.last.x - box.first.x + 1, box.last.y - box.first.y + 1}, kEnd) {}

  void add(std::uint32_t segment, const CellBox& box) {
    for_each_cell(box, [&](std::uint32_t& head) {
      entries_.push_back({segment, head});
      head = static_cast<std::uint32_t>(entries_.size() - 1);
      return false;
    });
  }

  /// Whether `hits(segment)` holds for any segment in the cells of the box.
  template <class Predicate>
  [[nodiscard]] bool any_of(const CellBox& box, const Predicate& hits) {
    return for_each_cell(box, [&](std::uint32_t head) {
      for (; head != kEnd; head = entries_[head].next) {
        if (hits(entries_[head].segment)) return true;
      }
      return false;
    });
  }

 private:
  static constexpr std::uint32_t kEnd = 0xffff'ffffU;
  struct Entry {
    std::uint32_t segment;
    std::uint32_t next;
  };

  /// Until one call gives true.
  template <class Body>
  bool for_each_cell(const CellBox& box, const Body& body) {
    for (int y = box.first.y; y <= box.last.y; ++y) {
      for (int x = box.first.x; x <= box.last.x; ++x) {
        if (body(heads_[{x - origin_.x, y - origin_.y}])) return true;
      }
    }
    return false;
  }

  Pixel origin_;
  Grid<std::uint32_t> heads_;
  std::vector<Entry> entries_;
};

bool are_in_conflict(const SeamSegment& s, const SeamSegment& t,
                     std::span<const GridPoint> points) {
  for (std::size_t i = 0; i < 2; ++i) {
    for (std::size_t j = 0; j < 2; ++j) {
      if (s[i] != t[j]) continue;
      return s[1 - i] != t[1 - j] &&
             segments_overlap_at(points[s[i]], points[s[1 - i]], points[t[1 - j]]);
    }
  }
  return segments_touch(points[s[0]], points[s[1]], points[t[0]], points[t[1]]);
}

}  // namespace

std::size_t drop_conflicting_segments(std::vector<SeamSegment>& segments,
                                      std::size_t first_optional,
                                      std::span<const GridPoint> points) {
  if (segments.empty()) return 0;
  constexpr std::int64_t kMostCells = std::int64_t{1} << 22;  // 16 MB of list heads
  int bits = kGridBits;
  while (box_of(segments, points, bits).cells() > kMostCells)
    ++bits;

  Buckets buckets(box_of(segments, points, bits));
  std::vector<SeamSegment> kept;
  kept.reserve(segments.size());
  for (std::size_t i = 0; i < segments.size(); ++i) {
    const SeamSegment& s = segments[i];
    const CellBox box = box_of(points[s[0]], points[s[1]], bits);
    if (i >= first_optional) {
      if (points[s[0]] == points[s[1]]) continue;
      const bool is_blocked =
          buckets.any_of(box, [&](std::uint32_t k) { return are_in_conflict(s, kept[k], points); });
      if (is_blocked) continue;
    }
    buckets.add(static_cast<std::uint32_t>(kept.size()), box);
    kept.push_back(s);
  }
  const std::size_t dropped = segments.size() - kept.size();
  segments = std::move(kept);
  return dropped;
}

}  // namespace rangezip

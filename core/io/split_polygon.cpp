#include "core/io/split_polygon.h"

#include <bit>
#include <cmath>
#include <cstddef>
#include <optional>

#include "core/io/corner_tree.h"

namespace rangezip {

namespace {

/// Sum of the area vectors of the polygon's triangles: normal to the plane that fits it best
/// (Newell's method).
Vec3 polygon_normal(std::span<const Vec3> positions) {
  Vec3 sum{0.0};
  for (std::size_t i = 2; i < positions.size(); ++i) {
    sum += area_vector(positions[0], positions[i - 1], positions[i]);
  }
  return sum;
}

/// The polygon seen along its normal.
std::vector<Vec2> flatten(std::span<const Vec3> positions) {
  const Vec3 normal = polygon_normal(positions);
  int axis = 0;
  for (int other = 1; other < 3; ++other) {
    if (std::abs(normal[other]) > std::abs(normal[axis])) axis = other;
  }
  // Dropping the axis that the normal follows most keeps every turn; swapping the two others keeps
  // its sign where the normal points the other way.
  const bool is_turned = normal[axis] < 0.0;
  const int u = (axis + (is_turned ? 2 : 1)) % 3;
  const int v = (axis + (is_turned ? 1 : 2)) % 3;
  std::vector<Vec2> flat;
  flat.reserve(positions.size());
  for (const Vec3& p : positions)
    flat.emplace_back(p[u], p[v]);
  return flat;
}

bool is_convex(std::span<const Vec2> flat) {
  const std::size_t count = flat.size();
  std::size_t rightward_starts = 0;  // a convex outline runs to the right in one piece
  bool was_rightward = flat[0].x > flat[count - 1].x;
  for (std::size_t i = 0; i < count; ++i) {
    const Vec2& next = flat[(i + 1) % count];
    if (turn(flat[i], next, flat[(i + 2) % count]) < 0.0) return false;
    const bool is_rightward = next.x > flat[i].x;
    if (is_rightward && !was_rightward) ++rightward_starts;
    was_rightward = is_rightward;
  }
  return rightward_starts <= 1;
}

/// Marks, of corners, that are looked for in the order of the outline.
class CornerMarks {
 public:
  explicit CornerMarks(std::size_t count) : words_((count + kBits - 1) / kBits, 0) {
    for (std::size_t i = 0; i < count; ++i)
      set(i);
  }

  void set(std::size_t i) { words_[i / kBits] |= std::uint64_t{1} << (i % kBits); }
  void clear(std::size_t i) { words_[i / kBits] &= ~(std::uint64_t{1} << (i % kBits)); }

  /// The first one marked from `start` on, and from the beginning when that was the end.
  [[nodiscard]] std::optional<std::size_t> next(std::size_t start) const {
    const std::size_t first = start / kBits;
    const std::uint64_t from_start = ~std::uint64_t{0} << (start % kBits);
    for (std::size_t step = 0; step <= words_.size(); ++step) {
      const std::size_t k = (first + step) % words_.size();
      std::uint64_t word = words_[k];
      if (step == 0) word &= from_start;
      if (step == words_.size()) word &= ~from_start;
      if (word != 0) return k * kBits + static_cast<std::size_t>(std::countr_zero(word));
    }
    return std::nullopt;
  }

 private:
  static constexpr std::size_t kBits = 64;
  std::vector<std::uint64_t> words_;
};

/// Takes ears off the outline until three corners are left. A corner that is none is not asked
/// again before its neighbours have changed or the corner that lies in its triangle is gone.
class EarClipper {
 public:
  EarClipper(std::span<const Vec2> flat, const Progress& progress)
      : flat_(flat),
        progress_(progress),
        corners_(flat),
        may_be_ear_(flat.size()),
        blocked_(flat.size()),
        is_clipped_(flat.size()) {
    for (std::size_t i = 0; i < flat.size(); ++i) {
      before_.push_back(i == 0 ? flat.size() - 1 : i - 1);
      after_.push_back(i + 1 == flat.size() ? 0 : i + 1);
    }
  }

  template <class Emit>
  void clip(const Emit& emit) {
    for (std::size_t left = flat_.size(); left > 3; --left) {
      const std::size_t ear = find_ear();
      emit(before_[ear], ear, after_[ear]);
      remove(ear);
    }
    emit(first_, after_[first_], before_[first_]);
  }

 private:
  /// An ear, looked for from the last one on. A polygon that crosses itself may have none: then the
  /// corner at the start is taken, so that clipping ends.
  [[nodiscard]] std::size_t find_ear() {
    while (const auto corner = may_be_ear_.next(start_)) {
      progress_.check_stop();  // for one ear all corners may be asked
      if (is_ear(*corner)) return *corner;
      may_be_ear_.clear(*corner);
    }
    return start_;
  }

  [[nodiscard]] bool is_ear(std::size_t i) {
    const Vec2& a = flat_[before_[i]];
    const Vec2& b = flat_[i];
    const Vec2& c = flat_[after_[i]];
    if (turn(a, b, c) <= 0.0) return false;
    const auto inside = corners_.find_inside(a, b, c);
    if (inside) blocked_[*inside].push_back(i);
    return !inside;
  }

  void remove(std::size_t ear) {
    const std::size_t before = before_[ear], after = after_[ear];
    after_[before] = after;
    before_[after] = before;
    corners_.remove(ear);
    is_clipped_[ear] = true;
    may_be_ear_.clear(ear);
    may_be_ear_.set(before);
    may_be_ear_.set(after);
    for (const std::size_t i : blocked_[ear]) {
      if (!is_clipped_[i]) may_be_ear_.set(i);
    }
    start_ = ear == first_ ? after : before;
    if (ear == first_) first_ = after;
  }

  std::span<const Vec2> flat_;
  const Progress& progress_;
  CornerTree corners_;
  CornerMarks may_be_ear_;
  std::vector<std::vector<std::size_t>> blocked_;  ///< whose triangles a corner was found in
  std::vector<bool> is_clipped_;
  std::vector<std::size_t> before_, after_;  ///< neighbours in the outline
  std::size_t first_ = 0;                    ///< the lowest corner in the outline
  std::size_t start_ = 0;
};

}  // namespace

void split_polygon(std::span<const std::uint32_t> polygon, std::span<const Vec3> positions,
                   std::vector<Triangle>& triangles, const Progress& progress) {
  if (polygon.size() < 3) return;
  const auto emit = [&](std::size_t a, std::size_t b, std::size_t c) {
    if (positions[a] == positions[b] || positions[b] == positions[c] ||
        positions[c] == positions[a]) {
      return;
    }
    triangles.push_back({polygon[a], polygon[b], polygon[c]});
  };
  if (polygon.size() == 3) {
    emit(0, 1, 2);
    return;
  }
  const std::vector<Vec2> flat = flatten(positions);
  if (is_convex(flat)) {
    for (std::size_t i = 2; i < polygon.size(); ++i)
      emit(0, i - 1, i);
  } else {
    EarClipper(flat, progress).clip(emit);
  }
}

}  // namespace rangezip

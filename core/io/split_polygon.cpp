#include "core/io/split_polygon.h"

#include <cmath>
#include <cstddef>

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

/// Positive where a, b, c turn left.
double turn(const Vec2& a, const Vec2& b, const Vec2& c) {
  return (b.x - a.x) * (c.y - a.y) - (b.y - a.y) * (c.x - a.x);
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

/// Takes ears off the outline until three corners are left.
class EarClipper {
 public:
  explicit EarClipper(std::span<const Vec2> flat) : flat_(flat) {
    for (std::size_t i = 0; i < flat.size(); ++i)
      outline_.push_back(i);
  }

  template <class Emit>
  void clip(const Emit& emit) {
    while (outline_.size() > 3) {
      const std::size_t ear = find_ear();
      emit(before(ear), outline_[ear], after(ear));
      outline_.erase(outline_.begin() + static_cast<std::ptrdiff_t>(ear));
      start_ = ear == 0 ? 0 : ear - 1;
    }
    emit(outline_[0], outline_[1], outline_[2]);
  }

 private:
  [[nodiscard]] std::size_t before(std::size_t i) const {
    return outline_[(i + outline_.size() - 1) % outline_.size()];
  }
  [[nodiscard]] std::size_t after(std::size_t i) const {
    return outline_[(i + 1) % outline_.size()];
  }

  /// An ear, looked for from the last one on. A polygon that crosses itself may have none: then the
  /// corner at the start is taken, so that clipping ends.
  [[nodiscard]] std::size_t find_ear() const {
    for (std::size_t step = 0; step < outline_.size(); ++step) {
      const std::size_t i = (start_ + step) % outline_.size();
      if (is_ear(i)) return i;
    }
    return start_ % outline_.size();
  }

  [[nodiscard]] bool is_ear(std::size_t i) const {
    const Vec2& a = flat_[before(i)];
    const Vec2& b = flat_[outline_[i]];
    const Vec2& c = flat_[after(i)];
    if (turn(a, b, c) <= 0.0) return false;
    for (const std::size_t other : outline_) {
      const Vec2& p = flat_[other];
      if (p == a || p == b || p == c) continue;
      if (turn(a, b, p) >= 0.0 && turn(b, c, p) >= 0.0 && turn(c, a, p) >= 0.0) return false;
    }
    return true;
  }

  std::span<const Vec2> flat_;
  std::vector<std::size_t> outline_;
  std::size_t start_ = 0;
};

}  // namespace

void split_polygon(std::span<const std::uint32_t> polygon, std::span<const Vec3> positions,
                   std::vector<Triangle>& triangles) {
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
    EarClipper(flat).clip(emit);
  }
}

}  // namespace rangezip

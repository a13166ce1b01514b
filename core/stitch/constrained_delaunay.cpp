#include "core/stitch/constrained_delaunay.h"

#include <algorithm>
#include <deque>
#include <numeric>
#include <optional>

namespace rangezip {

namespace {

using Index = std::uint32_t;
constexpr Index kNone = 0xffff'ffffU;

/// Position along a Hilbert curve over the square of all grid points, 16 levels deep: neighbours
/// on the curve are neighbours in the plane, which keeps the walks short.
std::uint32_t hilbert_key(const GridPoint& point) {
  constexpr int kLevels = 16;
  constexpr int kDroppedBits = 29 - kLevels;  // of the 29 bits of a coordinate made positive
  auto x = static_cast<std::uint32_t>((point.x + kGridLimit) >> kDroppedBits);
  auto y = static_cast<std::uint32_t>((point.y + kGridLimit) >> kDroppedBits);
  x = std::min(x, (1U << kLevels) - 1U);
  y = std::min(y, (1U << kLevels) - 1U);
  std::uint32_t key = 0;
  for (int level = kLevels - 1; level >= 0; --level) {
    const std::uint32_t right = (x >> level) & 1U;
    const std::uint32_t upper = (y >> level) & 1U;
    key = (key << 2) | ((3U * right) ^ upper);
    if (upper == 0) {  // turn the quarter so that its curve starts where the last one ended
      if (right == 1) {
        x = ~x;
        y = ~y;
      }
      std::swap(x, y);
    }
  }
  return key;
}

/// A triangulation of the whole plane: triangles with the corner kInfinite fill the outside of the
/// convex hull. Half-edges 3t, 3t+1, 3t+2 run counter-clockwise around triangle t.
class Triangulation {
 public:
  explicit Triangulation(std::span<const GridPoint> points)
      : points_(points),
        infinite_(static_cast<Index>(points.size())),
        outgoing_(points.size() + 1, kNone) {}

  void insert_all();
  /// False, and nothing changed from the crossing on, if the segment crosses an entered one.
  bool insert_segment(Index from, Index to);
  [[nodiscard]] std::vector<Triangle> finite_triangles() const;

 private:
  using Edge = std::array<Index, 2>;  ///< by its corners: half-edges change theirs in flips

  static Index next(Index e) { return e % 3 == 2 ? e - 2 : e + 1; }
  static Index previous(Index e) { return e % 3 == 0 ? e + 2 : e - 1; }
  [[nodiscard]] Index from(Index e) const { return corner_[e]; }
  [[nodiscard]] Index to(Index e) const { return corner_[next(e)]; }
  [[nodiscard]] Index apex(Index e) const { return corner_[previous(e)]; }
  [[nodiscard]] Index rotated(Index e) const { return twin_[previous(e)]; }
  [[nodiscard]] std::int64_t turn(Index a, Index b, Index c) const {
    return orientation(points_[a], points_[b], points_[c]);
  }

  Index add_triangle(Index a, Index b, Index c);
  void link(Index e, Index f);
  void flip(Index e);
  bool start(std::vector<Index>& order);
  [[nodiscard]] Index locate(Index point) const;
  void insert(Index point);
  [[nodiscard]] bool must_flip(Index e) const;

  [[nodiscard]] Index find(const Edge& edge) const;
  void fix(Index e);
  struct Trace {
    std::vector<Edge> crossed;
    Index end = kNone;  ///< the first vertex on the segment; kNone: a fixed edge is in the way
  };
  [[nodiscard]] Trace trace(Index from, Index to) const;
  void flip_out(const Edge& segment, const std::vector<Edge>& crossed);
  void restore_delaunay();

  std::span<const GridPoint> points_;
  Index infinite_;
  std::vector<Index> corner_;  ///< of half-edge e, where it starts
  std::vector<Index> twin_;
  std::vector<std::uint8_t> fixed_;
  std::vector<Index> outgoing_;  ///< of each vertex, one half-edge that starts there
  std::vector<Index> stack_;
  std::vector<Edge> changed_;  ///< edges to be looked at by restore_delaunay
  Index last_ = 0;             ///< half-edge where the next walk starts
};

Index Triangulation::add_triangle(Index a, Index b, Index c) {
  const Index e = static_cast<Index>(corner_.size());
  corner_.insert(corner_.end(), {a, b, c});
  twin_.insert(twin_.end(), {kNone, kNone, kNone});
  fixed_.insert(fixed_.end(), {0, 0, 0});
  outgoing_[a] = e;
  outgoing_[b] = e + 1;
  outgoing_[c] = e + 2;
  return e;
}

void Triangulation::link(Index e, Index f) {
  twin_[e] = f;
  twin_[f] = e;
}

/// Replaces edge u-v of the two triangles uvp and vuw by p-w. Afterwards e runs from w to v, its
/// old twin from p to u.
void Triangulation::flip(Index e) {
  const Index f = twin_[e];
  const Index e_next = next(e);
  const Index e_previous = previous(e);
  const Index f_next = next(f);
  const Index f_previous = previous(f);
  corner_[e] = corner_[f_previous];
  corner_[f] = corner_[e_previous];
  fixed_[e] = fixed_[f_previous];
  fixed_[f] = fixed_[e_previous];
  fixed_[e_previous] = fixed_[f_previous] = 0;
  link(e, twin_[f_previous]);
  link(f, twin_[e_previous]);
  link(e_previous, f_previous);
  for (const Index h : {e, f, e_next, f_next})
    outgoing_[corner_[h]] = h;
}

/// The first triangle, from the first points in `order` that are not collinear, with the three
/// infinite ones around it; takes its corners out of the order. False if there is none.
bool Triangulation::start(std::vector<Index>& order) {
  if (order.size() < 3) return false;
  std::size_t third = 2;
  while (third < order.size() && turn(order[0], order[1], order[third]) == 0)
    ++third;
  if (third == order.size()) return false;

  std::array<Index, 3> corners{order[0], order[1], order[third]};
  if (turn(corners[0], corners[1], corners[2]) < 0) std::swap(corners[1], corners[2]);
  order.erase(order.begin() + static_cast<std::ptrdiff_t>(third));
  order.erase(order.begin(), order.begin() + 2);

  const Index inner = add_triangle(corners[0], corners[1], corners[2]);
  std::array<Index, 3> outer{};
  for (Index k = 0; k < 3; ++k) {
    outer[k] = add_triangle(corners[(k + 1) % 3], corners[k], infinite_);
    link(inner + k, outer[k]);
  }
  for (Index k = 0; k < 3; ++k)
    link(next(outer[k]), previous(outer[(k + 2) % 3]));
  return true;
}

/// A half-edge of the triangle that contains the point, on its border or not; of an infinite
/// triangle the point sees its hull edge from strictly outside.
Index Triangulation::locate(Index point) const {
  Index e = last_;
  for (;;) {
    Index across = kNone;
    Index h = e;
    for (int k = 0; k < 3 && across == kNone; ++k, h = next(h)) {
      if (turn(from(h), to(h), point) < 0) across = twin_[h];
    }
    if (across == kNone || apex(across) == infinite_) return across == kNone ? e : across;
    e = across;
  }
}

void Triangulation::insert(Index point) {
  const Index ab = locate(point);
  const Index bc = next(ab);
  const Index ca = previous(ab);
  const Index a = from(ab);
  const Index b = from(bc);
  const Index c = from(ca);
  const Index beyond_bc = twin_[bc];
  const Index beyond_ca = twin_[ca];

  corner_[ca] = point;  // abc becomes ab-point
  const Index second = add_triangle(b, c, point);
  const Index third = add_triangle(c, a, point);
  outgoing_[a] = ab;
  outgoing_[b] = bc;
  outgoing_[point] = ca;
  link(second, beyond_bc);
  link(third, beyond_ca);
  link(bc, second + 2);
  link(second + 1, third + 2);
  link(third + 1, ca);

  stack_.assign({ab, second, third});
  while (!stack_.empty()) {
    const Index e = stack_.back();
    stack_.pop_back();
    if (!must_flip(e)) continue;
    const Index beyond = next(twin_[e]);
    flip(e);
    stack_.push_back(e);
    stack_.push_back(beyond);
  }
  // A finite triangle for the next walk to start from.
  Index e = outgoing_[point];
  while (to(e) == infinite_ || apex(e) == infinite_)
    e = rotated(e);
  last_ = e;
}

/// Whether edge e of a triangle and the one across is not Delaunay; the limit of the predicate
/// where a corner is at infinity: then it is about the convex hull.
bool Triangulation::must_flip(Index e) const {
  const Index u = from(e);
  const Index v = to(e);
  const Index p = apex(e);
  const Index w = apex(twin_[e]);
  if (fixed_[e] != 0 || p == infinite_) return false;
  if (w == infinite_) return turn(p, u, v) == 0;
  if (u == infinite_) return turn(w, v, p) > 0;
  if (v == infinite_) return turn(p, u, w) > 0;
  return in_circle(points_[u], points_[v], points_[p], points_[w]);
}

void Triangulation::insert_all() {
  std::vector<Index> order(points_.size());
  std::iota(order.begin(), order.end(), Index{0});
  std::vector<std::uint32_t> keys(points_.size());
  std::transform(points_.begin(), points_.end(), keys.begin(), hilbert_key);
  std::sort(order.begin(), order.end(),
            [&](Index i, Index j) { return keys[i] != keys[j] ? keys[i] < keys[j] : i < j; });
  // A triangulation of n points of the plane and one at infinity has 2 n - 2 triangles.
  corner_.reserve(6 * points_.size());
  twin_.reserve(6 * points_.size());
  fixed_.reserve(6 * points_.size());
  if (!start(order)) return;
  for (const Index point : order)
    insert(point);
}

/// The half-edge between two corners; @pre it exists.
Index Triangulation::find(const Edge& edge) const {
  Index e = outgoing_[edge[0]];
  while (to(e) != edge[1])
    e = rotated(e);
  return e;
}

void Triangulation::fix(Index e) {
  fixed_[e] = 1;
  fixed_[twin_[e]] = 1;
}

/// Follows the segment through the triangles up to the first vertex on it.
Triangulation::Trace Triangulation::trace(Index start, Index end) const {
  Trace result;
  Index e = outgoing_[start];
  for (const Index first = e;;) {
    const Index right = to(e);
    const Index left = apex(e);
    if (right != infinite_) {
      const std::int64_t side = turn(start, end, right);
      if (side == 0 && dot_at(points_[start], points_[right], points_[end]) > 0) {
        result.end = right;
        return result;
      }
      if (side < 0 && left != infinite_ && turn(start, end, left) > 0) break;
    }
    e = rotated(e);
    if (e == first) return result;  // cannot be: some triangle around the start looks at the end
  }
  Index crossed = next(e);
  for (;;) {
    if (fixed_[crossed] != 0) return result;
    result.crossed.push_back({from(crossed), to(crossed)});
    const Index across = twin_[crossed];
    const Index ahead = apex(across);
    const std::int64_t side = turn(start, end, ahead);
    if (side == 0) {
      result.end = ahead;
      return result;
    }
    crossed = side < 0 ? previous(across) : next(across);
  }
}

/// Flips the crossed edges until none crosses the segment.
void Triangulation::flip_out(const Edge& segment, const std::vector<Edge>& crossed) {
  const auto& [start, end] = segment;
  std::deque<Edge> queue(crossed.begin(), crossed.end());
  while (!queue.empty()) {
    const Edge edge = queue.front();
    queue.pop_front();
    const Index e = find(edge);
    const Index p = apex(e);
    const Index w = apex(twin_[e]);
    const bool is_convex = turn(p, from(e), w) > 0 && turn(w, to(e), p) > 0;
    if (!is_convex) {
      queue.push_back(edge);
      continue;
    }
    flip(e);
    const bool ends_there = p == start || p == end || w == start || w == end;
    const bool still_crosses =
        !ends_there && (turn(start, end, p) > 0) != (turn(start, end, w) > 0);
    if (still_crosses) {
      queue.push_back({p, w});
    } else {
      changed_.push_back({p, w});
    }
  }
}

/// Lawson's flips from the changed edges outward.
void Triangulation::restore_delaunay() {
  while (!changed_.empty()) {
    const Edge edge = changed_.back();
    changed_.pop_back();
    // An edge that a later flip took away needs no look: the flip entered its whole quadrilateral.
    Index e = outgoing_[edge[0]];
    const Index first = e;
    while (to(e) != edge[1] && rotated(e) != first)
      e = rotated(e);
    if (to(e) != edge[1] || !must_flip(e)) continue;
    const Index f = twin_[e];
    const std::array<Index, 4> corners{from(e), apex(f), to(e), apex(e)};
    flip(e);
    for (std::size_t k = 0; k < 4; ++k)
      changed_.push_back({corners[k], corners[(k + 1) % 4]});
  }
}

bool Triangulation::insert_segment(Index start, Index end) {
  if (corner_.empty()) return true;
  while (start != end) {
    const Trace found = trace(start, end);
    if (found.end == kNone) return false;
    flip_out({start, found.end}, found.crossed);
    fix(find({start, found.end}));
    restore_delaunay();
    start = found.end;
  }
  return true;
}

std::vector<Triangle> Triangulation::finite_triangles() const {
  std::vector<Triangle> triangles;
  triangles.reserve(corner_.size() / 3);
  for (std::size_t e = 0; e < corner_.size(); e += 3) {
    const Triangle triangle{corner_[e], corner_[e + 1], corner_[e + 2]};
    if (std::find(triangle.begin(), triangle.end(), infinite_) == triangle.end()) {
      triangles.push_back(triangle);
    }
  }
  return triangles;
}

}  // namespace

ConstrainedDelaunay triangulate_constrained(
    std::span<const GridPoint> points, std::span<const std::array<std::uint32_t, 2>> segments) {
  Triangulation triangulation(points);
  triangulation.insert_all();
  ConstrainedDelaunay result;
  for (const auto& [start, end] : segments) {
    if (!triangulation.insert_segment(start, end)) ++result.skipped_segments;
  }
  result.triangles = triangulation.finite_triangles();
  return result;
}

}  // namespace rangezip

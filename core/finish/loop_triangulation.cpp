#include "core/finish/loop_triangulation.h"

#include <algorithm>
#include <limits>
#include <optional>
#include <tuple>
#include <utility>

namespace rangezip {
namespace {

/// Which vertices of a loop the mesh already joins, by their places in the loop.
std::vector<std::pair<std::uint32_t, std::uint32_t>> joined_places(
    const CornerTable& table, const std::vector<std::uint32_t>& vertices) {
  std::vector<std::pair<std::uint32_t, std::uint32_t>> place_of;  // vertex, place in the loop
  for (std::uint32_t i = 0; i < vertices.size(); ++i)
    place_of.emplace_back(vertices[i], i);
  std::sort(place_of.begin(), place_of.end());
  std::vector<std::pair<std::uint32_t, std::uint32_t>> joined;
  for (std::uint32_t i = 0; i < vertices.size(); ++i) {
    table.for_each_neighbor(vertices[i], [&](std::uint32_t w) {
      const auto at = std::lower_bound(place_of.begin(), place_of.end(), std::pair{w, 0U});
      if (at != place_of.end() && at->first == w) joined.emplace_back(i, at->second);
    });
  }
  std::sort(joined.begin(), joined.end());
  return joined;
}

/// Longer loops are divided: beyond this the cubic cost shows.
constexpr std::size_t kMaxDirectEdges = 100;
/// A chord leaves at least this share of the loop on either side.
constexpr std::size_t kDivideIntoAtLeast = 4;

constexpr double kLongSide = 1.5;  // in h

/// A piece of the loop: indices of its points, and the normals across its edges.
struct Piece {
  std::vector<std::uint32_t> points;
  std::vector<Vec3> edge_normals;
};

/// How bad a triangulation is: first by what leads through air, then by its sharpest edge, then by
/// its size.
struct Weight {
  double air = 0.0;    ///< twice the area that leads through air
  double angle = 0.0;  ///< the largest 1 - cos between neighbours
  double size = 0.0;   ///< twice the area, or the length of the sides

  friend bool operator<(const Weight& a, const Weight& b) {
    return std::tie(a.air, a.angle, a.size) < std::tie(b.air, b.angle, b.size);
  }
};

constexpr double kFold = 2.0;  ///< the largest angle

constexpr double kInfinity = std::numeric_limits<double>::infinity();
constexpr Weight kImpossible{kInfinity, kInfinity, kInfinity};

/// 0 for parallel unit normals, 2 for a fold; nothing across: no angle.
double bend(const Vec3& a, const Vec3& b) {
  return glm::dot(b, b) > 0.0 ? 1.0 - glm::dot(a, b) : 0.0;
}

bool is_long(const LoopShape& shape, const Vec3& p, const Vec3& q) {
  return glm::length(q - p) > shape.long_side;
}

/// Whether a side, if it is long, has its middle in the air.
bool is_side_in_air(const LoopShape& shape, const Vec3& p, const Vec3& q) {
  return is_long(shape, p, q) && shape.is_in_air(0.5 * (p + q));
}

/// Whether the middle of a triangle, if a side is long, is in the air.
bool has_air_inside(const LoopShape& shape, const Vec3& a, const Vec3& b, const Vec3& c) {
  return (is_long(shape, a, b) || is_long(shape, b, c) || is_long(shape, c, a)) &&
         shape.is_in_air((a + b + c) / 3.0);
}

/// Whether that, or the middle of a side is.
bool leads_through_air(const LoopShape& shape, const Triangle& t) {
  const Vec3 &a = shape.points[t[0]], &b = shape.points[t[1]], &c = shape.points[t[2]];
  return is_side_in_air(shape, a, b) || is_side_in_air(shape, b, c) ||
         is_side_in_air(shape, c, a) || has_air_inside(shape, a, b, c);
}

/// The table of best triangulations of all sub-polygons i..k of a piece.
class Triangulator {
 public:
  Triangulator(const LoopShape& shape, const Piece& piece, bool avoids_air)
      : shape_(shape),
        piece_(piece),
        avoids_air_(avoids_air),
        size_(piece.points.size()),
        weights_(size_ * size_, kImpossible),
        normals_(size_ * size_, Vec3{0.0}),
        middles_(size_ * size_, 0) {
    if (avoids_air) find_air();
  }

  /// The best triangulation; empty if there is none.
  std::vector<Triangle> run() {
    for (std::size_t i = 0; i + 1 < size_; ++i)
      set(i, i + 1, Weight{}, piece_.edge_normals[i], i);
    for (std::size_t span = 2; span < size_; ++span) {
      for (std::size_t i = 0; i + span < size_; ++i)
        choose_middle(i, i + span);
    }
    if (weights_[slot(0, size_ - 1)].air == kInfinity) return {};
    return collect();
  }

 private:
  [[nodiscard]] std::size_t slot(std::size_t i, std::size_t k) const { return i * size_ + k; }
  [[nodiscard]] const Vec3& point(std::size_t i) const { return shape_.points[piece_.points[i]]; }

  void choose_middle(std::size_t i, std::size_t k) {
    const bool closes = i == 0 && k == size_ - 1;  // the side from k to i is an edge of the piece
    if (!closes && shape_.is_forbidden(piece_.points[i], piece_.points[k])) return;
    const Weight& best = weights_[slot(i, k)];
    for (std::size_t m = i + 1; m < k; ++m) {
      const Weight& left = weights_[slot(i, m)];
      const Weight& right = weights_[slot(k, m)];
      Weight weight{left.air + right.air, std::max(left.angle, right.angle),
                    left.size + right.size};
      if (weight.air == kInfinity || is_worse(weight, best)) continue;
      const Vec3 area = area_vector(point(i), point(m), point(k));
      const double length = glm::length(area);
      weight.size += shape_.by_length ? length_of_sides(i, m, k) : length;
      const Vec3 normal = length > 0.0 ? area / length : Vec3(0.0);
      weight.angle = std::max(weight.angle, sharpest_angle(i, m, k, normal));
      if (closes) weight.angle = std::max(weight.angle, angle_across(k, normal));
      if (!(weight < best)) continue;
      if (avoids_air_ && leads_through_air(i, m, k)) weight.air += length;
      if (weight < best && can_take(i, m, k)) set(i, k, weight, normal, m);
    }
  }

  /// Between a triangle, with this unit normal, and those across its sides from i to m and m to k;
  /// one without area is as bad as a fold.
  [[nodiscard]] double sharpest_angle(std::size_t i, std::size_t m, std::size_t k,
                                      const Vec3& normal) const {
    if (shape_.by_length) return 0.0;
    if (glm::dot(normal, normal) == 0.0) return kFold;
    return std::max(bend(normal, normals_[slot(i, m)]), bend(normal, normals_[slot(k, m)]));
  }

  /// The same across edge k of the piece.
  [[nodiscard]] double angle_across(std::size_t k, const Vec3& normal) const {
    return shape_.by_length ? 0.0 : bend(normal, piece_.edge_normals[k]);
  }

  /// Without the side from k to i, which counts for the triangle across it.
  [[nodiscard]] double length_of_sides(std::size_t i, std::size_t m, std::size_t k) const {
    return glm::length(point(m) - point(i)) + glm::length(point(k) - point(m));
  }

  [[nodiscard]] bool can_take(std::size_t i, std::size_t m, std::size_t k) const {
    return !shape_.can_take ||
           shape_.can_take({piece_.points[i], piece_.points[m], piece_.points[k]});
  }

  /// Each side is asked about once, of which there are far fewer than triangles.
  void find_air() {
    in_air_.assign(size_ * size_, 0);
    for (std::size_t i = 0; i < size_; ++i) {
      for (std::size_t k = i + 1; k < size_; ++k)
        in_air_[slot(i, k)] = is_side_in_air(shape_, point(i), point(k)) ? 1 : 0;
    }
  }

  [[nodiscard]] bool leads_through_air(std::size_t i, std::size_t m, std::size_t k) const {
    return in_air_[slot(i, m)] != 0 || in_air_[slot(m, k)] != 0 || in_air_[slot(i, k)] != 0 ||
           has_air_inside(shape_, point(i), point(m), point(k));
  }

  /// Whether nothing that is added to a weight can make it the better one.
  static bool is_worse(const Weight& sum, const Weight& best) {
    return std::tie(sum.air, sum.angle) > std::tie(best.air, best.angle);
  }

  /// In both halves of the tables, so that choose_middle() reads rows only.
  void set(std::size_t i, std::size_t k, const Weight& weight, const Vec3& normal,
           std::size_t middle) {
    for (const std::size_t here : {slot(i, k), slot(k, i)}) {
      weights_[here] = weight;
      normals_[here] = normal;
      middles_[here] = static_cast<std::uint32_t>(middle);
    }
  }

  [[nodiscard]] std::vector<Triangle> collect() const {
    std::vector<Triangle> triangles;
    std::vector<std::pair<std::size_t, std::size_t>> open{{0, size_ - 1}};
    while (!open.empty()) {
      const auto [i, k] = open.back();
      open.pop_back();
      if (k - i < 2) continue;
      const std::size_t m = middles_[slot(i, k)];
      triangles.push_back({piece_.points[i], piece_.points[m], piece_.points[k]});
      open.emplace_back(i, m);
      open.emplace_back(m, k);
    }
    return triangles;
  }

  const LoopShape& shape_;
  const Piece& piece_;
  bool avoids_air_;
  std::size_t size_;
  std::vector<Weight> weights_;
  std::vector<Vec3> normals_;
  std::vector<std::uint32_t> middles_;
  std::vector<std::uint8_t> in_air_;  // flags of sides; empty: of no interest
};

struct Chord {
  std::size_t from = 0;
  std::size_t to = 0;
};

/// How much longer a chord through air counts.
constexpr double kAirChord = 4.0;
/// Points that happen to lie far apart let a little of any surface look like air.
constexpr double kMuchLess = 0.5;

/// Other chords to divide a loop by first, where what the shortest gives leads through air.
constexpr int kOtherChords = 3;
/// Of the points of a loop: how far the ends of these lie from those of one that was tried.
constexpr std::size_t kApartByPart = 8;

/// Whether a point of a loop of n lies near the end of a chord.
bool is_near_end(std::size_t i, const std::vector<Chord>& chords, std::size_t n) {
  return std::any_of(chords.begin(), chords.end(), [&](const Chord& chord) {
    const std::size_t a = i > chord.from ? i - chord.from : chord.from - i;
    const std::size_t b = i > chord.to ? i - chord.to : chord.to - i;
    return kApartByPart * std::min({a, n - a, b, n - b}) < n;
  });
}

/// The shortest allowed chord that leaves enough of the loop on either side, away from others.
std::optional<Chord> dividing_chord(const LoopShape& shape, const Piece& piece,
                                    const std::vector<Chord>& others) {
  const std::size_t n = piece.points.size();
  const std::size_t least = std::max<std::size_t>(2, n / kDivideIntoAtLeast);
  std::optional<Chord> best;
  double best_length = std::numeric_limits<double>::infinity();
  for (std::size_t i = 0; i < n; ++i) {
    if (is_near_end(i, others, n)) continue;
    const Vec3& a = shape.points[piece.points[i]];
    for (std::size_t k = i + least; k < n && n - (k - i) >= least; ++k) {
      const Vec3 d = shape.points[piece.points[k]] - a;
      double length = glm::dot(d, d);
      if (length >= best_length || shape.is_forbidden(piece.points[i], piece.points[k])) continue;
      if (shape.is_in_air && is_side_in_air(shape, a, shape.points[piece.points[k]])) {
        length *= kAirChord * kAirChord;
        if (length >= best_length) continue;
      }
      if (is_near_end(k, others, n)) continue;
      best_length = length;
      best = Chord{i, k};
    }
  }
  return best;
}

/// The part of a piece from one point to another along the loop, closed by the chord.
Piece part_of(const Piece& piece, std::size_t from, std::size_t to) {
  const std::size_t n = piece.points.size();
  Piece part;
  for (std::size_t i = from; i != to; i = (i + 1) % n) {
    part.points.push_back(piece.points[i]);
    part.edge_normals.push_back(piece.edge_normals[i]);
  }
  part.points.push_back(piece.points[to]);
  part.edge_normals.push_back(Vec3{0.0});
  return part;
}

double area_in_air(const LoopShape& shape, const std::vector<Triangle>& triangles) {
  double area = 0.0;
  for (const Triangle& t : triangles) {
    if (!leads_through_air(shape, t)) continue;
    area += glm::length(area_vector(shape.points[t[0]], shape.points[t[1]], shape.points[t[2]]));
  }
  return area;
}

/// The least sharp one, or if much of that leads through air and could do without, one of those
/// with the least in the air.
std::vector<Triangle> triangulate_piece(const LoopShape& shape, const Piece& piece) {
  std::vector<Triangle> blunt = Triangulator(shape, piece, false).run();
  if (!shape.is_in_air) return blunt;
  const double in_air = area_in_air(shape, blunt);
  if (in_air == 0.0) return blunt;
  std::vector<Triangle> around = Triangulator(shape, piece, true).run();
  return area_in_air(shape, around) < kMuchLess * in_air ? around : blunt;
}

/// Divides pieces until they are short enough. Empty if one cannot be divided or triangulated.
std::vector<Triangle> triangulate_pieces(const LoopShape& shape, std::vector<Piece> open) {
  std::vector<Triangle> triangles;
  while (!open.empty()) {
    const Piece piece = std::move(open.back());
    open.pop_back();
    if (piece.points.size() > kMaxDirectEdges) {
      const std::optional<Chord> chord = dividing_chord(shape, piece, {});
      if (!chord) return {};
      open.push_back(part_of(piece, chord->from, chord->to));
      open.push_back(part_of(piece, chord->to, chord->from));
      continue;
    }
    const std::vector<Triangle> part = triangulate_piece(shape, piece);
    if (part.empty()) return {};
    triangles.insert(triangles.end(), part.begin(), part.end());
  }
  return triangles;
}

/// Of a long loop. The shortest chord may part the two rims of a crack all around a tube from each
/// other, beside the bridge between them: then each is closed across the tube, and another chord
/// divides the crack.
std::vector<Triangle> triangulate_divided(const LoopShape& shape, const Piece& whole) {
  std::vector<Triangle> best;
  double least_air = kInfinity;
  std::vector<Chord> tried;
  for (int k = 0; k <= kOtherChords && least_air > 0.0; ++k) {
    const std::optional<Chord> chord = dividing_chord(shape, whole, tried);
    if (!chord) break;
    tried.push_back(*chord);
    std::vector<Triangle> triangles = triangulate_pieces(
        shape, {part_of(whole, chord->from, chord->to), part_of(whole, chord->to, chord->from)});
    if (triangles.empty()) continue;
    const double air = shape.is_in_air ? area_in_air(shape, triangles) : 0.0;
    if (!best.empty() && air >= kMuchLess * least_air) continue;
    best = std::move(triangles);
    least_air = air;
  }
  return best;
}

}  // namespace

LoopShape shape_of(const BoundaryLoop& loop, const CornerTable& table,
                   const std::vector<Vec3>& positions, const CloudEvidence& evidence) {
  const std::vector<std::uint32_t> vertices = vertices_of(loop, table);
  LoopShape shape;
  for (const std::uint32_t v : vertices)
    shape.points.push_back(positions[v]);
  for (const std::uint32_t c : loop.corners) {
    shape.edge_normals.push_back(unit_normal(positions, table.triangle(c / 3)));
  }
  shape.forbidden = joined_places(table, vertices);
  shape.is_in_air = air_test(evidence, shape.points);
  shape.long_side = kLongSide * evidence.pixel_size;
  return shape;
}

std::vector<Triangle> triangulate_loop(const LoopShape& shape) {
  if (shape.points.size() < 3) return {};
  Piece whole;
  for (std::uint32_t i = 0; i < shape.points.size(); ++i)
    whole.points.push_back(i);
  whole.edge_normals = shape.edge_normals;
  if (whole.points.size() <= kMaxDirectEdges) return triangulate_piece(shape, whole);
  return triangulate_divided(shape, whole);
}

double share_in_air(const LoopShape& shape, const std::vector<Triangle>& triangles) {
  double area = 0.0;
  for (const Triangle& t : triangles)
    area += glm::length(area_vector(shape.points[t[0]], shape.points[t[1]], shape.points[t[2]]));
  return shape.is_in_air && area > 0.0 ? area_in_air(shape, triangles) / area : 0.0;
}

}  // namespace rangezip

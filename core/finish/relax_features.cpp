#include "core/finish/relax_features.h"

#include <algorithm>
#include <utility>

#include "core/finish/edge_changes.h"
#include "core/finish/feature_sides.h"
#include "core/finish/triangle_shape.h"
#include "core/finish/vertex_geometry.h"

namespace rangezip {
namespace {

constexpr int kRounds = 5;
constexpr int kRings = 3;            // around features: vertices that move
constexpr int kRingsToTurn = 2;      // whose edges turn, and which may go
constexpr double kGain = 0.002;      // of the sine of the smallest angle, or of their mean
constexpr double kKeptAngle = 0.5;   // sine: 30 degrees, for the sake of the mean
constexpr double kOneSide = 0.95;    // cosine: faces of one side
constexpr double kTurn = 0.9;        // cosine: how far a face may turn
constexpr int kMendFrom = 2;         // rounds that only relax
constexpr double kSmallAngle = 0.4;  // sine: 24 degrees

class Relaxer {
 public:
  Relaxer(CornerTable& table, std::vector<Vec3>& positions,
          const std::vector<std::uint8_t>& is_feature, const VertexSides& sides)
      : table_(table),
        positions_(positions),
        is_feature_(is_feature),
        sides_(sides),
        may_relax_(positions.size(), 1),
        may_turn_(positions.size(), 1) {}

  void run() {
    const std::vector<std::uint32_t> vertices = near_features(kRingsToTurn);
    const std::vector<std::uint32_t> relaxed = near_features(kRings);
    for (int round = 0; round < kRounds; ++round) {
      for (const std::uint32_t v : relaxed) {
        if (std::exchange(may_relax_[v], std::uint8_t{0}) != 0) relax(v);
      }
      for (const std::uint32_t v : vertices) {
        if (std::exchange(may_turn_[v], std::uint8_t{0}) != 0) turn_edges(v);
      }
      if (round < kMendFrom) continue;
      for (const std::uint32_t v : vertices)
        mend(v);
    }
  }

 private:
  [[nodiscard]] const Vec3& at(std::uint32_t vertex) const { return positions_[vertex]; }

  /// What has been in vain at a vertex and those around may be good now that it has changed.
  void try_again_around(std::uint32_t v) {
    const auto note = [&](std::uint32_t w) { may_relax_[w] = may_turn_[w] = 1; };
    note(v);
    table_.for_each_neighbor(v, note);
  }

  /// The inner vertices within so many edges of a feature, in order.
  [[nodiscard]] std::vector<std::uint32_t> near_features(int rings) const {
    std::vector<std::uint8_t> is_near(is_feature_.size());
    std::vector<std::uint32_t> vertices;
    const auto add = [&](std::uint32_t v) {
      if (is_near[v] != 0) return;
      is_near[v] = 1;
      vertices.push_back(v);
    };
    for (std::uint32_t v = 0; v < is_feature_.size(); ++v) {
      if (is_feature_[v] != 0 && table_.corner_of(v) != CornerTable::kNone) add(v);
    }
    std::size_t begin = 0;
    for (int ring = 0; ring < rings; ++ring) {
      const std::size_t end = vertices.size();
      for (; begin < end; ++begin)
        table_.for_each_neighbor(vertices[begin], add);
    }
    std::erase_if(vertices, [&](std::uint32_t v) { return table_.is_boundary(v); });
    std::sort(vertices.begin(), vertices.end());
    return vertices;
  }

  void relax(std::uint32_t v) {
    if (is_feature_[v] > 1) return;
    if (table_.corner_of(v) == CornerTable::kNone) return;
    const double before = smallest_angle(v, at(v));
    const std::optional<Vec3> middle =
        is_feature_[v] != 0 ? middle_of_chain(v) : middle_of_faces(v);
    if (!middle) return;
    const std::optional<Vec3> place = sides_.place_on(v, *middle);
    if (!place || !has_better_angles(v, *place, before)) return;
    if (before >= 0.0 && turns_face(v, *place)) return;
    positions_[v] = *place;
    try_again_around(v);
  }

  /// Sine of the smallest angle of the faces around a vertex, were it at `place`; where faces look
  /// the wrong way, the sum of theirs as a negative number.
  [[nodiscard]] double smallest_angle(std::uint32_t v, const Vec3& place) const {
    double smallest = 1.0, wrong = 0.0;
    table_.for_each_corner(v, [&](std::uint32_t c) {
      const Vec3 &p = at(table_.head(c)), &q = at(table_.apex(c));
      const double angle = sine_of_smallest_angle(place, p, q);
      if (!sides_.may_face(v, area_vector(place, p, q))) wrong += angle;
      smallest = std::min(smallest, angle);
    });
    return wrong > 0.0 ? -wrong : smallest;
  }

  /// The smallest one, or without loss for that, the mean of those of the faces.
  [[nodiscard]] bool has_better_angles(std::uint32_t v, const Vec3& place, double before) const {
    const double after = smallest_angle(v, place);
    if (after >= before + kGain) return true;
    return after >= std::min(before, kKeptAngle) &&
           mean_angle(v, place) >= mean_angle(v, at(v)) + kGain;
  }

  /// Mean sine of the smallest angles of the faces around a vertex, were it at `place`.
  [[nodiscard]] double mean_angle(std::uint32_t v, const Vec3& place) const {
    double sum = 0.0;
    int count = 0;
    table_.for_each_corner(v, [&](std::uint32_t c) {
      sum += sine_of_smallest_angle(place, at(table_.head(c)), at(table_.apex(c)));
      ++count;
    });
    return sum / count;
  }

  [[nodiscard]] bool turns_face(std::uint32_t v, const Vec3& place) const {
    bool turns = false;
    table_.for_each_corner(v, [&](std::uint32_t c) {
      const Vec3 &p = at(table_.head(c)), &q = at(table_.apex(c));
      turns = turns || !has_cosine(area_vector(at(v), p, q), area_vector(place, p, q), kTurn);
    });
    return turns;
  }

  /// Of the two neighbours along the edge of the feature; nothing where there are not two.
  [[nodiscard]] std::optional<Vec3> middle_of_chain(std::uint32_t v) const {
    Vec3 sum{0.0};
    int count = 0;
    table_.for_each_corner(v, [&](std::uint32_t c) {
      const std::uint32_t w = table_.head(c);
      if (is_feature_[w] == 0 || !is_crease(table_, positions_, c)) return;
      sum += at(w);
      ++count;
    });
    if (count != 2) return std::nullopt;
    return 0.5 * sum;
  }

  [[nodiscard]] std::optional<Vec3> middle_of_faces(std::uint32_t v) const {
    Vec3 sum{0.0};
    double weight = 0.0;
    table_.for_each_corner(v, [&](std::uint32_t c) {
      const double area = glm::length(face_area_vector(table_, positions_, c / 3));
      sum += area / 3.0 * (at(v) + at(table_.head(c)) + at(table_.apex(c)));
      weight += area;
    });
    if (!(weight > 0.0)) return std::nullopt;
    return sum / weight;
  }

  void turn_edges(std::uint32_t v) {
    const std::uint32_t first = table_.corner_of(v);
    if (first == CornerTable::kNone || !sides_.may_change(v)) return;
    std::uint32_t worst = CornerTable::kNone;
    double most = kGain;
    table_.for_each_corner(v, [&](std::uint32_t c) {
      if (table_.across(c) == CornerTable::kNone || !sides_.may_change(table_.head(c))) return;
      const Diamond d(table_, c);
      if (!is_flat(DiamondAreas(positions_, d), kOneSide)) return;
      const double gain = angle_after_flip(positions_, d) - angle_before_flip(positions_, d);
      if (gain <= most || !table_.is_flip_ok(c)) return;
      most = gain;
      worst = c;
    });
    if (worst == CornerTable::kNone) return;
    const Diamond turned(table_, worst);
    table_.flip(worst);
    for (const std::uint32_t w : {turned.a, turned.b, turned.x, turned.y})
      try_again_around(w);
  }

  /// Where relaxing did not open a fold or a small angle, the vertex goes.
  void mend(std::uint32_t v) {
    if (table_.corner_of(v) == CornerTable::kNone || !sides_.may_change(v)) return;
    if (smallest_angle(v, at(v)) >= kSmallAngle) return;
    double best = kSmallAngle;
    std::uint32_t into = CornerTable::kNone;
    table_.for_each_corner(v, [&](std::uint32_t c) {
      if (is_feature_[v] > is_feature_[table_.head(c)] || !table_.is_collapse_ok(c)) return;
      const double angle = angle_after_collapse(c);
      if (angle <= best) return;
      best = angle;
      into = c;
    });
    if (into == CornerTable::kNone) return;
    const std::uint32_t target = table_.head(into);
    table_.collapse(into);
    try_again_around(target);
  }

  /// The smallest angle of the faces around the half-edge's vertex after it moved into the head; -1
  /// if one looks the wrong way.
  [[nodiscard]] double angle_after_collapse(std::uint32_t corner) const {
    const std::uint32_t v = table_.vertex(corner), target = table_.head(corner);
    double smallest = 1.0;
    for_each_face_after_collapse(table_, corner, [&](std::uint32_t p, std::uint32_t q) {
      const Vec3 area = area_vector(at(target), at(p), at(q));
      const bool is_right = sides_.may_face(v, area) && sides_.may_face(target, area);
      smallest =
          std::min(smallest, is_right ? sine_of_smallest_angle(at(target), at(p), at(q)) : -1.0);
    });
    return smallest;
  }

  CornerTable& table_;
  std::vector<Vec3>& positions_;
  const std::vector<std::uint8_t>& is_feature_;
  const VertexSides& sides_;
  std::vector<std::uint8_t> may_relax_;  ///< 0 where nothing has changed since it was in vain
  std::vector<std::uint8_t> may_turn_;
};

}  // namespace

bool is_crease(const CornerTable& table, const std::vector<Vec3>& positions, std::uint32_t corner) {
  const std::uint32_t across = table.across(corner);
  return across == CornerTable::kNone ||
         !has_cosine(face_area_vector(table, positions, corner / 3),
                     face_area_vector(table, positions, across / 3), kFeatureCosine);
}

void relax_features(CornerTable& table, std::vector<Vec3>& positions,
                    const std::vector<std::uint8_t>& is_feature, const VertexSides& sides) {
  Relaxer(table, positions, is_feature, sides).run();
}

}  // namespace rangezip

#include "core/finish/feature_cleanup.h"

#include <algorithm>
#include <array>
#include <limits>
#include <optional>

#include "core/finish/edge_changes.h"
#include "core/finish/triangle_shape.h"

namespace rangezip {
namespace {

// Lengths are in h, angles as cosines, and smallest angles as sines.
constexpr int kRounds = 3;
constexpr int kSliverRounds = 4;
constexpr double kShortEdge = 0.5;
constexpr double kCollapseTurn = 0.3;  // faces beside a feature may tilt a lot
constexpr double kMinAngleAfterCollapse = 0.12;
constexpr double kMinAngleAfterFlip = 0.1;
constexpr double kNegligibleArea = 0.05;  // twice the area, in h^2: has no direction to keep
constexpr double kSliver = 0.2;
constexpr double kGain = 0.02;
constexpr double kNoArea = 0.01;
constexpr double kHasDirection = 0.1;
constexpr std::array kSliverTurns{0.8, 0.5};  // the second for what the first leaves
constexpr double kFoldedCosine = 0.8;         // of a face back over the one beyond it

class Cleaner {
 public:
  Cleaner(CornerTable& table, const std::vector<Vec3>& positions,
          const std::vector<std::uint8_t>& is_feature, double pixel_size, const ShareField& sizes,
          const std::vector<std::uint8_t>& is_kept)
      : table_(table),
        positions_(positions),
        is_feature_(is_feature),
        h_(pixel_size),
        sizes_(sizes),
        is_kept_(is_kept) {}

  FeatureCleanupReport run() {
    for (int i = 0; i < kRounds; ++i) {
      collapse_short_edges();
      join_features();
      remove_all_slivers();
    }
    return report_;
  }

  FeatureCleanupReport remove_all_slivers() {
    for (const double turn : kSliverTurns) {
      max_turn_ = turn;
      for (int i = 0; i < kSliverRounds; ++i) {
        if (!remove_slivers()) break;
      }
    }
    return report_;
  }

 private:
  [[nodiscard]] const Vec3& at(std::uint32_t vertex) const { return positions_[vertex]; }
  [[nodiscard]] bool is_kept(std::uint32_t v) const {
    return v < is_kept_.size() && is_kept_[v] != 0;
  }
  [[nodiscard]] bool may_change(std::uint32_t c) const {
    return !is_kept(table_.vertex(c)) && !is_kept(table_.head(c));
  }
  /// A feature vertex may only move along the feature, and a corner nowhere.
  [[nodiscard]] bool may_collapse(std::uint32_t c) const {
    const bool leaves = is_feature_[table_.vertex(c)] > is_feature_[table_.head(c)];
    return !leaves && may_change(c) && table_.is_collapse_ok(c);
  }

  void collapse_short_edges() {
    for (std::uint32_t c = 0; c < table_.corner_count(); ++c) {
      if (!table_.names_inner_edge(c)) continue;
      const Vec3 &from = at(table_.vertex(c)), edge = at(table_.head(c)) - from;
      const double limit = kShortEdge * h_ * sizes_.at(from);
      if (glm::dot(edge, edge) > limit * limit) continue;
      for (const std::uint32_t side : {c, table_.across(c)}) {
        if (!may_collapse(side) || !keeps_shape(side)) continue;
        table_.collapse(side);
        ++report_.collapsed_edges;
        break;
      }
    }
  }

  /// Moving the half-edge's vertex into its head neither turns a face that has a direction nor
  /// leaves it with a small angle.
  [[nodiscard]] bool keeps_shape(std::uint32_t corner) const {
    const Vec3 &from = at(table_.vertex(corner)), &to = at(table_.head(corner));
    const double negligible = kNegligibleArea * h_ * h_;
    bool ok = true;
    for_each_face_after_collapse(table_, corner, [&](std::uint32_t p, std::uint32_t q) {
      if (!ok) return;
      const Vec3 before = area_vector(from, at(p), at(q)), after = area_vector(to, at(p), at(q));
      ok = (has_cosine(before, after, kCollapseTurn) &&
            sine_of_smallest_angle(to, at(p), at(q)) >= kMinAngleAfterCollapse) ||
           glm::dot(before, before) <= negligible * negligible;
    });
    return ok;
  }

  void join_features() {
    for (std::uint32_t c = 0; c < table_.corner_count(); ++c) {
      if (!table_.names_inner_edge(c) || !may_change(c)) continue;
      const Diamond d(table_, c);
      if (is_feature_[d.x] == 0 || is_feature_[d.y] == 0) continue;
      if (is_feature_[d.a] != 0 && is_feature_[d.b] != 0) continue;
      if (angle_after_flip(positions_, d) < kMinAngleAfterFlip || !table_.is_flip_ok(c)) continue;
      table_.flip(c);
      ++report_.flipped_edges;
    }
  }

  /// @return whether anything was done
  bool remove_slivers() {
    bool any = false;
    for (std::uint32_t face = 0; face < table_.face_count(); ++face) {
      if (table_.is_deleted(face)) continue;
      const Triangle t = table_.triangle(face);
      const double angle = sine_of_smallest_angle(at(t[0]), at(t[1]), at(t[2]));
      if (angle < kSliver && remove_sliver(face, angle + kGain)) any = true;
    }
    return any;
  }

  bool remove_sliver(std::uint32_t face, double at_least) {
    double best = at_least;
    std::optional<std::uint32_t> collapse, flip;
    for (std::uint32_t c = 3 * face; c < 3 * face + 3; ++c) {
      if (table_.across(c) == CornerTable::kNone) continue;
      for (const std::uint32_t side : {c, table_.across(c)}) {
        if (!may_collapse(side)) continue;
        const double angle = angle_after_collapse(side);
        if (angle <= best) continue;
        best = angle;
        collapse = side;
      }
    }
    for (std::uint32_t c = 3 * face; c < 3 * face + 3; ++c) {
      const double angle = angle_after_turning(c);
      if (angle < best || !table_.is_flip_ok(c)) continue;
      best = angle;
      flip = c;
    }
    if (flip) {
      table_.flip(*flip);
      ++report_.flipped_edges;
    } else if (collapse) {
      table_.collapse(*collapse);
      ++report_.collapsed_edges;
    }
    return flip || collapse;
  }

  /// Whether the half-edge's vertex stands on three faces that fold over what is around them, like
  /// a fin: with it they may turn.
  [[nodiscard]] bool is_fin(std::uint32_t corner) const {
    const std::uint32_t v = table_.vertex(corner);
    if (table_.is_boundary(v)) return false;
    int faces = 0;
    bool folds = false;
    table_.for_each_corner(v, [&](std::uint32_t c) {
      ++faces;
      const std::uint32_t beyond = table_.across(CornerTable::next(c));
      if (beyond == CornerTable::kNone) return;
      const Vec3 inside = area_of(c / 3), outside = area_of(beyond / 3);
      folds =
          folds || (glm::dot(inside, outside) < 0.0 && has_cosine(inside, -outside, kFoldedCosine));
    });
    return faces == 3 && folds;
  }
  [[nodiscard]] Vec3 area_of(std::uint32_t face) const {
    const Triangle t = table_.triangle(face);
    return area_vector(at(t[0]), at(t[1]), at(t[2]));
  }

  /// The smallest angle around after the half-edge's vertex moved into its head; -1 if a face
  /// would turn or lose its area.
  [[nodiscard]] double angle_after_collapse(std::uint32_t corner) const {
    const bool may_turn = is_fin(corner);
    const Vec3 &from = at(table_.vertex(corner)), &to = at(table_.head(corner));
    double smallest = 1.0;
    for_each_face_after_collapse(table_, corner, [&](std::uint32_t p, std::uint32_t q) {
      if (smallest < 0.0) return;
      const double before = sine_of_smallest_angle(from, at(p), at(q));
      const double after = sine_of_smallest_angle(to, at(p), at(q));
      const bool turns =
          !may_turn && before > kHasDirection &&
          !has_cosine(area_vector(from, at(p), at(q)), area_vector(to, at(p), at(q)), max_turn_);
      smallest = turns || after <= kNoArea ? -1.0 : std::min(smallest, after);
    });
    return smallest;
  }

  /// Of both new faces; -1 if the edge is none to turn: they must look as the face beyond it does.
  [[nodiscard]] double angle_after_turning(std::uint32_t c) const {
    if (table_.across(c) == CornerTable::kNone || !may_change(c)) return -1.0;
    const Diamond d(table_, c);
    const DiamondAreas areas(positions_, d);
    const bool keeps_direction = has_cosine(areas.new_a, areas.old_y, max_turn_) &&
                                 has_cosine(areas.new_b, areas.old_y, max_turn_);
    return keeps_direction ? angle_after_flip(positions_, d) : -1.0;
  }

  CornerTable& table_;
  const std::vector<Vec3>& positions_;
  const std::vector<std::uint8_t>& is_feature_;
  double h_;
  const ShareField& sizes_;
  const std::vector<std::uint8_t>& is_kept_;
  double max_turn_ = kSliverTurns.front();  ///< cosine, of faces when slivers are removed
  FeatureCleanupReport report_;
};

}  // namespace

FeatureCleanupReport clean_features(CornerTable& table, const std::vector<Vec3>& positions,
                                    const std::vector<std::uint8_t>& is_feature, double pixel_size,
                                    const ShareField& sizes,
                                    const std::vector<std::uint8_t>& is_kept) {
  return Cleaner(table, positions, is_feature, pixel_size, sizes, is_kept).run();
}

FeatureCleanupReport remove_slivers(CornerTable& table, const std::vector<Vec3>& positions) {
  const std::vector<std::uint8_t> is_feature(positions.size(), 0);
  return Cleaner(table, positions, is_feature, 0.0, {}, {}).remove_all_slivers();
}

}  // namespace rangezip

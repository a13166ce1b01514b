#include "core/finish/extend_border.h"

#include <algorithm>
#include <array>
#include <bit>
#include <cmath>
#include <cstdint>
#include <map>
#include <set>
#include <utility>
#include <vector>

#include "core/finish/border_gaps.h"
#include "core/finish/border_step.h"
#include "core/finish/clean_topology.h"
#include "core/finish/components.h"
#include "core/finish/corner_table.h"
#include "core/finish/face_grid.h"
#include "core/finish/gap_memo.h"
#include "core/mesh/self_intersection.h"

namespace rangezip {
namespace {

constexpr double kReach = 1.0;        ///< in h: points farther from the border do not count
constexpr double kNegligible = 1e-3;  ///< in h, beyond the border
constexpr double kNeedle = 0.01;      ///< sine of a smallest angle: half a degree
/// Of a step's quality, for each halving of its way: full ways are tried first.
constexpr double kHalvingCost = 0.5;
/// The same for each move of the vertex before: a vertex must not go to and fro between points.
constexpr double kMoveCost = 0.5;
constexpr std::uint32_t kMaxMoves = 6;
/// Times as many border edges as there were: a border that moves out to where the cloud ends grows
/// little; one that feathers follows points of which no scan has an image.
constexpr std::size_t kMaxGrowth = 3;
constexpr int kMaxRings = 4;     ///< around a face that is cut away
constexpr int kMaxFailures = 3;  ///< of steps at an edge before its face is cut away
constexpr std::uint32_t kNone = CornerTable::kNone;

bool is_move(BorderStepKind kind) {
  return kind == BorderStepKind::move_start || kind == BorderStepKind::move_end;
}
bool is_notch(BorderStepKind kind) {
  return kind == BorderStepKind::notch_start || kind == BorderStepKind::notch_end;
}

Triangle sorted(Triangle t) {
  std::sort(t.begin(), t.end());
  return t;
}

/// Steps of a border edge that failed while its farthest point was this one, as bits.
struct Failures {
  Vec3 point{0.0};
  std::uint32_t bits = 0;
};

std::uint32_t bit_of(const BorderStep& step) {
  return 1U << (3U * static_cast<std::uint32_t>(step.kind) +
                static_cast<std::uint32_t>(step.halvings));
}

std::array<double, 3> key_of(const Vec3& point) {
  return {point.x, point.y, point.z};
}

std::size_t count_border_edges(const CornerTable& table) {
  std::size_t count = 0;
  for (std::uint32_t c = 0; c < table.corner_count(); ++c)
    count += table.across(c) == kNone ? 1 : 0;
  return count;
}

class Extender {
 public:
  Extender(TriangleMesh& mesh, const PointGrid& cloud, const ExtendBorderOptions& options,
           const Progress& progress)
      : mesh_(mesh),
        h_(options.pixel_size),
        reach_(kReach * options.pixel_size),
        smallest_angle_(options.smallest_angle),
        min_component_(options.min_component),
        gaps_(cloud, {reach_, kNegligible * h_}),
        progress_(progress) {}

  /// @return whether anything changed
  bool round(ExtendBorderReport& report) {
    const CornerTable table(mesh_.triangles, mesh_.positions.size());
    const std::size_t border_edges = count_border_edges(table);
    if (border_edges == 0) return false;
    if (first_border_edges_ == 0) first_border_edges_ = border_edges;
    if (border_edges > kMaxGrowth * first_border_edges_) return false;
    const FaceGrid faces(mesh_, table, reach_);
    std::vector<BorderGap> gaps = gaps_.find(mesh_, table, faces);
    report.edges_left = gaps.size();
    std::stable_sort(gaps.begin(), gaps.end(),
                     [](const BorderGap& p, const BorderGap& q) { return p.beyond > q.beyond; });
    moves_.resize(mesh_.positions.size(), 0);
    std::vector<BorderStep> steps = choose(gaps, table);
    if (steps.empty()) return false;
    const auto cuts = std::stable_partition(steps.begin(), steps.end(), [](const BorderStep& s) {
      return s.kind != BorderStepKind::cut;
    });
    std::vector<BorderStep> changes(steps.begin(), cuts);
    report.reverted_steps += apply_without_crossings(changes, table);
    for (const BorderStep& step : changes) {
      if (is_move(step.kind)) ++moves_[step.vertices.front()];
    }
    take_away({cuts, steps.end()}, report.dropped);
    report.steps += changes.size() + static_cast<std::size_t>(steps.end() - cuts);
    return true;
  }

 private:
  using EdgeKey = std::pair<std::uint32_t, std::uint32_t>;

  /// At most one step for each gap; no two share a vertex.
  std::vector<BorderStep> choose(const std::vector<BorderGap>& gaps, const CornerTable& table) {
    std::vector<BorderStep> steps;
    std::vector<std::uint8_t> is_busy(mesh_.positions.size(), 0);
    for (const BorderGap& gap : gaps) {
      progress_.check_stop();
      BorderStep step = best_step(gap, table);
      const auto& vertices = step.vertices;
      if (vertices.empty() || std::any_of(vertices.begin(), vertices.end(),
                                          [&](std::uint32_t v) { return is_busy[v] != 0; })) {
        continue;
      }
      for (const std::uint32_t v : vertices)
        is_busy[v] = 1;
      steps.push_back(std::move(step));
    }
    return steps;
  }

  /// Without vertices if there is none.
  BorderStep best_step(const BorderGap& gap, const CornerTable& table) {
    Failures& failures = failures_[{table.vertex(gap.corner), table.head(gap.corner)}];
    if (failures.point != gap.point) failures = {gap.point, 0};
    if (std::popcount(failures.bits) >= kMaxFailures) return cut(gap, table);
    BorderStep best;
    double best_value = kNeedle;
    for (BorderStep& step : steps_towards(gap, mesh_, table, h_)) {
      if ((failures.bits & bit_of(step)) != 0 || step.quality < smallest_angle_) continue;
      const double value = value_of(step, table);
      if (value <= best_value) continue;
      best_value = value;
      best = std::move(step);
    }
    return best.vertices.empty() ? cut(gap, table) : best;
  }

  /// Wider each time that the same point is in the way.
  [[nodiscard]] BorderStep cut(const BorderGap& gap, const CornerTable& table) const {
    const auto cuts = cuts_.find(key_of(gap.point));
    const int rings = cuts == cuts_.end() ? 0 : cuts->second;
    if (rings > kMaxRings) return {};
    BorderStep step = cut_at(gap.corner, table, rings);
    step.target = gap.point;
    return step;
  }

  [[nodiscard]] double value_of(const BorderStep& step, const CornerTable& table) const {
    double value = step.quality;
    for (int i = 0; i < step.halvings; ++i)
      value *= kHalvingCost;
    if (is_move(step.kind)) {
      const std::uint32_t moves = moves_[step.vertices.front()];
      if (moves >= kMaxMoves) return 0.0;
      for (std::uint32_t i = 0; i < moves; ++i)
        value *= kMoveCost;
    }
    // What was cut away does not come back.
    if (is_notch(step.kind) &&
        cut_.contains(
            sorted({step.vertices.front(), table.vertex(step.corner), table.head(step.corner)}))) {
      return 0.0;
    }
    return value;
  }

  /// Steps whose faces cross others fail, until none is left: a face that stays after all may be
  /// crossed by one of another step.
  /// @return how many failed
  std::size_t apply_without_crossings(std::vector<BorderStep>& steps, const CornerTable& table) {
    const std::size_t wanted = steps.size();
    for (;;) {
      const std::vector<Change> changes = apply(steps, table);
      const std::vector<std::uint8_t> fails = crossing(changes);
      if (std::find(fails.begin(), fails.end(), 1) == fails.end()) return wanted - steps.size();
      undo(changes, steps, table);
      std::size_t kept = 0;
      for (std::size_t s = 0; s < steps.size(); ++s) {
        if (fails[s] != 0) {
          failures_[{table.vertex(steps[s].corner), table.head(steps[s].corner)}].bits |=
              bit_of(steps[s]);
        } else if (kept++ != s) {
          steps[kept - 1] = std::move(steps[s]);
        }
      }
      steps.resize(kept);
    }
  }

  /// What a step changed, and how it was before.
  struct Change {
    std::vector<std::uint32_t> faces;
    Triangle face_before{};
    Vec3 place_before{0.0};
  };

  std::vector<Change> apply(const std::vector<BorderStep>& steps, const CornerTable& table) {
    std::vector<Change> changes;
    for (const BorderStep& step : steps) {
      Change change;
      change.face_before = mesh_.triangles[step.corner / 3];
      change.place_before = mesh_.positions[step.vertices.front()];
      change.faces = apply_step(step, table, mesh_);
      changes.push_back(std::move(change));
    }
    return changes;
  }

  void undo(const std::vector<Change>& changes, const std::vector<BorderStep>& steps,
            const CornerTable& table) {
    for (std::size_t s = 0; s < steps.size(); ++s) {
      mesh_.triangles[steps[s].corner / 3] = changes[s].face_before;
      mesh_.positions[steps[s].vertices.front()] = changes[s].place_before;
    }
    mesh_.triangles.resize(table.face_count());
    mesh_.positions.resize(table.vertex_count());
    if (!mesh_.sources.empty()) mesh_.sources.resize(table.vertex_count());
  }

  [[nodiscard]] std::vector<std::uint8_t> crossing(const std::vector<Change>& changes) const {
    std::vector<std::uint32_t> change_of(mesh_.triangles.size(), kNone);
    std::vector<std::uint32_t> changed;
    for (std::uint32_t s = 0; s < changes.size(); ++s) {
      for (const std::uint32_t f : changes[s].faces) {
        change_of[f] = s;
        changed.push_back(f);
      }
    }
    std::vector<std::uint8_t> fails(changes.size(), 0);
    for (const auto& [i, j] : self_intersections(mesh_, changed, {}, progress_)) {
      for (const std::uint32_t f : {i, j}) {
        if (change_of[f] != kNone) fails[change_of[f]] = 1;
      }
    }
    return fails;
  }

  void take_away(const std::vector<BorderStep>& cuts, DroppedComponents& sum) {
    if (cuts.empty()) return;
    std::vector<std::uint8_t> goes(mesh_.triangles.size(), 0);
    for (const BorderStep& step : cuts) {
      ++cuts_[key_of(step.target)];
      for (const std::uint32_t f : step.faces) {
        goes[f] = 1;
        cut_.insert(sorted(mesh_.triangles[f]));
      }
    }
    remove_triangles(mesh_.triangles, goes);
    clean_topology(mesh_);
    const CornerTable table(mesh_.triangles, mesh_.positions.size());
    const DroppedComponents dropped =
        drop_small_components(mesh_, table, components_of(table), {min_component_, h_});
    sum.components += dropped.components;
    sum.faces += dropped.faces;
  }

  TriangleMesh& mesh_;
  double h_;
  double reach_;
  double smallest_angle_;
  std::size_t min_component_;
  GapMemo gaps_;
  std::size_t first_border_edges_ = 0;
  std::vector<std::uint32_t> moves_;  // of each vertex so far
  std::map<EdgeKey, Failures> failures_;
  std::map<std::array<double, 3>, int> cuts_;  // so far, for a point
  std::set<Triangle> cut_;                     // corners rising
  const Progress& progress_;
};

}  // namespace

ExtendBorderReport extend_border(TriangleMesh& mesh, const PointGrid& cloud,
                                 const ExtendBorderOptions& options, const Progress& progress) {
  ExtendBorderReport report;
  if (cloud.empty()) return report;
  Extender extender(mesh, cloud, options, progress);
  for (int round = 0; round < options.max_rounds; ++round) {
    progress.check_stop();
    if (!extender.round(report)) break;
  }
  return report;
}

}  // namespace rangezip

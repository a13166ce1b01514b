#include "core/finish/border_step.h"

#include <algorithm>
#include <cmath>

#include "core/finish/triangle_shape.h"

namespace rangezip {
namespace {

/// In h: points higher over the plane of the edge's face, and higher than beyond, are passed under.
constexpr double kMaxLift = 0.3;
constexpr double kMaxTurn = 0.34;  ///< cosine: 70 degrees between a face before and after
constexpr double kMaxNotch = 3.0;  ///< in h, between the outer ends of its two edges
constexpr int kMaxHalvings = 2;

bool is_turn_small(const Vec3& from, const Vec3& to) {
  return has_cosine(from, to, kMaxTurn);
}

class Judge {
 public:
  Judge(const BorderGap& gap, const TriangleMesh& mesh, const CornerTable& table, double h)
      : gap_(gap),
        mesh_(mesh),
        table_(table),
        h_(h),
        a_(table.vertex(gap.corner)),
        b_(table.head(gap.corner)),
        c_(table.apex(gap.corner)),
        goal_(std::abs(gap.height) > std::max(kMaxLift * h, gap.beyond)
                  ? gap.point - gap.height * gap.normal
                  : gap.point) {}

  std::vector<BorderStep> run() {
    for (int halvings = 0; halvings <= kMaxHalvings; ++halvings) {
      const Vec3 foot = at(a_) + gap_.share * (at(b_) - at(a_));
      judge_split(start(BorderStepKind::split, foot, halvings));
      judge_ear(start(BorderStepKind::ear, foot, halvings));
      judge_move(start(BorderStepKind::move_start, at(a_), halvings), a_);
      judge_move(start(BorderStepKind::move_end, at(b_), halvings), b_);
    }
    judge_notch(start(BorderStepKind::notch_start, at(a_), 0));
    judge_notch(start(BorderStepKind::notch_end, at(b_), 0));
    std::erase_if(steps_, [](const BorderStep& step) { return !(step.quality > 0.0); });
    std::stable_sort(steps_.begin(), steps_.end(),
                     [](const auto& p, const auto& q) { return p.kind < q.kind; });
    return std::move(steps_);
  }

 private:
  [[nodiscard]] const Vec3& at(std::uint32_t vertex) const { return mesh_.positions[vertex]; }

  [[nodiscard]] BorderStep start(BorderStepKind kind, const Vec3& from, int halvings) const {
    const double share = 1.0 / static_cast<double>(1 << halvings);
    return {kind, halvings, gap_.corner, from + share * (goal_ - from), 0.0, {}, {}};
  }

  void judge_split(BorderStep step) {
    step.vertices = {a_, b_, c_};
    if (!is_turn_small(gap_.normal, area_vector(at(a_), step.target, at(c_))) ||
        !is_turn_small(gap_.normal, area_vector(step.target, at(b_), at(c_)))) {
      return;
    }
    step.quality = std::min(sine_of_smallest_angle(at(a_), step.target, at(c_)),
                            sine_of_smallest_angle(step.target, at(b_), at(c_)));
    steps_.push_back(std::move(step));
  }

  /// Of a face between the edge and a place.
  [[nodiscard]] double quality_beyond(const Vec3& place) const {
    return is_turn_small(gap_.normal, area_vector(at(b_), at(a_), place))
               ? sine_of_smallest_angle(at(a_), at(b_), place)
               : 0.0;
  }

  void judge_ear(BorderStep step) {
    step.vertices = {a_, b_};
    step.quality = quality_beyond(step.target);
    steps_.push_back(std::move(step));
  }

  void judge_move(BorderStep step, std::uint32_t v) {
    step.vertices = {v};
    step.quality = 1.0;
    table_.for_each_corner(v, [&](std::uint32_t c) {
      const std::uint32_t p = table_.head(c), q = table_.apex(c);
      step.vertices.insert(step.vertices.end(), {p, q});
      const bool is_small =
          is_turn_small(area_vector(at(v), at(p), at(q)), area_vector(step.target, at(p), at(q)));
      step.quality = is_small
                         ? std::min(step.quality, sine_of_smallest_angle(step.target, at(p), at(q)))
                         : 0.0;
    });
    steps_.push_back(std::move(step));
  }

  void judge_notch(BorderStep step) {
    const bool is_start = step.kind == BorderStepKind::notch_start;
    const std::uint32_t other =
        is_start ? border_before(table_, gap_.corner) : border_after(table_, gap_.corner);
    const std::uint32_t tip = is_start ? table_.vertex(other) : table_.head(other);
    const std::uint32_t far_end = is_start ? b_ : a_;
    if (tip == far_end || table_.are_neighbors(tip, far_end)) return;
    if (glm::length(at(tip) - at(far_end)) > kMaxNotch * h_) return;
    const Vec3 beside =
        area_vector(at(table_.vertex(other)), at(table_.head(other)), at(table_.apex(other)));
    if (!is_turn_small(beside, area_vector(at(b_), at(a_), at(tip)))) return;
    step.vertices = {tip, a_, b_};
    step.quality = quality_beyond(at(tip));
    steps_.push_back(std::move(step));
  }

  const BorderGap& gap_;
  const TriangleMesh& mesh_;
  const CornerTable& table_;
  double h_;
  std::uint32_t a_, b_, c_;  // start and end of the edge, and its face's third vertex
  Vec3 goal_;
  std::vector<BorderStep> steps_;
};

bool contains(const std::vector<std::uint32_t>& values, std::uint32_t value) {
  return std::find(values.begin(), values.end(), value) != values.end();
}

/// A face and those within some rings of neighbours that share a corner.
std::vector<std::uint32_t> faces_around(std::uint32_t face, const CornerTable& table, int rings) {
  std::vector<std::uint32_t> faces{face};
  for (std::size_t begin = 0; rings > 0; --rings) {
    const std::size_t end = faces.size();
    for (; begin < end; ++begin) {
      for (const std::uint32_t v : table.triangle(faces[begin])) {
        table.for_each_corner(v, [&](std::uint32_t c) {
          if (!contains(faces, c / 3)) faces.push_back(c / 3);
        });
      }
    }
  }
  return faces;
}

}  // namespace

std::vector<BorderStep> steps_towards(const BorderGap& gap, const TriangleMesh& mesh,
                                      const CornerTable& table, double pixel_size) {
  return Judge(gap, mesh, table, pixel_size).run();
}

BorderStep cut_at(std::uint32_t corner, const CornerTable& table, int rings) {
  BorderStep step;
  step.corner = corner;
  step.faces = faces_around(corner / 3, table, rings);
  for (const std::uint32_t f : step.faces) {
    for (const std::uint32_t v : table.triangle(f)) {
      if (!contains(step.vertices, v)) step.vertices.push_back(v);
    }
  }
  return step;
}

std::vector<std::uint32_t> apply_step(const BorderStep& step, const CornerTable& table,
                                      TriangleMesh& mesh) {
  const std::uint32_t a = table.vertex(step.corner), b = table.head(step.corner),
                      c = table.apex(step.corner), face = step.corner / 3;
  const auto new_face = static_cast<std::uint32_t>(mesh.triangles.size());
  const auto new_vertex = static_cast<std::uint32_t>(mesh.positions.size());
  const auto add_vertex = [&] {
    mesh.positions.push_back(step.target);
    if (!mesh.sources.empty()) mesh.sources.emplace_back();
  };
  switch (step.kind) {
    case BorderStepKind::split:
      add_vertex();
      mesh.triangles[face] = {a, new_vertex, c};
      mesh.triangles.push_back({new_vertex, b, c});
      return {face, new_face};
    case BorderStepKind::ear:
      add_vertex();
      mesh.triangles.push_back({b, a, new_vertex});
      return {new_face};
    case BorderStepKind::notch_start:
    case BorderStepKind::notch_end:
      mesh.triangles.push_back({b, a, step.vertices.front()});
      return {new_face};
    case BorderStepKind::move_start:
    case BorderStepKind::move_end: {
      const std::uint32_t v = step.vertices.front();
      mesh.positions[v] = step.target;
      std::vector<std::uint32_t> faces;
      table.for_each_corner(v, [&](std::uint32_t k) { faces.push_back(k / 3); });
      return faces;
    }
    case BorderStepKind::cut:
      break;
  }
  return {};
}

}  // namespace rangezip

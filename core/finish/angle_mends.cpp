#include "core/finish/angle_mends.h"

#include <algorithm>
#include <array>
#include <optional>
#include <utility>

#include "core/finish/border_gaps.h"
#include "core/finish/edge_changes.h"
#include "core/finish/triangle_shape.h"

namespace rangezip {
namespace {

// Smallest angles are sines.
constexpr double kGain = 0.02;
/// Faces with a smaller angle have no direction of their own; those around them tell it, roughly.
constexpr double kHasDirection = 0.1;
constexpr double kRoughTurn = 0.3;
/// Of the way to a neighbour or across a face.
constexpr std::array kSteps{0.1, 0.2, 0.35, 0.5};
constexpr std::uint32_t kNone = CornerTable::kNone;

class Mender {
 public:
  Mender(std::uint32_t face, const std::vector<Vec3>& positions, const CornerTable& table,
         const AngleMendOptions& options)
      : face_(face), positions_(positions), table_(table), options_(options) {}

  std::vector<AngleMend> run() {
    for (const std::uint32_t c : corners())
      turn(c);
    for (const std::uint32_t c : corners())
      collapse(c);
    for (const double step : kSteps) {
      for (const std::uint32_t c : corners())
        move(table_.vertex(c), step);
    }
    for (const std::uint32_t c : corners())
      turn_onto_edge(c);
    for (const std::uint32_t c : corners())
      take_off_border(c);
    std::stable_sort(mends_.begin(), mends_.end(),
                     [](const AngleMend& p, const AngleMend& q) { return p.gain > q.gain; });
    return std::move(mends_);
  }

 private:
  [[nodiscard]] std::array<std::uint32_t, 3> corners() const {
    return {3 * face_, 3 * face_ + 1, 3 * face_ + 2};
  }
  [[nodiscard]] const Vec3& at(std::uint32_t vertex) const { return positions_[vertex]; }
  [[nodiscard]] bool is_border(std::uint32_t corner) const {
    return table_.across(corner) == kNone;
  }
  [[nodiscard]] double angle_of(const Triangle& t) const {
    return sine_of_smallest_angle(at(t[0]), at(t[1]), at(t[2]));
  }
  [[nodiscard]] double lack_of(double angle) const {
    return std::max(options_.enough - angle, 0.0);
  }
  [[nodiscard]] Vec3 area_of(const Triangle& t) const {
    return area_vector(at(t[0]), at(t[1]), at(t[2]));
  }

  /// A mend in the making: with the directions that its faces should keep.
  struct Draft {
    AngleMend mend;
    std::vector<Vec3> directions;  // of mend.faces: zero if unknown
    Vec3 around{0.0};              // of all faces that go

    [[nodiscard]] bool replaces(std::uint32_t face) const {
      return std::find(mend.gone.begin(), mend.gone.end(), face) != mend.gone.end();
    }
  };

  void drop(Draft& draft, std::uint32_t face) const {
    draft.mend.gone.push_back(face);
    draft.around += area_of(table_.triangle(face));
  }
  void add(Draft& draft, const Triangle& face, const Triangle& like) const {
    draft.mend.faces.push_back(face);
    draft.directions.push_back(angle_of(like) > kHasDirection ? area_of(like) : Vec3(0.0));
  }
  /// All faces around a vertex that the draft does not replace yet, one vertex for another.
  void redo_around(Draft& draft, std::uint32_t vertex, std::uint32_t from, std::uint32_t to) const {
    table_.for_each_corner(vertex, [&](std::uint32_t c) {
      if (draft.replaces(c / 3)) return;
      const Triangle before = table_.triangle(c / 3);
      Triangle after = before;
      std::replace(after.begin(), after.end(), from, to);
      drop(draft, c / 3);
      add(draft, after, before);
    });
  }

  /// Keeps the draft if its faces are better than those that go, and look where those looked.
  void judge(Draft draft) {
    AngleMend& mend = draft.mend;
    double smallest_before = 1.0, smallest = 1.0;
    for (const std::uint32_t f : mend.gone) {
      const double angle = angle_of(table_.triangle(f));
      smallest_before = std::min(smallest_before, angle);
      mend.gain += lack_of(angle);
    }
    const auto place_of = [&](std::uint32_t v) { return v == mend.vertex ? mend.place : at(v); };
    for (std::size_t i = 0; i < mend.faces.size(); ++i) {
      const auto& [p, q, r] = mend.faces[i];
      const Vec3 a = place_of(p), b = place_of(q), c = place_of(r);
      const double angle = sine_of_smallest_angle(a, b, c);
      smallest = std::min(smallest, angle);
      mend.gain -= lack_of(angle);
      const bool is_known = draft.directions[i] != Vec3(0.0);
      const Vec3& direction = is_known ? draft.directions[i] : draft.around;
      const double turn = is_known ? options_.max_turn : kRoughTurn;
      if (!has_cosine(direction, area_vector(a, b, c), turn)) return;
    }
    if (mend.gain > kGain && smallest >= smallest_before) mends_.push_back(std::move(mend));
  }

  /// Both faces of a turned edge should look as the one beyond it did.
  [[nodiscard]] std::optional<Draft> turned(std::uint32_t corner) const {
    if (is_border(corner) || !table_.is_flip_ok(corner)) return std::nullopt;
    Draft draft;
    const Diamond d(table_, corner);
    const Triangle beyond = table_.triangle(table_.across(corner) / 3);
    drop(draft, face_);
    drop(draft, table_.across(corner) / 3);
    add(draft, {d.a, d.y, d.x}, beyond);
    add(draft, {d.b, d.x, d.y}, beyond);
    return draft;
  }
  void turn(std::uint32_t corner) {
    if (std::optional<Draft> draft = turned(corner)) judge(std::move(*draft));
  }
  void turn_onto_edge(std::uint32_t corner) {
    const std::uint32_t apex = table_.apex(corner);
    if (table_.is_boundary(apex)) return;
    std::optional<Draft> draft = turned(corner);
    if (!draft) return;
    move_to(*draft, apex, foot_on(corner, at(apex)));
    judge(std::move(*draft));
  }

  [[nodiscard]] Vec3 foot_on(std::uint32_t corner, const Vec3& place) const {
    const Vec3 &a = at(table_.vertex(corner)), edge = at(table_.head(corner)) - a;
    const double square = glm::dot(edge, edge);
    return square > 0.0 ? a + std::clamp(glm::dot(place - a, edge) / square, 0.0, 1.0) * edge : a;
  }

  void move_to(Draft& draft, std::uint32_t vertex, const Vec3& place) const {
    draft.mend.vertex = vertex;
    draft.mend.place = place;
    redo_around(draft, vertex, vertex, vertex);
  }

  /// Into either end and halfway between.
  void collapse(std::uint32_t corner) {
    const Vec3 middle = 0.5 * (at(table_.vertex(corner)) + at(table_.head(corner)));
    if (is_border(corner)) {
      collapse_border(corner, middle);
      return;
    }
    for (const std::uint32_t side : {corner, table_.across(corner)}) {
      if (table_.is_collapse_ok(side)) collapse_to(side, at(table_.head(side)));
    }
    const bool is_inside =
        !table_.is_boundary(table_.vertex(corner)) && !table_.is_boundary(table_.head(corner));
    if (is_inside && table_.is_collapse_ok(corner)) collapse_to(corner, middle);
  }
  void collapse_border(std::uint32_t corner, const Vec3& middle) {
    if (!table_.is_boundary_collapse_ok(corner)) return;
    const Vec3 &start = at(table_.vertex(corner)), &end = at(table_.head(corner));
    if (glm::length(end - start) > options_.max_border_way) return;
    if (const std::optional<Vec3> outer = outer_place(corner)) collapse_to(corner, *outer);
    for (const Vec3& place : {end, start, middle})
      collapse_to(corner, place);
  }
  void collapse_to(std::uint32_t corner, const Vec3& place) {
    const std::uint32_t u = table_.vertex(corner), w = table_.head(corner);
    Draft draft;
    drop(draft, corner / 3);
    if (!is_border(corner)) drop(draft, table_.across(corner) / 3);
    redo_around(draft, u, u, w);
    if (place != at(w)) move_to(draft, w, place);
    judge(std::move(draft));
  }

  /// Where the border's edges before and after a border edge, drawn on, come nearest to each other.
  [[nodiscard]] std::optional<Vec3> outer_place(std::uint32_t corner) const {
    const std::uint32_t before = border_before(table_, corner),
                        after = border_after(table_, corner);
    const Vec3 &a = at(table_.vertex(corner)), &b = at(table_.head(corner));
    const Vec3 u = a - at(table_.vertex(before)), v = b - at(table_.head(after)), w = a - b;
    const double uu = glm::dot(u, u), uv = glm::dot(u, v), vv = glm::dot(v, v);
    const double uw = glm::dot(u, w), vw = glm::dot(v, w), determinant = uu * vv - uv * uv;
    if (!(determinant > 0.0)) return std::nullopt;
    const double s = (uv * vw - vv * uw) / determinant, t = (uu * vw - uv * uw) / determinant;
    if (s < 0.0 || t < 0.0) return std::nullopt;
    const Vec3 place = 0.5 * (a + s * u + b + t * v);
    const double way = std::max(glm::length(place - a), glm::length(place - b));
    return way <= options_.max_border_way ? std::optional(place) : std::nullopt;
  }
  /// On the faces around it, towards its neighbours and the middles of the edges between them; at
  /// the border also outward, and away from neighbours.
  void move(std::uint32_t vertex, double step) {
    const Vec3& from = at(vertex);
    const bool is_at_border = table_.is_boundary(vertex);
    if (is_at_border) move_vertex(vertex, step * outward_at(vertex));
    table_.for_each_neighbor(vertex, [&](std::uint32_t v) {
      move_vertex(vertex, step * (at(v) - from));
      if (is_at_border) move_vertex(vertex, step * (from - at(v)));
    });
    table_.for_each_corner(vertex, [&](std::uint32_t c) {
      const Vec3 middle = 0.5 * (at(table_.head(c)) + at(table_.apex(c)));
      move_vertex(vertex, step * (middle - from));
    });
  }
  /// As long as the border's edges there are on average.
  [[nodiscard]] Vec3 outward_at(std::uint32_t vertex) const {
    const std::uint32_t first = table_.corner_of(vertex), last = border_before(table_, first);
    Vec3 normal{0.0};
    table_.for_each_corner(vertex,
                           [&](std::uint32_t c) { normal += area_of(table_.triangle(c / 3)); });
    const double length = glm::length(normal);
    if (!(length > 0.0)) return Vec3(0.0);
    return 0.5 * glm::cross(at(table_.head(first)) - at(table_.vertex(last)), normal / length);
  }
  void move_vertex(std::uint32_t vertex, const Vec3& way) {
    const double length = glm::length(way);
    const bool is_too_far = table_.is_boundary(vertex) && length > options_.max_border_way;
    Draft draft;
    move_to(draft, vertex,
            at(vertex) + (is_too_far ? options_.max_border_way / length : 1.0) * way);
    judge(std::move(draft));
  }

  void take_off_border(std::uint32_t corner) {
    if (!is_border(corner)) return;
    const std::uint32_t apex = table_.apex(corner);
    const bool is_ear =
        is_border(CornerTable::next(corner)) && !is_border(CornerTable::previous(corner));
    Draft draft;
    drop(draft, face_);
    if (is_ear) {
      // Nothing comes for it; what is beyond tells how good the place looks then.
      redo_around_face_beyond(draft, CornerTable::previous(corner));
      judge(std::move(draft));
    } else if (!table_.is_boundary(apex)) {
      const Vec3 foot = foot_on(corner, at(apex));
      if (glm::length(foot - at(apex)) > options_.max_border_way) return;
      Draft moved = draft;
      move_to(moved, apex, foot);
      judge(std::move(moved));
      redo_around(draft, apex, apex, apex);
      judge(std::move(draft));
    }
  }
  void redo_around_face_beyond(Draft& draft, std::uint32_t corner) const {
    const std::uint32_t beyond = table_.across(corner) / 3;
    drop(draft, beyond);
    add(draft, table_.triangle(beyond), table_.triangle(beyond));
  }

  std::uint32_t face_;
  const std::vector<Vec3>& positions_;
  const CornerTable& table_;
  AngleMendOptions options_;
  std::vector<AngleMend> mends_;
};

}  // namespace

std::vector<AngleMend> angle_mends(std::uint32_t face, const std::vector<Vec3>& positions,
                                   const CornerTable& table, const AngleMendOptions& options) {
  return Mender(face, positions, table, options).run();
}

}  // namespace rangezip

#include "core/finish/split_features.h"

#include <algorithm>
#include <cmath>
#include <optional>
#include <utility>
#include <vector>

namespace rangezip {
namespace {

constexpr double kSplitReach = 0.7;   // of an edge: it crosses a right angle so near its middle
constexpr double kFarthest = 3.0;     // in h: so near any other
constexpr double kCornerReach = 1.4;  // of the way from the middle of a face to a vertex
constexpr double kTaken = 0.35;       // in h: no vertex comes so near to one on a feature

class Splitter {
 public:
  Splitter(FeatureMesh& mesh, const FeatureCloud& cloud) : mesh_(mesh), cloud_(cloud) {}

  bool split_crossing(std::uint32_t corner) {
    const CornerTable& table = mesh_.table;
    const std::uint32_t a = table.vertex(corner), b = table.head(corner);
    if (mesh_.is_feature[a] != 0 || mesh_.is_feature[b] != 0) return false;
    if (!mesh_.surfaces[a].is_clean || !mesh_.surfaces[b].is_clean) return false;
    const Vec3 middle = 0.5 * (at(a) + at(b));
    const Surroundings around = cloud_.surroundings(
        middle,
        {seen_from(middle, mesh_.surfaces[a], 1.0), seen_from(middle, mesh_.surfaces[b], 1.0)});
    if (is_one_side(around.sides[0], around.sides[1])) return false;
    const std::optional<Vec3> place = meeting_place(around.sides);
    if (!place || glm::length(*place) > reach_across(around, glm::distance(at(a), at(b))))
      return false;
    if (!residual2_of_sides(around, *place, {0, 1})) return false;
    const Vec3 crossing = middle + *place;
    const std::uint32_t x = table.apex(corner), y = table.apex(table.across(corner));
    if (is_taken(x, crossing, 1) || is_taken(y, crossing, 1)) return false;
    mesh_.split(corner, crossing, {middle, around.sides}, 1);
    return true;
  }

  bool split_corner(std::uint32_t face) {
    const Triangle t = mesh_.table.triangle(face);
    if (std::any_of(t.begin(), t.end(), [&](std::uint32_t v) { return mesh_.is_feature[v] != 1; }))
      return false;
    const std::uint32_t longest = longest_edge(face);
    const std::optional<Vec3> corner = corner_over(t);
    if (!corner || has_corner(t, *corner)) return false;
    if (mesh_.table.across(longest) == CornerTable::kNone) return false;
    mesh_.split(longest, *corner, {*corner, {}}, 2);
    return true;
  }

 private:
  [[nodiscard]] const Vec3& at(std::uint32_t vertex) const { return mesh_.positions[vertex]; }

  /// How far from the middle of an edge between two sides these may meet: the sharper they do, the
  /// farther, as the tip of a wedge from a line across it.
  [[nodiscard]] double reach_across(const Surroundings& around, double edge) const {
    const double cosine =
        glm::dot(unit_or_z(around.sides[0].height.slope), unit_or_z(around.sides[1].height.slope));
    const double sharper = std::sqrt((1.0 - cosine) / std::max(1.0 + cosine, 1e-6));
    return std::min(kSplitReach * edge * std::max(1.0, sharper),
                    std::max(kSplitReach * edge, kFarthest * around.pixel_size));
  }

  /// Whether a vertex on an edge of a feature (1) or at a corner (2), at least, is next to a place.
  [[nodiscard]] bool is_taken(std::uint32_t vertex, const Vec3& place, std::uint8_t least) const {
    return mesh_.is_feature[vertex] >= least &&
           glm::distance(at(vertex), place) < kTaken * cloud_.h_at(place);
  }

  /// Where the sides meet that meet in pairs at the vertices of a face.
  [[nodiscard]] std::optional<Vec3> corner_over(const Triangle& t) const {
    const Vec3 middle = (at(t[0]) + at(t[1]) + at(t[2])) / 3.0;
    std::vector<FeatureSide> sides;
    double reach = 0.0;
    for (const std::uint32_t v : t) {
      const Feature& feature = mesh_.features[v];
      for (const FeatureSide& side : feature.sides)
        sides.push_back({side.height.seen_from(middle - feature.origin), 1.0});
      reach = std::max(reach, kCornerReach * glm::distance(at(v), middle));
    }
    const Surroundings around =
        cloud_.surroundings(middle, sides_of(std::move(sides), cloud_.step_at(middle)));
    if (around.sides.size() != 3) return std::nullopt;
    for (std::size_t i = 0; i < 3; ++i) {
      if (is_one_side(around.sides[i], around.sides[(i + 1) % 3])) return std::nullopt;
    }
    const std::optional<Vec3> place = meeting_place(around.sides);
    if (!place || glm::length(*place) > reach) return std::nullopt;
    if (!residual2_of_sides(around, *place, {0, 1, 2})) return std::nullopt;
    return middle + *place;
  }

  [[nodiscard]] bool has_corner(const Triangle& t, const Vec3& corner) const {
    bool found = false;
    for (const std::uint32_t v : t) {
      mesh_.table.for_each_neighbor(
          v, [&](std::uint32_t w) { found = found || is_taken(w, corner, 2); });
    }
    return found;
  }

  [[nodiscard]] std::uint32_t longest_edge(std::uint32_t face) const {
    const auto length = [&](std::uint32_t c) {
      return glm::length(at(mesh_.table.head(c)) - at(mesh_.table.vertex(c)));
    };
    std::uint32_t longest = 3 * face;
    for (const std::uint32_t c : {3 * face + 1, 3 * face + 2}) {
      if (length(c) > length(longest)) longest = c;
    }
    return longest;
  }

  FeatureMesh& mesh_;
  const FeatureCloud& cloud_;
};

}  // namespace

std::size_t split_crossing_edges(FeatureMesh& mesh, const FeatureCloud& cloud) {
  Splitter splitter(mesh, cloud);
  std::size_t count = 0;
  const auto corners = static_cast<std::uint32_t>(mesh.table.corner_count());
  for (std::uint32_t c = 0; c < corners; ++c) {
    if (mesh.table.names_inner_edge(c)) count += splitter.split_crossing(c) ? 1 : 0;
  }
  return count;
}

std::size_t split_cut_corners(FeatureMesh& mesh, const FeatureCloud& cloud) {
  Splitter splitter(mesh, cloud);
  std::size_t count = 0;
  const auto faces = static_cast<std::uint32_t>(mesh.table.face_count());
  for (std::uint32_t f = 0; f < faces; ++f) {
    if (!mesh.table.is_deleted(f)) count += splitter.split_corner(f) ? 1 : 0;
  }
  return count;
}

}  // namespace rangezip

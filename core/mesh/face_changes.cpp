#include "core/mesh/face_changes.h"

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <string>
#include <tuple>
#include <vector>

#include "core/base/error.h"
#include "core/mesh/edge_map.h"

namespace rangezip {

namespace {

/// The face from its lowest corner on.
Triangle from_lowest(const Triangle& face) {
  Triangle result = face;
  std::rotate(result.begin(), std::min_element(result.begin(), result.end()), result.end());
  return result;
}

bool is_before(const Vec3& a, const Vec3& b) {
  return std::tie(a.x, a.y, a.z) < std::tie(b.x, b.y, b.z);
}

/// The vertices that faces have, sorted by their places.
std::vector<std::uint32_t> vertices_by_place(const TriangleMesh& mesh) {
  std::vector<std::uint8_t> is_used(mesh.positions.size(), 0);
  for (const Triangle& t : mesh.triangles) {
    for (const std::uint32_t v : t)
      is_used[v] = 1;
  }
  std::vector<std::uint32_t> vertices;
  for (std::uint32_t v = 0; v < is_used.size(); ++v) {
    if (is_used[v] != 0) vertices.push_back(v);
  }
  std::stable_sort(vertices.begin(), vertices.end(), [&](std::uint32_t v, std::uint32_t w) {
    return is_before(mesh.positions[v], mesh.positions[w]);
  });
  return vertices;
}

/// Finds for faces after a change the same ones before it.
class Matcher {
 public:
  Matcher(const TriangleMesh& before, const TriangleMesh& after)
      : before_(before),
        after_(after),
        has_stayed_(after.positions.size(), 0),
        is_left_(before.triangles.size(), 0),
        is_old_(after.triangles.size(), 0) {
    for (std::size_t v = 0; v < before.positions.size(); ++v)
      has_stayed_[v] = before.positions[v] == after.positions[v] ? 1 : 0;
  }

  /// What stays mostly keeps its order, so a walk along both lists pairs most faces at once. Where
  /// new faces stand between, it would look at many in vain: it ends once it has done so for as
  /// many as there are.
  void match_in_order() {
    const std::size_t count = before_.triangles.size();
    std::size_t next = 0, in_vain = 0;
    for (std::size_t f = 0; f < is_old_.size() && in_vain <= count; ++f) {
      const Triangle& face = after_.triangles[f];
      if (!has_stayed(face)) continue;
      std::size_t same = next;
      while (same < count && before_.triangles[same] != face)
        ++same;
      if (same == count) {
        in_vain += count - next;
        continue;
      }
      is_left_[same] = is_old_[f] = 1;
      next = same + 1;
    }
  }

  /// All others. A directed edge has one face, so the one from the lowest corner names it.
  void match_by_edges() {
    const auto left = static_cast<std::size_t>(std::count(is_left_.begin(), is_left_.end(), 1));
    EdgeMap faces(is_left_.size() - left);
    for (std::uint32_t f = 0; f < is_left_.size(); ++f) {
      if (is_left_[f] != 0) continue;
      const Triangle face = from_lowest(before_.triangles[f]);
      faces.insert(face[0], face[1], f);
    }
    for (std::size_t f = 0; f < is_old_.size(); ++f) {
      if (is_old_[f] != 0 || !has_stayed(after_.triangles[f])) continue;
      const Triangle face = from_lowest(after_.triangles[f]);
      const std::uint32_t old = faces.find(face[0], face[1]);
      if (old == EdgeMap::kNone || from_lowest(before_.triangles[old]) != face) continue;
      is_left_[old] = is_old_[f] = 1;
    }
  }

  [[nodiscard]] FaceChanges changes() const {
    FaceChanges changes;
    for (std::uint32_t f = 0; f < is_old_.size(); ++f) {
      if (is_old_[f] == 0) changes.made.push_back(f);
    }
    for (std::uint32_t f = 0; f < is_left_.size(); ++f) {
      if (is_left_[f] == 0) changes.gone.push_back(f);
    }
    return changes;
  }

 private:
  /// None of the corners is new or has moved.
  [[nodiscard]] bool has_stayed(const Triangle& face) const {
    return (has_stayed_[face[0]] & has_stayed_[face[1]] & has_stayed_[face[2]]) != 0;
  }

  const TriangleMesh& before_;
  const TriangleMesh& after_;
  std::vector<std::uint8_t> has_stayed_;  ///< per vertex after: neither new nor moved
  std::vector<std::uint8_t> is_left_;     ///< per face before
  std::vector<std::uint8_t> is_old_;      ///< per face after
};

}  // namespace

FaceChanges find_face_changes(const TriangleMesh& before, const TriangleMesh& after) {
  if (after.positions.size() < before.positions.size()) {
    throw InvalidArgument("find_face_changes: of " + std::to_string(before.positions.size()) +
                          " vertices only " + std::to_string(after.positions.size()) + " are left");
  }
  Matcher matcher(before, after);
  matcher.match_in_order();
  matcher.match_by_edges();
  return matcher.changes();
}

TriangleMesh with_numbers_of(const TriangleMesh& before, const TriangleMesh& after) {
  const std::vector<std::uint32_t> known = vertices_by_place(before);
  const bool has_sources = !before.sources.empty() && !after.sources.empty();
  TriangleMesh renumbered{before.positions, after.triangles, {}};
  if (has_sources) renumbered.sources = before.sources;
  std::vector<std::uint32_t> number_of(after.positions.size());
  for (std::uint32_t v = 0; v < number_of.size(); ++v) {
    const Vec3& place = after.positions[v];
    const auto found = std::lower_bound(
        known.begin(), known.end(), place,
        [&](std::uint32_t k, const Vec3& p) { return is_before(before.positions[k], p); });
    if (found != known.end() && before.positions[*found] == place) {
      number_of[v] = *found;
    } else {
      number_of[v] = static_cast<std::uint32_t>(renumbered.positions.size());
      renumbered.positions.push_back(place);
      if (has_sources) renumbered.sources.push_back(after.sources[v]);
    }
  }
  for (Triangle& t : renumbered.triangles) {
    for (std::uint32_t& v : t)
      v = number_of[v];
  }
  return renumbered;
}

std::vector<std::uint32_t> find_new_faces(const TriangleMesh& before, const TriangleMesh& after) {
  return find_face_changes(before, with_numbers_of(before, after)).made;
}

}  // namespace rangezip

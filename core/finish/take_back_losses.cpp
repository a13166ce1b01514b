#include "core/finish/take_back_losses.h"

#include <algorithm>
#include <cstdint>
#include <utility>
#include <vector>

#include "core/base/disjoint_sets.h"
#include "core/finish/corner_table.h"
#include "core/mesh/face_changes.h"
#include "core/mesh/self_intersection.h"

namespace rangezip {
namespace {

/// Of the surface that went around a loop: if more came, the loop is mostly closed.
constexpr double kMostMade = 0.5;
/// In square h: losing less is no worse than the cracks that were there.
constexpr double kSmallLoss = 10.0;

/// Where a vertex is: `nowhere` if no face has it.
enum class Where : std::uint8_t { nowhere, inside, border };

std::vector<Where> where_vertices_are(const TriangleMesh& mesh) {
  const CornerTable table(mesh.triangles, mesh.positions.size());
  std::vector<Where> where(mesh.positions.size(), Where::nowhere);
  for (std::uint32_t c = 0; c < table.corner_count(); ++c)
    where[table.vertex(c)] = Where::inside;
  for (std::uint32_t c = 0; c < table.corner_count(); ++c) {
    if (table.across(c) == CornerTable::kNone)
      where[table.vertex(c)] = where[table.head(c)] = Where::border;
  }
  return where;
}

/// The changes from one mesh to another with the same vertices, by what hangs together.
class Losses {
 public:
  Losses(const TriangleMesh& before, const TriangleMesh& after, double h)
      : before_(before),
        after_(after),
        changes_(find_face_changes(before, after)),
        sets_(after.positions.size()),
        is_undone_(after.positions.size(), 0) {
    for (const std::uint32_t f : changes_.gone)
      join(before.triangles[f]);
    for (const std::uint32_t f : changes_.made)
      join(after.triangles[f]);
    choose(kSmallLoss * h * h);
  }

  /// The mesh without the changes that were chosen, but for those that would cross others.
  /// @return faces that came back
  std::size_t undo(TriangleMesh& mesh) {
    for (;;) {
      std::vector<std::uint32_t> back;
      mesh.triangles = undone(back);
      const auto crossing = self_intersections(mesh, back);
      if (crossing.empty()) return back.size();
      for (const auto& [i, j] : crossing) {
        for (const std::uint32_t f : {i, j}) {
          if (f >= back.front()) is_undone_[sets_.find(mesh.triangles[f][0])] = 0;
        }
      }
    }
  }

 private:
  void join(const Triangle& face) {
    sets_.join(face[0], face[1]);
    sets_.join(face[0], face[2]);
  }

  /// Sets at an open loop, or of which nothing is left, in which much more surface went than came.
  /// @param least surface lost, square model units
  void choose(double least) {
    std::vector<double> gone(after_.positions.size(), 0.0), made = gone;
    for (const std::uint32_t f : changes_.gone) {
      const Triangle& t = before_.triangles[f];
      gone[sets_.find(t[0])] += area_of_face(before_.positions, t);
    }
    for (const std::uint32_t f : changes_.made) {
      const Triangle& t = after_.triangles[f];
      made[sets_.find(t[0])] += area_of_face(after_.positions, t);
    }
    const std::vector<Where> where = where_vertices_are(after_);
    std::vector<Where> where_most(after_.positions.size(), Where::nowhere);
    for (const std::uint32_t f : changes_.gone) {
      for (const std::uint32_t v : before_.triangles[f])
        where_most[sets_.find(v)] = std::max(where_most[sets_.find(v)], where[v]);
    }
    for (std::size_t set = 0; set < gone.size(); ++set) {
      const bool is_much = made[set] <= kMostMade * gone[set] && gone[set] - made[set] >= least;
      if (is_much && where_most[set] != Where::inside) is_undone_[set] = 1;
    }
  }

  /// @param back set to the numbers of the faces that come back: the last ones
  [[nodiscard]] std::vector<Triangle> undone(std::vector<std::uint32_t>& back) {
    std::vector<std::uint8_t> goes(after_.triangles.size(), 0);
    for (const std::uint32_t f : changes_.made)
      goes[f] = is_undone_[sets_.find(after_.triangles[f][0])];
    std::vector<Triangle> triangles = after_.triangles;
    remove_triangles(triangles, goes);
    for (const std::uint32_t f : changes_.gone) {
      if (is_undone_[sets_.find(before_.triangles[f][0])] == 0) continue;
      back.push_back(static_cast<std::uint32_t>(triangles.size()));
      triangles.push_back(before_.triangles[f]);
    }
    return triangles;
  }

  const TriangleMesh& before_;
  const TriangleMesh& after_;
  FaceChanges changes_;
  DisjointSets sets_;
  std::vector<std::uint8_t> is_undone_;  ///< of sets, by the vertex that names each
};

}  // namespace

std::size_t take_back_losses(TriangleMesh& mesh, const TriangleMesh& before, double pixel_size) {
  const TriangleMesh after = with_numbers_of(before, mesh);
  TriangleMesh undone = after;
  const std::size_t back = Losses(before, after, pixel_size).undo(undone);
  if (back == 0) return 0;
  mesh = std::move(undone);
  remove_unused_vertices(mesh);
  return back;
}

}  // namespace rangezip

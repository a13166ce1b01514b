#include "core/finish/take_back_losses.h"

#include <algorithm>
#include <cstdint>
#include <utility>
#include <vector>

#include "core/base/disjoint_sets.h"
#include "core/base/parallel.h"
#include "core/finish/corner_table.h"
#include "core/finish/face_grid.h"
#include "core/finish/left_out_points.h"
#include "core/mesh/coverage.h"
#include "core/mesh/face_changes.h"
#include "core/mesh/self_intersection.h"

namespace rangezip {
namespace {

/// Of the surface that went around a loop: if more came, the loop is mostly closed.
constexpr double kMostMade = 0.5;
/// In square h: losing less is no worse than the cracks that were there.
constexpr double kSmallLoss = 10.0;
constexpr std::size_t kPointsPerBlock = 4096;

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

TriangleMesh faces_of(const TriangleMesh& mesh, const std::vector<std::uint32_t>& faces) {
  TriangleMesh some{mesh.positions, {}, {}};
  for (const std::uint32_t f : faces)
    some.triangles.push_back(mesh.triangles[f]);
  return some;
}

/// Points, and a vertex of the face that is nearest to each.
struct PointsNear {
  std::vector<Vec3> points;
  std::vector<std::uint32_t> vertex_near;
};

/// Those of the points to which a face comes nearer than `distance`.
PointsNear points_near(const TriangleMesh& mesh, const std::vector<Vec3>& points, double distance) {
  const FaceGrid grid(mesh, distance);
  std::vector<std::uint32_t> nearest(points.size());
  parallel_for(points.size(), kPointsPerBlock, [&](std::size_t begin, std::size_t end) {
    for (std::size_t i = begin; i < end; ++i)
      nearest[i] = grid.nearest_face(points[i], distance);
  });
  PointsNear near;
  for (std::size_t i = 0; i < points.size(); ++i) {
    if (nearest[i] == CornerTable::kNone) continue;
    near.points.push_back(points[i]);
    near.vertex_near.push_back(mesh.triangles[nearest[i]][0]);
  }
  return near;
}

/// The changes from one mesh to another with the same vertices, by what hangs together.
class Losses {
 public:
  Losses(const TriangleMesh& before, const TriangleMesh& after)
      : before_(before),
        after_(after),
        changes_(find_face_changes(before, after)),
        gone_(faces_of(before, changes_.gone)),
        made_(faces_of(after, changes_.made)),
        sets_(after.positions.size()),
        is_undone_(after.positions.size(), 0) {
    for (const TriangleMesh* faces : {&gone_, &made_}) {
      for (const Triangle& face : faces->triangles) {
        sets_.join(face[0], face[1]);
        sets_.join(face[0], face[2]);
      }
    }
  }

  /// Chooses the sets at an open loop, or of which nothing is left, in which much more surface went
  /// than came.
  /// @param least surface lost, square model units
  /// @param only_vanished only those of which nothing is left
  void choose_by_area(double least, bool only_vanished) {
    const std::vector<double> gone = areas_of_sets(gone_), made = areas_of_sets(made_);
    const std::vector<Where> where = where_of_sets();
    for (std::size_t set = 0; set < gone.size(); ++set) {
      const bool is_much = made[set] <= kMostMade * gone[set] && gone[set] - made[set] >= least;
      const bool may_come_back =
          only_vanished ? where[set] == Where::nowhere : where[set] != Where::inside;
      is_undone_[set] = is_much && may_come_back ? 1 : 0;
    }
  }

  /// Of the chosen sets leaves those that leave out more points than they reach.
  /// @param distance of points that a mesh reaches, model units
  void keep_by_points(const PointGrid& cloud, double distance) {
    const bool any_chosen = std::find(is_undone_.begin(), is_undone_.end(), 1) != is_undone_.end();
    if (!any_chosen || cloud.empty()) return;
    const std::vector<Vec3> points = cloud.points(cloud.size());
    const std::vector<std::size_t> lost = reached_only_by(gone_, points, after_, distance);
    const std::vector<std::size_t> won = reached_only_by(made_, points, before_, distance);
    for (std::size_t set = 0; set < lost.size(); ++set) {
      if (lost[set] <= won[set] + kFewLeftOut) is_undone_[set] = 0;
    }
  }

  /// The mesh without the changes that lose points, but for those that would cross others.
  /// @return faces that came back
  std::size_t undo(TriangleMesh& mesh, const Progress& progress) {
    for (;;) {
      std::vector<std::uint32_t> back;
      mesh.triangles = undone(back);
      const auto crossing = self_intersections(mesh, back, {}, progress);
      if (crossing.empty()) return back.size();
      for (const auto& [i, j] : crossing) {
        for (const std::uint32_t f : {i, j}) {
          if (f >= back.front()) is_undone_[sets_.find(mesh.triangles[f][0])] = 0;
        }
      }
    }
  }

 private:
  /// For each set whether a vertex of the faces that have gone is on the border now, else whether
  /// one is left.
  [[nodiscard]] std::vector<Where> where_of_sets() {
    const std::vector<Where> where = where_vertices_are(after_);
    std::vector<Where> of_sets(where.size(), Where::nowhere);
    for (const Triangle& face : gone_.triangles) {
      Where& of_set = of_sets[sets_.find(face[0])];
      for (const std::uint32_t v : face)
        of_set = std::max(of_set, where[v]);
    }
    return of_sets;
  }

  [[nodiscard]] std::vector<double> areas_of_sets(const TriangleMesh& faces) {
    std::vector<double> areas(after_.positions.size(), 0.0);
    for (const Triangle& face : faces.triangles)
      areas[sets_.find(face[0])] += area_of_face(faces.positions, face);
    return areas;
  }

  /// How many points the faces of each set reach that another mesh does not.
  [[nodiscard]] std::vector<std::size_t> reached_only_by(const TriangleMesh& faces,
                                                         const std::vector<Vec3>& points,
                                                         const TriangleMesh& other,
                                                         double distance) {
    std::vector<std::size_t> count(after_.positions.size(), 0);
    if (faces.empty()) return count;
    const PointsNear near = points_near(faces, points, distance);
    const std::vector<std::uint8_t> is_covered = covered_points(near.points, other, distance);
    for (std::size_t i = 0; i < near.points.size(); ++i) {
      if (is_covered[i] == 0) ++count[sets_.find(near.vertex_near[i])];
    }
    return count;
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
  TriangleMesh gone_, made_;  ///< the faces
  DisjointSets sets_;
  std::vector<std::uint8_t> is_undone_;  ///< of sets, by the vertex that names each
};

std::size_t take_back(TriangleMesh& mesh, const TriangleMesh& before, const PointGrid* cloud,
                      double pixel_size, bool only_vanished, const Progress& progress) {
  progress.check_stop();
  const TriangleMesh after = with_numbers_of(before, mesh);
  TriangleMesh undone = after;
  Losses losses(before, after);
  losses.choose_by_area(kSmallLoss * pixel_size * pixel_size, only_vanished);
  if (cloud != nullptr) losses.keep_by_points(*cloud, kLeftOut * pixel_size);
  const std::size_t back = losses.undo(undone, progress);
  if (back == 0) return 0;
  mesh = std::move(undone);
  remove_unused_vertices(mesh);
  return back;
}

}  // namespace

std::size_t take_back_losses(TriangleMesh& mesh, const TriangleMesh& before, const PointGrid* cloud,
                             double pixel_size, const Progress& progress) {
  return take_back(mesh, before, cloud, pixel_size, false, progress);
}

std::size_t take_back_vanished(TriangleMesh& mesh, const TriangleMesh& before,
                               const PointGrid& cloud, double pixel_size,
                               const Progress& progress) {
  return take_back(mesh, before, &cloud, pixel_size, true, progress);
}

}  // namespace rangezip

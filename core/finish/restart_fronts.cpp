#include "core/finish/restart_fronts.h"

#include <algorithm>
#include <array>
#include <cstdint>
#include <utility>
#include <vector>

#include "core/base/cubes.h"
#include "core/base/disjoint_sets.h"
#include "core/finish/boundary_loops.h"
#include "core/finish/clean_topology.h"
#include "core/finish/corner_table.h"
#include "core/finish/face_part.h"
#include "core/finish/places_near.h"
#include "core/mesh/coverage.h"

namespace rangezip {
namespace {

/// How far around the border faces go, in h, and what fronts start with: each time something else.
struct Start {
  double cleared = 0.0;
  FrontStart front;
};
constexpr std::array<Start, 8> kStarts{{{2.0, {0.45, 0.75}},
                                        {1.5, {0.45, 0.9}},
                                        {2.5, {0.3, 0.8}},
                                        {1.0, {0.5, 0.7}},
                                        {2.0, {0.6, 0.85}},
                                        {1.5, {0.4, 0.95}},
                                        {2.5, {0.45, 0.7}},
                                        {1.0, {0.3, 0.9}}}};
constexpr std::size_t kRagged = 5;  ///< edges of a loop; less is closed as well by any fill
/// In h, around the border of such loops: points that fronts may reach, and faces that they might
/// meet.
constexpr double kPlace = 4.0;
constexpr double kPart = 8.0;
constexpr double kGrown = 3.0;  ///< in h, of a place that has been grown over
constexpr double kCube = 2.0;   ///< in h
/// What a place has at least of the area that it had: else a crack was made wide.
constexpr double kNoSmaller = 0.95;
/// What a place has at most of the ragged border that it had: true borders, grown again, come out a
/// little shorter or longer.
constexpr double kMuchLess = 0.85;

/// Something that is left to do at a place.
struct Rest {
  Vec3 place{0.0};
  double size = 0.0;  ///< square model units
};

/// The edges of ragged loops within `reach` of a place, by their ends. An edge counts as its length
/// times that of its loop: several short loops are closed more easily than a long one.
std::vector<Rest> ragged_border(TriangleMesh mesh, const PointGrid& places, double reach) {
  clean_topology(mesh);
  const CornerTable table(mesh.triangles, mesh.positions.size());
  std::vector<Rest> border;
  for (const BoundaryLoop& loop : boundary_loops(table)) {
    if (loop.corners.size() < kRagged) continue;
    const double perimeter = perimeter_of(loop, table, mesh.positions);
    for (const std::uint32_t corner : loop.corners) {
      const Vec3 &from = mesh.positions[table.vertex(corner)],
                 &to = mesh.positions[table.head(corner)];
      if (places.has_point_within(from, reach))
        border.push_back({from, glm::distance(from, to) * perimeter});
    }
  }
  return border;
}

PointGrid grid_of_border(const std::vector<Rest>& border, double h) {
  std::vector<Vec3> places;
  places.reserve(border.size());
  for (const Rest& rest : border)
    places.push_back(rest.place);
  return grid_of(places, kCube * h);
}

/// What is left to do in a growth.
struct Left {
  std::vector<Rest> border;   ///< of ragged loops
  std::vector<Vec3> missing;  ///< points that are not in the mesh
};

/// Another growth of a mesh: the same without some faces, and with others at the end.
struct Growth {
  std::vector<std::uint8_t> goes;  ///< per face of the mesh
  TriangleMesh mesh;
};

/// Calls visit(mesh, triangle) for the faces that go, then for those that have come.
template <class Visit>
void for_each_changed_face(const TriangleMesh& mesh, const Growth& growth, const Visit& visit) {
  std::size_t kept = mesh.triangles.size();
  for (std::size_t f = 0; f < mesh.triangles.size(); ++f) {
    if (growth.goes[f] == 0) continue;
    --kept;
    visit(mesh, mesh.triangles[f]);
  }
  for (std::size_t f = kept; f < growth.mesh.triangles.size(); ++f)
    visit(growth.mesh, growth.mesh.triangles[f]);
}

/// Where two growths differ: cubes that touch, or that one face is in, are one place.
class ChangedPlaces {
 public:
  ChangedPlaces(const TriangleMesh& mesh, const Growth& growth, double h)
      : side_(kCube * h), cubes_(changed_cubes(mesh, growth)), sets_(cubes_.size()) {
    for (std::size_t i = 0; i < cubes_.size(); ++i)
      for_each_cube_around(cubes_, cubes_[i], [&](std::size_t k) { join(i, k); });
    for_each_changed_face(mesh, growth, [&](const TriangleMesh& of, const Triangle& t) {
      join(cube_at(of.positions[t[0]]), cube_at(of.positions[t[1]]));
      join(cube_at(of.positions[t[0]]), cube_at(of.positions[t[2]]));
    });
  }

  [[nodiscard]] std::size_t size() const { return cubes_.size(); }

  /// The number of the one at a point, or next to it; size() if there is none.
  [[nodiscard]] std::size_t at(const Vec3& point) {
    std::size_t cube = cube_at(point);
    if (cube == cubes_.size()) {
      for_each_cube_around(cubes_, cube_of(point, side_),
                           [&](std::size_t other) { cube = std::min(cube, other); });
    }
    return cube < cubes_.size() ? sets_.find(static_cast<std::uint32_t>(cube)) : cubes_.size();
  }

 private:
  [[nodiscard]] std::vector<Cube> changed_cubes(const TriangleMesh& mesh,
                                                const Growth& growth) const {
    std::vector<Cube> cubes;
    for_each_changed_face(mesh, growth, [&](const TriangleMesh& of, const Triangle& t) {
      for (const std::uint32_t v : t)
        cubes.push_back(cube_of(of.positions[v], side_));
    });
    sort_cubes(cubes);
    return cubes;
  }

  [[nodiscard]] std::size_t cube_at(const Vec3& point) const {
    return find_cube(cubes_, cube_of(point, side_));
  }

  void join(std::size_t a, std::size_t b) {
    sets_.join(static_cast<std::uint32_t>(a), static_cast<std::uint32_t>(b));
  }

  double side_;
  std::vector<Cube> cubes_;
  DisjointSets sets_;
};

/// The places where much less is open, no more points are missing, and the surface is no smaller.
/// The last flag is 0: that of where nothing has changed.
std::vector<std::uint8_t> better_places(ChangedPlaces& places, const TriangleMesh& mesh,
                                        const Growth& growth, const Left& before,
                                        const Left& after) {
  std::vector<double> gone(places.size() + 1, 0.0), come = gone;
  for_each_changed_face(mesh, growth, [&](const TriangleMesh& of, const Triangle& t) {
    (&of == &mesh ? gone : come)[places.at(of.positions[t[0]])] += area_of_face(of.positions, t);
  });
  std::vector<double> open_before(places.size() + 1, 0.0), open_after = open_before;
  std::vector<std::int64_t> more_missing(places.size() + 1, 0);
  for (const Rest& rest : before.border)
    open_before[places.at(rest.place)] += rest.size;
  for (const Rest& rest : after.border)
    open_after[places.at(rest.place)] += rest.size;
  for (const Vec3& p : before.missing)
    --more_missing[places.at(p)];
  for (const Vec3& p : after.missing)
    ++more_missing[places.at(p)];
  std::vector<std::uint8_t> is_better(places.size() + 1, 0);
  for (std::size_t i = 0; i < places.size(); ++i)
    is_better[i] = open_after[i] < kMuchLess * open_before[i] && more_missing[i] <= 0 &&
                           come[i] >= kNoSmaller * gone[i]
                       ? 1
                       : 0;
  return is_better;
}

/// Takes, place by place, what is better. @return whether that is anything
bool take_better(TriangleMesh& mesh, Growth growth, const Left& before, const Left& after,
                 double h) {
  ChangedPlaces places(mesh, growth, h);
  const std::vector<std::uint8_t> is_better = better_places(places, mesh, growth, before, after);
  if (std::count(is_better.begin(), is_better.end(), 1) == 0) return false;
  const auto is_better_at = [&](const TriangleMesh& of, const Triangle& t) {
    return is_better[places.at(of.positions[t[0]])] != 0;
  };
  std::vector<Triangle> triangles;
  std::size_t kept = 0;
  for (std::size_t f = 0; f < mesh.triangles.size(); ++f) {
    kept += growth.goes[f] == 0 ? 1 : 0;
    if (growth.goes[f] == 0 || !is_better_at(mesh, mesh.triangles[f]))
      triangles.push_back(mesh.triangles[f]);
  }
  for (std::size_t f = kept; f < growth.mesh.triangles.size(); ++f) {
    const Triangle& t = growth.mesh.triangles[f];
    if (is_better_at(growth.mesh, t)) triangles.push_back(t);
  }
  mesh = std::move(growth.mesh);
  mesh.triangles = std::move(triangles);
  return true;
}

/// Without the faces around a border, grown again.
Growth grow_again(const TriangleMesh& mesh, std::span<const Vec3> points, const PointGrid& border,
                  double reach, const GrowOverOptions& options, const Progress& progress) {
  Growth growth{.goes = flags_of(mesh.triangles.size(),
                                 [&](std::size_t f) {
                                   const Triangle& t = mesh.triangles[f];
                                   return std::any_of(t.begin(), t.end(), [&](std::uint32_t v) {
                                     return border.has_point_within(mesh.positions[v], reach);
                                   });
                                 }),
                .mesh = mesh};
  remove_triangles(growth.mesh.triangles, growth.goes);
  grow_over(growth.mesh, points, options, progress);
  return growth;
}

}  // namespace

std::size_t restart_fronts(TriangleMesh& mesh, std::span<const Vec3> points, const PointGrid& grown,
                           const GrowOverOptions& options, const Progress& progress) {
  const double h = options.pixel_size;
  const std::vector<Rest> border = ragged_border(mesh, grown, kGrown * h);
  if (border.empty()) return 0;
  const PointGrid around = grid_of_border(border, h);
  FacePart part = part_near(mesh, around, kPart * h);
  const std::vector<Vec3> near = points_near(points, around, kPlace * h);
  const std::size_t before = part.mesh.triangles.size();
  bool is_better = false;
  const auto left_in = [&](const TriangleMesh& grown_mesh) {
    return Left{ragged_border(grown_mesh, around, kPlace * h),
                points_off(near, grown_mesh, options.off_mesh)};
  };
  Left left = left_in(part.mesh);
  for (const Start& start : kStarts) {
    if (left.border.empty()) break;
    GrowOverOptions again = options;
    again.start = start.front;
    Growth growth = grow_again(part.mesh, near, grid_of_border(left.border, h), start.cleared * h,
                               again, progress);
    const Left left_then = left_in(growth.mesh);
    if (!take_better(part.mesh, std::move(growth), left, left_then, h)) continue;
    left = left_in(part.mesh);
    is_better = true;
  }
  if (!is_better) return 0;
  const std::size_t after = part.mesh.triangles.size();
  put_back(std::move(part), mesh);
  return after > before ? after - before : 0;
}

}  // namespace rangezip

#include "core/finish/small_angles.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <map>
#include <span>
#include <utility>
#include <vector>

#include "core/finish/angle_mends.h"
#include "core/finish/border_gaps.h"
#include "core/finish/corner_table.h"
#include "core/finish/face_grid.h"
#include "core/finish/face_part.h"
#include "core/finish/triangle_shape.h"
#include "core/mesh/self_intersection.h"

namespace rangezip {
namespace {

/// Angles to mend: those under one, for some rounds. Sines, and the turn of faces as a cosine.
struct Stage {
  double under;
  double enough;  // see AngleMendOptions
  double max_turn;
  double border_way;  // in h, of a vertex of the border
  double beyond;      // in h: points so far beyond the border are none
};
constexpr double kNegligible = 1e-3;  ///< in h, as in extend_border.h
constexpr double kEnough = 0.25;      ///< 14 degrees
constexpr std::array kSmall{Stage{kSmallAngle, kEnough, 0.8, 0.5, kNegligible},
                            Stage{kSmallAngle, kEnough, 0.5, 0.5, kNegligible},
                            Stage{kSmallAngle, kEnough, 0.0, 0.5, 0.02},
                            Stage{kSmallAngle, kEnough, 0.0, 0.5, 0.5},
                            Stage{kSmallAngle, kEnough, 0.0, 0.5, 1.0}};  // all within the reach
constexpr std::array kMedium{Stage{0.5, 0.52, 0.97, 0.1, kNegligible}};   ///< 30 and 31 degrees
constexpr double kFew =
    0.05;                   ///< of all faces: more with an angle under 30 are what the mesh is like
constexpr int kRounds = 8;  ///< of each stage
constexpr std::size_t kMostTries = 64;  ///< of the mends of a face
constexpr int kRings = 3;               ///< around small angles: what the rounds may change
constexpr double kReach = 1.0;  ///< in h, of points beyond the border, as in extend_border.h
/// In h: what is nearer than this to a change tells whether it may be; points within the reach, and
/// faces that may be nearer to them.
constexpr double kAround = 2.5;
constexpr double kCube = 4.0;  ///< in h, of the cubes in which faces are looked up
constexpr std::uint32_t kNone = CornerTable::kNone;

double angle_of(const std::vector<Vec3>& p, const Triangle& t) {
  return sine_of_smallest_angle(p[t[0]], p[t[1]], p[t[2]]);
}

/// Faces with an angle whose sine is less.
std::vector<std::uint32_t> small_faces(const TriangleMesh& mesh, double sine) {
  std::vector<std::uint32_t> found;
  for (std::uint32_t f = 0; f < mesh.triangles.size(); ++f) {
    if (angle_of(mesh.positions, mesh.triangles[f]) < sine) found.push_back(f);
  }
  return found;
}

bool has_flag(const std::vector<std::uint8_t>& flags, const Triangle& t) {
  return (flags[t[0]] | flags[t[1]] | flags[t[2]]) != 0;
}

Box widened(Box box, double margin) {
  box.lower -= Vec3(margin);
  box.upper += Vec3(margin);
  return box;
}

/// What has a box, by the cubes of a grid that the boxes meet.
class Cubes {
 public:
  /// @param origin moves along with the mesh: so do the cubes
  Cubes(const Vec3& origin, double side) : origin_(origin), per_side_(1.0 / side) {}

  void add(const Box& box, std::uint32_t id) {
    for_each(box, [&](const Cube& cube) { entries_.emplace_back(cube, id); });
  }
  void sort() {
    std::sort(entries_.begin(), entries_.end());
    entries_.erase(std::unique(entries_.begin(), entries_.end()), entries_.end());
  }
  /// Those whose boxes meet a cube that this one meets, rising. @pre sort()
  [[nodiscard]] std::vector<std::uint32_t> near(const Box& box) const {
    std::vector<std::uint32_t> ids;
    for_each(box, [&](const Cube& cube) {
      auto entry = std::lower_bound(entries_.begin(), entries_.end(), Entry(cube, 0));
      for (; entry != entries_.end() && entry->first == cube; ++entry)
        ids.push_back(entry->second);
    });
    std::sort(ids.begin(), ids.end());
    ids.erase(std::unique(ids.begin(), ids.end()), ids.end());
    return ids;
  }

 private:
  using Cube = std::array<std::int64_t, 3>;
  using Entry = std::pair<Cube, std::uint32_t>;

  [[nodiscard]] Cube cube_at(const Vec3& place) const {
    const Vec3 cube = glm::floor((place - origin_) * per_side_);
    return {static_cast<std::int64_t>(cube.x), static_cast<std::int64_t>(cube.y),
            static_cast<std::int64_t>(cube.z)};
  }
  template <class Visit>
  void for_each(const Box& box, const Visit& visit) const {
    const Cube lower = cube_at(box.lower), upper = cube_at(box.upper);
    for (std::int64_t x = lower[0]; x <= upper[0]; ++x) {
      for (std::int64_t y = lower[1]; y <= upper[1]; ++y) {
        for (std::int64_t z = lower[2]; z <= upper[2]; ++z)
          visit({x, y, z});
      }
    }
  }

  Vec3 origin_;
  double per_side_;
  std::vector<Entry> entries_;
};

/// Flags of the vertices of the faces that have a flagged vertex.
std::vector<std::uint8_t> with_neighbors(const TriangleMesh& mesh,
                                         const std::vector<std::uint8_t>& flags) {
  std::vector<std::uint8_t> more = flags;
  for (const Triangle& t : mesh.triangles) {
    if (!has_flag(flags, t)) continue;
    for (const std::uint32_t v : t)
      more[v] = 1;
  }
  return more;
}

/// Flags of the vertices of these faces and some rings around.
std::vector<std::uint8_t> vertices_around(const TriangleMesh& mesh,
                                          const std::vector<std::uint32_t>& faces) {
  std::vector<std::uint8_t> flags(mesh.positions.size(), 0);
  for (const std::uint32_t f : faces) {
    for (const std::uint32_t v : mesh.triangles[f])
      flags[v] = 1;
  }
  for (int ring = 0; ring < kRings; ++ring)
    flags = with_neighbors(mesh, flags);
  return flags;
}

/// The faces near those with a flagged vertex.
FacePart part_around(const TriangleMesh& mesh, const std::vector<std::uint8_t>& flags, double h) {
  Cubes cubes(bounds_of(mesh).lower, kCube * h);
  for (const Triangle& t : mesh.triangles) {
    if (has_flag(flags, t)) cubes.add(widened(box_of(mesh, t), kAround * h), 0);
  }
  cubes.sort();
  std::vector<std::uint8_t> is_near(mesh.triangles.size());
  std::transform(mesh.triangles.begin(), mesh.triangles.end(), is_near.begin(),
                 [&](const Triangle& t) {
                   return static_cast<std::uint8_t>(cubes.near(box_of(mesh, t)).empty() ? 0 : 1);
                 });
  return face_part(mesh, is_near);
}

/// The faces of a mesh by where they are.
Cubes cubes_of(const TriangleMesh& mesh, double h) {
  Cubes cubes(bounds_of(mesh).lower, kCube * h);
  for (std::uint32_t f = 0; f < mesh.triangles.size(); ++f)
    cubes.add(box_of(mesh, mesh.triangles[f]), f);
  cubes.sort();
  return cubes;
}

/// A few faces as a mesh of their own.
struct Neighborhood {
  TriangleMesh mesh;
  std::vector<std::uint32_t> faces;     // of the whole, rising, one per face
  std::vector<std::uint32_t> vertices;  // of the whole, rising, one per position

  Neighborhood(const TriangleMesh& whole, std::vector<std::uint32_t> some)
      : faces(std::move(some)) {
    for (const std::uint32_t f : faces)
      vertices.insert(vertices.end(), whole.triangles[f].begin(), whole.triangles[f].end());
    std::sort(vertices.begin(), vertices.end());
    vertices.erase(std::unique(vertices.begin(), vertices.end()), vertices.end());
    for (const std::uint32_t v : vertices)
      mesh.positions.push_back(whole.positions[v]);
    for (const std::uint32_t f : faces)
      mesh.triangles.push_back(triangle(whole.triangles[f]));
  }

  [[nodiscard]] std::uint32_t vertex(std::uint32_t of_whole) const {
    return index_in(vertices, of_whole);
  }
  [[nodiscard]] std::uint32_t face(std::uint32_t of_whole) const {
    return index_in(faces, of_whole);
  }
  [[nodiscard]] Triangle triangle(const Triangle& of_whole) const {
    return {vertex(of_whole[0]), vertex(of_whole[1]), vertex(of_whole[2])};
  }

 private:
  static std::uint32_t index_in(const std::vector<std::uint32_t>& all, std::uint32_t of_whole) {
    return static_cast<std::uint32_t>(std::lower_bound(all.begin(), all.end(), of_whole) -
                                      all.begin());
  }
};

/// Of what tells whether faces may change.
Box box_around(const TriangleMesh& mesh, const CornerTable& table,
               std::span<const std::uint32_t> faces, double h) {
  Box box;
  for (const std::uint32_t f : faces) {
    for (const std::uint32_t v : mesh.triangles[f])
      table.for_each_neighbor(v, [&](std::uint32_t w) { box.add(mesh.positions[w]); });
  }
  return widened(box, kAround * h);
}

/// The faces that mends replace.
std::vector<std::uint32_t> faces_gone(const std::vector<AngleMend>& mends) {
  std::vector<std::uint32_t> gone;
  for (const AngleMend& mend : mends)
    gone.insert(gone.end(), mend.gone.begin(), mend.gone.end());
  std::sort(gone.begin(), gone.end());
  gone.erase(std::unique(gone.begin(), gone.end()), gone.end());
  return gone;
}

/// A mesh after a mend, and which of its faces are new.
struct Mended {
  TriangleMesh mesh;
  std::vector<std::uint32_t> changed;
};

/// The surroundings of a face, on which its mends are tried.
class Spot {
 public:
  /// @param gone the faces that these replace
  Spot(const TriangleMesh& mesh, const CornerTable& table, const Cubes& cubes,
       std::span<const std::uint32_t> gone, const PointGrid& cloud, double h, double beyond)
      : part_(mesh, cubes.near(box_around(mesh, table, gone, h))),
        cloud_(cloud),
        h_(h),
        table_(part_.mesh.triangles, part_.mesh.positions.size()),
        faces_(part_.mesh, table_, kReach * h),
        is_changed_(part_.mesh.positions.size(), 0) {
    for (const std::uint32_t f : gone) {
      for (const std::uint32_t v : mesh.triangles[f])
        is_changed_[part_.vertex(v)] = 1;
    }
    for (const Triangle& t : part_.mesh.triangles) {
      if (has_flag(is_changed_, t)) near_change_.add(box_of(part_.mesh, t));
    }
    near_change_ = widened(near_change_, 2.0 * kReach * h);
    for (std::uint32_t v = 0; v < is_changed_.size(); ++v)
      is_at_border_ = is_at_border_ || (is_changed_[v] != 0 && table_.is_boundary(v));
    beyond_ = is_at_border_ ? std::max(beyond, farthest_beyond(part_.mesh, table_, faces_)) : 0.0;
  }

  /// Whether with the mend no faces cross, and no point is farther beyond the border than may be,
  /// or than there is without.
  [[nodiscard]] bool allows(const AngleMend& mend) const {
    const Mended mended = apply(mend);
    if (!self_intersections(mended.mesh, mended.changed).empty()) return false;
    if (!is_at_border_) return true;
    const CornerTable table(mended.mesh.triangles, mended.mesh.positions.size());
    const FaceGrid faces(mended.mesh, table, kReach * h_);
    return farthest_beyond(mended.mesh, table, faces) <= beyond_;
  }

 private:
  [[nodiscard]] Mended apply(const AngleMend& mend) const {
    Mended mended{part_.mesh, {}};
    std::vector<std::uint8_t> goes(part_.faces.size(), 0);
    for (const std::uint32_t f : mend.gone)
      goes[part_.face(f)] = 1;
    auto& triangles = mended.mesh.triangles;
    remove_triangles(triangles, goes);
    for (const Triangle& t : mend.faces) {
      mended.changed.push_back(static_cast<std::uint32_t>(triangles.size()));
      triangles.push_back(part_.triangle(t));
    }
    if (mend.vertex != kNone) mended.mesh.positions[part_.vertex(mend.vertex)] = mend.place;
    return mended;
  }

  /// Of points beyond border edges at what changes, or that lay there before.
  [[nodiscard]] double farthest_beyond(const TriangleMesh& mesh, const CornerTable& table,
                                       const FaceGrid& faces) const {
    double farthest = 0.0;
    for (const BorderGap& gap : find_border_gaps(mesh, table, faces, cloud_, border(mesh, table),
                                                 {kReach * h_, kNegligible * h_})) {
      if (has_flag(is_changed_, table.triangle(gap.corner / 3)) || was_at_change(gap.point))
        farthest = std::max(farthest, gap.beyond);
    }
    return farthest;
  }
  /// The border edges beyond which such points may be: most of the others are where the
  /// surroundings were cut out.
  [[nodiscard]] std::vector<std::uint32_t> border(const TriangleMesh& mesh,
                                                  const CornerTable& table) const {
    std::vector<std::uint32_t> corners;
    for (std::uint32_t c = 0; c < table.corner_count(); ++c) {
      if (table.across(c) != kNone) continue;
      const Triangle face = table.triangle(c / 3);
      if (has_flag(is_changed_, face) || boxes_meet(near_change_, box_of(mesh, face)))
        corners.push_back(c);
    }
    return corners;
  }
  [[nodiscard]] bool was_at_change(const Vec3& point) const {
    const std::uint32_t face = faces_.nearest_face(point, kReach * h_);
    return face != kNone && has_flag(is_changed_, table_.triangle(face));
  }

  Neighborhood part_;
  const PointGrid& cloud_;
  double h_;
  CornerTable table_;
  FaceGrid faces_;
  std::vector<std::uint8_t> is_changed_;  // per position: a face around it may change
  Box near_change_;                       // twice the reach around the faces that may
  bool is_at_border_ = false;
  double beyond_ = 0.0;  // how far points may be
};

/// Faces for which no mend was found, and the boxes of what was looked at: nothing is found in
/// another round either as long as nothing there has changed.
class Hopeless {
 public:
  void add(const Triangle& face, const Box& looked_at) { faces_.emplace(face, looked_at); }
  [[nodiscard]] bool contains(const Triangle& face) const { return faces_.contains(face); }
  void forget_near(const Cubes& changed) {
    std::erase_if(faces_, [&](const auto& entry) { return !changed.near(entry.second).empty(); });
  }

 private:
  std::map<Triangle, Box> faces_;
};

class Round {
 public:
  /// @param may_change per position
  /// @param hopeless of this stage
  Round(TriangleMesh& mesh, const std::vector<std::uint8_t>& may_change, const PointGrid& cloud,
        double h, const Stage& stage, Hopeless& hopeless)
      : mesh_(mesh),
        cloud_(cloud),
        h_(h),
        under_(stage.under),
        beyond_(stage.beyond * h),
        options_{stage.max_turn, stage.border_way * h, stage.enough},
        table_(mesh.triangles, mesh.positions.size()),
        cubes_(cubes_of(mesh, h)),
        hopeless_(hopeless),
        may_change_(may_change),
        is_busy_(may_change.size(), 0) {}

  /// The smallest angles first; no two mends change faces around neighbours.
  /// @return number of faces mended
  std::size_t run() {
    std::vector<std::pair<double, std::uint32_t>> order;
    for (const std::uint32_t f : small_faces(mesh_, under_))
      order.emplace_back(angle_of(mesh_.positions, mesh_.triangles[f]), f);
    std::sort(order.begin(), order.end());
    for (const auto& [angle, face] : order)
      mend(face);
    while (!chosen_.empty()) {
      const std::vector<std::uint8_t> fails = apply();
      if (std::find(fails.begin(), fails.end(), 1) == fails.end()) return chosen_.size();
      std::size_t kept = 0;
      for (std::size_t i = 0; i < chosen_.size(); ++i) {
        if (fails[i] == 0 && kept++ != i) chosen_[kept - 1] = std::move(chosen_[i]);
      }
      chosen_.resize(kept);
    }
    return 0;
  }

 private:
  /// Chooses the best mend that the surroundings allow.
  void mend(std::uint32_t face) {
    if (hopeless_.contains(mesh_.triangles[face])) return;
    std::vector<AngleMend> mends = angle_mends(face, mesh_.positions, table_, options_);
    std::vector<std::uint32_t> looked_at = faces_gone(mends);
    looked_at.push_back(face);
    std::erase_if(mends, [&](const AngleMend& mend) { return !all_may_change(mend.gone); });
    const std::size_t possible = mends.size();
    std::erase_if(mends, [&](const AngleMend& mend) { return is_any_busy(mend.gone); });
    const bool waits = mends.size() < possible;
    if (mends.size() > kMostTries) mends.resize(kMostTries);
    auto best = mends.end();
    if (!mends.empty()) {
      const Spot spot(mesh_, table_, cubes_, faces_gone(mends), cloud_, h_, beyond_);
      best = std::find_if(mends.begin(), mends.end(),
                          [&](const AngleMend& mend) { return spot.allows(mend); });
    }
    if (best != mends.end()) {
      choose(std::move(*best));
    } else if (!waits) {
      hopeless_.add(mesh_.triangles[face], box_around(mesh_, table_, looked_at, h_));
    }
  }

  [[nodiscard]] bool all_may_change(const std::vector<std::uint32_t>& faces) const {
    return std::all_of(faces.begin(), faces.end(), [&](std::uint32_t f) {
      const Triangle& t = mesh_.triangles[f];
      return (may_change_[t[0]] & may_change_[t[1]] & may_change_[t[2]]) != 0;
    });
  }
  [[nodiscard]] bool is_any_busy(const std::vector<std::uint32_t>& faces) const {
    return std::any_of(faces.begin(), faces.end(),
                       [&](std::uint32_t f) { return has_flag(is_busy_, mesh_.triangles[f]); });
  }

  void choose(AngleMend mend) {
    for (const std::uint32_t f : mend.gone) {
      for (const std::uint32_t v : mesh_.triangles[f])
        table_.for_each_neighbor(v, [&](std::uint32_t w) { is_busy_[w] = 1; });
    }
    chosen_.push_back(std::move(mend));
  }

  /// Makes all changes, unless some of the faces that come cross each other. @return flags of those
  std::vector<std::uint8_t> apply() {
    TriangleMesh changed = mesh_;
    std::vector<std::uint8_t> goes(mesh_.triangles.size(), 0);
    for (const AngleMend& mend : chosen_) {
      for (const std::uint32_t f : mend.gone)
        goes[f] = 1;
      if (mend.vertex != kNone) changed.positions[mend.vertex] = mend.place;
    }
    remove_triangles(changed.triangles, goes);
    const std::size_t first = changed.triangles.size();
    std::vector<std::uint32_t> faces, mend_of;
    for (std::uint32_t i = 0; i < chosen_.size(); ++i) {
      for (const Triangle& t : chosen_[i].faces) {
        faces.push_back(static_cast<std::uint32_t>(changed.triangles.size()));
        mend_of.push_back(i);
        changed.triangles.push_back(t);
      }
    }
    std::vector<std::uint8_t> fails(chosen_.size(), 0);
    for (const auto& [i, j] : self_intersections(changed, faces)) {
      for (const std::uint32_t f : {i, j}) {
        if (f >= first) fails[mend_of[f - first]] = 1;
      }
    }
    if (std::find(fails.begin(), fails.end(), 1) != fails.end()) return fails;
    Cubes places(bounds_of(mesh_).lower, kCube * h_);
    for (std::size_t f = 0; f < goes.size(); ++f) {
      if (goes[f] != 0) places.add(box_of(mesh_, mesh_.triangles[f]), 0);
    }
    for (const std::uint32_t f : faces)
      places.add(box_of(changed, changed.triangles[f]), 0);
    places.sort();
    hopeless_.forget_near(places);
    mesh_ = std::move(changed);
    return fails;
  }

  TriangleMesh& mesh_;
  const PointGrid& cloud_;
  double h_;
  double under_;
  double beyond_;
  AngleMendOptions options_;
  CornerTable table_;
  Cubes cubes_;
  Hopeless& hopeless_;
  const std::vector<std::uint8_t>& may_change_;
  std::vector<std::uint8_t> is_busy_;  // per position: it or what is around changes in this round
  std::vector<AngleMend> chosen_;
};

/// @param most faces: where there are more, none is mended
/// @return number of places where faces changed
std::size_t mend(TriangleMesh& mesh, const PointGrid& cloud, double h,
                 std::span<const Stage> stages, std::size_t most) {
  const std::vector<std::uint32_t> faces = small_faces(mesh, stages.front().under);
  if (faces.empty() || faces.size() > most) return 0;
  const std::vector<std::uint8_t> flags = vertices_around(mesh, faces);
  FacePart part = part_around(mesh, flags, h);
  std::vector<std::uint8_t> may_change(part.vertices.size());
  for (std::size_t v = 0; v < may_change.size(); ++v)
    may_change[v] = flags[part.vertices[v]];
  std::size_t count = 0;
  for (const Stage& stage : stages) {
    Hopeless hopeless;
    for (int round = 0; round < kRounds; ++round) {
      const std::size_t mended = Round(part.mesh, may_change, cloud, h, stage, hopeless).run();
      if (mended == 0) break;
      count += mended;
    }
  }
  if (count == 0) return 0;
  put_back(std::move(part), mesh);
  remove_unused_vertices(mesh);
  return count;
}

}  // namespace

SmallAngleReport mend_small_angles(TriangleMesh& mesh, const PointGrid& cloud, double pixel_size) {
  SmallAngleReport report;
  const std::size_t count = mesh.triangles.size();
  const auto few = static_cast<std::size_t>(kFew * static_cast<double>(count));
  report.mended = mend(mesh, cloud, pixel_size, kSmall, count);
  report.mended += mend(mesh, cloud, pixel_size, kMedium, few);
  report.left = small_faces(mesh, kSmallAngle).size();
  return report;
}

}  // namespace rangezip

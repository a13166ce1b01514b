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
#include "core/finish/box_cubes.h"
#include "core/finish/corner_table.h"
#include "core/finish/face_part.h"
#include "core/finish/mend_spot.h"
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
constexpr double kEnough = 0.25;  ///< 14 degrees
constexpr std::array kSmall{Stage{kSmallAngle, kEnough, 0.8, 0.5, kNegligibleBeyond},
                            Stage{kSmallAngle, kEnough, 0.5, 0.5, kNegligibleBeyond},
                            Stage{kSmallAngle, kEnough, 0.0, 0.5, 0.02},
                            Stage{kSmallAngle, kEnough, 0.0, 0.5, 0.5},
                            Stage{kSmallAngle, kEnough, 0.0, 0.5, 1.0}};  // all within the reach
constexpr std::array kMedium{
    Stage{0.5, 0.52, 0.97, 0.1, kNegligibleBeyond}};  ///< 30 and 31 degrees
constexpr double kFew =
    0.05;                   ///< of all faces: more with an angle under 30 are what the mesh is like
constexpr int kRounds = 8;  ///< of each stage
constexpr std::size_t kMostTries = 64;  ///< of the mends of a face
constexpr int kRings = 3;               ///< around small angles: what the rounds may change
constexpr double kCube = 4.0;           ///< in h, of the cubes in which faces are looked up
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
  BoxCubes cubes(bounds_of(mesh).lower, kCube * h);
  for (const Triangle& t : mesh.triangles) {
    if (has_flag(flags, t)) cubes.add(widened(box_of(mesh, t), kMendReach * h), 0);
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
BoxCubes cubes_of(const TriangleMesh& mesh, double h) {
  BoxCubes cubes(bounds_of(mesh).lower, kCube * h);
  for (std::uint32_t f = 0; f < mesh.triangles.size(); ++f)
    cubes.add(box_of(mesh, mesh.triangles[f]), f);
  cubes.sort();
  return cubes;
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

/// Faces for which no mend was found, and the boxes of what was looked at: nothing is found in
/// another round either as long as nothing there has changed.
class Hopeless {
 public:
  void add(const Triangle& face, const Box& looked_at) { faces_.emplace(face, looked_at); }
  [[nodiscard]] bool contains(const Triangle& face) const { return faces_.contains(face); }
  void forget_near(const BoxCubes& changed) {
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
        double h, const Stage& stage, Hopeless& hopeless, const Progress& progress)
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
        is_busy_(may_change.size(), 0),
        progress_(progress) {}

  /// The smallest angles first; no two mends change faces around neighbours.
  /// @return number of faces mended
  std::size_t run() {
    std::vector<std::pair<double, std::uint32_t>> order;
    for (const std::uint32_t f : small_faces(mesh_, under_))
      order.emplace_back(angle_of(mesh_.positions, mesh_.triangles[f]), f);
    std::sort(order.begin(), order.end());
    for (const auto& [angle, face] : order) {
      progress_.check_stop();
      mend(face);
    }
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
      const MendSpot spot(mesh_, table_, cubes_, faces_gone(mends), cloud_, h_, beyond_);
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
    for (const auto& [i, j] : self_intersections(changed, faces, {}, progress_)) {
      for (const std::uint32_t f : {i, j}) {
        if (f >= first) fails[mend_of[f - first]] = 1;
      }
    }
    if (std::find(fails.begin(), fails.end(), 1) != fails.end()) return fails;
    forget_hopeless(goes, changed, faces);
    mesh_ = std::move(changed);
    return fails;
  }

  /// Where faces go or come.
  void forget_hopeless(const std::vector<std::uint8_t>& goes, const TriangleMesh& changed,
                       const std::vector<std::uint32_t>& made) {
    BoxCubes places(bounds_of(mesh_).lower, kCube * h_);
    for (std::size_t f = 0; f < goes.size(); ++f) {
      if (goes[f] != 0) places.add(box_of(mesh_, mesh_.triangles[f]), 0);
    }
    for (const std::uint32_t f : made)
      places.add(box_of(changed, changed.triangles[f]), 0);
    places.sort();
    hopeless_.forget_near(places);
  }

  TriangleMesh& mesh_;
  const PointGrid& cloud_;
  double h_;
  double under_;
  double beyond_;
  AngleMendOptions options_;
  CornerTable table_;
  BoxCubes cubes_;
  Hopeless& hopeless_;
  const std::vector<std::uint8_t>& may_change_;
  std::vector<std::uint8_t> is_busy_;  // per position: it or what is around changes in this round
  std::vector<AngleMend> chosen_;
  const Progress& progress_;
};

/// @param most faces: where there are more, none is mended
/// @return number of places where faces changed
std::size_t mend(TriangleMesh& mesh, const PointGrid& cloud, double h,
                 std::span<const Stage> stages, std::size_t most, const Progress& progress) {
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
      const std::size_t mended =
          Round(part.mesh, may_change, cloud, h, stage, hopeless, progress).run();
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

SmallAngleReport mend_small_angles(TriangleMesh& mesh, const PointGrid& cloud, double pixel_size,
                                   const Progress& progress) {
  SmallAngleReport report;
  const std::size_t count = mesh.triangles.size();
  const auto few = static_cast<std::size_t>(kFew * static_cast<double>(count));
  report.mended = mend(mesh, cloud, pixel_size, kSmall, count, progress);
  report.mended += mend(mesh, cloud, pixel_size, kMedium, few, progress);
  report.left = small_faces(mesh, kSmallAngle).size();
  return report;
}

}  // namespace rangezip

#include "core/finish/feature_place.h"

#include <algorithm>
#include <cmath>

#include "core/finish/vertex_geometry.h"

namespace rangezip {
namespace {

// Lengths are in h, angles as cosines, squared distances of points in those of the noise.
constexpr std::size_t kMaxSides = 5;
constexpr double kCornerReach = 0.8;  // of the edges around; of corners none may be missed
constexpr double kEdgeReach = 0.5;    // of the edges around: one of two ends is so near
constexpr double kMaxMove = 2.5;
constexpr double kProofRadius = 0.87;              // of that of the surroundings
constexpr std::array kWiderProofs{1.0, 1.3, 1.7};  // where points are few
constexpr int kMinProofPoints = 8;
constexpr int kMinPointsOfSide = 2;
constexpr double kProofSureness = 1.5;  // standard deviations
constexpr double kSharperShare = 0.5;   // of the residual of a smooth surface
constexpr double kWidestFoot = 1.3;     // radii around a place on a side beside an edge
constexpr double kNoSurface = 0.2;      // residual
constexpr double kBeyond = 0.05;
constexpr double kBeyondShare = 0.15;  // of the points: so few may lie where the side has ended
constexpr int kMinSame = 2;            // points, of a side that has not
constexpr double kSameShare = 0.35;    // of the height of the place or h: these lie as far beyond

/// The points around a place.
struct Proof {
  int count = 0;
  std::array<int, kMaxSides> nearest{};  ///< points, for each side
  double residual2 = 0.0;                ///< mean square distance to the nearest side
};

/// Calls visit(point relative to the origin).
template <class Visit>
void for_each_point(const Surroundings& around, const Vec3& place, double radius, Visit visit) {
  around.cloud.for_each_near(around.origin + place, radius, [&](const Vec3& d) {
    if (glm::dot(d, d) <= radius * radius) visit(place + d);
  });
}

std::size_t side_count(const Surroundings& around) {
  return std::min(around.sides.size(), kMaxSides);
}

Proof proof_at(const Surroundings& around, const Vec3& place, double radius) {
  Proof proof;
  for_each_point(around, place, radius, [&](const Vec3& p) {
    double least = radius;
    std::size_t nearest = 0;
    for (std::size_t i = 0; i < side_count(around); ++i) {
      const double distance = std::abs(around.sides[i].height.at(p));
      if (distance >= least) continue;
      least = distance;
      nearest = i;
    }
    proof.residual2 += least * least;
    ++proof.count;
    ++proof.nearest[nearest];
  });
  if (proof.count > 0) proof.residual2 /= proof.count;
  return proof;
}

bool is_proved(const Surroundings& around, double smooth_residual2, const Vec3& place,
               std::initializer_list<std::size_t> meeting) {
  const double smooth_excess = smooth_residual2 - around.noise2;
  if (!(smooth_excess > around.noise2)) return false;
  const std::optional<double> residual2 = residual2_of_sides(around, place, meeting);
  return residual2 && *residual2 - around.noise2 < kSharperShare * smooth_excess;
}

/// Points nearer to one side than to another: how many are on the place's side of the other, by
/// kSameShare of as far at least, and how many on its far side.
struct Beyond {
  int same = 0, opposite = 0;
};

Beyond points_beyond(const Surroundings& around, const Vec3& place, double radius, std::size_t own,
                     std::size_t other) {
  const SurfaceHeight &on = around.sides[own].height, &over = around.sides[other].height;
  const double height = over.at(place);
  // Points where the two sides meet lie a little above the other, too.
  const double least = kSameShare * std::min(std::abs(height), around.pixel_size);
  Beyond points;
  for_each_point(around, place, radius, [&](const Vec3& p) {
    const double above = height > 0.0 ? over.at(p) : -over.at(p);
    if (std::abs(on.at(p)) >= std::abs(above)) return;
    if (above < 0.0) ++points.opposite;
    if (above > least) ++points.same;
  });
  return points;
}

/// Whether a place on one side lies on the wrong side of another, as hardly a point of the first
/// does, or where the first has no points.
/// @param widest in radii of the surroundings: so far points are asked if nearer ones do not tell
bool is_beyond(const Surroundings& around, const Vec3& place, std::size_t own, std::size_t other,
               double widest) {
  if (std::abs(around.sides[other].height.at(place)) < kBeyond * around.pixel_size) return false;
  for (const double wider : kWiderProofs) {
    if (wider > widest) break;
    const auto [same, opposite] = points_beyond(around, place, wider * around.radius, own, other);
    if (same + opposite >= kMinSame) return same < kMinSame || same <= kBeyondShare * opposite;
  }
  return true;
}

/// Whether the place lies where one of the sides that meet there has ended at another.
bool is_beyond_others(const Surroundings& around, const Vec3& place,
                      std::initializer_list<std::size_t> meeting, double widest = 1.0) {
  for (std::size_t k = 0; k < side_count(around); ++k) {
    if (std::find(meeting.begin(), meeting.end(), k) != meeting.end()) continue;
    for (const std::size_t i : meeting) {
      if (is_beyond(around, place, i, k, widest)) return true;
    }
  }
  return false;
}

/// Takes the place where the given sides meet if it is nearer than the one so far, and proved.
void offer(const Surroundings& around, double smooth_residual2, double reach,
           std::initializer_list<std::size_t> meeting, FeaturePlace& nearest) {
  std::vector<FeatureSide> sides;
  for (const std::size_t i : meeting) {
    for (const FeatureSide& other : sides) {
      if (is_one_side(around.sides[i], other)) return;
    }
    sides.push_back(around.sides[i]);
  }
  const std::optional<Vec3> place = meeting_place(sides);
  const double farthest = nearest.count > 0 ? glm::length(nearest.place) : reach;
  if (!place || !(glm::length(*place) < farthest)) return;
  if (is_beyond_others(around, *place, meeting)) return;
  if (!is_proved(around, smooth_residual2, *place, meeting)) return;
  nearest = {meeting.size(), *place, {}};
  std::copy(meeting.begin(), meeting.end(), nearest.sides.begin());
}

FeaturePlace nearest_corner(const Surroundings& around, double smooth_residual2, double reach) {
  FeaturePlace nearest;
  for (std::size_t i = 0; i < side_count(around); ++i) {
    for (std::size_t j = i + 1; j < side_count(around); ++j) {
      for (std::size_t k = j + 1; k < side_count(around); ++k)
        offer(around, smooth_residual2, reach, {i, j, k}, nearest);
    }
  }
  return nearest;
}

FeaturePlace nearest_edge(const Surroundings& around, double smooth_residual2) {
  FeaturePlace nearest;
  for (std::size_t i = 0; i < side_count(around); ++i) {
    for (std::size_t j = i + 1; j < side_count(around); ++j)
      offer(around, smooth_residual2, kMaxMove * around.pixel_size, {i, j}, nearest);
  }
  return nearest;
}

/// On the nearer of the two sides of an edge.
FeaturePlace nearest_side(const Surroundings& around, double smooth_residual2,
                          const FeaturePlace& edge) {
  FeaturePlace nearest;
  for (const std::size_t own : {edge.sides[0], edge.sides[1]}) {
    const std::optional<Vec3> foot = meeting_place({&around.sides[own], 1});
    if (!foot || (nearest.count > 0 && glm::length(nearest.place) <= glm::length(*foot))) continue;
    if (!is_beyond_others(around, *foot, {own}, kWidestFoot)) nearest = {1, *foot, {own}};
  }
  if (nearest.count > 0 && !is_proved(around, smooth_residual2, nearest.place, {})) return {};
  return nearest;
}

/// On the only side that there is, where the points are no smooth surface at all.
FeaturePlace only_side(const Surroundings& around, double smooth_residual2) {
  const double least = kNoSurface * around.pixel_size;
  if (smooth_residual2 < least * least) return {};
  const std::optional<Vec3> foot = meeting_place({around.sides.data(), 1});
  if (!foot || glm::length(*foot) > kMaxMove * around.pixel_size) return {};
  if (!is_proved(around, smooth_residual2, *foot, {0})) return {};
  return {1, *foot, {0}};
}

}  // namespace

FeaturePlace find_feature_place(const Surroundings& around, double edge, double smooth_residual2) {
  const FeaturePlace corner = nearest_corner(around, smooth_residual2, kCornerReach * edge);
  if (corner.count > 0) return corner;
  if (side_count(around) == 1) return only_side(around, smooth_residual2);
  const FeaturePlace ridge = nearest_edge(around, smooth_residual2);
  if (ridge.count == 0 || glm::length(ridge.place) <= kEdgeReach * edge) return ridge;
  return nearest_side(around, smooth_residual2, ridge);
}

std::optional<double> residual2_of_sides(const Surroundings& around, const Vec3& place,
                                         std::initializer_list<std::size_t> meeting) {
  for (const double wider : kWiderProofs) {
    const Proof proof = proof_at(around, place, wider * kProofRadius * around.radius);
    const bool has_all = std::all_of(meeting.begin(), meeting.end(), [&](std::size_t i) {
      return proof.nearest[i] >= kMinPointsOfSide;
    });
    if (proof.count < kMinProofPoints || !has_all) continue;
    const double limit = around.tolerance * around.pixel_size;
    const double scatter = 1.0 + kProofSureness * std::sqrt(2.0 / proof.count);
    if (!(proof.residual2 < limit * limit + scatter * around.noise2)) return std::nullopt;
    return proof.residual2;
  }
  return std::nullopt;
}

bool is_one_side(const FeatureSide& a, const FeatureSide& b) {
  return has_cosine(a.height.slope, b.height.slope, kFeatureCosine);
}

}  // namespace rangezip

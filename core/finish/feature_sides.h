#pragma once

#include <optional>
#include <span>
#include <vector>

#include "core/base/geometry.h"

namespace rangezip {

/// Cosine of 30 degrees: directions that differ by more are those of two sides of a feature.
inline constexpr double kFeatureCosine = 0.87;

/// How high places lie over a curved surface, to second order, relative to an origin close by:
/// constant + slope . p - p . bending p / 2.
struct SurfaceHeight {
  double constant = 0.0;  ///< model units
  Vec3 slope{0.0};        ///< about a unit vector, away from the solid
  Mat3 bending{0.0};      ///< per model unit

  [[nodiscard]] double at(const Vec3& p) const {
    return constant + glm::dot(slope, p) - 0.5 * glm::dot(p, bending * p);
  }
  [[nodiscard]] Vec3 slope_at(const Vec3& p) const { return slope - bending * p; }
  /// The same relative to p.
  [[nodiscard]] SurfaceHeight seen_from(const Vec3& p) const {
    return {at(p), slope_at(p), bending};
  }
};

/// A surface seen from a place, or several of them as one side of a feature.
struct FeatureSide {
  SurfaceHeight height;
  double weight = 0.0;
};

/// Groups surfaces that are the same at the origin: they differ by less than 25 degrees and less
/// than `step` in height. A side is the weighted mean of its group; the heaviest comes first, and
/// groups with hardly any weight are left out.
/// @param surfaces those with the largest weights first found their groups; weights positive
[[nodiscard]] std::vector<FeatureSide> sides_of(std::vector<FeatureSide> surfaces, double step);

/// The place on all the given sides, one to three, that is nearest to the origin; nothing if they
/// are too much alike to tell, or more.
[[nodiscard]] std::optional<Vec3> meeting_place(std::span<const FeatureSide> sides);

}  // namespace rangezip

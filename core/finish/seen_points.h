#pragma once

#include <array>
#include <cstdint>
#include <span>

#include "core/base/geometry.h"

namespace rangezip {

/// Points of a surface, world positions, and from where they are seen.
struct SeenPoints {
  std::span<const Vec3> points;
  /// Of the first of these, as VisibilityVotes: a direction in 1/127, short where few see the
  /// point. Empty: not known.
  std::span<const std::array<std::int8_t, 3>> votes = {};
};

}  // namespace rangezip

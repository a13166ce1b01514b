#pragma once

#include <vector>

#include "core/base/geometry.h"

namespace rangezip {

/// `count` unit vectors spread evenly over the sphere, without transcendental functions, so that
/// the bits are the same on every machine: a spherical Fibonacci lattice whose golden rotation is
/// applied by repeated multiplication with a constant rotation (re-normalised).
/// @throws InvalidArgument if count < 1.
[[nodiscard]] std::vector<Vec3> sphere_directions(int count);

}  // namespace rangezip

#pragma once

#include <functional>
#include <span>

#include "core/finish/point_grid.h"

namespace rangezip {

/// The points that a mesh was made of, as evidence of where the surface is.
struct CloudEvidence {
  const PointGrid* cloud = nullptr;  ///< none: nothing is known
  double pixel_size = 0.0;           ///< h, model units
};

/// Whether the surface does not lie at a place.
using AirTest = std::function<bool(const Vec3& place)>;

/// For places near a border: there is air where no point is within the reach of kCloseSupport
/// (core/finish/unsupported_faces.h), with the median spacing at vertices of the border. Empty
/// without a cloud, or where it is too sparse to tell.
[[nodiscard]] AirTest air_test(const CloudEvidence& evidence, std::span<const Vec3> border);

}  // namespace rangezip

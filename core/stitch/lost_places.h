#pragma once

#include <vector>

#include "core/stitch/lost_pixels.h"

namespace rangezip {

/// Where a face is gone of which a place has no face within `distance` (model units) any more: for
/// what find_lost_pixels() cannot see, since no pixel centre lies on it. The places are the corners
/// and the centroid or, where sides are longer than `distance`, a lattice finer than that. Returns
/// the pixels nearest to them; those without image are left out. In no order.
/// O(faces near what changed).
[[nodiscard]] std::vector<Pixel> find_lost_places(const SeenMesh& before, const SeenMesh& after,
                                                  const FaceChanges& changes, double distance);

}  // namespace rangezip

#pragma once

#include <vector>

#include "core/finish/feature_place.h"

namespace rangezip {

/// Fits the sides of features to the points around the place, each point to the side it lies on: a
/// few rounds of {least squares of height and slope, points find their sides anew}. Sides that come
/// from surfaces farther away (feature_sides.h) miss the points where these bend differently, as
/// along the rim of a bent side; points next to the place tell, but noise tells more. Bending stays
/// as it is, and so does a side with too few points. Cost: the points within 1.3 radii, a round.
[[nodiscard]] std::vector<FeatureSide> refit_sides(const Surroundings& around);

}  // namespace rangezip

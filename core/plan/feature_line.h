#pragma once

#include <optional>

#include "core/image/range_image.h"

namespace rangezip {

/// A straight line in the image: places p in window coordinates with normal.p = offset.
struct FeatureLine {
  Vec2 normal{1.0, 0.0};  ///< unit
  double offset = 0.0;    ///< pixels
  double length = 0.0;    ///< pixels along which the crease was measured
};

/// The straight crease that shows most in a range image, by its length and by how sharply the
/// surface bends there: the feature line that [Kobbelt, Botsch 2000, 4.1] lets the user align the
/// pixel grid with. Steps of depth are no creases.
///
/// Second differences vote for lines, by direction and offset. The winner is measured in pieces of
/// 6 pixels: on each side a plane is fitted to the samples near the line but not next to it, and
/// the two planes meet at the crease, however the pixels lie. A line through these places is the
/// result: exact between planes, whatever the resolution. Directions are ratios of whole numbers,
/// and votes are whole numbers: the same bits everywhere. O(pixels).
/// @return nothing if there is no crease of more than 20 degrees that is straight for 18 pixels
[[nodiscard]] std::optional<FeatureLine> find_feature_line(const RangeImage& image);

}  // namespace rangezip

#pragma once

#include <cstddef>
#include <cstdint>
#include <vector>

#include "core/base/geometry.h"
#include "core/finish/corner_table.h"
#include "core/finish/share_field.h"

namespace rangezip {

struct FeatureCleanupReport {
  std::size_t collapsed_edges = 0;
  std::size_t flipped_edges = 0;
};

/// Tidies the triangles after vertices were pulled onto features: collapses edges shorter than h/2
/// (never a feature vertex into another kind), turns edges between two faces so that they join
/// feature vertices, and removes slivers by the collapse or flip that leaves the best angles.
/// No valid face turns over but for fins, three faces around a vertex that fold over those beyond
/// them.
/// @param is_feature per vertex: 1 for those on a feature, 2 at a corner of it
/// @param sizes of triangles, in h: where they are smaller, half of that counts
/// @param is_kept vertices whose edges stay; those past its end are not
FeatureCleanupReport clean_features(CornerTable& table, const std::vector<Vec3>& positions,
                                    const std::vector<std::uint8_t>& is_feature, double pixel_size,
                                    const ShareField& sizes,
                                    const std::vector<std::uint8_t>& is_kept);

/// Removes triangles with an angle under 11 degrees by the collapse or flip that leaves the best
/// angles, where no valid face turns by more than 60 degrees but those of a fin.
FeatureCleanupReport remove_slivers(CornerTable& table, const std::vector<Vec3>& positions);

}  // namespace rangezip

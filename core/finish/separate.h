#pragma once

#include <cstdint>
#include <span>
#include <utility>
#include <vector>

#include "core/base/progress.h"
#include "core/finish/finish.h"
#include "core/finish/point_grid.h"
#include "core/mesh/triangle_mesh.h"

namespace rangezip {

/// Faces that pairs name, each as often as they do.
[[nodiscard]] std::vector<std::uint32_t> faces_of_pairs(
    const std::vector<std::pair<std::uint32_t, std::uint32_t>>& pairs);

/// After faces of a clean mesh have changed: untangles those that cross (core/finish/untangle.h),
/// and cuts out and closes again what still does (core/finish/repair.h). Adds to the counts of
/// `report`.
/// @param changed faces; all others are known not to cross each other
/// @return whether something was cut: then vertices have new numbers
bool separate(TriangleMesh& mesh, std::span<const std::uint32_t> changed, const PointGrid& cloud,
              const FinishOptions& options, FinishReport& report, const Progress& progress);

}  // namespace rangezip

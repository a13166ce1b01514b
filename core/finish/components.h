#pragma once

#include <cstdint>
#include <vector>

#include "core/finish/corner_table.h"

namespace rangezip {

/// The component of each face, joined over shared edges, numbered from 0 in order of their first
/// face; deleted faces get CornerTable::kNone. O(faces).
[[nodiscard]] std::vector<std::uint32_t> components_of(const CornerTable& table);

}  // namespace rangezip

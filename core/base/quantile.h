#pragma once

#include <algorithm>
#include <cstddef>
#include <vector>

namespace rangezip {

/// The value that a share of the others do not exceed, by the lower neighbour in sorted order.
/// O(n).
/// @param share in [0, 1]
/// @pre at least one value
[[nodiscard]] inline double quantile(std::vector<double> values, double share) {
  const auto at = static_cast<std::ptrdiff_t>(share * static_cast<double>(values.size() - 1));
  std::nth_element(values.begin(), values.begin() + at, values.end());
  return values[static_cast<std::size_t>(at)];
}

}  // namespace rangezip

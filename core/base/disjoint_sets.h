#pragma once

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <numeric>
#include <vector>

namespace rangezip {

/// The numbers from 0 to a count, sorted into sets that only ever get joined. The lowest number of
/// a set stands for it, whatever the order of the joins. Close to O(1) a call.
class DisjointSets {
 public:
  explicit DisjointSets(std::size_t count = 0) { reset(count); }

  /// Each number is alone again.
  void reset(std::size_t count) {
    parent_.resize(count);
    std::iota(parent_.begin(), parent_.end(), 0U);
  }
  /// The lowest number of the set of `i`; shortens the way to it.
  [[nodiscard]] std::uint32_t find(std::uint32_t i) noexcept {
    while (parent_[i] != i)
      i = parent_[i] = parent_[parent_[i]];
    return i;
  }
  /// @return whether the two were apart until now
  bool join(std::uint32_t i, std::uint32_t j) noexcept {
    const auto [low, high] = std::minmax({find(i), find(j)});
    parent_[high] = low;
    return low != high;
  }

 private:
  std::vector<std::uint32_t> parent_;  ///< of the same set and not higher; its own: the lowest
};

}  // namespace rangezip

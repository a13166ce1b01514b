#pragma once

#include <algorithm>
#include <cmath>
#include <optional>

namespace rangezip {

/// Looks for the excess that pixels have to be chosen for (choose_resolution() in
/// core/reconstruct/resolution.h), from the triangles that earlier runs gave: proportional steps,
/// and between one excess that was too large and one too small their geometric mean.
class ExcessSearch {
 public:
  [[nodiscard]] double excess() const { return excess_; }

  /// @param ratio of the triangles that there are to those that are wanted, positive
  void go_on_from(double ratio) {
    (ratio > 1.0 ? too_many_ : too_few_) = excess_;
    excess_ *= ratio;
    if (!too_many_ || !too_few_) return;
    const auto [low, high] = std::minmax(*too_many_, *too_few_);
    if (!(excess_ > low && excess_ < high)) excess_ = std::sqrt(low * high);
  }

 private:
  double excess_ = 1.0;
  std::optional<double> too_many_;  ///< the latest that gave more than are wanted
  std::optional<double> too_few_;   ///< the latest that gave fewer
};

}  // namespace rangezip

#pragma once

namespace rangezip {

/// tan(angle) with the same bits on every machine and with every C library, which std::tan does not
/// promise: only additions, multiplications and divisions in a fixed order. At most 2 units in the
/// last place off.
/// @pre 0 <= angle < pi / 2 (as a double)
[[nodiscard]] double deterministic_tan(double angle) noexcept;

}  // namespace rangezip

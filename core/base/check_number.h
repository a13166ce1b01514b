#pragma once

#include <string>

namespace rangezip {

/// @param name of what is checked, as `operation: option`
/// @throws InvalidArgument if the value is negative, not finite or not a number.
void check_not_negative(const std::string& name, double value);

/// @throws InvalidArgument if the value is not greater than 0, not finite or not a number.
void check_positive(const std::string& name, double value);

/// @throws InvalidArgument if the value is not in [lowest, highest].
void check_range(const std::string& name, double value, double lowest, double highest);

}  // namespace rangezip

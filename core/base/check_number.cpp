#include "core/base/check_number.h"

#include <cmath>

#include "core/base/error.h"

namespace rangezip {
namespace {

[[noreturn]] void refuse(const std::string& name, const std::string& rule, double value) {
  throw InvalidArgument(name + " must " + rule + ", got " + std::to_string(value));
}

}  // namespace

void check_not_negative(const std::string& name, double value) {
  if (!(value >= 0.0) || !std::isfinite(value)) refuse(name, "be finite and not negative", value);
}

void check_positive(const std::string& name, double value) {
  if (!(value > 0.0) || !std::isfinite(value)) refuse(name, "be positive and finite", value);
}

void check_range(const std::string& name, double value, double lowest, double highest) {
  if (value >= lowest && value <= highest) return;
  refuse(name, "lie in " + std::to_string(lowest) + ".." + std::to_string(highest), value);
}

}  // namespace rangezip

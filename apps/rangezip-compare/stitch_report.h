#pragma once

#include <iosfwd>
#include <nlohmann/json.hpp>
#include <span>
#include <string>

#include "compare/stitch_summary.h"

/// Verdicts on stitches as text and as JSON.
namespace rangezip::compare {

/// A row for each command, then the session in figures, each with its limit.
/// @param commands their names, one for each step
void print_stitches(std::ostream& out, std::span<const std::string> commands,
                    std::span<const StitchStep> steps, const StitchLimits& limits);

/// The same with all counts and every place that is farther than it may be; docs/command-line.md
/// names the members.
[[nodiscard]] nlohmann::ordered_json json_of(std::span<const std::string> commands,
                                             std::span<const StitchStep> steps,
                                             const StitchLimits& limits);

}  // namespace rangezip::compare

#pragma once

#include <nlohmann/json.hpp>
#include <string>

#include "compare/drawing_judge.h"
#include "core/view/view.h"

/// Verdicts on drawings as text and as JSON.
namespace rangezip::compare {

/// "262144 pixels, 101234 covered, identical", or how many differ in what, and why.
[[nodiscard]] std::string text_of(const DrawingCounts& counts);

/// A pixel with what both drawings have there, and their primitives, several lines.
[[nodiscard]] std::string text_of(const PixelDifference& difference);

[[nodiscard]] nlohmann::ordered_json json_of(const DrawingCounts& counts);
[[nodiscard]] nlohmann::ordered_json json_of(const PixelDifference& difference);
[[nodiscard]] nlohmann::ordered_json json_of(const DrawingTolerance& tolerance);

/// The camera, with the members that a session file has for it, so that a view can be drawn again.
[[nodiscard]] nlohmann::ordered_json json_of(const Camera& camera);

}  // namespace rangezip::compare

#pragma once

#include <cstddef>
#include <string>

#include "raster_gl/shader_text.h"

/// Pieces of GLSL that several programs share (shader_text.h).
namespace rangezip::shader_text {

/// What every compute kernel begins with: version, definitions, its number of an invocation.
/// @param group_size invocations of a group
[[nodiscard]] std::string kernel_beginning(const ShaderVariant& variant, std::size_t group_size);

/// snap(): a position on the window's grid (R2-R4, R11).
[[nodiscard]] std::string snapping();

/// plot(): a fragment's way into the image (R9, R12).
[[nodiscard]] std::string plotting();

/// Corners3, corners_of(), Setup, set_up(): a triangle ready to be drawn (R6). Needs plotting().
[[nodiscard]] std::string triangle_setup();

/// edge(), divide(): a triangle's depth at a pixel (R7).
[[nodiscard]] std::string depth_division();

/// What vertex and fragment shaders begin with: version and definitions.
[[nodiscard]] std::string hardware_beginning(const ShaderVariant& variant);

/// What a fragment shader writes, and is_in_band() (R12).
[[nodiscard]] std::string fragment_output();

}  // namespace rangezip::shader_text

#pragma once

#include <string>

#include "raster_gl/shader_text.h"

namespace rangezip {

/// Pixels between the borders of the image and those of the viewport, to the left and below, in
/// which the hardware draws whole triangles; and the viewport's size. A power of two, so that
/// positions on the grid of R3 pass through the viewport unrounded.
inline constexpr int kViewportMargin = 4096;
inline constexpr int kViewportSize = 16'384;

/// Vertex and fragment shaders in GLSL, for drawing by OpenGL's own rasterization.
namespace shader_text {

/// Exact: corners and centres are snapped before (R2-R5), depths computed from the corners (R7);
/// only coverage (R6) and the depth test (R9) are the hardware's.
[[nodiscard]] std::string fixed_point_vertex();
[[nodiscard]] std::string fixed_point_fragment(const ShaderVariant& variant);
[[nodiscard]] std::string fixed_triangle_vertex();
[[nodiscard]] std::string fixed_triangle_fragment(const ShaderVariant& variant);

/// As any program of OpenGL would: a matrix, and the driver's own rounding everywhere.
[[nodiscard]] std::string native_vertex();
/// @param of_points the ID is the vertex's number, else the primitive's
[[nodiscard]] std::string native_fragment(const ShaderVariant& variant, bool of_points);

}  // namespace shader_text

}  // namespace rangezip

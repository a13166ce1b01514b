#pragma once

#include <compare>
#include <string>

namespace rangezip {

/// What fragments do to the image, for programs that draw.
enum class DrawPass {
  depth,   ///< the first of two: the least depth of each pixel
  winner,  ///< the second: the least ID of those with that depth
  key,     ///< both in one, with atomics on 64-bit integers
};

/// What a program is made for; one that draws is compiled for each set in use.
struct ShaderVariant {
  DrawPass pass = DrawPass::depth;
  bool has_band = false;      ///< R12
  bool outside_only = false;  ///< triangles that fixed functions leave out (Place)
  bool wide_rows = false;     ///< R2 in double precision, for drivers whose floats flush denormals
  bool is_central = false;    ///< R4, else R3; of programs that snap positions
  bool has_clip_planes = false;  ///< R11; of programs that snap positions

  friend auto operator<=>(const ShaderVariant&, const ShaderVariant&) = default;
};

/// Pixels between the borders of the image and those of the viewport, to the left and below, in
/// which the hardware draws whole triangles; and the viewport's size. A power of two, so that
/// positions on the grid of R3 pass through the viewport unrounded.
inline constexpr int kViewportMargin = 4096;
inline constexpr int kViewportSize = 16'384;

/// The programs in GLSL, by docs/rasterization.md: a function a file, shader_points.cpp for
/// draw_points(). What several of them share is in shader_parts.h.
namespace shader_text {

// Compute kernels, all in integers but for R2-R4 and candidates of quotients. gl_kernels.h names
// the buffers and tells what each kernel does.
[[nodiscard]] std::string snap_positions(const ShaderVariant& variant);
[[nodiscard]] std::string draw_points(const ShaderVariant& variant);
[[nodiscard]] std::string draw_single_points(const ShaderVariant& variant);
[[nodiscard]] std::string classify_triangles(const ShaderVariant& variant);
[[nodiscard]] std::string draw_small_triangles(const ShaderVariant& variant);
[[nodiscard]] std::string draw_tiles(const ShaderVariant& variant);
[[nodiscard]] std::string fill();
[[nodiscard]] std::string split_keys();
[[nodiscard]] std::string sum_points(const ShaderVariant& variant);

// Vertex and fragment shaders for drawing by OpenGL's own rasterization, exactly: corners and
// centres are snapped before (R2-R5), depths computed from the corners (R7); only coverage (R6) and
// the depth test (R9) are the hardware's.
[[nodiscard]] std::string fixed_point_vertex();
[[nodiscard]] std::string fixed_point_fragment(const ShaderVariant& variant);
[[nodiscard]] std::string fixed_triangle_vertex();
[[nodiscard]] std::string fixed_triangle_fragment(const ShaderVariant& variant);

// The same as any program of OpenGL would have them: a matrix, and the driver's own rounding
// everywhere.
[[nodiscard]] std::string native_vertex(const ShaderVariant& variant);
/// @param of_points the ID is the vertex's number, else the primitive's
[[nodiscard]] std::string native_fragment(const ShaderVariant& variant, bool of_points);

}  // namespace shader_text

}  // namespace rangezip

#pragma once

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
  bool has_band = false;       ///< R12
  bool outside_only = false;   ///< triangles that fixed functions leave out (inside_viewport())
  bool single_pixels = false;  ///< points of size 1, the bulk of a large cloud
  bool wide_rows = false;      ///< R2 in double precision, for drivers whose floats flush denormals
};

/// Compute kernels in GLSL, by docs/rasterization.md. All in integers, but for R2-R4.
/// gl_kernels.h names the buffers and tells what each kernel does.
namespace shader_text {

[[nodiscard]] std::string snap_positions(const ShaderVariant& variant);
[[nodiscard]] std::string draw_points(const ShaderVariant& variant);
[[nodiscard]] std::string classify_triangles(const ShaderVariant& variant);
[[nodiscard]] std::string draw_small_triangles(const ShaderVariant& variant);
[[nodiscard]] std::string draw_tiles(const ShaderVariant& variant);
[[nodiscard]] std::string sum_points(const ShaderVariant& variant);
[[nodiscard]] std::string count_outside(const ShaderVariant& variant);

/// is_inside(corner): whether the hardware draws a triangle of such corners whole, unclipped.
[[nodiscard]] std::string inside_viewport();

}  // namespace shader_text

}  // namespace rangezip

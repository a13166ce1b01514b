#include "compare/drawing_files.h"

#include <algorithm>
#include <cmath>
#include <string>

#include "core/base/error.h"
#include "core/io/image_file.h"

namespace rangezip::compare {

namespace {

std::string text_of(Extent extent) {
  return std::to_string(extent.width) + " x " + std::to_string(extent.height);
}

/// The depth of a pixel in which something is drawn.
std::uint32_t depth_units(double depth, Pixel pixel, const std::filesystem::path& path) {
  if (!(depth >= 0.0 && depth <= 1.0)) {
    throw IoError(path.string() + ": pixel (" + std::to_string(pixel.x) + ", " +
                  std::to_string(pixel.y) + "): a depth must lie in [0, 1] where an ID is, got " +
                  std::to_string(depth));
  }
  const auto units = static_cast<std::uint32_t>(std::lround(std::ldexp(depth, kDepthBits)));
  return std::min(units, kMaxDepth);
}

}  // namespace

Framebuffer read_drawing(const std::filesystem::path& depth, const std::filesystem::path& ids) {
  const Grid<double> depths = read_pfm(depth);
  Framebuffer drawing{.id = read_id_png(ids)};
  const Extent extent = drawing.id.extent();
  if (depths.extent() != extent) {
    throw IoError(depth.string() + ": must be of the size of " + ids.string() + ", " +
                  text_of(extent) + ", got " + text_of(depths.extent()));
  }
  drawing.depth = Grid<std::uint32_t>(extent, kNoDepth);
  for (int y = 0; y < extent.height; ++y) {
    for (Pixel p{0, y}; p.x < extent.width; ++p.x) {
      const bool is_cleared = drawing.id[p] == kNoPrimitive && depths[p] >= 1.0;
      if (!is_cleared) drawing.depth[p] = depth_units(depths[p], p, depth);
    }
  }
  return drawing;
}

}  // namespace rangezip::compare

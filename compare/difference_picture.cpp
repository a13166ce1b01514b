#include "compare/difference_picture.h"

#include <array>

namespace rangezip::compare {

namespace {

constexpr std::array<Rgb, kCauses> kColours{{
    {40, 90, 220},   // edge
    {30, 150, 60},   // depth_tie
    {230, 190, 20},  // depth_rounding
    {150, 60, 190},  // depth_plane
    {230, 20, 20},   // unexplained
}};

Rgb shade_of(std::uint32_t depth) {
  constexpr std::uint32_t kNearest = 220;
  constexpr std::uint32_t kFarthest = 130;
  if (depth > kMaxDepth) return {255, 255, 255};
  const auto grey = static_cast<std::uint8_t>(
      kNearest - (std::uint64_t{kNearest - kFarthest} * depth >> unsigned{kDepthBits}));
  return {grey, grey, grey};
}

}  // namespace

Grid<Rgb> draw_differences(const Framebuffer& reference, const Grid<std::uint8_t>& causes) {
  Grid<Rgb> picture(causes.extent());
  for (std::size_t i = 0; i < causes.pixels().size(); ++i) {
    const std::uint8_t cause = causes.pixels()[i];
    picture.pixels()[i] =
        cause == 0 ? shade_of(reference.depth.pixels()[i]) : kColours[std::size_t{cause} - 1];
  }
  return picture;
}

}  // namespace rangezip::compare

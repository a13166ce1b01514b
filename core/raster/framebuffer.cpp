#include "core/raster/framebuffer.h"

#include <string>
#include <tuple>

#include "core/base/error.h"

namespace rangezip {

namespace {

std::string to_text(Extent extent) {
  return std::to_string(extent.width) + " x " + std::to_string(extent.height);
}

}  // namespace

Framebuffer make_framebuffer(Extent extent) {
  return {.depth = Grid<std::uint32_t>(extent, kNoDepth),
          .id = Grid<PrimitiveId>(extent, kNoPrimitive)};
}

void set_extent(Framebuffer& image, Extent extent) {
  if (image.depth.extent() != extent) image.depth.reset(extent);
  if (image.id.extent() != extent) image.id.reset(extent);
}

void composite(Framebuffer& onto, const Framebuffer& from) {
  for (const Extent extent : {onto.id.extent(), from.depth.extent(), from.id.extent()}) {
    if (extent == onto.depth.extent()) continue;
    throw InvalidArgument("composite: the framebuffers must have one extent, got " +
                          to_text(onto.depth.extent()) + " and " + to_text(extent));
  }
  const auto depth = onto.depth.pixels();
  const auto id = onto.id.pixels();
  const auto other_depth = from.depth.pixels();
  const auto other_id = from.id.pixels();
  for (std::size_t i = 0; i < depth.size(); ++i) {
    // R9. An empty pixel is all ones and loses to everything.
    if (std::tie(other_depth[i], other_id[i]) < std::tie(depth[i], id[i])) {
      depth[i] = other_depth[i];
      id[i] = other_id[i];
    }
  }
}

}  // namespace rangezip

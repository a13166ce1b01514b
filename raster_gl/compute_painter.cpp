#include "raster_gl/compute_painter.h"

#include <algorithm>
#include <variant>

namespace rangezip {

ComputePainter::ComputePainter(const ComputeTools& tools)
    : tools_(tools),
      target_(tools),
      triangles_(tools, target_),
      rows_(tools.device),
      counters_(tools.device) {}

DrawReport ComputePainter::draw(const View& view, std::span<const DrawItem> items,
                                const DepthBand* band, Framebuffer& out) {
  set_extent(out, view.extent());
  DrawReport report;
  for (const ImagePart& part : parts_of(view.extent(), target_.most_pixels())) {
    const bool is_counting = part.first_row == 0;  // every part sees all points
    target_.begin(part, band);
    for (std::size_t i = items.size(); i-- > 0;) {
      if (const auto* points = std::get_if<DrawPoints>(&items[i])) {
        const auto rows = make_row_transform(view, points->world_from_item);
        report.dropped_points += draw_points(*points, rows, is_counting);
      } else {
        const auto& triangles = std::get<DrawTriangles>(items[i]);
        const auto rows = make_row_transform(view, triangles.world_from_item);
        const std::size_t dropped = triangles_.draw(triangles, rows);
        if (is_counting) report.dropped_triangles += dropped;
      }
    }
    target_.read(out);
  }
  return report;
}

/// @return points that R3 or R4 rejects; 0 unless they are counted
std::size_t ComputePainter::draw_points(const DrawPoints& points, const RowTransform& rows,
                                        bool is_counting) {
  // Larger points have the invocations of a group's width: what one does stays short.
  constexpr int kLargestAlone = 8;
  constexpr std::size_t kManyLanes = 64;
  const bool is_single = points.point_size == 1;
  const std::size_t lanes = points.point_size <= kLargestAlone ? 1 : kManyLanes;
  const std::size_t chunk = tools_.chunk_of(sizeof(Vec3f));
  rows_.upload(rows);
  counters_.restart(tools_.kernels);
  for (std::size_t end = points.positions.size(); end > 0;) {
    const std::size_t begin = (end - 1) / chunk * chunk;
    const std::size_t count = end - begin;
    const GlBuffer& positions =
        tools_.uploads.get({.content_key = points.content_key, .first = begin, .count = count},
                           points.positions.subspan(begin, count));
    for (const DrawPass pass : target_.passes()) {
      ShaderVariant variant = rows_.variant(tools_.setup);
      variant.pass = pass;
      const GlProgram& program =
          target_.kernel(is_single ? Kernel::draw_single_points : Kernel::draw_points, variant);
      rows_.bind(tools_.kernels, program, positions);
      program.set("count", static_cast<unsigned>(count));
      program.set("first_id", points.first_id + static_cast<PrimitiveId>(begin));
      program.set("point_size", points.point_size);
      program.set("lanes", static_cast<unsigned>(lanes));
      program.set("is_counting", is_counting && pass == target_.passes().front() ? 1U : 0U);
      tools_.kernels.dispatch(program, groups_of(count * lanes, kPointGroup));
    }
    tools_.device.check("drawing points");
    end = begin;
  }
  return is_counting ? counters_.read()[static_cast<std::size_t>(Counter::rejected_points)] : 0;
}

}  // namespace rangezip

#include "compare/checked_rasterizer.h"

#include <utility>

namespace rangezip::compare {

namespace {

bool same(const DrawReport& a, const DrawReport& b) {
  return a.dropped_points == b.dropped_points && a.dropped_triangles == b.dropped_triangles;
}

DrawingDifference difference_of(const char* operation, const Framebuffer& reference,
                                const Framebuffer& candidate) {
  DrawingDifference difference{.operation = operation};
  const Extent extent = reference.id.extent();
  for (int y = 0; y < extent.height; ++y) {
    for (Pixel p{0, y}; p.x < extent.width; ++p.x) {
      if (reference.id[p] == candidate.id[p] && reference.depth[p] == candidate.depth[p]) continue;
      ++difference.pixels;
      if (!difference.first) difference.first = p;
    }
  }
  return difference;
}

DrawingDifference difference_of(const Grid<PixelMoments>& reference,
                                const Grid<PixelMoments>& candidate) {
  DrawingDifference difference{.operation = "accumulate"};
  const Extent extent = reference.extent();
  for (int y = 0; y < extent.height; ++y) {
    for (Pixel p{0, y}; p.x < extent.width; ++p.x) {
      if (reference[p] == candidate[p]) continue;
      ++difference.pixels;
      if (!difference.first) difference.first = p;
    }
  }
  return difference;
}

}  // namespace

DrawingsRecord CheckedRasterizer::take_record() {
  return std::exchange(record_, {});
}

void CheckedRasterizer::record(DrawingDifference difference, bool same_report) {
  difference.number = record_.drawings++;
  if (difference.pixels == 0 && same_report) return;
  ++record_.different;
  if (!record_.first) record_.first = std::move(difference);
}

DrawReport CheckedRasterizer::do_render(const View& view, std::span<const DrawItem> items,
                                        Framebuffer& out) {
  Framebuffer expected;
  const DrawReport expected_report = reference_.render(view, items, expected);
  const DrawReport report = candidate_.render(view, items, out);
  record(difference_of("render", expected, out), same(report, expected_report));
  return report;
}

DrawReport CheckedRasterizer::do_render_in_band(const View& view, std::span<const DrawItem> items,
                                                const DepthBand& band, Framebuffer& out) {
  Framebuffer expected;
  const DrawReport expected_report = reference_.render_in_band(view, items, band, expected);
  const DrawReport report = candidate_.render_in_band(view, items, band, out);
  record(difference_of("render_in_band", expected, out), same(report, expected_report));
  return report;
}

DrawReport CheckedRasterizer::do_accumulate(const View& view, std::span<const DrawItem> items,
                                            const AccumulateWindow& window,
                                            Grid<PixelMoments>& out) {
  Grid<PixelMoments> expected;
  const DrawReport expected_report = reference_.accumulate(view, items, window, expected);
  const DrawReport report = candidate_.accumulate(view, items, window, out);
  record(difference_of(expected, out), same(report, expected_report));
  return report;
}

}  // namespace rangezip::compare

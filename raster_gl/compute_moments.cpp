#include "raster_gl/compute_moments.h"

#include <algorithm>
#include <string>
#include <type_traits>
#include <variant>

#include "core/base/error.h"

namespace rangezip {

// The device's sums are read into these as they lie in memory.
static_assert(std::is_standard_layout_v<PixelMoments> &&
              sizeof(PixelMoments) == 10 * sizeof(std::int64_t));

ComputeMoments::ComputeMoments(const ComputeTools& tools)
    : tools_(tools),
      rows_(tools.device),
      counters_(tools.device),
      votes_(tools.device),
      lower_(tools.device),
      upper_(tools.device),
      reference_(tools.device),
      sums_(tools.device),
      counts_(tools.device) {
  votes_.reserve(sizeof(std::uint32_t), "votes");
}

DrawReport ComputeMoments::add(const View& view, std::span<const DrawItem> items,
                               const AccumulateWindow& window, Grid<PixelMoments>& out) {
  out.reset(view.extent());
  DrawReport report;
  const std::size_t most_pixels = tools_.setup.block_bytes / sizeof(PixelMoments);
  for (const ImagePart& part : parts_of(view.extent(), most_pixels)) {
    const bool is_counting = part.first_row == 0;  // every part sees all points
    begin(part, window);
    for (const DrawItem& item : items) {
      const auto* points = std::get_if<DrawPoints>(&item);
      if (points == nullptr) continue;
      rows_.upload(make_row_transform(view, points->world_from_item));
      add_points(*points, part, window.shift, is_counting);
    }
    check_counts(part);
    const auto counters = counters_.read();
    report.dropped_points += counters[static_cast<std::size_t>(Counter::rejected_points)];
    sums_.download(part.of(out.pixels()));
  }
  return report;
}

void ComputeMoments::begin(const ImagePart& part, const AccumulateWindow& window) {
  tools_.device.enter(GlPhase::draw);
  lower_.upload(part.of(window.band.lower.pixels()), "the window");
  upper_.upload(part.of(window.band.upper.pixels()), "the window");
  reference_.upload(part.of(window.reference.pixels()), "the window");
  const std::size_t bytes = part.pixels() * sizeof(PixelMoments);
  sums_.reserve(bytes, "sums");
  tools_.kernels.fill(sums_, bytes, 0);
  const std::size_t count_bytes = part.pixels() * sizeof(std::uint32_t);
  counts_.reserve(count_bytes, "counts");
  tools_.kernels.fill(counts_, count_bytes, 0);
  const Kernels& kernels = tools_.kernels;
  counters_.restart(kernels);
  kernels.bind(Binding::lower, lower_);
  kernels.bind(Binding::upper, upper_);
  kernels.bind(Binding::reference, reference_);
  kernels.bind(Binding::sums, sums_);
  kernels.bind(Binding::counts, counts_);
}

void ComputeMoments::add_points(const DrawPoints& points, const ImagePart& part, int shift,
                                bool is_counting) {
  ShaderVariant variant = rows_.variant(tools_.setup);
  if (tools_.setup.has_atomic_int64) variant.pass = DrawPass::key;
  const GlProgram& program = tools_.kernels.get(Kernel::sum_points, variant);
  program.set("width", part.extent.width);
  program.set("first_row", part.first_row);
  program.set("row_count", part.row_count);
  program.set("shift", shift);
  program.set("has_votes", points.votes.empty() ? 0U : 1U);
  program.set("is_counting", is_counting ? 1U : 0U);
  const std::size_t chunk = tools_.chunk_of(sizeof(Vec3f));
  for (std::size_t begin = 0; begin < points.positions.size(); begin += chunk) {
    const std::size_t count = std::min(chunk, points.positions.size() - begin);
    const GlBuffer& positions =
        tools_.uploads.get({.content_key = points.content_key, .first = begin, .count = count},
                           points.positions.subspan(begin, count));
    if (!points.votes.empty()) votes_.upload(points.votes.subspan(begin, count), "votes");
    tools_.kernels.bind(Binding::votes, votes_);
    rows_.bind(tools_.kernels, program, positions);
    program.set("count", static_cast<unsigned>(count));
    tools_.kernels.dispatch(program, groups_of(count, kPointGroup));
    tools_.device.check("summing points");
  }
}

void ComputeMoments::check_counts(const ImagePart& part) const {
  const std::uint32_t full = counters_.read()[static_cast<std::size_t>(Counter::full_pixel)];
  if (full == 0) return;
  const auto width = static_cast<std::uint32_t>(part.extent.width);
  const std::uint32_t column = (full - 1) % width;
  const std::uint32_t row = (full - 1) / width + static_cast<std::uint32_t>(part.first_row);
  throw Error("accumulate: a pixel takes at most 2^19 points, more lie around pixel (" +
              std::to_string(column) + ", " + std::to_string(row) + "); use smaller pixels");
}

}  // namespace rangezip

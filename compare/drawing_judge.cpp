#include "compare/drawing_judge.h"

#include <algorithm>
#include <bit>
#include <numeric>
#include <string>
#include <vector>

#include "core/base/error.h"

namespace rangezip::compare {

namespace {

constexpr std::size_t kSides = 2;  // the reference and the candidate

/// R9: depth first, then ID, as one number.
std::uint64_t key_of(std::uint64_t depth, PrimitiveId id) {
  return depth << 32U | id;
}

/// One drawing's say in a pixel, and what the primitives say about it.
struct Side {
  std::uint32_t depth = kNoDepth;
  PrimitiveId id = kNoPrimitive;
  bool is_possible = false;  ///< what it shows may be there, at this depth
  bool must_cover = false;   ///< and covers the pixel in any case

  [[nodiscard]] bool is_drawn() const { return id != kNoPrimitive; }
};

struct DifferingPixel {
  Pixel pixel;
  std::array<Side, kSides> sides;
  std::uint64_t surest = key_of(kNoDepth, kNoPrimitive);  ///< farthest that anything may be shown
};

void check_arguments(const View& view, const Framebuffer& reference, const Framebuffer& candidate,
                     const DrawingTolerance& tolerance) {
  for (const Extent extent : {reference.depth.extent(), reference.id.extent(),
                              candidate.depth.extent(), candidate.id.extent()}) {
    if (extent == view.extent()) continue;
    throw InvalidArgument("judge_drawing: the extents must be that of the view, " +
                          std::to_string(view.extent().width) + " x " +
                          std::to_string(view.extent().height) + ", got " +
                          std::to_string(extent.width) + " x " + std::to_string(extent.height));
  }
  if (tolerance.edge < 0 || tolerance.slope < tolerance.edge || tolerance.depth < 0) {
    throw InvalidArgument("judge_drawing: 0 <= edge <= slope and 0 <= depth must hold, got edge " +
                          std::to_string(tolerance.edge) + ", slope " +
                          std::to_string(tolerance.slope) + ", depth " +
                          std::to_string(tolerance.depth));
  }
}

Side side_of(const Framebuffer& drawing, std::size_t index) {
  const std::uint32_t depth = drawing.depth.pixels()[index];
  const PrimitiveId id = drawing.id.pixels()[index];
  return {.depth = depth, .id = id, .is_possible = depth == kNoDepth && id == kNoPrimitive};
}

/// Row by row, each from the left.
std::vector<DifferingPixel> differing_pixels(const Framebuffer& reference,
                                             const Framebuffer& candidate) {
  std::vector<DifferingPixel> pixels;
  const Extent extent = reference.id.extent();
  for (int y = 0; y < extent.height; ++y) {
    for (int x = 0; x < extent.width; ++x) {
      const std::size_t i = extent.index({x, y});
      const Side expected = side_of(reference, i);
      const Side found = side_of(candidate, i);
      if (expected.depth == found.depth && expected.id == found.id) continue;
      pixels.push_back({.pixel = {x, y}, .sides = {expected, found}});
    }
  }
  return pixels;
}

/// What the fit of one more primitive says about a pixel.
void add_evidence(PrimitiveId id, const PixelFit& fit, DifferingPixel& pixel) {
  if (!fit.may_cover) return;
  if (fit.must_be_drawn()) {
    pixel.surest = std::min(pixel.surest, key_of(static_cast<std::uint64_t>(fit.farthest), id));
  }
  for (Side& side : pixel.sides) {
    if (side.id != id) continue;
    side.is_possible =
        side.depth <= kMaxDepth && side.depth >= fit.nearest && side.depth <= fit.farthest;
    side.must_cover = fit.must_cover;
  }
}

/// The differing pixels, findable by their rows and, since most primitives are small, by blocks of
/// their rows.
class RowsOfPixels {
 public:
  RowsOfPixels(std::span<DifferingPixel> pixels, Extent extent)
      : pixels_(pixels),
        blocks_{extent.width / kBlock + 1, extent.height},
        starts_(blocks_.count() + 1, 0) {
    for (const DifferingPixel& pixel : pixels)
      ++starts_[block_of(pixel.pixel.x, pixel.pixel.y) + 1];
    std::partial_sum(starts_.begin(), starts_.end(), starts_.begin());
  }

  /// Those of row y in the columns first..last.
  [[nodiscard]] std::span<DifferingPixel> between(int y, int first, int last) const {
    const std::size_t start = starts_[block_of(first, y)];
    const auto near = pixels_.subspan(start, starts_[block_of(last, y) + 1] - start);
    const auto begin = std::partition_point(
        near.begin(), near.end(), [&](const DifferingPixel& p) { return p.pixel.x < first; });
    const auto end = std::partition_point(
        begin, near.end(), [&](const DifferingPixel& p) { return p.pixel.x <= last; });
    return {begin, end};
  }

 private:
  static constexpr int kBlock = 8;  // pixels; most primitives lie in one or two

  [[nodiscard]] std::size_t block_of(int x, int y) const { return blocks_.index({x / kBlock, y}); }

  std::span<DifferingPixel> pixels_;
  Extent blocks_;
  std::vector<std::size_t> starts_;  ///< block b is [starts_[b], starts_[b + 1])
};

/// Asks one primitive about the differing pixels that it may reach.
void ask(const SnappedPrimitive& primitive, const PixelBox& box, const DrawingTolerance& tolerance,
         const RowsOfPixels& rows) {
  for (int y = box.first.y; y <= box.last.y; ++y) {
    for (DifferingPixel& pixel : rows.between(y, box.first.x, box.last.x)) {
      add_evidence(primitive.id, fit_of(primitive, pixel.pixel, tolerance), pixel);
    }
  }
}

void gather_evidence(const View& view, std::span<const DrawItem> items,
                     const DrawingTolerance& tolerance, std::span<DifferingPixel> pixels) {
  const RowsOfPixels rows(pixels, view.extent());
  SnappedPrimitive primitive;
  for (const DrawItem& item : items) {
    const SnappedItem snapped = snap_item(view, item);
    for (std::size_t i = 0; i < primitive_count(item); ++i) {
      get_primitive(snapped, i, primitive);
      ask(primitive, reach_of(primitive, tolerance, view.extent()), tolerance, rows);
    }
  }
}

Difference difference_of(const DifferingPixel& pixel) {
  const auto& [reference, candidate] = pixel.sides;
  if (reference.id == candidate.id) return Difference::depth;
  return reference.is_drawn() && candidate.is_drawn() ? Difference::id : Difference::coverage;
}

/// Whether some renderer within the tolerance may show this.
bool is_plausible(const Side& side, std::uint64_t surest) {
  return side.is_possible && key_of(side.depth, side.id) <= surest;
}

Cause cause_of(const DifferingPixel& pixel) {
  for (const Side& side : pixel.sides) {
    if (!is_plausible(side, pixel.surest)) return Cause::unexplained;
  }
  const Difference difference = difference_of(pixel);
  if (difference == Difference::depth) return Cause::depth_rounding;
  for (const Side& side : pixel.sides) {
    if (side.is_drawn() && !side.must_cover) return Cause::edge;
  }
  return difference == Difference::id ? Cause::depth_tie : Cause::depth_plane;
}

void count_depth_step(const DifferingPixel& pixel, DrawingCounts& counts) {
  const auto& [reference, candidate] = pixel.sides;
  if (reference.depth > kMaxDepth || candidate.depth > kMaxDepth) return;  // no step: torn
  const std::uint32_t step =
      std::max(reference.depth, candidate.depth) - std::min(reference.depth, candidate.depth);
  ++counts.depth_steps[static_cast<std::size_t>(std::bit_width(step / 2))];
  counts.largest_depth_step = std::max(counts.largest_depth_step, step);
}

PixelContent content_of(const View& view, std::span<const DrawItem> items, const Side& side,
                        Pixel pixel, const DrawingTolerance& tolerance) {
  PixelContent content{.depth = side.depth, .id = side.id};
  for (const DrawItem& item : items) {
    if (side.id < first_id(item) || side.id - first_id(item) >= primitive_count(item)) continue;
    content.primitive.emplace();
    get_primitive(snap_item(view, item), side.id - first_id(item), *content.primitive);
    content.fit = fit_of(*content.primitive, pixel, tolerance);
  }
  return content;
}

PixelDifference describe(const View& view, std::span<const DrawItem> items,
                         const DifferingPixel& pixel, const DrawingTolerance& tolerance) {
  return {.pixel = pixel.pixel,
          .difference = difference_of(pixel),
          .cause = cause_of(pixel),
          .reference = content_of(view, items, pixel.sides[0], pixel.pixel, tolerance),
          .candidate = content_of(view, items, pixel.sides[1], pixel.pixel, tolerance)};
}

}  // namespace

std::size_t DrawingCounts::of(Difference difference) const noexcept {
  const auto& row = different[static_cast<std::size_t>(difference)];
  return std::accumulate(row.begin(), row.end(), std::size_t{0});
}

std::size_t DrawingCounts::of(Cause cause) const noexcept {
  std::size_t sum = 0;
  for (const auto& row : different)
    sum += row[static_cast<std::size_t>(cause)];
  return sum;
}

DrawingCounts& DrawingCounts::operator+=(const DrawingCounts& other) noexcept {
  pixels += other.pixels;
  covered += other.covered;
  identical += other.identical;
  for (std::size_t d = 0; d < kDifferences; ++d) {
    for (std::size_t c = 0; c < kCauses; ++c)
      different[d][c] += other.different[d][c];
  }
  for (std::size_t k = 0; k < depth_steps.size(); ++k)
    depth_steps[k] += other.depth_steps[k];
  largest_depth_step = std::max(largest_depth_step, other.largest_depth_step);
  return *this;
}

DrawingVerdict judge_drawing(const View& view, std::span<const DrawItem> items,
                             const Framebuffer& reference, const Framebuffer& candidate,
                             const DrawingTolerance& tolerance) {
  check_arguments(view, reference, candidate, tolerance);
  std::vector<DifferingPixel> pixels = differing_pixels(reference, candidate);
  if (!pixels.empty()) gather_evidence(view, items, tolerance, pixels);

  DrawingVerdict verdict{.causes = Grid<std::uint8_t>(view.extent(), 0)};
  DrawingCounts& counts = verdict.counts;
  counts.pixels = view.extent().count();
  counts.identical = counts.pixels - pixels.size();
  const auto ids = reference.id.pixels();
  counts.covered =
      counts.pixels - static_cast<std::size_t>(std::count(ids.begin(), ids.end(), kNoPrimitive));
  const DifferingPixel* first_unexplained = nullptr;
  for (const DifferingPixel& pixel : pixels) {
    const Difference difference = difference_of(pixel);
    const Cause cause = cause_of(pixel);
    ++counts.different[static_cast<std::size_t>(difference)][static_cast<std::size_t>(cause)];
    if (difference == Difference::depth) count_depth_step(pixel, counts);
    verdict.causes[pixel.pixel] = static_cast<std::uint8_t>(1 + static_cast<int>(cause));
    if (cause == Cause::unexplained && first_unexplained == nullptr) first_unexplained = &pixel;
  }
  if (!pixels.empty()) verdict.first = describe(view, items, pixels.front(), tolerance);
  if (first_unexplained != nullptr) {
    verdict.first_unexplained = describe(view, items, *first_unexplained, tolerance);
  }
  return verdict;
}

}  // namespace rangezip::compare

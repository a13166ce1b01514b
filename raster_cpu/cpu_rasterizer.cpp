#include "raster_cpu/cpu_rasterizer.h"

#include <algorithm>
#include <vector>

#include "core/base/error.h"
#include "core/base/parallel.h"
#include "raster_cpu/fixed_point.h"
#include "raster_cpu/key_buffer.h"
#include "raster_cpu/point_moments.h"
#include "raster_cpu/point_raster.h"
#include "raster_cpu/simd_kernels.h"
#include "raster_cpu/triangle_raster.h"

namespace rangezip {

namespace {

constexpr std::string_view kScalar = "scalar";

/// Into how many parts a scene is cut, each drawn into its own buffer. A part must be worth the
/// clearing and merging of its buffer. Their number cannot show: the minimum of the keys does not
/// depend on the order (R9).
std::size_t part_count(std::span<const DrawItem> items, Extent extent) {
  constexpr std::size_t kLeastPrimitives = std::size_t{1} << 16;
  std::size_t primitives = 0;
  for (const DrawItem& item : items)
    primitives += primitive_count(item);
  const std::size_t worthwhile = primitives / std::max(kLeastPrimitives, extent.count() / 2);
  return std::clamp<std::size_t>(worthwhile, 1, static_cast<std::size_t>(thread_count()));
}

std::size_t blocks_in(std::size_t count, std::size_t grain) {
  return (count + grain - 1) / grain;
}

/// R2-R4 and R11. @return number rejected by R3 or R4
std::size_t snap(const RowTransform& rows, std::span<const Vec3f> positions,
                 std::span<SnappedPosition> snapped, const SimdKernels* kernels) {
  KernelReport done;
  if (kernels != nullptr) done = kernels->snap(rows, positions, snapped);
  const auto from = positions.subspan(done.processed);
  const auto to = snapped.subspan(done.processed);
  done.rejected += snap_positions(rows, from, to);
  reject_clipped(rows, from, to);
  return done.rejected;
}

/// Snaps positions for several threads. @return number rejected by R3 or R4.
std::size_t snap_in_parallel(const RowTransform& rows, std::span<const Vec3f> positions,
                             std::span<SnappedPosition> snapped, const SimdKernels* kernels) {
  constexpr std::size_t kGrain = std::size_t{1} << 14;
  std::vector<std::size_t> rejected(blocks_in(positions.size(), kGrain));
  parallel_for(positions.size(), kGrain, [&](std::size_t begin, std::size_t end) {
    const auto from = positions.subspan(begin, end - begin);
    const auto to = snapped.subspan(begin, end - begin);
    rejected[begin / kGrain] = snap(rows, from, to, kernels);
  });
  std::size_t sum = 0;
  for (const std::size_t count : rejected)
    sum += count;
  return sum;
}

/// Draws one item, its k-th part into the k-th buffer, and counts what was dropped.
class ItemPainter {
 public:
  ItemPainter(const View& view, const DepthBand* band, std::vector<std::vector<PixelKey>>& buffers,
              std::size_t parts, std::vector<SnappedPosition>& scratch, const SimdKernels* kernels)
      : view_(view),
        band_(band),
        buffers_(buffers),
        parts_(parts),
        scratch_(scratch),
        kernels_(kernels) {}

  void operator()(const DrawPoints& points) {
    const RowTransform rows = make_row_transform(view_, points.world_from_item);
    report_.dropped_points += draw_parts(
        points.positions.size(), [&](std::size_t begin, std::size_t end, const DrawTarget& target) {
          return draw_points(points, rows, begin, end, target, kernels_);
        });
  }

  void operator()(const DrawTriangles& item) {
    const RowTransform rows = make_row_transform(view_, item.world_from_item);
    if (scratch_.size() < item.positions.size()) scratch_.resize(item.positions.size());
    const auto snapped = std::span(scratch_).first(item.positions.size());
    snap_in_parallel(rows, item.positions, snapped, kernels_);
    report_.dropped_triangles += draw_parts(
        item.triangles.size(), [&](std::size_t begin, std::size_t end, const DrawTarget& target) {
          return draw_triangles(item, rows, snapped, begin, end, target);
        });
  }

  [[nodiscard]] DrawReport report() const { return report_; }

 private:
  template <class Draw>
  std::size_t draw_parts(std::size_t count, const Draw& draw) {
    std::vector<std::size_t> dropped(parts_);
    parallel_for(parts_, 1, [&](std::size_t first, std::size_t last) {
      for (std::size_t part = first; part < last; ++part) {
        const DrawTarget target{.extent = view_.extent(),
                                .keys = std::span(buffers_[part]).first(view_.extent().count()),
                                .band = band_};
        dropped[part] = draw(count * part / parts_, count * (part + 1) / parts_, target);
      }
    });
    std::size_t sum = 0;
    for (const std::size_t n : dropped)
      sum += n;
    return sum;
  }

  const View& view_;
  const DepthBand* band_;
  std::vector<std::vector<PixelKey>>& buffers_;
  std::size_t parts_;
  std::vector<SnappedPosition>& scratch_;
  const SimdKernels* kernels_;
  DrawReport report_;
};

}  // namespace

/// Memory that is kept from call to call.
struct CpuRasterizer::Workspace {
  std::vector<std::vector<PixelKey>> keys;  ///< one buffer per part of the scene
  std::vector<SnappedPosition> snapped;
  std::vector<std::uint32_t> counts;
  RowBins bins;
};

std::vector<std::string> cpu_instructions() {
  std::vector<std::string> names;
  for (const SimdKernels& kernels : simd_kernels())
    names.push_back(kernels.name);
  names.emplace_back(kScalar);
  return names;
}

CpuRasterizer::CpuRasterizer() : CpuRasterizer(cpu_instructions().front()) {}

CpuRasterizer::CpuRasterizer(std::string_view instructions)
    : workspace_(std::make_unique<Workspace>()) {
  if (instructions == kScalar) return;
  for (const SimdKernels& kernels : simd_kernels()) {
    if (kernels.name == instructions) kernels_ = &kernels;
  }
  if (kernels_ == nullptr) {
    throw InvalidArgument("CpuRasterizer: this machine has no instructions named \"" +
                          std::string(instructions) + "\"");
  }
}

CpuRasterizer::~CpuRasterizer() = default;

RasterizerInfo CpuRasterizer::info() const {
  return {.name = "cpu",
          .max_extent = {kMaxRasterExtent, kMaxRasterExtent},
          .max_point_size = kMaxPointSize,
          .subpixel_bits = kSubpixelBits,
          .reproducible = true};
}

DrawReport CpuRasterizer::draw(const View& view, std::span<const DrawItem> items,
                               const DepthBand* band, Framebuffer& out) {
  const std::size_t pixels = view.extent().count();
  auto& keys = workspace_->keys;
  const std::size_t parts = part_count(items, view.extent());
  keys.resize(std::max(keys.size(), parts));
  parallel_for(parts, 1, [&](std::size_t first, std::size_t last) {
    for (std::size_t part = first; part < last; ++part)
      keys[part].assign(pixels + kKeyPadding, kEmptyPixel);
  });
  ItemPainter painter(view, band, keys, parts, workspace_->snapped, kernels_);
  for (const DrawItem& item : items)
    std::visit(painter, item);
  constexpr std::size_t kGrain = std::size_t{1} << 16;
  parallel_for(pixels, kGrain, [&](std::size_t begin, std::size_t end) {
    for (std::size_t part = 1; part < parts; ++part) {
      merge_keys(std::span(keys[0]).subspan(begin, end - begin),
                 std::span(keys[part]).subspan(begin, end - begin));
    }
  });
  unpack_keys(std::span(keys[0]).first(pixels), view.extent(), out);
  return painter.report();
}

DrawReport CpuRasterizer::do_render(const View& view, std::span<const DrawItem> items,
                                    Framebuffer& out) {
  return draw(view, items, nullptr, out);
}

DrawReport CpuRasterizer::do_render_in_band(const View& view, std::span<const DrawItem> items,
                                            const DepthBand& band, Framebuffer& out) {
  return draw(view, items, &band, out);
}

DrawReport CpuRasterizer::do_accumulate(const View& view, std::span<const DrawItem> items,
                                        const AccumulateWindow& window, Grid<PixelMoments>& out) {
  const Extent extent = view.extent();
  out.reset(extent);
  workspace_->counts.assign(extent.count(), 0);
  const MomentTarget target{
      .extent = extent, .window = &window, .moments = out.pixels(), .counts = workspace_->counts};
  // Private sums per thread would cost 80 bytes a pixel each. Instead all threads snap a chunk of
  // points, which are sorted by rows of pixels, and then each thread adds to rows of its own.
  constexpr std::size_t kChunk = std::size_t{1} << 20;
  const auto bins = blocks_in(static_cast<std::size_t>(extent.height), RowBins::kRows);
  const std::size_t bins_per_thread = blocks_in(bins, static_cast<std::size_t>(thread_count()));
  DrawReport report;
  for (const DrawItem& item : items) {
    const auto* points = std::get_if<DrawPoints>(&item);
    if (points == nullptr) continue;
    const RowTransform rows = make_row_transform(view, points->world_from_item);
    for (std::size_t at = 0; at < points->positions.size(); at += kChunk) {
      const std::size_t count = std::min(kChunk, points->positions.size() - at);
      workspace_->snapped.resize(std::max(workspace_->snapped.size(), count));
      const auto snapped = std::span(workspace_->snapped).first(count);
      report.dropped_points +=
          snap_in_parallel(rows, points->positions.subspan(at, count), snapped, kernels_);
      const auto votes = points->votes.empty() ? points->votes : points->votes.subspan(at, count);
      workspace_->bins.fill(snapped, votes, extent);
      parallel_for(bins, bins_per_thread, [&](std::size_t begin, std::size_t end) {
        const int first = static_cast<int>(begin) * RowBins::kRows;
        const int last = std::min(static_cast<int>(end) * RowBins::kRows, extent.height);
        const bool has_vectors = kernels_ != nullptr && kernels_->add_moments != nullptr;
        const auto add = has_vectors ? kernels_->add_moments : &add_moments;
        add(workspace_->bins.touching(first, last), {first, last - 1}, target);
      });
    }
  }
  return report;
}

}  // namespace rangezip

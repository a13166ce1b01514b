#include "raster_gl/compute_tools.h"

#include <algorithm>
#include <vector>

namespace rangezip {

std::size_t ComputeTools::chunk_of(std::size_t bytes_each) const noexcept {
  // Numbers of invocations, of which a point may have 64, fit in 32 bits.
  constexpr std::size_t kMost = std::size_t{1} << 25;
  constexpr std::size_t kMultiple = 4;  // votes are packed by four
  const std::size_t fitting = setup.block_bytes / bytes_each / kMultiple * kMultiple;
  return std::clamp(fitting, kMultiple, kMost);
}

void KernelCounters::restart(const Kernels& kernels) {
  constexpr std::array<std::uint32_t, kCounters> kZero{};
  buffer_.upload(std::span(kZero), "counters");
  kernels.bind(Binding::counters, buffer_);
}

std::array<std::uint32_t, kCounters> KernelCounters::read() const {
  std::array<std::uint32_t, kCounters> values{};
  buffer_.download(std::span(values));
  return values;
}

void SnapRows::upload(const RowTransform& rows) {
  std::vector<Row> all{rows.x, rows.y, rows.z, rows.w};
  all.insert(all.end(), rows.clip.begin(), rows.clip.end());
  buffer_.upload(std::span<const Row>(all), "rows");
  clip_planes_ = static_cast<std::uint32_t>(rows.clip.size());
  is_central_ = rows.is_central ? 1 : 0;
}

void SnapRows::bind(const Kernels& kernels, const GlProgram& program,
                    const GlBuffer& positions) const {
  kernels.bind(Binding::rows, buffer_);
  kernels.bind(Binding::positions, positions);
  program.set("clip_planes", clip_planes_);
  program.set("is_central", is_central_);
}

void SnapRows::snap(const ComputeTools& tools, std::span<const Vec3f> positions,
                    const UploadKey& key, GlBuffer& snapped, bool is_counting) const {
  const GlProgram& program =
      tools.kernels.get(Kernel::snap_positions, {.wide_rows = tools.setup.wide_rows});
  snapped.reserve(positions.size() * sizeof(SnappedPosition), "snapped positions");
  bind(tools.kernels, program, tools.uploads.get(key, positions));
  tools.kernels.bind(Binding::snapped, snapped);
  program.set("count", static_cast<unsigned>(positions.size()));
  program.set("is_counting", is_counting ? 1U : 0U);
  tools.kernels.dispatch(program, groups_of(positions.size(), kPointGroup));
  tools.device.check("snapping positions");
}

}  // namespace rangezip

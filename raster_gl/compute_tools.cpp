#include "raster_gl/compute_tools.h"

#include <algorithm>
#include <bit>

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
  const auto bits_of = [](const Row& row) {
    return std::bit_cast<std::array<std::uint32_t, 4>>(row);
  };
  rows_ = {bits_of(rows.x), bits_of(rows.y), bits_of(rows.z), bits_of(rows.w)};
  clip_rows_.upload(std::span<const Row>(rows.clip), "clip planes");
  clip_planes_ = static_cast<std::uint32_t>(rows.clip.size());
  is_central_ = rows.is_central;
}

ShaderVariant SnapRows::variant(const ComputeSetup& setup) const noexcept {
  return {
      .wide_rows = setup.wide_rows, .is_central = is_central_, .has_clip_planes = clip_planes_ > 0};
}

void SnapRows::bind(const Kernels& kernels, const GlProgram& program,
                    const GlBuffer& positions) const {
  kernels.bind(Binding::positions, positions);
  program.set("rows", std::span<const std::array<std::uint32_t, 4>>(rows_));
  kernels.bind(Binding::clip_rows, clip_rows_);
  program.set("clip_planes", clip_planes_);
}

void SnapRows::snap(const ComputeTools& tools, std::span<const Vec3f> positions,
                    const UploadKey& key, GlBuffer& snapped, bool is_counting) const {
  const GlProgram& program = tools.kernels.get(Kernel::snap_positions, variant(tools.setup));
  snapped.reserve(positions.size() * sizeof(PlacedPosition), "snapped positions");
  bind(tools.kernels, program, tools.uploads.get(key, positions));
  tools.kernels.bind(Binding::snapped, snapped);
  program.set("count", static_cast<unsigned>(positions.size()));
  program.set("is_counting", is_counting ? 1U : 0U);
  tools.kernels.dispatch(program, groups_of(positions.size(), kPointGroup));
  tools.device.check("snapping positions");
}

}  // namespace rangezip

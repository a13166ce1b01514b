#include "raster_gl/compute_target.h"

#include <array>

namespace rangezip {

namespace {

constexpr std::size_t kBytesPerKey = sizeof(std::uint64_t);
constexpr std::size_t kBytesPerDepth = sizeof(std::uint32_t);

}  // namespace

ComputeTarget::ComputeTarget(const ComputeTools& tools)
    : tools_(tools),
      depths_(tools.device),
      winners_(tools.device),
      lower_(tools.device),
      upper_(tools.device) {}

std::size_t ComputeTarget::most_pixels() const noexcept {
  return tools_.setup.block_bytes / (tools_.setup.has_atomic_int64 ? kBytesPerKey : kBytesPerDepth);
}

void ComputeTarget::begin(const ImagePart& part, const DepthBand* band) {
  tools_.device.enter(GlPhase::draw);
  part_ = part;
  has_band_ = band != nullptr;
  const Kernels& kernels = tools_.kernels;
  if (has_band_) {
    lower_.upload(part.of(band->lower.pixels()), "the band");
    upper_.upload(part.of(band->upper.pixels()), "the band");
    kernels.bind(Binding::lower, lower_);
    kernels.bind(Binding::upper, upper_);
  }
  const bool is_one_pass = tools_.setup.has_atomic_int64;
  for (GlBuffer* const buffer : {&depths_, &winners_}) {
    if (is_one_pass && buffer == &winners_) break;
    const std::size_t bytes = part.pixels() * (is_one_pass ? kBytesPerKey : kBytesPerDepth);
    buffer->reserve(bytes, "the image");
    tools_.kernels.fill(*buffer, bytes, kNoDepth);
  }
  kernels.bind(Binding::depths, depths_);
  kernels.bind(Binding::winners, winners_);
}

std::span<const DrawPass> ComputeTarget::passes() const noexcept {
  static constexpr std::array kTwo{DrawPass::depth, DrawPass::winner};
  static constexpr std::array kOne{DrawPass::key};
  if (tools_.setup.has_atomic_int64) return kOne;
  return kTwo;
}

const GlProgram& ComputeTarget::kernel(Kernel kernel, ShaderVariant variant) const {
  variant.has_band = has_band_;
  variant.outside_only = tools_.setup.outside_only;
  const GlProgram& program = tools_.kernels.get(kernel, variant);
  program.set("width", part_.extent.width);
  program.set("first_row", part_.first_row);
  program.set("row_count", part_.row_count);
  return program;
}

void ComputeTarget::read(Framebuffer& out) {
  const PhaseScope phase(tools_.device, GlPhase::read);
  const auto depths = part_.of(out.depth.pixels());
  const auto ids = part_.of(out.id.pixels());
  if (!tools_.setup.has_atomic_int64) {
    depths_.download(depths);
    winners_.download(ids);
    return;
  }
  split_keys();
  winners_.download(ids);
  winners_.download(depths, ids.size_bytes());
}

void ComputeTarget::split_keys() {
  const std::size_t pixels = part_.pixels();
  winners_.reserve(pixels * kBytesPerKey, "the image");
  tools_.kernels.bind(Binding::depths, depths_);
  tools_.kernels.bind(Binding::winners, winners_);
  const GlProgram& program = tools_.kernels.get(Kernel::split_keys, {});
  program.set("count", static_cast<unsigned>(pixels));
  tools_.kernels.dispatch(program, groups_of(pixels, kPointGroup));
  tools_.device.check("splitting depths and IDs");
}

}  // namespace rangezip

#include "raster_gl/compute_target.h"

#include <array>

#include "core/base/parallel.h"

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
    buffer->fill(bytes, kNoDepth);
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
  if (tools_.setup.has_atomic_int64) {
    read_keys(out);
    return;
  }
  depths_.download(part_.of(out.depth.pixels()));
  winners_.download(part_.of(out.id.pixels()));
}

void ComputeTarget::read_keys(Framebuffer& out) {
  keys_.resize(part_.pixels());
  depths_.download(std::span(keys_));
  const auto depths = part_.of(out.depth.pixels());
  const auto ids = part_.of(out.id.pixels());
  constexpr std::size_t kGrain = std::size_t{1} << 16;
  parallel_for(keys_.size(), kGrain, [&](std::size_t begin, std::size_t end) {
    for (std::size_t i = begin; i < end; ++i) {
      depths[i] = static_cast<std::uint32_t>(keys_[i] >> 32U);
      ids[i] = static_cast<std::uint32_t>(keys_[i]);
    }
  });
}

}  // namespace rangezip

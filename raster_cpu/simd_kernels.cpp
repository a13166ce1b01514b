#include "raster_cpu/simd_kernels.h"

#include "raster_cpu/simd_targets.h"

#include <hwy/highway.h>

namespace rangezip {

namespace {

void add_all(std::size_t target, SimdKernels& kernels) {
  add_point_kernels(target, kernels);
  add_moment_kernels(target, kernels);
  add_triangle_kernels(target, kernels);
  add_box_kernels(target, kernels);
  add_span_kernels(target, kernels);
}

std::vector<SimdKernels> find_kernels() {
  std::vector<SimdKernels> found;
#if (HWY_TARGETS & (HWY_TARGETS - 1)) == 0
  found.push_back({.name = hwy::TargetName(HWY_TARGETS)});
  add_all(0, found.back());
#else
  // The lower the bit, the wider the instructions.
  for (std::int64_t left = hwy::SupportedTargets(); left != 0; left &= left - 1) {
    const std::int64_t target = left & -left;
    hwy::ChosenTarget chosen;
    chosen.Update(target);
    found.push_back({.name = hwy::TargetName(target)});
    add_all(chosen.GetIndex(), found.back());
  }
#endif
  std::erase_if(found, [](const SimdKernels& kernels) { return kernels.snap == nullptr; });
  return found;
}

}  // namespace

const std::vector<SimdKernels>& simd_kernels() {
  static const std::vector<SimdKernels> kernels = find_kernels();
  return kernels;
}

}  // namespace rangezip

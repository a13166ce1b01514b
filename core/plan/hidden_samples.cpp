#include "core/plan/hidden_samples.h"

#include <cstddef>

#include "core/plan/outer_samples.h"
#include "core/plan/unseen_samples.h"

namespace rangezip {

std::vector<std::uint8_t> hidden_samples(Rasterizer& rasterizer, const Scene& scene,
                                         std::span<const Vec3> samples, double pixel_size,
                                         const Progress& progress) {
  std::vector<std::uint8_t> is_hidden =
      unseen_samples(rasterizer, scene, samples, pixel_size, progress);
  std::vector<Vec3> unseen;
  for (std::size_t i = 0; i < samples.size(); ++i) {
    if (is_hidden[i] != 0) unseen.push_back(samples[i]);
  }
  const std::vector<std::uint8_t> is_outer = outer_samples(scene, unseen, progress);
  if (!are_outer(is_outer)) return is_hidden;
  std::size_t next = 0;
  for (std::uint8_t& flag : is_hidden) {
    if (flag != 0) flag = is_outer[next++] != 0 ? 0 : 1;
  }
  return is_hidden;
}

}  // namespace rangezip

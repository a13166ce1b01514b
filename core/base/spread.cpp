#include "core/base/spread.h"

namespace rangezip {

std::uint64_t scrambled_bits(std::uint64_t value) {
  value += 0x9e37'79b9'7f4a'7c15U;
  value = (value ^ (value >> 30U)) * 0xbf58'476d'1ce4'e5b9U;
  value = (value ^ (value >> 27U)) * 0x94d0'49bb'1331'11ebU;
  return value ^ (value >> 31U);
}

std::vector<std::size_t> spread_indices(std::size_t count, std::size_t wanted) {
  const std::size_t chosen = wanted < count ? wanted : count;
  std::vector<std::size_t> indices(chosen);
  std::size_t begin = 0;
  for (std::size_t slice = 0; slice < chosen; ++slice) {
    // (slice + 1) * count / chosen without a product that could leave 64 bits
    const std::size_t end =
        (slice + 1) * (count / chosen) + (slice + 1) * (count % chosen) / chosen;
    indices[slice] = begin + scrambled_bits(slice) % (end - begin);
    begin = end;
  }
  return indices;
}

}  // namespace rangezip

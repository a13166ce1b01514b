#pragma once

#include <cstddef>
#include <cstdint>
#include <vector>

namespace rangezip {

/// A 64-bit integer whose bits all depend on all bits of `value`, the same on every machine: the
/// output function of splitmix64 [Steele, Lea, Flood 2014].
[[nodiscard]] std::uint64_t scrambled_bits(std::uint64_t value);

/// `wanted` ascending indices in [0, count), one from each of `wanted` equal slices, at a scrambled
/// place in it: even over the whole, but in step with nothing, such as the rows of a range scan.
/// All indices if count <= wanted.
[[nodiscard]] std::vector<std::size_t> spread_indices(std::size_t count, std::size_t wanted);

}  // namespace rangezip

#pragma once

#include <cstddef>
#include <span>
#include <vector>

#include "core/base/geometry.h"

namespace rangezip {

/// Chooses the origin about which positions are stored as floats, from an even sample of them.
///
/// The origin is the median of the sample per axis, so that a few strays do not pull it away,
/// rounded to whole steps of a power of two: about twice the size of the data, but at most 1. Data
/// near zero thus keep the origin 0 and their own floats, and data moved by whole units, as between
/// map grids, get the moved origin and the same local floats.
class LocalOrigin {
 public:
  LocalOrigin();

  /// Of `count` positions, those whose index is a multiple of this decide. Given only these,
  /// origin() is the same.
  [[nodiscard]] static std::size_t stride_of(std::size_t count);

  /// Takes the next position of the file. @pre finite
  void add(const Vec3& position) {
    if (--until_next_ == 0) take(position);
  }
  /// Takes the next positions of the file. @pre finite
  void add(std::span<const Vec3> block) {
    std::size_t next = until_next_ - 1;
    for (; next < block.size(); next += until_next_)
      take(block[next]);
    until_next_ = next - block.size() + 1;
  }
  /// (0, 0, 0) if nothing was added.
  [[nodiscard]] Vec3 origin() const;

 private:
  void take(const Vec3& position);

  std::vector<Vec3> sample_;
  std::size_t stride_ = 1;  ///< every stride_-th position is in the sample
  std::size_t until_next_ = 1;
};

}  // namespace rangezip

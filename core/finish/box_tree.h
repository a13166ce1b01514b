#pragma once

#include <cstddef>
#include <cstdint>
#include <vector>

#include "core/base/geometry.h"

namespace rangezip {

/// Boxes, of whatever sizes, for asking which of them meet a box: a tree over their centers in
/// order along a curve, with a box around each run of neighbours [Kamel, Faloutsos 1993].
class BoxTree {
 public:
  /// O(n). @pre none is empty, all are finite
  explicit BoxTree(const std::vector<Box>& boxes);

  /// The numbers of those that have a point in common with this one, rising. O(log n) for each of
  /// them where few boxes overlap.
  [[nodiscard]] std::vector<std::uint32_t> meeting(const Box& box) const;

  /// Whether there is any; stops at the first one.
  [[nodiscard]] bool meets(const Box& box) const;

 private:
  /// Calls visit(number) for those that meet a box as long as it returns true.
  template <class Visit>
  void visit_meeting(const Box& box, const Visit& visit) const;
  /// The same of those below a box of a level. @return whether it always did
  template <class Visit>
  bool visit_below(std::size_t level, std::size_t place, const Box& box, const Visit& visit) const;

  std::vector<std::uint32_t> numbers_;    ///< along the curve
  std::vector<std::vector<Box>> levels_;  ///< first the boxes, along the curve; then those around
                                          ///< runs of the level before; the last has one at most
};

}  // namespace rangezip

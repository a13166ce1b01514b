#pragma once

#include <span>
#include <vector>

#include "core/raster/draw_item.h"

namespace rangezip {

/// Finds the item that a drawn ID belongs to. O(log items) a look-up.
class ItemLookup {
 public:
  /// @param items what was drawn, in ascending order of their IDs; must outlive this object
  explicit ItemLookup(std::span<const DrawItem> items);

  static constexpr std::size_t kNone = static_cast<std::size_t>(-1);

  /// Index of the item that holds `id`, or kNone.
  [[nodiscard]] std::size_t find(PrimitiveId id) const;

 private:
  std::span<const DrawItem> items_;
  std::vector<std::size_t> filled_;  ///< indices of the items that have primitives
};

}  // namespace rangezip

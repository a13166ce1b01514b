#include "core/image/item_lookup.h"

#include <algorithm>

namespace rangezip {

ItemLookup::ItemLookup(std::span<const DrawItem> items) : items_(items) {
  for (std::size_t i = 0; i < items.size(); ++i) {
    if (primitive_count(items[i]) > 0) filled_.push_back(i);
  }
}

std::size_t ItemLookup::find(PrimitiveId id) const {
  const auto after = std::upper_bound(
      filled_.begin(), filled_.end(), id,
      [this](PrimitiveId wanted, std::size_t item) { return wanted < first_id(items_[item]); });
  if (after == filled_.begin()) return kNone;
  const std::size_t item = *(after - 1);
  return id - first_id(items_[item]) < primitive_count(items_[item]) ? item : kNone;
}

}  // namespace rangezip

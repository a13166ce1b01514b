#include "core/finish/components.h"

namespace rangezip {

std::vector<std::uint32_t> components_of(const CornerTable& table) {
  std::vector<std::uint32_t> component(table.face_count(), CornerTable::kNone);
  std::vector<std::uint32_t> open;
  std::uint32_t count = 0;
  for (std::uint32_t seed = 0; seed < component.size(); ++seed) {
    if (component[seed] != CornerTable::kNone || table.is_deleted(seed)) continue;
    component[seed] = count;
    open.push_back(seed);
    while (!open.empty()) {
      const std::uint32_t face = open.back();
      open.pop_back();
      for (std::uint32_t c = 3 * face; c < 3 * face + 3; ++c) {
        const std::uint32_t other = table.across(c);
        if (other == CornerTable::kNone || component[other / 3] != CornerTable::kNone) continue;
        component[other / 3] = count;
        open.push_back(other / 3);
      }
    }
    ++count;
  }
  return component;
}

}  // namespace rangezip

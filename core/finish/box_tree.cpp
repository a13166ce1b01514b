#include "core/finish/box_tree.h"

#include <algorithm>
#include <utility>

#include "core/base/curve_order.h"

namespace rangezip {
namespace {

constexpr std::size_t kRun = 8;  ///< boxes of a level below one of the next

std::vector<std::uint32_t> order_of(const std::vector<Box>& boxes) {
  std::vector<Vec3> centers;
  centers.reserve(boxes.size());
  for (const Box& box : boxes)
    centers.push_back(box.center());
  return order_along_curve(centers);
}

std::vector<Box> boxes_around_runs(const std::vector<Box>& boxes) {
  std::vector<Box> around((boxes.size() + kRun - 1) / kRun);
  for (std::size_t i = 0; i < boxes.size(); ++i)
    around[i / kRun].add(boxes[i]);
  return around;
}

}  // namespace

BoxTree::BoxTree(const std::vector<Box>& boxes) : numbers_(order_of(boxes)) {
  std::vector<Box> sorted;
  sorted.reserve(boxes.size());
  for (const std::uint32_t number : numbers_)
    sorted.push_back(boxes[number]);
  levels_.push_back(std::move(sorted));
  while (levels_.back().size() > 1)
    levels_.push_back(boxes_around_runs(levels_.back()));
}

std::vector<std::uint32_t> BoxTree::meeting(const Box& box) const {
  std::vector<std::uint32_t> found;
  visit_meeting(box, [&](std::uint32_t number) {
    found.push_back(number);
    return true;
  });
  std::sort(found.begin(), found.end());
  return found;
}

bool BoxTree::meets(const Box& box) const {
  bool found = false;
  visit_meeting(box, [&](std::uint32_t) {
    found = true;
    return false;
  });
  return found;
}

template <class Visit>
void BoxTree::visit_meeting(const Box& box, const Visit& visit) const {
  if (!numbers_.empty()) visit_below(levels_.size() - 1, 0, box, visit);
}

template <class Visit>
bool BoxTree::visit_below(std::size_t level, std::size_t place, const Box& box,
                          const Visit& visit) const {
  if (!boxes_meet(levels_[level][place], box)) return true;
  if (level == 0) return visit(numbers_[place]);
  const std::size_t end = std::min(kRun * (place + 1), levels_[level - 1].size());
  for (std::size_t i = kRun * place; i < end; ++i) {
    if (!visit_below(level - 1, i, box, visit)) return false;
  }
  return true;
}

}  // namespace rangezip

#include "core/stitch/crossing_faces.h"

#include <algorithm>
#include <tuple>

namespace rangezip {

namespace {

struct Choice {
  std::uint32_t goes, stays;
};

}  // namespace

std::vector<std::uint32_t> choose_crossing_faces(std::span<const FacePair> pairs,
                                                 std::span<const FaceOrigin> origins) {
  std::vector<std::uint32_t> crossings(origins.size(), 0);
  for (const auto& [first, second] : pairs) {
    ++crossings[first];
    ++crossings[second];
  }
  const auto goes_before = [&](std::uint32_t a, std::uint32_t b) {
    return std::tuple(origins[a], crossings[b], b) < std::tuple(origins[b], crossings[a], a);
  };
  std::vector<Choice> choices;
  for (const auto& [first, second] : pairs) {
    if (goes_before(first, second)) {
      choices.push_back({first, second});
    } else {
      choices.push_back({second, first});
    }
  }
  // The worst faces first: one that goes may save the others in its way.
  std::stable_sort(choices.begin(), choices.end(),
                   [&](const Choice& a, const Choice& b) { return goes_before(a.goes, b.goes); });
  std::vector<std::uint8_t> is_gone(origins.size(), 0);
  std::vector<std::uint32_t> gone;
  for (const auto& [goes, stays] : choices) {
    if (is_gone[goes] != 0 || is_gone[stays] != 0) continue;
    is_gone[goes] = 1;
    gone.push_back(goes);
  }
  std::sort(gone.begin(), gone.end());
  return gone;
}

}  // namespace rangezip

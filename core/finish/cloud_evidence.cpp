#include "core/finish/cloud_evidence.h"

#include <algorithm>
#include <optional>
#include <vector>

#include "core/base/spread.h"
#include "core/finish/unsupported_faces.h"

namespace rangezip {
namespace {

constexpr std::size_t kPlaces = 9;  // of a border that are asked for the spacing

}  // namespace

AirTest air_test(const CloudEvidence& evidence, std::span<const Vec3> border) {
  if (evidence.cloud == nullptr || evidence.cloud->empty()) return {};
  std::vector<double> spacings;
  for (const std::size_t i : spread_indices(border.size(), kPlaces)) {
    const std::optional<double> spacing =
        spacing_near(*evidence.cloud, border[i], evidence.pixel_size);
    if (spacing) spacings.push_back(*spacing);
  }
  if (2 * spacings.size() <= std::min(border.size(), kPlaces)) return {};
  const auto middle = spacings.begin() + static_cast<std::ptrdiff_t>(spacings.size() / 2);
  std::nth_element(spacings.begin(), middle, spacings.end());
  const double reach =
      std::max(kCloseSupport.pixels * evidence.pixel_size, kCloseSupport.spacings * *middle);
  return [cloud = evidence.cloud, reach](const Vec3& place) {
    return !cloud->has_point_within(place, reach);
  };
}

}  // namespace rangezip

#include "core/plan/own_sheet.h"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <vector>

#include "core/base/symmetric_eigen.h"

namespace rangezip {
namespace {

/// Heights over a plane are those of two sheets if the gap between them is so many times as wide
/// as their spread on either side of it. Of noise fewer than one neighbourhood in a hundred has
/// such a gap.
constexpr double kSheetGap = 4.0;

/// Places in the order of their heights along a normal, parted at the widest gap.
struct TwoSheets {
  Vec3 normal{0.0};
  std::vector<Vec3> places;
  std::size_t cut = 1;  ///< the first one past the gap

  [[nodiscard]] double height(std::size_t i) const { return glm::dot(places[i], normal); }
  [[nodiscard]] double gap_before(std::size_t i) const { return height(i) - height(i - 1); }
  [[nodiscard]] std::span<const Vec3> lower() const { return std::span(places).first(cut); }
  [[nodiscard]] std::span<const Vec3> upper() const { return std::span(places).subspan(cut); }
};

TwoSheets part_along(const Vec3& normal, std::span<const Vec3> places) {
  TwoSheets parted{normal, {places.begin(), places.end()}};
  std::sort(parted.places.begin(), parted.places.end(), [&](const Vec3& a, const Vec3& b) {
    return glm::dot(a, normal) < glm::dot(b, normal);
  });
  for (std::size_t i = 2; i < parted.places.size(); ++i) {
    if (parted.gap_before(i) > parted.gap_before(parted.cut)) parted.cut = i;
  }
  return parted;
}

std::vector<Vec3> copy_of(std::span<const Vec3> places) {
  return {places.begin(), places.end()};
}

/// The places that lie on the first one's side of a wall: all, or those on this side of the gap.
std::vector<Vec3> own_sheet(std::span<const Vec3> places, double wall) {
  constexpr std::size_t kNearest = 7;  // the place and its first ring: of one sheet, mostly
  constexpr int kRounds = 4;           // both sheets tell the normal, better each time
  if (places.size() <= kNearest) return copy_of(places);
  Mat3 scatter = scatter_of(places.first(kNearest));
  TwoSheets parted;
  for (int round = 0; round < kRounds; ++round) {
    parted = part_along(eigen_of_symmetric(scatter).vectors[0], places);
    scatter = scatter_of(parted.lower()) + scatter_of(parted.upper());
  }
  const double squares = glm::dot(parted.normal, scatter * parted.normal);
  const double spread = std::sqrt(std::max(0.0, squares) / static_cast<double>(places.size()));
  if (parted.gap_before(parted.cut) < std::max(wall, kSheetGap * spread)) return copy_of(places);
  const bool is_own_below = parted.height(parted.cut) > 0.0;
  return copy_of(is_own_below ? parted.lower() : parted.upper());
}

}  // namespace

Mat3 scatter_of(std::span<const Vec3> places) {
  Vec3 mean{0.0};
  for (const Vec3& place : places)
    mean += place;
  mean /= static_cast<double>(places.size());
  Mat3 scatter{0.0};
  for (const Vec3& place : places)
    scatter += glm::outerProduct(place - mean, place - mean);
  return scatter;
}

double distance_from_plane(std::span<const Vec3> places, double wall) {
  if (places.empty()) return 0.0;
  const std::vector<Vec3> sheet = own_sheet(places, wall);
  if (sheet.size() <= 3) return 0.0;
  const double squares = std::max(0.0, eigen_of_symmetric(scatter_of(sheet)).values[0]);
  return std::sqrt(squares / static_cast<double>(sheet.size() - 3));
}

}  // namespace rangezip

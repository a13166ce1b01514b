#include "core/finish/left_out_faces.h"

#include <algorithm>
#include <array>
#include <cstddef>

#include "core/base/disjoint_sets.h"
#include "core/finish/unsupported_faces.h"

namespace rangezip {
namespace {

/// Gaps that are no wider come from how points happen to lie: of points spread at random one disc
/// in a million is empty out to 2.1 spacings.
constexpr SupportReach kGapSupport{.pixels = 1.75, .spacings = 3.0};
/// In h^2, of faces that are left out: with what lies around it a hole about 5 h wide.
constexpr double kLeastArea = 2.0;

/// A face beside one of its edges.
struct EdgeFace {
  std::uint32_t low, high, face;

  [[nodiscard]] bool is_beside(const EdgeFace& other) const {
    return low == other.low && high == other.high;
  }
  friend bool operator<(const EdgeFace& p, const EdgeFace& q) {
    if (p.low != q.low) return p.low < q.low;
    if (p.high != q.high) return p.high < q.high;
    return p.face < q.face;
  }
};

/// Joins the flagged faces that share an edge.
DisjointSets regions_of(const std::vector<Triangle>& faces,
                        const std::vector<std::uint8_t>& is_flagged) {
  std::vector<EdgeFace> edges;
  for (std::uint32_t f = 0; f < faces.size(); ++f) {
    if (is_flagged[f] == 0) continue;
    for (std::size_t k = 0; k < 3; ++k) {
      const auto [low, high] = std::minmax(faces[f][k], faces[f][(k + 1) % 3]);
      edges.push_back({low, high, f});
    }
  }
  std::sort(edges.begin(), edges.end());
  DisjointSets regions(faces.size());
  for (std::size_t i = 0; i + 1 < edges.size(); ++i) {
    if (edges[i].is_beside(edges[i + 1])) regions.join(edges[i].face, edges[i + 1].face);
  }
  return regions;
}

}  // namespace

bool is_left_out(const PointGrid& cloud, const Vec3& place, double pixel_size) {
  return !is_supported(cloud, place, pixel_size, kGapSupport);
}

std::vector<std::uint8_t> left_out_faces(const std::vector<Triangle>& faces,
                                         const std::function<Vec3(std::uint32_t)>& position,
                                         const PointGrid& cloud, double pixel_size) {
  std::vector<std::uint8_t> is_bare(faces.size(), 0);
  std::vector<double> area(faces.size(), 0.0);  // of those that are left out
  const auto is_shown = [&](const Vec3& place) {
    return is_supported(cloud, place, pixel_size, kFaceSupport);
  };
  for (std::size_t f = 0; f < faces.size(); ++f) {
    const Vec3 a = position(faces[f][0]), b = position(faces[f][1]), c = position(faces[f][2]);
    const Vec3 middle = (a + b + c) / 3.0;
    const std::array<Vec3, 4> places{middle, a, b, c};
    is_bare[f] = std::all_of(places.begin(), places.end(), is_shown) ? 0 : 1;
    if (is_bare[f] == 0) continue;
    if (is_left_out(cloud, middle, pixel_size)) area[f] = 0.5 * glm::length(area_vector(a, b, c));
  }
  DisjointSets regions = regions_of(faces, is_bare);
  std::vector<double> area_of(faces.size(), 0.0);  // of regions, at the face that stands for each
  for (std::uint32_t f = 0; f < faces.size(); ++f)
    area_of[regions.find(f)] += area[f];
  std::vector<std::uint8_t> flags(faces.size(), 0);
  for (std::uint32_t f = 0; f < faces.size(); ++f)
    flags[f] = area_of[regions.find(f)] > kLeastArea * pixel_size * pixel_size ? 1 : 0;
  return flags;
}

}  // namespace rangezip

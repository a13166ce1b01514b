#include "core/finish/spikes.h"

#include <algorithm>
#include <cmath>
#include <optional>

#include "core/base/parallel.h"

namespace rangezip {
namespace {

constexpr double kMinHeight = 0.5;  ///< in h
constexpr double kFlat = 0.5;       ///< height of the neighbours, share of the spike's, at most
/// Points count up to this share of the way from the foot to the neighbours: nearer to those the
/// spike's faces and the plane below are too close to tell which of them a point is on.
constexpr double kFootShare = 0.7;

/// The plane through the neighbours of an inner vertex.
struct Ring {
  Vec3 center{0.0};
  Vec3 normal{0.0};  ///< unit
  double roughness = 0.0;
  double radius = 0.0;  ///< mean distance of the neighbours
};

std::optional<Ring> ring_around(std::uint32_t v, const std::vector<Vec3>& positions,
                                const CornerTable& table) {
  Ring ring;
  int count = 0;
  Vec3 area{0.0};
  table.for_each_corner(v, [&](std::uint32_t c) {
    ring.center += positions[table.head(c)];
    area += area_vector(positions[v], positions[table.head(c)], positions[table.apex(c)]);
    ++count;
  });
  const double length = glm::length(area);
  if (count == 0 || !(length > 0.0)) return std::nullopt;
  ring.center /= static_cast<double>(count);
  ring.normal = area / length;
  table.for_each_corner(v, [&](std::uint32_t c) {
    const double height = glm::dot(positions[table.head(c)] - ring.center, ring.normal);
    ring.roughness = std::max(ring.roughness, std::abs(height));
    ring.radius += glm::length(positions[table.head(c)] - ring.center) / static_cast<double>(count);
  });
  return ring;
}

/// Where the vertex belongs, if it is a spike.
std::optional<Vec3> place_in_plane(std::uint32_t v, const std::vector<Vec3>& positions,
                                   const CornerTable& table, const PointGrid& cloud, double h) {
  const auto ring = ring_around(v, positions, table);
  if (!ring) return std::nullopt;
  const double height = glm::dot(positions[v] - ring->center, ring->normal);
  if (std::abs(height) <= kMinHeight * h || ring->roughness > kFlat * std::abs(height))
    return std::nullopt;
  int in_plane = 0, on_spike = 0;
  double sum = 0.0;
  const double reach = kFootShare * ring->radius;
  cloud.for_each_near(ring->center, reach + 2.0 * std::abs(height), [&](const Vec3& d) {
    const double up = glm::dot(d, ring->normal);
    const double along = glm::length(d - up * ring->normal);
    if (along > reach) return;
    // Of the way from the plane to the spike's face.
    const double share = up / (height * (1.0 - along / ring->radius));
    if (std::abs(share) < 0.5) {
      ++in_plane;
      sum += up;
    } else if (share > 0.0 && share < 2.0) {
      ++on_spike;
    }
  });
  if (in_plane == 0 || on_spike > in_plane) return std::nullopt;
  return ring->center + (sum / static_cast<double>(in_plane)) * ring->normal;
}

bool is_fixed(std::uint32_t v, const CornerTable& table) {
  return table.corner_of(v) == CornerTable::kNone || table.is_boundary(v);
}

/// Marks the spikes as the positions are; once one has moved, its neighbours are to be asked again.
std::vector<std::uint8_t> spikes_of(const std::vector<Vec3>& positions, const CornerTable& table,
                                    const PointGrid& cloud, double h) {
  constexpr std::size_t kPerBlock = 1024;
  std::vector<std::uint8_t> is_spike(table.vertex_count(), 0);
  parallel_for(is_spike.size(), kPerBlock, [&](std::size_t begin, std::size_t end) {
    for (auto v = static_cast<std::uint32_t>(begin); v < end; ++v) {
      if (is_fixed(v, table)) continue;
      is_spike[v] = place_in_plane(v, positions, table, cloud, h) ? 1 : 0;
    }
  });
  return is_spike;
}

}  // namespace

std::size_t flatten_spikes(std::vector<Vec3>& positions, const CornerTable& table,
                           const PointGrid& cloud, double pixel_size) {
  std::vector<std::uint8_t> is_asked = spikes_of(positions, table, cloud, pixel_size);
  std::size_t count = 0;
  for (std::uint32_t v = 0; v < table.vertex_count(); ++v) {
    if (is_asked[v] == 0 || is_fixed(v, table)) continue;
    if (const auto place = place_in_plane(v, positions, table, cloud, pixel_size)) {
      positions[v] = *place;
      table.for_each_neighbor(v, [&](std::uint32_t w) { is_asked[w] = 1; });
      ++count;
    }
  }
  return count;
}

}  // namespace rangezip

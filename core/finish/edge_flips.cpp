#include "core/finish/edge_flips.h"

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <limits>

#include "core/base/parallel.h"
#include "core/finish/edge_changes.h"
#include "core/finish/triangle_shape.h"

namespace rangezip {
namespace {

// Angles as cosines, smallest angles as sines.
constexpr double kGain = 0.05;          // smaller gains would flip to and fro
constexpr double kMinCosine = 0.5;      // between and against the old faces
constexpr double kMaxSharper = 0.1;     // an edge may not get much sharper
constexpr double kSmallAngle = 0.35;    // 20 degrees
constexpr double kAlignedAngle = 0.5;   // 30 degrees
constexpr double kAlignedGain = 0.995;  // of the deviation: equal ones would turn to and fro
constexpr double kAlignedCosine = 0.8;
constexpr int kRegularValence = 6;

/// Whether the faces after the flip look where those before it did.
bool keeps_sides(const std::vector<Vec3>& p, const Diamond& d) {
  const DiamondAreas areas(p, d);
  const Vec3 old_x = glm::normalize(areas.old_x), old_y = glm::normalize(areas.old_y);
  const Vec3 new_a = glm::normalize(areas.new_a), new_b = glm::normalize(areas.new_b);
  // A face without area has no direction; comparisons with it are false.
  const double sharpness = glm::dot(new_a, new_b);
  return sharpness >= kMinCosine && !(sharpness < glm::dot(old_x, old_y) - kMaxSharper) &&
         !(glm::dot(new_a, old_y) < kMinCosine) && !(glm::dot(new_b, old_x) < kMinCosine);
}

/// One per corner: 1 where it names an inner edge for which is_better(diamond) holds.
template <class IsBetter>
std::vector<std::uint8_t> better_edges(const CornerTable& table, const IsBetter& is_better) {
  constexpr std::size_t kCornersPerBlock = 8192;
  std::vector<std::uint8_t> better(table.corner_count(), 0);
  parallel_for(better.size(), kCornersPerBlock, [&](std::size_t begin, std::size_t end) {
    for (auto c = static_cast<std::uint32_t>(begin); c < end; ++c)
      better[c] = table.names_inner_edge(c) && is_better(Diamond(table, c)) ? 1 : 0;
  });
  return better;
}

/// Turns every inner edge for which is_better(diamond) holds, one after the other. What is_better()
/// says of the edges as they are at first is found out in parallel.
/// @param is_stale whether a turn has changed what is_better() knows of the corners of a diamond
template <class IsBetter, class IsStale, class Turned>
std::size_t flip_where(CornerTable& table, const IsBetter& is_better, const IsStale& is_stale,
                       const Turned& turned) {
  const std::vector<std::uint8_t> better = better_edges(table, is_better);
  std::vector<std::uint8_t> is_changed(better.size(), 0);  // another edge, or in another diamond
  std::size_t count = 0;
  for (std::uint32_t c = 0; c < table.corner_count(); ++c) {
    if (!table.names_inner_edge(c)) continue;
    const Diamond d(table, c);
    const bool is_known = is_changed[c] == 0 && !is_stale(d);
    if (!(is_known ? better[c] != 0 : is_better(d)) || !table.is_flip_ok(c)) continue;
    table.flip(c);
    for (const std::uint32_t face : {c / 3, table.across(CornerTable::next(c)) / 3}) {
      for (std::uint32_t k = 3 * face; k < 3 * face + 3; ++k) {
        is_changed[k] = 1;
        if (table.across(k) != CornerTable::kNone) is_changed[table.across(k)] = 1;
      }
    }
    turned(d);
    ++count;
  }
  return count;
}

constexpr auto kNeverStale = [](const Diamond&) { return false; };
constexpr auto kIgnore = [](const Diamond&) {};

/// Neighbours of every vertex; at the boundary as many more as are missing at a straight one.
std::vector<int> valences_of(const CornerTable& table) {
  std::vector<int> valences(table.vertex_count(), 0);
  for (std::uint32_t v = 0; v < valences.size(); ++v) {
    if (table.corner_of(v) == CornerTable::kNone) continue;
    if (table.is_boundary(v)) valences[v] = 2;
    table.for_each_neighbor(v, [&](std::uint32_t) { ++valences[v]; });
  }
  return valences;
}

/// How much a face's normal deviates from those of the surface at its corners, by area.
double deviation(const std::vector<Vec3>& p, const std::vector<Vec3>& normals, std::uint32_t i,
                 std::uint32_t j, std::uint32_t k) {
  const Vec3 area = area_vector(p[i], p[j], p[k]);
  const double length = glm::length(area);
  if (!(length > 0.0)) return std::numeric_limits<double>::infinity();
  const Vec3 normal = area / length;
  double sum = 0.0;
  for (const std::uint32_t v : {i, j, k}) {
    const Vec3 off = normal - normals[v];
    sum += glm::dot(off, off);
  }
  return sum * length;
}

}  // namespace

std::size_t flip_for_angles(CornerTable& table, const std::vector<Vec3>& positions) {
  const auto is_better = [&](const Diamond& d) {
    return angle_after_flip(positions, d) >= angle_before_flip(positions, d) + kGain &&
           keeps_sides(positions, d);
  };
  return flip_where(table, is_better, kNeverStale, kIgnore);
}

std::size_t flip_for_valence(CornerTable& table, const std::vector<Vec3>& positions) {
  std::vector<int> valences = valences_of(table);
  const auto off = [&](std::uint32_t v, int change) {
    const int difference = valences[v] + change - kRegularValence;
    return difference * difference;
  };
  const auto is_better = [&](const Diamond& d) {
    const bool is_more_regular = off(d.a, -1) + off(d.b, -1) + off(d.x, 1) + off(d.y, 1) <
                                 off(d.a, 0) + off(d.b, 0) + off(d.x, 0) + off(d.y, 0);
    const double before = angle_before_flip(positions, d);
    if (!is_more_regular && before >= kSmallAngle) return false;  // as for most edges
    const double after = angle_after_flip(positions, d);
    const bool mends = before < kSmallAngle && after >= before + kGain;
    if (!mends && !(is_more_regular && after >= std::min(before, kSmallAngle))) return false;
    return keeps_sides(positions, d);
  };
  std::vector<std::uint8_t> is_stale(valences.size(), 0);
  const auto any_is_stale = [&](const Diamond& d) {
    return (is_stale[d.a] | is_stale[d.b] | is_stale[d.x] | is_stale[d.y]) != 0;
  };
  return flip_where(table, is_better, any_is_stale, [&](const Diamond& d) {
    --valences[d.a];
    --valences[d.b];
    ++valences[d.x];
    ++valences[d.y];
    for (const std::uint32_t v : {d.a, d.b, d.x, d.y})
      is_stale[v] = 1;
  });
}

std::size_t flip_for_normals(CornerTable& table, const std::vector<Vec3>& positions,
                             const std::vector<Vec3>& normals) {
  const auto has_normals = [&](const Diamond& d) {
    const Vec3 zero{0.0};
    return normals[d.a] != zero && normals[d.b] != zero && normals[d.x] != zero &&
           normals[d.y] != zero;
  };
  const auto is_better = [&](const Diamond& d) {
    if (!has_normals(d) || angle_after_flip(positions, d) < kAlignedAngle) return false;
    const DiamondAreas areas(positions, d);
    if (!has_cosine(areas.new_a, areas.new_b, kAlignedCosine)) return false;
    if (!has_cosine(areas.new_a, areas.old_x, kAlignedCosine)) return false;
    const double before =
        deviation(positions, normals, d.a, d.b, d.x) + deviation(positions, normals, d.b, d.a, d.y);
    const double after =
        deviation(positions, normals, d.a, d.y, d.x) + deviation(positions, normals, d.b, d.x, d.y);
    return after < kAlignedGain * before;
  };
  return flip_where(table, is_better, kNeverStale, kIgnore);
}

}  // namespace rangezip

#include "core/finish/border_gaps.h"

#include <algorithm>
#include <cmath>
#include <optional>

#include "core/base/parallel.h"

namespace rangezip {
namespace {

constexpr std::size_t kEdgesPerBlock = 64;
/// Of the reach: what is nearer by less than this is no nearer; a point that is as near to another
/// part of the mesh counts as beyond the edge.
constexpr double kSame = 3e-3;

/// A border edge and its face.
struct Edge {
  Vec3 start{0.0};
  Vec3 along{0.0};
  double squared_length = 0.0;
  Vec3 normal{0.0};   ///< unit
  Vec3 outward{0.0};  ///< unit
};

std::optional<Edge> edge_at(const TriangleMesh& mesh, const CornerTable& table,
                            std::uint32_t corner) {
  const Vec3& a = mesh.positions[table.vertex(corner)];
  const Vec3& b = mesh.positions[table.head(corner)];
  const Vec3 area = area_vector(a, b, mesh.positions[table.apex(corner)]);
  const Vec3 out = glm::cross(b - a, area);
  const double area_length = glm::length(area), out_length = glm::length(out);
  if (!(area_length > 0.0) || !(out_length > 0.0)) return std::nullopt;
  return Edge{a, b - a, glm::dot(b - a, b - a), area / area_length, out / out_length};
}

class Finder {
 public:
  Finder(const TriangleMesh& mesh, const CornerTable& table, const FaceGrid& faces,
         const PointGrid& cloud, const BorderGapOptions& options)
      : mesh_(mesh), table_(table), faces_(faces), cloud_(cloud), options_(options) {}

  [[nodiscard]] std::optional<BorderGap> worst_at(std::uint32_t corner) const {
    const auto edge = edge_at(mesh_, table_, corner);
    if (!edge) return std::nullopt;
    const auto previous = edge_at(mesh_, table_, border_before(table_, corner));
    const auto next = edge_at(mesh_, table_, border_after(table_, corner));
    const Vec3 middle = edge->start + 0.5 * edge->along;
    BorderGap worst;
    worst.beyond = options_.negligible;
    bool found = false;
    std::uint32_t in_the_way = CornerTable::kNone;  // of the point before: often of the next, too
    cloud_.for_each_near(
        middle, options_.reach + 0.5 * std::sqrt(edge->squared_length), [&](const Vec3& d) {
          const Vec3 from_start = middle + d - edge->start;
          const double share =
              std::clamp(glm::dot(from_start, edge->along) / edge->squared_length, 0.0, 1.0);
          const Vec3 offset = from_start - share * edge->along;
          const double squared = glm::dot(offset, offset);
          if (squared > options_.reach * options_.reach) return;
          double over = glm::dot(offset, edge->outward);
          if (share <= 0.0 && previous) over = std::max(over, glm::dot(offset, previous->outward));
          if (share >= 1.0 && next) over = std::max(over, glm::dot(offset, next->outward));
          if (over <= worst.beyond) return;
          const double distance = std::sqrt(squared) - kSame * options_.reach;
          const Vec3 point = edge->start + from_start;
          if (has_nearer_face(point, distance, in_the_way)) return;
          worst = {corner,        point,       share, over, glm::dot(offset, edge->normal),
                   edge->outward, edge->normal};
          found = true;
        });
    if (!found) return std::nullopt;
    return worst;
  }

 private:
  /// @param in_the_way a face that may be nearer, or kNone; becomes one that is, if there is one
  [[nodiscard]] bool has_nearer_face(const Vec3& point, double distance,
                                     std::uint32_t& in_the_way) const {
    if (distance <= 0.0) return false;
    const std::uint32_t nearer = faces_.face_within(point, distance, in_the_way);
    if (nearer != CornerTable::kNone) in_the_way = nearer;
    return nearer != CornerTable::kNone;
  }

  const TriangleMesh& mesh_;
  const CornerTable& table_;
  const FaceGrid& faces_;
  const PointGrid& cloud_;
  BorderGapOptions options_;
};

}  // namespace

std::uint32_t border_before(const CornerTable& table, std::uint32_t corner) {
  std::uint32_t last = corner;
  table.for_each_corner(table.vertex(corner), [&](std::uint32_t c) { last = c; });
  return CornerTable::previous(last);
}

std::uint32_t border_after(const CornerTable& table, std::uint32_t corner) {
  return table.corner_of(table.head(corner));
}

std::vector<BorderGap> find_border_gaps(const TriangleMesh& mesh, const CornerTable& table,
                                        const FaceGrid& faces, const PointGrid& cloud,
                                        const BorderGapOptions& options) {
  std::vector<std::uint32_t> border;
  for (std::uint32_t c = 0; c < table.corner_count(); ++c) {
    if (!table.is_deleted(c / 3) && table.across(c) == CornerTable::kNone) border.push_back(c);
  }
  return find_border_gaps(mesh, table, faces, cloud, border, options);
}

std::vector<BorderGap> find_border_gaps(const TriangleMesh& mesh, const CornerTable& table,
                                        const FaceGrid& faces, const PointGrid& cloud,
                                        std::span<const std::uint32_t> border,
                                        const BorderGapOptions& options) {
  const Finder finder(mesh, table, faces, cloud, options);
  std::vector<std::optional<BorderGap>> worst(border.size());
  parallel_for(border.size(), kEdgesPerBlock, [&](std::size_t begin, std::size_t end) {
    for (std::size_t i = begin; i < end; ++i)
      worst[i] = finder.worst_at(border[i]);
  });
  std::vector<BorderGap> gaps;
  for (const auto& gap : worst) {
    if (gap) gaps.push_back(*gap);
  }
  return gaps;
}

}  // namespace rangezip

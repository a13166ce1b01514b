#include "core/finish/points_on_faces.h"

#include <algorithm>
#include <cmath>
#include <utility>

#include "core/base/parallel.h"
#include "core/finish/face_grid.h"
#include "core/finish/face_part.h"

namespace rangezip {
namespace {

constexpr std::uint32_t kNone = CornerTable::kNone;
constexpr std::size_t kPerBlock = 1024;
constexpr double kCellPerEdge = 1.5;
constexpr double kSmallestCell = 0.1;  // of the reach
constexpr int kMostSteps = 6;          // of a walk: vertices move by less than an edge
/// Of the squared distance: of a point over a convex edge both faces are as near, but for rounding,
/// which is to decide nothing.
constexpr double kNearer = 0.999;
constexpr double kAsNear = 1.0 + 1e-9;  // for a face that is as near, but for rounding

double squared_distance(const CornerTable& table, const std::vector<Vec3>& positions,
                        std::uint32_t face, const Vec3& point) {
  const Triangle t = table.triangle(face);
  return squared_distance_to_triangle(point, positions[t[0]], positions[t[1]], positions[t[2]]);
}

/// About the size of faces, model units.
double cell_for(const TriangleMesh& mesh, double reach) {
  double sum = 0.0;
  for (const auto& [a, b, c] : mesh.triangles)
    sum += glm::length(mesh.positions[b] - mesh.positions[a]);
  const auto faces = static_cast<double>(std::max<std::size_t>(mesh.triangles.size(), 1));
  return std::max(kCellPerEdge * sum / faces, kSmallestCell * reach);
}

/// The face across the side beyond which the point's foot lies; the face itself if that is inside.
std::uint32_t face_towards(const CornerTable& table, const std::vector<Vec3>& positions,
                           std::uint32_t face, const Vec3& point) {
  const Triangle t = table.triangle(face);
  const auto share = barycentric(point, positions[t[0]], positions[t[1]], positions[t[2]]);
  const auto least = std::min_element(share.begin(), share.end());
  if (!(*least < 0.0)) return face;
  const auto corner = static_cast<std::uint32_t>(least - share.begin());
  const std::uint32_t across = table.across(CornerTable::next(3 * face + corner));
  return across == kNone ? face : across / 3;
}

std::uint32_t walk(const CornerTable& table, const std::vector<Vec3>& positions, std::uint32_t face,
                   const Vec3& point) {
  for (int step = 0; step < kMostSteps; ++step) {
    const std::uint32_t next = face_towards(table, positions, face, point);
    if (next == face || !(squared_distance(table, positions, next, point) <
                          kNearer * squared_distance(table, positions, face, point)))
      return face;
    face = next;
  }
  return face;
}

}  // namespace

PointsOnFaces::PointsOnFaces(const TriangleMesh& mesh, const CornerTable& table,
                             std::vector<Vec3> points, double reach)
    : reach_(reach), points_(std::move(points)), face_of_(points_.size(), kNone) {
  const FaceGrid grid(mesh, cell_for(mesh, reach));
  parallel_for(points_.size(), kPerBlock, [&](std::size_t begin, std::size_t end) {
    std::uint32_t guess = 0;  // points follow each other closely, mostly
    for (std::size_t i = begin; i < end; ++i) {
      face_of_[i] =
          grid.nearest_face(points_[i], reach, walk(table, mesh.positions, guess, points_[i]));
      if (face_of_[i] != kNone) guess = face_of_[i];
    }
  });
  sort(mesh.triangles.size());
}

void PointsOnFaces::find_again(const TriangleMesh& mesh, const CornerTable& table,
                               const std::vector<std::uint8_t>& is_changed) {
  const FacePart changed = face_part(mesh, is_changed);
  if (changed.mesh.empty()) return;
  const double cell = cell_for(mesh, reach_);
  const FaceGrid grid(mesh, cell), of_changed(changed.mesh, cell);
  parallel_for(points_.size(), kPerBlock, [&](std::size_t begin, std::size_t end) {
    for (std::size_t i = begin; i < end; ++i) {
      const std::uint32_t face = face_of_[i];
      const Vec3& point = points_[i];
      if (face != kNone && is_changed[face] == 0) {
        const double distance = std::sqrt(squared_distance(table, mesh.positions, face, point));
        if (!of_changed.has_face_within(point, kAsNear * distance)) continue;
      }
      face_of_[i] = face == kNone ? grid.nearest_face(point, reach_)
                                  : grid.nearest_face(point, reach_,
                                                      walk(table, mesh.positions, face, point));
    }
  });
  sort(mesh.triangles.size());
}

void PointsOnFaces::follow(const CornerTable& table, const std::vector<Vec3>& positions) {
  parallel_for(points_.size(), kPerBlock, [&](std::size_t begin, std::size_t end) {
    for (std::size_t i = begin; i < end; ++i) {
      if (face_of_[i] != kNone) face_of_[i] = walk(table, positions, face_of_[i], points_[i]);
    }
  });
  sort(table.face_count());
}

void PointsOnFaces::sort(std::size_t faces) {
  starts_.assign(faces + 1, 0);
  for (const std::uint32_t face : face_of_) {
    if (face != kNone) ++starts_[face + 1];
  }
  for (std::size_t f = 1; f < starts_.size(); ++f)
    starts_[f] += starts_[f - 1];
  order_.resize(starts_.back());
  std::vector<std::uint32_t> next(starts_.begin(), starts_.end() - 1);
  for (std::uint32_t i = 0; i < face_of_.size(); ++i) {
    if (face_of_[i] != kNone) order_[next[face_of_[i]]++] = i;
  }
}

std::array<double, 3> barycentric(const Vec3& point, const Vec3& a, const Vec3& b, const Vec3& c) {
  const Vec3 area = glm::cross(b - a, c - a);
  const double per_square = 1.0 / glm::dot(area, area);
  const double of_a = glm::dot(glm::cross(b - point, c - point), area) * per_square;
  const double of_b = glm::dot(glm::cross(c - point, a - point), area) * per_square;
  return {of_a, of_b, 1.0 - of_a - of_b};
}

}  // namespace rangezip

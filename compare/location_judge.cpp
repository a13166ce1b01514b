#include "compare/location_judge.h"

#include <algorithm>
#include <string>
#include <utility>
#include <vector>

#include "compare/mesh_distance.h"
#include "core/base/error.h"
#include "core/mesh/edge_map.h"

namespace rangezip::compare {

namespace {

constexpr double kRounding = 1e-12;  ///< of the diagonal: some 1e4 roundings of a coordinate

void check_faces(const TriangleMesh& mesh, std::span<const Vec3> points,
                 std::span<const PrimitiveId> faces) {
  if (points.size() != faces.size()) {
    throw InvalidArgument("judge_location: one face a point must be given, got " +
                          std::to_string(faces.size()) + " faces for " +
                          std::to_string(points.size()) + " points");
  }
  for (const PrimitiveId face : faces) {
    if (face == kNoPrimitive || face < mesh.triangles.size()) continue;
    throw InvalidArgument("judge_location: a face must be less than the " +
                          std::to_string(mesh.triangles.size()) + " triangles, got " +
                          std::to_string(face));
  }
}

/// Adds up what each located point lost.
class Losses {
 public:
  Losses(const TriangleMesh& mesh, std::span<const Vec3> points, double slack)
      : tolerance_(kRounding * bounds_of(mesh).diagonal()), slack_(slack) {
    verdict_.points = points.size();
  }

  void add(const WrongFace& found) {
    sum_ += found.loss;
    verdict_.max_loss = std::max(verdict_.max_loss, found.loss);
    if (found.loss <= tolerance_) {
      ++verdict_.agreeing;
      return;
    }
    if (found.loss <= slack_) ++verdict_.close;
    verdict_.wrong.push_back(found);
  }
  void add_unlocated() { ++verdict_.unlocated; }

  LocationVerdict verdict() {
    const std::size_t located = verdict_.points - verdict_.unlocated;
    if (located > 0) verdict_.mean_loss = sum_ / static_cast<double>(located);
    return std::move(verdict_);
  }

 private:
  LocationVerdict verdict_;
  double tolerance_;
  double slack_;
  double sum_ = 0.0;
};

Vec3 closest_point(const TriangleMesh& mesh, PrimitiveId face, const Vec3& point) {
  const auto& [a, b, c] = mesh.triangles[face];
  return closest_point_on_triangle(point, mesh.positions[a], mesh.positions[b], mesh.positions[c]);
}

/// A face as a line through a point meets it, or passes beside it.
struct Passing {
  double distance = 0.0;  ///< to the plane of the face, along the line
  double gap = 0.0;       ///< between the place there and the face
};

/// Where the line through a point meets the plane of a face.
Vec3 place_on_line(const TriangleMesh& mesh, PrimitiveId face, const Vec3& point,
                   const Vec3& direction) {
  const auto& [a, b, c] = mesh.triangles[face];
  const Vec3 normal = area_vector(mesh.positions[a], mesh.positions[b], mesh.positions[c]);
  const double share = glm::dot(normal, mesh.positions[a] - point) / glm::dot(normal, direction);
  return point + share * direction;
}

Passing pass(const TriangleMesh& mesh, PrimitiveId face, const Vec3& point, const Vec3& direction) {
  const Vec3 place = place_on_line(mesh, face, point, direction);
  return {.distance = glm::length(place - point),
          .gap = glm::length(place - closest_point(mesh, face, place))};
}

std::vector<Vec3> lines_of_sight(const View& view, std::span<const Vec3> points) {
  std::vector<Vec3> directions;
  for (const Vec3& point : points)
    directions.push_back(view.toward_viewer(point));
  return directions;
}

/// The ends of a surface: edges that no other face has, and their vertices.
class SurfaceEnds {
 public:
  explicit SurfaceEnds(const TriangleMesh& mesh) : mesh_(mesh), edges_(3 * mesh.triangles.size()) {
    for (const Triangle& t : mesh.triangles) {
      for (std::size_t k = 0; k < 3; ++k)
        edges_.insert(t[k], t[(k + 1) % 3], 0);
    }
    is_end_.assign(mesh.positions.size(), 0);
    for (const Triangle& t : mesh.triangles) {
      for (std::size_t k = 0; k < 3; ++k) {
        if (is_end(t, k)) is_end_[t[k]] = is_end_[t[(k + 1) % 3]] = 1;
      }
    }
  }

  /// Whether a place on the face lies within `tolerance` of an end.
  [[nodiscard]] bool are_near(PrimitiveId face, const Vec3& place, double tolerance) const {
    const Triangle& t = mesh_.triangles[face];
    for (std::size_t k = 0; k < 3; ++k) {
      const Vec3& a = mesh_.positions[t[k]];
      const Vec3& b = mesh_.positions[t[(k + 1) % 3]];
      if (is_end_[t[k]] != 0 && glm::length(place - a) <= tolerance) return true;
      const Vec3 on_edge = closest_point_on_triangle(place, a, b, b);
      if (is_end(t, k) && glm::length(place - on_edge) <= tolerance) return true;
    }
    return false;
  }

 private:
  [[nodiscard]] bool is_end(const Triangle& t, std::size_t k) const {
    return edges_.find(t[(k + 1) % 3], t[k]) == EdgeMap::kNone;
  }

  const TriangleMesh& mesh_;
  EdgeMap edges_;
  std::vector<std::uint8_t> is_end_;  ///< per vertex
};

}  // namespace

LocationVerdict judge_location(const TriangleMesh& mesh, std::span<const Vec3> points,
                               std::span<const PrimitiveId> faces, double slack) {
  check_faces(mesh, points, faces);
  const std::vector<NearestFace> nearest = nearest_faces(points, mesh);
  Losses losses(mesh, points, slack);
  for (std::size_t i = 0; i < points.size(); ++i) {
    if (faces[i] == kNoPrimitive) {
      losses.add_unlocated();
      continue;
    }
    const double distance = glm::length(points[i] - closest_point(mesh, faces[i], points[i]));
    losses.add({.point = i,
                .given = faces[i],
                .nearest = nearest[i].face,
                .loss = std::max(0.0, distance - nearest[i].distance)});
  }
  return losses.verdict();
}

LocationVerdict judge_location_in_sight(const TriangleMesh& mesh, const View& view,
                                        std::span<const Vec3> points,
                                        std::span<const PrimitiveId> faces, double slack) {
  check_faces(mesh, points, faces);
  const std::vector<Vec3> directions = lines_of_sight(view, points);
  const auto nearest = nearest_faces_along(points, directions, mesh);
  Losses losses(mesh, points, slack);
  for (std::size_t i = 0; i < points.size(); ++i) {
    if (faces[i] == kNoPrimitive) {
      losses.add_unlocated();
      continue;
    }
    const Passing passing = pass(mesh, faces[i], points[i], directions[i]);
    const double best = nearest[i] ? nearest[i]->distance : passing.distance;
    losses.add({.point = i,
                .given = faces[i],
                .nearest = nearest[i] ? nearest[i]->face : faces[i],
                .loss = std::max(0.0, passing.distance - best) + passing.gap});
  }
  return losses.verdict();
}

std::size_t count_missed(const TriangleMesh& mesh, const View& view, std::span<const Vec3> points,
                         std::span<const PrimitiveId> faces, double distance) {
  check_faces(mesh, points, faces);
  const double tolerance = distance / 30.0;  // a drawn face ends where its snapped corners say
  std::vector<Vec3> unlocated;
  for (std::size_t i = 0; i < points.size(); ++i) {
    if (faces[i] == kNoPrimitive) unlocated.push_back(points[i]);
  }
  const std::vector<Vec3> directions = lines_of_sight(view, unlocated);
  const auto nearest = nearest_faces_along(unlocated, directions, mesh);
  const SurfaceEnds ends(mesh);
  std::size_t missed = 0;
  for (std::size_t i = 0; i < unlocated.size(); ++i) {
    if (!nearest[i] || nearest[i]->distance > distance) continue;
    const PrimitiveId face = nearest[i]->face;
    const auto& [a, b, c] = mesh.triangles[face];
    const Vec3 normal = area_vector(mesh.positions[a], mesh.positions[b], mesh.positions[c]);
    const bool looks_at_viewer = glm::dot(normal, directions[i]) > 0.0;
    const Vec3 place = place_on_line(mesh, face, unlocated[i], directions[i]);
    if (looks_at_viewer && !ends.are_near(face, place, tolerance)) ++missed;
  }
  return missed;
}

}  // namespace rangezip::compare

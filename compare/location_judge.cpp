#include "compare/location_judge.h"

#include <algorithm>
#include <string>
#include <utility>
#include <vector>

#include "compare/mesh_distance.h"
#include "core/base/error.h"

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

Passing pass(const TriangleMesh& mesh, PrimitiveId face, const Vec3& point, const Vec3& direction) {
  const auto& [a, b, c] = mesh.triangles[face];
  const Vec3 normal = area_vector(mesh.positions[a], mesh.positions[b], mesh.positions[c]);
  const double share = glm::dot(normal, mesh.positions[a] - point) / glm::dot(normal, direction);
  const Vec3 place = point + share * direction;
  return {.distance = glm::length(place - point),
          .gap = glm::length(place - closest_point(mesh, face, place))};
}

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
  std::vector<Vec3> directions;
  for (const Vec3& point : points)
    directions.push_back(view.toward_viewer(point));
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

}  // namespace rangezip::compare

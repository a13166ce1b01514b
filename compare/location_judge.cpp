#include "compare/location_judge.h"

#include <algorithm>
#include <string>
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

}  // namespace

LocationVerdict judge_location(const TriangleMesh& mesh, std::span<const Vec3> points,
                               std::span<const PrimitiveId> faces) {
  check_faces(mesh, points, faces);
  const std::vector<NearestFace> nearest = nearest_faces(points, mesh);
  const double tolerance = kRounding * bounds_of(mesh).diagonal();

  LocationVerdict verdict{.points = points.size()};
  double sum_of_losses = 0.0;
  for (std::size_t i = 0; i < points.size(); ++i) {
    if (faces[i] == kNoPrimitive) {
      ++verdict.unlocated;
      continue;
    }
    const auto& [a, b, c] = mesh.triangles[faces[i]];
    const Vec3 foot = closest_point_on_triangle(points[i], mesh.positions[a], mesh.positions[b],
                                                mesh.positions[c]);
    const double loss = std::max(0.0, glm::length(points[i] - foot) - nearest[i].distance);
    if (loss <= tolerance) ++verdict.agreeing;
    sum_of_losses += loss;
    verdict.max_loss = std::max(verdict.max_loss, loss);
  }
  const std::size_t located = verdict.points - verdict.unlocated;
  if (located > 0) verdict.mean_loss = sum_of_losses / static_cast<double>(located);
  return verdict;
}

}  // namespace rangezip::compare

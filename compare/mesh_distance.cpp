#include "compare/mesh_distance.h"

#include <CGAL/AABB_traits.h>
#include <CGAL/AABB_tree.h>
#include <CGAL/AABB_triangle_primitive.h>
#include <CGAL/Exact_predicates_inexact_constructions_kernel.h>

#include <algorithm>
#include <cmath>
#include <iterator>
#include <string>

#include "compare/mesh_values.h"
#include "compare/random.h"
#include "core/base/error.h"
#include "core/base/parallel.h"

namespace rangezip::compare {

namespace {

using Kernel = CGAL::Exact_predicates_inexact_constructions_kernel;
using Triangles = std::vector<Kernel::Triangle_3>;
using Primitive = CGAL::AABB_triangle_primitive<Kernel, Triangles::const_iterator>;
using Tree = CGAL::AABB_tree<CGAL::AABB_traits<Kernel, Primitive>>;

constexpr std::size_t kQueriesPerBlock = 1024;

Kernel::Point_3 to_cgal(const Vec3& p) {
  return {p.x, p.y, p.z};
}

/// The triangles with an area, and which face of the mesh each is.
struct Faces {
  Triangles triangles;
  std::vector<std::uint32_t> index;
};

Faces faces_with_area(const TriangleMesh& mesh) {
  Faces faces;
  for (std::size_t i = 0; i < mesh.triangles.size(); ++i) {
    const auto& [a, b, c] = mesh.triangles[i];
    const Kernel::Triangle_3 triangle{to_cgal(mesh.positions[a]), to_cgal(mesh.positions[b]),
                                      to_cgal(mesh.positions[c])};
    if (triangle.is_degenerate()) continue;
    faces.triangles.push_back(triangle);
    faces.index.push_back(static_cast<std::uint32_t>(i));
  }
  return faces;
}

double distance_to_face(const Vec3& point, const TriangleMesh& mesh, std::uint32_t face) {
  const auto& [a, b, c] = mesh.triangles[face];
  return glm::length(point - closest_point_on_triangle(point, mesh.positions[a], mesh.positions[b],
                                                       mesh.positions[c]));
}

/// (u, v) in the unit square to an even spread over the triangle [Turk 1990].
Vec3 point_in_triangle(const TriangleMesh& mesh, const Triangle& triangle, double u, double v) {
  const double root = std::sqrt(u);
  return (1.0 - root) * mesh.positions[triangle[0]] +
         root * (1.0 - v) * mesh.positions[triangle[1]] + root * v * mesh.positions[triangle[2]];
}

void check_points(const std::string& function, std::span<const Vec3> points) {
  for (std::size_t i = 0; i < points.size(); ++i) {
    if (is_finite(points[i])) continue;
    throw InvalidArgument(function + ": every point must be finite, not so point " +
                          std::to_string(i));
  }
}

Faces faces_to_search(const char* function, const TriangleMesh& mesh) {
  check_mesh_values(function, mesh);
  Faces faces = faces_with_area(mesh);
  if (faces.triangles.empty()) {
    throw TopologyError(std::string(function) + ": the mesh must have a face with an area");
  }
  return faces;
}

/// From a point to where a line through it meets a triangle, along the line.
double distance_along(const Kernel::Point_3& point, const Kernel::Line_3& line,
                      const Kernel::Triangle_3& triangle) {
  const auto meeting = CGAL::intersection(line, triangle.supporting_plane());
  const auto* place = meeting ? boost::get<Kernel::Point_3>(&*meeting) : nullptr;
  // A line within the plane meets the triangle no nearer than the triangle is.
  return std::sqrt(place ? CGAL::squared_distance(point, *place)
                         : CGAL::squared_distance(point, triangle));
}

}  // namespace

std::vector<NearestFace> nearest_faces(std::span<const Vec3> points, const TriangleMesh& mesh) {
  check_points("nearest_faces", points);
  const Faces faces = faces_to_search("nearest_faces", mesh);
  Tree tree(faces.triangles.begin(), faces.triangles.end());
  tree.build();
  tree.accelerate_distance_queries();  // from here on the tree is only read

  std::vector<NearestFace> nearest(points.size());
  parallel_for(points.size(), kQueriesPerBlock, [&](std::size_t begin, std::size_t end) {
    for (std::size_t i = begin; i < end; ++i) {
      const auto found = tree.closest_point_and_primitive(to_cgal(points[i])).second;
      const auto position = static_cast<std::size_t>(found - faces.triangles.begin());
      const std::uint32_t face = faces.index[position];
      // CGAL's nearest point is constructed with rounding; the distance is computed afresh.
      nearest[i] = {.face = face, .distance = distance_to_face(points[i], mesh, face)};
    }
  });
  return nearest;
}

std::vector<std::optional<NearestFace>> nearest_faces_along(std::span<const Vec3> points,
                                                            std::span<const Vec3> directions,
                                                            const TriangleMesh& mesh) {
  check_points("nearest_faces_along", points);
  if (directions.size() != points.size()) {
    throw InvalidArgument("nearest_faces_along: one direction a point must be given, got " +
                          std::to_string(directions.size()) + " for " +
                          std::to_string(points.size()) + " points");
  }
  const Faces faces = faces_to_search("nearest_faces_along", mesh);
  Tree tree(faces.triangles.begin(), faces.triangles.end());
  tree.build();

  std::vector<std::optional<NearestFace>> nearest(points.size());
  parallel_for(points.size(), kQueriesPerBlock, [&](std::size_t begin, std::size_t end) {
    std::vector<Triangles::const_iterator> met;
    for (std::size_t i = begin; i < end; ++i) {
      const Kernel::Point_3 point = to_cgal(points[i]);
      const Kernel::Line_3 line(point, to_cgal(points[i] + directions[i]));
      met.clear();
      tree.all_intersected_primitives(line, std::back_inserter(met));
      for (const auto triangle : met) {
        const double distance = distance_along(point, line, *triangle);
        if (nearest[i] && nearest[i]->distance <= distance) continue;
        const auto position = static_cast<std::size_t>(triangle - faces.triangles.begin());
        nearest[i] = {.face = faces.index[position], .distance = distance};
      }
    }
  });
  return nearest;
}

std::vector<double> distances_to_mesh(std::span<const Vec3> points, const TriangleMesh& mesh) {
  std::vector<double> distances;
  distances.reserve(points.size());
  for (const NearestFace& nearest : nearest_faces(points, mesh)) {
    distances.push_back(nearest.distance);
  }
  return distances;
}

DistanceSummary summarize(std::span<const double> distances) {
  if (distances.empty()) return {};
  std::vector<double> sorted(distances.begin(), distances.end());
  std::ranges::sort(sorted);
  double sum = 0.0;
  double sum_of_squares = 0.0;
  for (const double distance : sorted) {
    sum += distance;
    sum_of_squares += distance * distance;
  }
  const auto count = static_cast<double>(sorted.size());
  return {.count = sorted.size(),
          .mean = sum / count,
          .rms = std::sqrt(sum_of_squares / count),
          .p95 = percentile(sorted, 95),
          .max = sorted.back()};
}

double percentile(std::vector<double> values, std::size_t percent) {
  if (values.empty()) return 0.0;
  const std::size_t rank = (values.size() * percent + 99) / 100;  // rounded up, from 1
  const auto place = values.begin() + static_cast<std::ptrdiff_t>(rank - 1);
  std::nth_element(values.begin(), place, values.end());
  return *place;
}

double share_within(std::span<const double> distances, double limit) {
  if (distances.empty()) return 1.0;
  const auto within = std::ranges::count_if(distances, [&](double d) { return d <= limit; });
  return static_cast<double>(within) / static_cast<double>(distances.size());
}

std::vector<Vec3> sample_surface(const TriangleMesh& mesh, const SurfaceSampleOptions& options) {
  check_mesh_values("sample_surface", mesh);
  std::vector<double> area_up_to;  // twice the area of the faces up to and with each
  area_up_to.reserve(mesh.triangles.size());
  double total = 0.0;
  for (const auto& [a, b, c] : mesh.triangles) {
    total += glm::length(area_vector(mesh.positions[a], mesh.positions[b], mesh.positions[c]));
    area_up_to.push_back(total);
  }
  if (!(total > 0.0)) throw TopologyError("sample_surface: the mesh must have an area");

  std::vector<Vec3> samples;
  samples.reserve(options.count);
  std::size_t face = 0;
  for (std::size_t i = 0; i < options.count; ++i) {
    const auto draw = [&](std::uint64_t k) {
      return uniform_in_unit_interval(options.seed, 3 * i + k);
    };
    const double target =
        total * (static_cast<double>(i) + draw(0)) / static_cast<double>(options.count);
    while (face + 1 < area_up_to.size() && area_up_to[face] <= target)
      ++face;
    samples.push_back(point_in_triangle(mesh, mesh.triangles[face], draw(1), draw(2)));
  }
  return samples;
}

}  // namespace rangezip::compare

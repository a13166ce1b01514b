#include "compare/geodesic_judge.h"

#include <CGAL/Exact_predicates_inexact_constructions_kernel.h>
#include <CGAL/Polygon_mesh_processing/orient_polygon_soup.h>
#include <CGAL/Polygon_mesh_processing/polygon_soup_to_polygon_mesh.h>
#include <CGAL/Surface_mesh.h>
#include <CGAL/Surface_mesh_shortest_path.h>

#include <algorithm>
#include <array>
#include <iterator>
#include <limits>
#include <map>
#include <string>
#include <unordered_map>
#include <unordered_set>
#include <utility>

#include "compare/mesh_values.h"
#include "core/base/error.h"
#include "core/base/parallel.h"
#include "core/mesh/outgoing_edges.h"

namespace rangezip::compare {

namespace {

namespace pmp = CGAL::Polygon_mesh_processing;
using Kernel = CGAL::Exact_predicates_inexact_constructions_kernel;
using SurfaceMesh = CGAL::Surface_mesh<Kernel::Point_3>;
using Traits = CGAL::Surface_mesh_shortest_path_traits<Kernel, SurfaceMesh>;
using ShortestPath = CGAL::Surface_mesh_shortest_path<Traits>;

constexpr std::size_t kPathsPerBlock = 16;
constexpr double kInside = 1e-10;   ///< least weight of a corner
constexpr double kRounding = 1e-7;  ///< of a length: some roundings of floating-point unfolding

/// The distance from a point to a face, model units.
double distance(const TriangleMesh& mesh, std::uint32_t face, const Vec3& point) {
  const auto& [a, b, c] = mesh.triangles[face];
  return glm::length(point - closest_point_on_triangle(point, mesh.positions[a], mesh.positions[b],
                                                       mesh.positions[c]));
}

/// The faces that a path of that length from the start can touch: they hang together by edges.
std::vector<std::uint32_t> reachable_faces(const TriangleMesh& mesh, const OutgoingEdges& edges,
                                           const SurfacePath& path, double length) {
  const double radius = length * (1.0 + kRounding);
  std::vector<std::uint32_t> faces{path.faces.front()};
  std::unordered_set<std::uint32_t> seen{path.faces.front()};
  for (std::size_t i = 0; i < faces.size(); ++i) {
    const Triangle& t = mesh.triangles[faces[i]];
    for (std::size_t k = 0; k < 3; ++k) {
      const std::uint32_t next = edges.find(t[(k + 1) % 3], t[k]);
      if (next == OutgoingEdges::kNone || !seen.insert(next).second) continue;
      if (distance(mesh, next, path.points.front()) <= radius) faces.push_back(next);
    }
  }
  return faces;
}

/// The form in which CGAL takes faces. Polygon i is face i of those that were asked for.
struct Soup {
  std::vector<Kernel::Point_3> points;
  std::vector<std::array<std::size_t, 3>> polygons;

  std::size_t add(const Vec3& p) {
    points.emplace_back(p.x, p.y, p.z);
    return points.size() - 1;
  }
};

/// The faces as they hang together in the mesh.
Soup part_of(const TriangleMesh& mesh, const std::vector<std::uint32_t>& faces) {
  Soup soup;
  std::unordered_map<std::uint32_t, std::size_t> local;
  for (const std::uint32_t f : faces) {
    auto& polygon = soup.polygons.emplace_back();
    for (std::size_t k = 0; k < 3; ++k) {
      const std::uint32_t v = mesh.triangles[f][k];
      const auto known = local.find(v);
      polygon[k] = known != local.end() ? known->second : soup.add(mesh.positions[v]);
      local[v] = polygon[k];
    }
  }
  return soup;
}

/// The faces as a strip: each hangs on the one before it only, also where it meets others.
Soup strip_of(const TriangleMesh& mesh, const std::vector<std::uint32_t>& faces) {
  Soup soup;
  std::map<std::uint32_t, std::size_t> last;
  for (const std::uint32_t f : faces) {
    auto& polygon = soup.polygons.emplace_back();
    std::map<std::uint32_t, std::size_t> here;
    for (std::size_t k = 0; k < 3; ++k) {
      const std::uint32_t v = mesh.triangles[f][k];
      const auto shared = last.find(v);
      polygon[k] = shared != last.end() ? shared->second : soup.add(mesh.positions[v]);
      here[v] = polygon[k];
    }
    last = std::move(here);
  }
  return soup;
}

/// What touches in one vertex only is parted.
SurfaceMesh surface_of(Soup soup) {
  pmp::orient_polygon_soup(soup.points, soup.polygons);
  SurfaceMesh surface;
  pmp::polygon_soup_to_polygon_mesh(soup.points, soup.polygons, surface);
  return surface;
}

/// Where a point of a face is in it, as CGAL wants it: by weights of the corners in the order of
/// the face's halfedges. From places on an edge CGAL 5.5 does not find the shortest path: they are
/// moved inside.
ShortestPath::Face_location location_of(const SurfaceMesh& surface, SurfaceMesh::Face_index face,
                                        const Vec3& point) {
  std::array<Vec3, 3> corners;
  auto e = surface.halfedge(face);
  for (Vec3& corner : corners) {
    const auto& p = surface.point(surface.source(e));
    corner = {p.x(), p.y(), p.z()};
    e = surface.next(e);
  }
  const Vec3 normal = area_vector(corners[0], corners[1], corners[2]);
  std::array<double, 3> weights{};
  double sum = 0.0;
  for (std::size_t k = 0; k < 3; ++k) {
    const Vec3 part = area_vector(point, corners[(k + 1) % 3], corners[(k + 2) % 3]);
    weights[k] = glm::dot(part, normal) / glm::dot(normal, normal);
    weights[k] = std::max(weights[k], kInside);
    sum += weights[k];
  }
  return {face, {weights[0] / sum, weights[1] / sum, weights[2] / sum}};
}

double distance_to_polyline(const Vec3& point, const std::vector<Vec3>& line) {
  double nearest = std::numeric_limits<double>::infinity();
  for (std::size_t i = 1; i < line.size(); ++i) {
    const Vec3 along = line[i] - line[i - 1];
    const double square = glm::dot(along, along);
    const double share =
        square > 0.0 ? std::clamp(glm::dot(point - line[i - 1], along) / square, 0.0, 1.0) : 0.0;
    nearest = std::min(nearest, glm::length(point - (line[i - 1] + share * along)));
  }
  return nearest;
}

double deviation_of(const std::vector<Vec3>& a, const std::vector<Vec3>& b) {
  double largest = 0.0;
  for (const Vec3& point : a)
    largest = std::max(largest, distance_to_polyline(point, b));
  for (const Vec3& point : b)
    largest = std::max(largest, distance_to_polyline(point, a));
  return largest;
}

/// The shortest path over a surface from its face 0 to another, between the ends of a path; empty
/// if there is none.
std::vector<Vec3> shortest_over(const SurfaceMesh& surface, std::size_t end_face,
                                const SurfacePath& path) {
  const auto from = location_of(surface, SurfaceMesh::Face_index(0), path.points.front());
  const auto to = location_of(
      surface, SurfaceMesh::Face_index(static_cast<std::uint32_t>(end_face)), path.points.back());
  std::vector<Kernel::Point_3> found;
  try {
    ShortestPath shortest(surface);
    shortest.add_source_point(from);
    shortest.shortest_path_points_to_source_points(to.first, to.second, std::back_inserter(found));
  } catch (const CGAL::Failure_exception&) {  // of checks that only debug builds have
    return {};
  }
  std::vector<Vec3> line;
  line.reserve(found.size() + 1);
  for (const auto& p : found)
    line.emplace_back(p.x(), p.y(), p.z());
  if (line.size() == 1) line.push_back(line.front());
  return line;
}

GeodesicMatch judge(const TriangleMesh& mesh, const OutgoingEdges& edges, const SurfacePath& path) {
  const double line = length_of(path.points);
  if (path.faces.size() == 1) {
    return {.line = line, .length = line, .shortest = line, .is_judged = true};
  }
  const std::vector<std::uint32_t> reachable = reachable_faces(mesh, edges, path, line);
  const auto end = std::find(reachable.begin(), reachable.end(), path.faces.back());
  if (end == reachable.end()) return {.line = line};
  const std::vector<Vec3> through =
      shortest_over(surface_of(strip_of(mesh, path.faces)), path.faces.size() - 1, path);
  const std::vector<Vec3> shortest =
      shortest_over(surface_of(part_of(mesh, reachable)),
                    static_cast<std::size_t>(end - reachable.begin()), path);
  if (through.empty() || shortest.empty()) return {.line = line};
  GeodesicMatch match{.line = line,
                      .length = length_of(through),
                      .shortest = length_of(shortest),
                      .deviation = deviation_of(through, shortest)};
  match.is_judged = match.shortest <= match.length * (1.0 + kRounding) &&
                    match.length <= line * (1.0 + kRounding);
  return match;
}

void check_paths(const TriangleMesh& mesh, std::span<const SurfacePath> paths) {
  for (const SurfacePath& path : paths) {
    if (path.faces.empty() || path.points.size() != path.faces.size() + 1) {
      throw InvalidArgument("judge_geodesics: a path must have a face and one point more, got " +
                            std::to_string(path.faces.size()) + " faces and " +
                            std::to_string(path.points.size()) + " points");
    }
    const std::uint32_t last = *std::max_element(path.faces.begin(), path.faces.end());
    if (last < mesh.triangles.size()) continue;
    throw InvalidArgument("judge_geodesics: a face must be less than the " +
                          std::to_string(mesh.triangles.size()) + " triangles, got " +
                          std::to_string(last));
  }
}

}  // namespace

std::vector<GeodesicMatch> judge_geodesics(const TriangleMesh& mesh,
                                           std::span<const SurfacePath> paths) {
  check_mesh_values("judge_geodesics", mesh);
  check_paths(mesh, paths);
  const OutgoingEdges edges(mesh);
  std::vector<GeodesicMatch> matches(paths.size());
  parallel_for(paths.size(), kPathsPerBlock, [&](std::size_t begin, std::size_t end) {
    for (std::size_t i = begin; i < end; ++i)
      matches[i] = judge(mesh, edges, paths[i]);
  });
  return matches;
}

}  // namespace rangezip::compare

#include "compare/mesh_judge.h"

#include <CGAL/Exact_predicates_inexact_constructions_kernel.h>
#include <CGAL/Polygon_mesh_processing/border.h>
#include <CGAL/Polygon_mesh_processing/connected_components.h>
#include <CGAL/Polygon_mesh_processing/measure.h>
#include <CGAL/Polygon_mesh_processing/polygon_soup_to_polygon_mesh.h>
#include <CGAL/Polygon_mesh_processing/self_intersections.h>
#include <CGAL/Surface_mesh.h>

#include <algorithm>
#include <array>
#include <iterator>
#include <string>

#include "compare/mesh_values.h"
#include "core/base/error.h"

namespace rangezip::compare {

namespace {

namespace pmp = CGAL::Polygon_mesh_processing;
using Kernel = CGAL::Exact_predicates_inexact_constructions_kernel;
using SurfaceMesh = CGAL::Surface_mesh<Kernel::Point_3>;
using FacePair = std::pair<std::uint32_t, std::uint32_t>;

/// The form in which CGAL takes triangles that may be no mesh at all.
struct Soup {
  std::vector<Kernel::Point_3> points;
  std::vector<std::array<std::size_t, 3>> polygons;
};

/// Without the positions that no triangle uses.
Soup make_soup(const char* function, TriangleMesh mesh) {
  check_mesh_values(function, mesh);
  remove_unused_vertices(mesh);
  Soup soup;
  soup.points.reserve(mesh.positions.size());
  for (const Vec3& p : mesh.positions)
    soup.points.emplace_back(p.x, p.y, p.z);
  soup.polygons.reserve(mesh.triangles.size());
  for (const Triangle& t : mesh.triangles)
    soup.polygons.push_back({t[0], t[1], t[2]});
  return soup;
}

/// Face i of the result is polygon i.
SurfaceMesh make_surface_mesh(const Soup& soup) {
  SurfaceMesh surface;
  pmp::polygon_soup_to_polygon_mesh(soup.points, soup.polygons, surface);
  return surface;
}

std::vector<FacePair> intersecting_pairs(const SurfaceMesh& surface) {
  std::vector<std::pair<SurfaceMesh::Face_index, SurfaceMesh::Face_index>> found;
  pmp::self_intersections(surface, std::back_inserter(found));
  std::vector<FacePair> pairs;
  pairs.reserve(found.size());
  for (const auto& [a, b] : found) {
    pairs.emplace_back(std::min<std::uint32_t>(a, b), std::max<std::uint32_t>(a, b));
  }
  std::ranges::sort(pairs);
  return pairs;
}

std::size_t count_components(const SurfaceMesh& surface) {
  std::vector<std::size_t> component_of(surface.num_faces());
  return pmp::connected_components(surface, CGAL::make_property_map(component_of));
}

std::size_t count_boundary_loops(const SurfaceMesh& surface) {
  std::vector<SurfaceMesh::Halfedge_index> loops;
  pmp::extract_boundary_cycles(surface, std::back_inserter(loops));
  return loops.size();
}

}  // namespace

MeshVerdict judge_mesh(const TriangleMesh& mesh) {
  const Soup soup = make_soup("judge_mesh", mesh);
  MeshVerdict verdict{.vertices = soup.points.size(), .faces = soup.polygons.size()};
  verdict.is_manifold = pmp::is_polygon_soup_a_polygon_mesh(soup.polygons);
  if (!verdict.is_manifold) return verdict;

  const SurfaceMesh surface = make_surface_mesh(soup);
  verdict.components = count_components(surface);
  verdict.boundary_loops = count_boundary_loops(surface);
  verdict.euler = static_cast<std::ptrdiff_t>(surface.num_vertices()) -
                  static_cast<std::ptrdiff_t>(surface.num_edges()) +
                  static_cast<std::ptrdiff_t>(surface.num_faces());
  if (verdict.boundary_loops == 0) verdict.volume = pmp::volume(surface);
  for (const auto& [a, b] : intersecting_pairs(surface)) {
    ++(a == b ? verdict.degenerate_faces : verdict.self_intersections);
  }
  return verdict;
}

std::vector<FacePair> cgal_self_intersections(const TriangleMesh& mesh) {
  const Soup soup = make_soup("cgal_self_intersections", mesh);
  if (!pmp::is_polygon_soup_a_polygon_mesh(soup.polygons)) {
    throw TopologyError("cgal_self_intersections: the mesh must be manifold and oriented");
  }
  return intersecting_pairs(make_surface_mesh(soup));
}

}  // namespace rangezip::compare

// Meshes a cloud by CGAL, for comparison only: cgal_peer af|smooth-af IN.xyz OUT.off
// af: advancing front of the points. smooth-af: jet smoothing, a grid of two spacings, advancing
// front: what a user of CGAL does with noise.
#include <CGAL/Advancing_front_surface_reconstruction.h>
#include <CGAL/Exact_predicates_inexact_constructions_kernel.h>
#include <CGAL/compute_average_spacing.h>
#include <CGAL/grid_simplify_point_set.h>
#include <CGAL/jet_smooth_point_set.h>

#include <cstdio>
#include <exception>
#include <iterator>
#include <string>

#include "plain_files.h"

namespace {

using Kernel = CGAL::Exact_predicates_inexact_constructions_kernel;
using Point = Kernel::Point_3;

void smooth_and_thin(std::vector<Point>& points) {
  constexpr unsigned kNeighbours = 24;
  constexpr unsigned kSpacingNeighbours = 6;
  CGAL::jet_smooth_point_set<CGAL::Sequential_tag>(points, kNeighbours);
  const double spacing =
      CGAL::compute_average_spacing<CGAL::Sequential_tag>(points, kSpacingNeighbours);
  points.erase(CGAL::grid_simplify_point_set(points, 2.0 * spacing), points.end());
}

}  // namespace

int main(int argc, char** argv) try {
  if (argc != 4) throw std::runtime_error("usage: cgal_peer af|smooth-af IN.xyz OUT.off");
  std::vector<Point> points;
  for (const auto& p : read_xyz(argv[2]))
    points.emplace_back(p[0], p[1], p[2]);
  if (std::string(argv[1]) == "smooth-af") smooth_and_thin(points);
  std::vector<std::array<std::size_t, 3>> faces;
  CGAL::advancing_front_surface_reconstruction(points.begin(), points.end(),
                                               std::back_inserter(faces));
  std::vector<std::array<double, 3>> positions;
  for (const Point& p : points)
    positions.push_back({p.x(), p.y(), p.z()});
  write_off(argv[3], positions, faces);
  return 0;
} catch (const std::exception& error) {
  std::fprintf(stderr, "cgal_peer: %s\n", error.what());
  return 1;
}

#include <CGAL/Constrained_Delaunay_triangulation_2.h>
#include <CGAL/Exact_predicates_inexact_constructions_kernel.h>
#include <CGAL/Triangulation_vertex_base_with_info_2.h>

#include <algorithm>
#include <catch2/catch.hpp>
#include <set>

#include "core/stitch/constrained_delaunay.h"
#include "tests/core/stitch/point_sets.h"

using namespace rangezip;
using test::PointSet;
using test::Segment;

namespace {

using Kernel = CGAL::Exact_predicates_inexact_constructions_kernel;
using VertexBase = CGAL::Triangulation_vertex_base_with_info_2<std::uint32_t, Kernel>;
using FaceBase = CGAL::Constrained_triangulation_face_base_2<Kernel>;
using Storage = CGAL::Triangulation_data_structure_2<VertexBase, FaceBase>;
using Oracle = CGAL::Constrained_Delaunay_triangulation_2<Kernel, Storage,
                                                          CGAL::No_constraint_intersection_tag>;

Triangle from_lowest(Triangle t) {
  std::rotate(t.begin(), std::min_element(t.begin(), t.end()), t.end());
  return t;
}

Oracle oracle_of(const PointSet& set) {
  Oracle oracle;
  std::vector<Oracle::Vertex_handle> handles;
  for (std::uint32_t i = 0; i < set.points.size(); ++i) {
    const GridPoint& p = set.points[i];
    handles.push_back(
        oracle.insert(Kernel::Point_2(static_cast<double>(p.x), static_cast<double>(p.y))));
    handles.back()->info() = i;
  }
  for (const Segment& s : set.segments)
    oracle.insert_constraint(handles[s[0]], handles[s[1]]);
  return oracle;
}

std::set<Triangle> triangles_of(const Oracle& oracle) {
  std::set<Triangle> triangles;
  for (auto f = oracle.finite_faces_begin(); f != oracle.finite_faces_end(); ++f) {
    triangles.insert(
        from_lowest({f->vertex(0)->info(), f->vertex(1)->info(), f->vertex(2)->info()}));
  }
  return triangles;
}

}  // namespace

TEST_CASE("triangulate_constrained gives CGAL's triangles where they are unique", "[stitch]") {
  for (unsigned seed = 0; seed < 40; ++seed) {
    CAPTURE(seed);
    // Four of a few hundred points on 2^29 steps are not co-circular but by a miracle.
    const PointSet set = test::random_points(seed, 10 + 8 * seed, 2 * kGridLimit, 3 * seed);
    std::set<Triangle> ours;
    for (const Triangle& t : triangulate_constrained(set.points, set.segments).triangles) {
      ours.insert(from_lowest(t));
    }
    CHECK(ours == triangles_of(oracle_of(set)));
  }
}

TEST_CASE("triangulate_constrained has as many triangles as CGAL on lattices", "[stitch]") {
  for (unsigned seed = 0; seed < 40; ++seed) {
    CAPTURE(seed);
    const PointSet set = test::random_points(seed, 20 + 8 * seed, 6 + seed / 3, 2 * seed);
    CHECK(triangulate_constrained(set.points, set.segments).triangles.size() ==
          triangles_of(oracle_of(set)).size());
  }
}

#pragma once

#include <vector>

#include "core/base/progress.h"
#include "core/mesh/triangle_mesh.h"

namespace rangezip {

/// Moves inner vertices, in any direction, and turns edges, so that the flat triangles are as near
/// as can be to the points: the least squares of the points' distances from the planes of the faces
/// they lie on, as in quadric error metrics [Garland, Heckbert 1997], of all vertices together. A
/// vertex comes to lie off a curved surface, on the outer side of its triangles, and slides to
/// where the surface bends most. Where it does not bend, vertices move towards the middle of their
/// faces. In six rounds, in each of which points find their faces anew. Vertices and edges stay
/// where an angle would get both under 31 degrees and smaller than it is, or a face would turn by
/// more than 60 degrees. The boundary stays. May leave self-intersections where sheets are close
/// together. Cost: linear in points and faces; in parallel but for 40 visits a face.
/// @param points of hardly any noise, several a face: fewer than three a vertex leave it
/// undetermined
/// @param reach points farther than this from the mesh do not count, model units; positive
/// @pre oriented, manifold (core/finish/clean_topology.h)
void fit_faces(TriangleMesh& mesh, std::vector<Vec3> points, double reach,
               const Progress& progress = {});

}  // namespace rangezip

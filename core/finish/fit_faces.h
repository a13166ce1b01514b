#pragma once

#include <vector>

#include "core/base/progress.h"
#include "core/mesh/triangle_mesh.h"

namespace rangezip {

struct FitFacesOptions {
  double reach = 0.0;  ///< points farther than this from the mesh do not count, model units;
                       ///< positive
  /// Sine of the angle under which none gets smaller: 31 degrees.
  double small_angle = 0.515;
  /// What holds vertices in the middle of their faces, in the weight of the points: where the
  /// surface bends by more than its root, a tenth of a radian, over an edge, the points decide.
  double hold = 0.009;
  /// Sine of what the median of the faces' smallest angles is to be: 50.1 degrees. After a round in
  /// which it is less vertices are held more, and edges turn more freely. 0: as they are.
  double median_angle = 0.7672;
};

/// Moves inner vertices, in any direction, and turns edges, so that the flat triangles are as near
/// as can be to the points: the least squares of the points' distances from the planes of the faces
/// they lie on, as in quadric error metrics [Garland, Heckbert 1997], of all vertices together. A
/// vertex comes to lie off a curved surface, on the outer side of its triangles, and slides to
/// where the surface bends most. A point more than a tenth of the reach off its face does not count
/// where hardly any other one around is as far off. Where few points tell, faces stay in their
/// planes. Where it does not bend, vertices move towards the middle of their faces; and edges turn
/// for better angles where the points stay as near. In four rounds, in each of which points find
/// their faces anew, or up to eight if the median of the angles is not met before.
/// Vertices and edges stay where an angle would get both under the smallest one and smaller than it
/// is, or a face would turn by more than 60 degrees. The boundary stays. May leave
/// self-intersections where sheets are close together. Cost: linear in points and faces; in
/// parallel but for three visits of a face in each round.
/// @param points of hardly any noise, best several a face
/// @pre oriented, manifold (core/finish/clean_topology.h)
void fit_faces(TriangleMesh& mesh, std::vector<Vec3> points, const FitFacesOptions& options,
               const Progress& progress = {});

}  // namespace rangezip

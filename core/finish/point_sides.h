#pragma once

#include "core/finish/point_grid.h"
#include "core/mesh/triangle_mesh.h"

namespace rangezip {

/// Tells apart the points on both sides of thin places and of edges sharper than a right angle, so
/// that fits to one side (core/finish/surface_fit.h) leave the other out: next to the edge of a
/// blade they lie as near to its tangent plane as its own points. Notes in the cloud for each point
/// within h of the mesh which way the nearest face does, wherever the mesh faces both ways within
/// about 4 h. Everywhere else nothing is noted, nor in the whole cloud if there is no such place.
/// Cost: O(faces), and a search for a face for every point of such places; in parallel.
/// @param pixel_size h, model units; positive
void tell_sides(PointGrid& cloud, const TriangleMesh& mesh, double pixel_size);

}  // namespace rangezip

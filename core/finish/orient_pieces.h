#pragma once

#include <cstddef>

#include "core/mesh/triangle_mesh.h"

namespace rangezip {

/// Turns pieces of a mesh inside out that face the wrong way (own). Through an opening of an
/// object, as the neck of a bust, scans see the inside of its surface, and what no scan sees from
/// outside gets its faces from there: a piece that continues what is around it, but faces the other
/// way, so that no seam, bridge or fill can join the two. Pieces are what hangs together by edges
/// over which faces turn by less than 120 degrees: now and then a seam catches an edge of the other
/// side, where the surface seems to fold back; less than 50 faces belong to what is beside them,
/// or, if nothing is, stay as they are.
///
/// Where the boundaries of two components run within 3 h of each other, the faces at both show
/// whether one surface continues the other: they end towards each other, and what lies between goes
/// on in their planes. From the largest component on, always the one is decided that comes near
/// those that are at most places, as many as half of its boundary has vertices, and if there is
/// none, the next largest: it is turned if it comes near others at an eighth of its boundary, and
/// at a third of these places continues them, facing the other way, and hardly anywhere facing the
/// same.
/// The two sides of a plate, whose boundaries end the same way, stay as they are, and so do two
/// walls of which each has a part only. What is turned then ends 1 h before what it continues: no
/// seam has joined the two, and where noise lets one lie over the other, nothing else could.
/// O(faces), and what loop_neighbors() costs.
/// @param pixel_size h, model units; positive
/// @pre oriented and manifold; stays so. Positions stay, and faces but for those at joints and a
///     few at folds by which pieces hung that were turned.
/// @return components turned
std::size_t orient_pieces(TriangleMesh& mesh, double pixel_size);

}  // namespace rangezip

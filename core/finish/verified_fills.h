#pragma once

#include <cstddef>
#include <cstdint>
#include <limits>
#include <vector>

#include "core/base/progress.h"
#include "core/finish/hole_filling.h"

namespace rangezip {

/// A loop to be closed, and how.
struct FillRequest {
  BoundaryLoop loop;
  FillShape shape = FillShape::smooth;
  HoleFill fill;  ///< of that shape, with the same options, if it has been made before
};

struct VerifiedFillOptions {
  double edge_length = 0.0;  ///< of new edges, model units; see fill_loop
  double zip_width = 0.0;    ///< sides this close get zipped, model units; see zip_loop
  double zipped_from = std::numeric_limits<double>::infinity();  ///< perimeter, model units
  CloudEvidence evidence;                                        ///< of air, which fills avoid
  TriangulationMemo* memo = nullptr;                             ///< as for fill_loop()
};

struct VerifiedFills {
  std::size_t filled_holes = 0;
  std::size_t filled_faces = 0;
  std::size_t zipped_pieces = 0;
  std::vector<std::size_t> rejected;  ///< indices of requests to fill that nothing was done for
  /// Vertices of the mesh with faces, in coarse fills, that crossed something: where rejected loops
  /// are obstructed. In no order, some more than once.
  std::vector<std::uint32_t> obstructed;
};

/// Fills loops and keeps the fills whose faces neither cross the mesh, nor each other, nor have no
/// area. Where a refined fill fails a coarse one is tried; then, of loops up to 100 edges, the
/// least sharp of those coarse ones whose faces cross nothing (own), unless 10 % of it lead through
/// air; and of loops longer than zipped_from at last the part where their sides are close. A mesh
/// without self-intersections stays without. Of two fills that cross, the earlier one stays.
/// @throws Cancelled if `progress` says so.
/// @pre `table` is that of `mesh` (and no longer after).
VerifiedFills fill_verified(TriangleMesh& mesh, const CornerTable& table,
                            const std::vector<FillRequest>& requests,
                            const VerifiedFillOptions& options, const Progress& progress = {});

/// The faces of fills that cross neither the mesh nor each other; of two that cross, the earlier
/// one. @throws Cancelled if `progress` says so.
[[nodiscard]] std::vector<HoleFill> without_crossing_faces(const TriangleMesh& mesh,
                                                           std::vector<HoleFill> fills,
                                                           const Progress& progress = {});

/// Appends the fills whose faces cross neither the mesh nor each other; of two that cross, the
/// earlier one stays. @return indices of those that were not appended
/// @throws Cancelled if `progress` says so.
std::vector<std::size_t> append_verified(TriangleMesh& mesh, const std::vector<HoleFill>& fills,
                                         const Progress& progress = {});

}  // namespace rangezip

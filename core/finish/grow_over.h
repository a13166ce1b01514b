#pragma once

#include <cstddef>
#include <optional>
#include <span>

#include "core/base/progress.h"
#include "core/finish/votes_near.h"
#include "core/mesh/triangle_mesh.h"

namespace rangezip {

/// How a front begins (AdvanceFrontOptions).
struct FrontStart {
  double apart = 0.0;
  double max_radius = 0.0;
};

struct GrowOverOptions {
  double pixel_size = 0.0;   ///< h, model units; positive
  double off_mesh = 0.0;     ///< model units: points farther from the mesh are not in it; positive
  double void_radius = 0.0;  ///< in h, of circles without points that are closed at last; 0: none
  const VoteGrid* votes = nullptr;  ///< AdvanceFrontOptions::votes
  std::optional<FrontStart> start;  ///< of a pass before all others
};

/// Grows the border of a mesh over points (core/finish/advance_front.h), in passes over those that
/// the mesh does not show yet: with points 0.6 h apart, then, where it stopped because the next
/// were too far, 0.3 h. Where points are sparse, circles without any, that the front has stopped
/// all around, may be closed at last: up to 1 h in radius they lead across no gap of 2 h.
/// @param points of the surface there, those that the mesh shows among them
/// @return faces that came; a vertex may have several fans, as after advance_front()
std::size_t grow_over(TriangleMesh& mesh, std::span<const Vec3> points,
                      const GrowOverOptions& options, const Progress& progress = {});

}  // namespace rangezip

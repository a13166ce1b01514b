#pragma once

#include <cstddef>
#include <cstdint>
#include <vector>

#include "core/finish/border_gaps.h"
#include "core/finish/corner_table.h"
#include "core/mesh/triangle_mesh.h"

namespace rangezip {

/// Ways to bring a point that lies beyond a border edge into the mesh.
enum class BorderStepKind : std::uint8_t {
  split,        ///< the edge's face becomes two that reach out to the point
  ear,          ///< a new face between the edge and the point
  move_start,   ///< the edge's start goes to the point
  move_end,     ///< its end does
  notch_start,  ///< a new face between the edge and the border edge before it
  notch_end,    ///< the same with the one after it
  cut,          ///< the edge's face goes, for other steps to begin from the faces behind it
};

/// A change of the mesh at one border edge.
struct BorderStep {
  BorderStepKind kind = BorderStepKind::cut;
  int halvings = 0;          ///< of the way to the point
  std::uint32_t corner = 0;  ///< of the half-edge at the border
  Vec3 target{0.0};          ///< of the vertex that is new or moves; of a cut the gap's point
  double quality = 0.0;      ///< sine of the smallest angle it makes; 0 turns a face too far
  /// Those of the faces that change or come; the one that moves, or the tip of a notch, is the
  /// first.
  std::vector<std::uint32_t> vertices;
  std::vector<std::uint32_t> faces;  ///< those that a cut takes away
};

/// The steps towards a gap's point, in the order of BorderStepKind, without cuts and without those
/// of quality 0. Points high over the edge's face are passed under.
/// @param pixel_size h, model units
[[nodiscard]] std::vector<BorderStep> steps_towards(const BorderGap& gap, const TriangleMesh& mesh,
                                                    const CornerTable& table, double pixel_size);

/// Cuts away the face of a border half-edge with so many rings of neighbours around it. What is
/// left may touch itself in a vertex (core/finish/clean_topology.h).
[[nodiscard]] BorderStep cut_at(std::uint32_t corner, const CornerTable& table, int rings);

/// Makes the change; new vertices and faces are appended. Not for cuts.
/// @return the faces that changed or came
std::vector<std::uint32_t> apply_step(const BorderStep& step, const CornerTable& table,
                                      TriangleMesh& mesh);

}  // namespace rangezip

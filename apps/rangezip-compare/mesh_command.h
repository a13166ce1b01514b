#pragma once

#include <cstddef>
#include <cstdint>
#include <filesystem>
#include <iosfwd>
#include <optional>

#include "core/base/progress.h"

namespace rangezip::compare {

struct MeshCommand {
  std::filesystem::path mesh;
  std::optional<std::filesystem::path> truth;  ///< a mesh to measure against
  std::optional<std::filesystem::path> cloud;  ///< points that the mesh should pass through
  std::optional<std::filesystem::path> json;   ///< where to write the figures as JSON
  std::size_t samples = 200'000;               ///< of each surface, for the distances
  std::uint64_t seed = 1;
};

/// Judges one mesh, prints the figures to `out`, and writes them as JSON if asked. Distances are
/// given in % of the diagonal of the truth's bounding box, else the cloud's.
/// @return true if the mesh is clean: manifold, oriented, without degenerate faces and
///     self-intersections
/// @throws IoError if a file cannot be read, or a mesh has no area where a distance is asked for;
///     OutputError if the report cannot be written, Cancelled (which is asked between figures).
bool run_mesh_command(const MeshCommand& command, std::ostream& out, const Progress& progress);

}  // namespace rangezip::compare

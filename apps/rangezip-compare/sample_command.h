#pragma once

#include <cstddef>
#include <cstdint>
#include <filesystem>

#include "core/base/progress.h"

namespace rangezip::compare {

struct SampleCommand {
  std::filesystem::path mesh;
  std::filesystem::path cloud;  ///< to write: text, "x y z" a line
  std::size_t points = 400'000;
  std::uint64_t seed = 1;
};

/// Writes points spread evenly over a mesh: a cloud whose true surface is known, for benchmarks.
/// Every coordinate has the digits that give back the same double.
/// @throws IoError if the mesh cannot be read or has no area, OutputError if the cloud cannot be
///     written in full, Cancelled.
void run_sample_command(const SampleCommand& command, const Progress& progress);

}  // namespace rangezip::compare

#pragma once

#include <filesystem>
#include <vector>

#include "core/io/input_file.h"
#include "core/raster/rasterizer.h"
#include "core/reconstruct/reconstruct.h"

namespace rangezip::app {

/// What `rangezip mesh --report` says (docs/command-line.md lists the members).
struct MeshRunReport {
  RasterizerInfo rasterizer;
  std::vector<InputReport> inputs;
  ReconstructReport reconstruction;
  std::vector<StageTime> stages;  ///< reading, all of the reconstruction, writing
};

/// Writes it as JSON. @throws IoError if it cannot be written in full.
void write_report(const std::filesystem::path& path, const MeshRunReport& report);

}  // namespace rangezip::app

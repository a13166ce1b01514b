#pragma once

#include <filesystem>
#include <vector>

#include "core/base/geometry.h"
#include "core/io/file_bytes.h"

namespace rangezip {

/// One scan of a Stanford .conf file.
struct PlacedScan {
  std::filesystem::path path;  ///< relative paths are taken from the folder of the .conf
  Mat4 world_from_scan{1.0};
};

/// Reads the lines `bmesh FILE tx ty tz qx qy qz qw`; `camera` and `mesh` lines are skipped. The
/// quaternion turns the world into the scan, so its rotation is inverted here:
/// p_world = transpose(R(q)) p_scan + t.
/// @throws IoError naming the line if there is no scan, a file is missing, a number is not finite,
///     a scan is moved by more than kLargestCoordinate along an axis, or a quaternion is not of
///     length 1 to a thousandth.
[[nodiscard]] std::vector<PlacedScan> read_conf(const FileBytes& file);

}  // namespace rangezip

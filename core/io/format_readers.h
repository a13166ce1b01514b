#pragma once

#include "core/base/progress.h"
#include "core/io/file_bytes.h"
#include "core/io/raw_geometry.h"

namespace rangezip {

/// One reader a format; each appends to `geometry`, empty before, and sets its format. They are
/// called through read_geometry(). What each takes for granted is in docs/file-formats.md.
/// @throws IoError naming file, place and rule
/// @throws Cancelled if `progress` says so
void read_ply(const FileBytes& file, RawGeometry& geometry, const Progress& progress);
void read_xyz(const FileBytes& file, RawGeometry& geometry, const Progress& progress);
void read_off(const FileBytes& file, RawGeometry& geometry, const Progress& progress);
void read_stl(const FileBytes& file, RawGeometry& geometry, const Progress& progress);
void read_obj(const FileBytes& file, RawGeometry& geometry, const Progress& progress);

}  // namespace rangezip

#pragma once

#include <cstddef>
#include <filesystem>
#include <memory>
#include <optional>
#include <span>
#include <string>
#include <vector>

#include "core/base/progress.h"
#include "core/scene/scene.h"

namespace rangezip {

/// What a reader found in one file, and what it left out and why.
struct InputReport {
  std::string path;
  std::string format;                   ///< "ply binary_little_endian", "xyz", "obj", ...
  std::size_t points = 0;               ///< taken
  std::size_t triangles = 0;            ///< taken, after splitting polygons and strips
  std::size_t polygons = 0;             ///< in the file, before splitting
  std::size_t nonfinite_points = 0;     ///< skipped
  std::size_t repeated_points = 0;      ///< skipped: in one place (core/io/repeated_points.h)
  std::size_t nonfinite_polygons = 0;   ///< skipped: a corner is not finite
  std::size_t degenerate_polygons = 0;  ///< skipped: fewer than three distinct corners
  Box bounds;                           ///< of all finite positions, in the file's own coordinates
  Vec3 origin{0.0};  ///< about which positions are stored, in the file's own coordinates
  std::vector<std::string> notes;  ///< ignored elements and the like
};

/// One cloud or one soup, with its place.
struct InputItem {
  std::shared_ptr<const PointCloud> cloud;  ///< exactly one of the two is set
  std::shared_ptr<const TriangleSoup> soup;
  Mat4 world_from_item{1.0};
};

struct InputFile {
  std::vector<InputItem> items;
  std::vector<InputReport> reports;  ///< one per file read; a .conf reads several
};

/// Reads whatever `path` is, by its name (".gz" of each is unpacked): PLY points and meshes,
/// XYZ/PTS/ASC/CSV/TXT text, OBJ, OFF, STL, and .conf lists of Stanford range scans. Polygons
/// become triangles; vertices of a file without faces, and OBJ point elements, become points.
/// Positions are stored in float about a local origin near the data, so large coordinates lose
/// nothing.
/// @throws IoError naming file, place and rule for anything that is not what it claims to be, and
///     if nothing usable is left of a file.
/// @throws Cancelled if `progress` says so.
[[nodiscard]] InputFile read_input(const std::filesystem::path& path,
                                   const Progress& progress = {});

/// A scene and what was found in its files.
struct SceneInput {
  Scene scene;
  std::vector<InputReport> reports;
};

/// All files as one scene, in order, for scanning: the points of a cloud whose order is not local
/// are put in order along a curve (see curve_order.h), which draws faster. Scene::number_of() still
/// tells their places in the file; only which of two equally near ones is drawn may change.
/// @throws IoError as read_input(); also if all points and corners together are fewer than three,
///     equal, or on one line (none farther from it than 1e-5 of the size of the whole), or so far
///     from (0, 0, 0) that doubles there have fewer than 1024 steps across the whole.
/// @throws InvalidArgument if there is no path.
[[nodiscard]] SceneInput read_scene(std::span<const std::filesystem::path> paths,
                                    const Progress& progress = {});

}  // namespace rangezip

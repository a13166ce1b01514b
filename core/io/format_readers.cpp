#include "core/io/format_readers.h"

#include <array>
#include <string_view>
#include <tuple>
#include <utility>

#include "core/base/error.h"
#include "core/io/text_fields.h"

namespace rangezip {

namespace {

using Reader = void (*)(const FileBytes&, RawGeometry&, const Progress&);

constexpr std::array<std::pair<std::string_view, Reader>, 9> kReaders{{
    {"ply", read_ply},
    {"xyz", read_xyz},
    {"pts", read_xyz},
    {"asc", read_xyz},
    {"csv", read_xyz},
    {"txt", read_xyz},
    {"obj", read_obj},
    {"off", read_off},
    {"stl", read_stl},
}};

Reader reader_of(const std::filesystem::path& path, std::string_view also_known = {}) {
  const std::string type = file_type(path);
  std::string all_known;
  for (const auto& [known, reader] : kReaders) {
    if (known == type) return reader;
    all_known += " ." + std::string(known);
  }
  if (!also_known.empty()) all_known += " ." + std::string(also_known);
  std::error_code error;
  const bool is_pipe = std::filesystem::is_other(path, error);
  throw IoError(path.string() + ": unknown type " + quote(type) + "; known are" + all_known +
                (is_pipe ? "; a link to a pipe may have a name of such a type" : ""));
}

}  // namespace

void check_geometry_type(const std::filesystem::path& path, std::string_view also_known) {
  std::ignore = reader_of(path, also_known);
}

RawGeometry read_geometry(const FileBytes& file, PositionList::Precision precision,
                          const std::optional<Vec3>& origin, const Progress& progress) {
  const Reader reader = reader_of(file.name());
  RawGeometry geometry{.positions = PositionList(precision, origin)};
  reader(file, geometry, progress);
  return geometry;
}

}  // namespace rangezip

#include "core/io/format_readers.h"

#include <array>
#include <string_view>
#include <utility>

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

Reader reader_of(const std::string& type) {
  for (const auto& [known, reader] : kReaders) {
    if (known == type) return reader;
  }
  return nullptr;
}

}  // namespace

bool is_geometry_type(const std::string& type) {
  return reader_of(type) != nullptr;
}

RawGeometry read_geometry(const FileBytes& file, const std::string& type,
                          PositionList::Precision precision, const std::optional<Vec3>& origin,
                          const Progress& progress) {
  const Reader reader = reader_of(type);
  if (reader == nullptr) {
    std::string known;
    for (const auto& entry : kReaders)
      known += " ." + std::string(entry.first);
    file.fail("unknown type " + quote(type) + "; known are" + known);
  }
  RawGeometry geometry{.positions = PositionList(precision, origin)};
  reader(file, geometry, progress);
  return geometry;
}

}  // namespace rangezip

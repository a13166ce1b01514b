#pragma once

#include <cstddef>
#include <cstdint>
#include <string>
#include <vector>

#include "core/io/file_bytes.h"

namespace rangezip {

enum class PlyType : std::uint8_t { int8, uint8, int16, uint16, int32, uint32, float32, float64 };

[[nodiscard]] std::size_t size_of(PlyType type);

struct PlyProperty {
  std::string name;
  PlyType type = PlyType::float32;  ///< of the value, or of the items of a list
  bool is_list = false;
  PlyType count_type = PlyType::uint8;  ///< of the length of a list
};

struct PlyElement {
  std::string name;
  std::size_t count = 0;
  std::vector<PlyProperty> properties;

  [[nodiscard]] bool has_list() const;
  /// Fewest bytes that one instance takes in a binary file: all of it but the items of its lists.
  [[nodiscard]] std::size_t binary_size() const;
  /// Position of the property of that name, or properties.size().
  [[nodiscard]] std::size_t find(const std::string& property) const;
};

enum class PlyEncoding : std::uint8_t { ascii, little_endian, big_endian };

/// The header of a PLY file [Turk 1994].
struct PlyHeader {
  PlyEncoding encoding = PlyEncoding::ascii;
  std::vector<PlyElement> elements;  ///< in the order of the file
  std::size_t size = 0;              ///< bytes up to the data

  /// Null if there is none of that name.
  [[nodiscard]] const PlyElement* find(const std::string& name) const;
};

/// Comments and obj_info lines are skipped. Counts are checked against what the file can hold at
/// most, so nothing is ever allocated for a header that lies.
/// @throws IoError naming line and rule
[[nodiscard]] PlyHeader read_ply_header(const FileBytes& file);

}  // namespace rangezip

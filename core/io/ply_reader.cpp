#include <algorithm>
#include <array>
#include <cmath>
#include <string_view>

#include "core/io/byte_order.h"
#include "core/io/format_readers.h"
#include "core/io/ply_header.h"
#include "core/io/text_fields.h"

namespace rangezip {

namespace {

/// What an element is to us.
enum class Role : std::uint8_t { vertices, faces, strips, ignored };

struct Plan {
  Role role = Role::ignored;
  std::array<std::size_t, 3> coordinates{};  ///< of vertices: which properties are x, y and z
  std::size_t list = 0;                      ///< of faces and strips: which property is the list
};

constexpr std::size_t kBlock = 65536;  ///< instances between two looks at the stop token

/// What both encodings share: which property is what, checks of indices, strips.
class PlyReader {
 public:
  PlyReader(const FileBytes& file, const PlyHeader& header, RawGeometry& geometry)
      : file_(file), header_(header), geometry_(geometry) {
    const PlyElement* const vertices = header.find("vertex");
    if (vertices == nullptr) fail_in_header("there is no element 'vertex'");
    if (vertices->count > kMostPositions) fail_in_header("at most 2^32 - 1 vertices can be read");
    vertex_count_ = vertices->count;
    geometry_.positions.reserve(vertex_count_);
  }

 protected:
  [[noreturn]] void fail_in_header(const std::string& rule) const {
    file_.fail_at_line(file_.bytes().data() + header_.size - 1, "in the header above: " + rule);
  }

  [[nodiscard]] Plan plan_for(const PlyElement& element) const {
    Plan plan;
    if (element.name == "vertex") {
      plan.role = Role::vertices;
      plan.coordinates = {coordinate(element, "x"), coordinate(element, "y"),
                          coordinate(element, "z")};
    } else if (element.name == "face" || element.name == "tristrips") {
      plan.role = element.name == "face" ? Role::faces : Role::strips;
      plan.list = std::min(element.find("vertex_indices"), element.find("vertex_index"));
      const bool is_found = plan.list != element.properties.size();
      if (element.count != 0 && (!is_found || !element.properties[plan.list].is_list)) {
        fail_in_header("element " + quote(element.name) +
                       " has no list property vertex_indices or vertex_index");
      }
    }
    return plan;
  }

  void note_ignored(const PlyElement& element) {
    geometry_.notes.push_back("element " + quote(element.name) + " (" +
                              std::to_string(element.count) + ") is ignored");
  }

  /// Is `index` a vertex of the file?
  [[nodiscard]] bool is_vertex(std::int64_t index) const {
    return index >= 0 && static_cast<std::uint64_t>(index) < vertex_count_;
  }
  [[nodiscard]] std::string index_rule(std::int64_t index) const {
    return "vertex index " + std::to_string(index) + " is out of range; the file has " +
           std::to_string(vertex_count_) + " vertices";
  }

  [[nodiscard]] static std::string count_rule(const PlyProperty& property, std::int64_t count) {
    return "the list " + quote(property.name) + " of " + std::to_string(count) +
           " items does not fit in the file";
  }

  /// Takes the list in items_ as a polygon or a strip. Indices are checked before.
  void take_list(Role role) {
    ++geometry_.polygons;
    if (role == Role::faces) {
      geometry_.add_polygon(items_);
      return;
    }
    std::size_t begin = 0;
    for (std::size_t i = 0; i <= items_.size(); ++i) {
      if (i != items_.size() && items_[i] != kRestart) continue;
      take_strip(std::span(items_).subspan(begin, i - begin));
      begin = i + 1;
    }
  }

  static constexpr std::uint32_t kRestart = 0xffff'ffffU;  ///< -1 in a list of strips

  const FileBytes& file_;
  const PlyHeader& header_;
  RawGeometry& geometry_;
  std::size_t vertex_count_ = 0;
  std::vector<std::uint32_t> items_;  ///< the current list

 private:
  [[nodiscard]] std::size_t coordinate(const PlyElement& vertex, const std::string& name) const {
    const std::size_t index = vertex.find(name);
    if (index == vertex.properties.size() || vertex.properties[index].is_list) {
      fail_in_header("element 'vertex' has no number property " + quote(name));
    }
    return index;
  }

  /// Every second triangle of a strip runs the other way. Triangles with a repeated corner only
  /// lead from one run to the next.
  void take_strip(std::span<const std::uint32_t> strip) {
    for (std::size_t i = 2; i < strip.size(); ++i) {
      std::array<std::uint32_t, 3> triangle{strip[i - 2], strip[i - 1], strip[i]};
      if (i % 2 == 1) std::swap(triangle[0], triangle[1]);
      if (triangle[0] == triangle[1] || triangle[1] == triangle[2] || triangle[2] == triangle[0]) {
        continue;
      }
      geometry_.add_polygon(triangle);
    }
  }
};

/// Instances are lines, values are parted by blanks.
class AsciiReader : private PlyReader {
 public:
  AsciiReader(const FileBytes& file, const PlyHeader& header, RawGeometry& geometry)
      : PlyReader(file, header, geometry), lines_(file.bytes().substr(header.size)) {}

  void read(const Progress& progress) {
    for (const PlyElement& element : header_.elements) {
      const Plan plan = plan_for(element);
      if (plan.role == Role::ignored) note_ignored(element);
      if (element.properties.empty()) continue;
      for (std::size_t i = 0; i < element.count; ++i) {
        if (i % kBlock == 0) progress.check_stop();
        read_instance(element, plan, i);
      }
    }
    const std::string_view rest = lines_.next_filled();
    if (!rest.empty()) {
      file_.fail_at_line(rest.data(),
                         "the file goes on after the last element that its header promises");
    }
  }

 private:
  void read_instance(const PlyElement& element, const Plan& plan, std::size_t number) {
    const std::string_view line = lines_.next_filled();
    if (line.empty()) {
      file_.fail_at_line(line.data(), "the file ends after " + std::to_string(number) + " of " +
                                          std::to_string(element.count) + " of element " +
                                          quote(element.name));
    }
    if (plan.role == Role::ignored) return;
    TextFields fields(line);
    if (plan.role == Role::vertices) {
      read_vertex(element, plan, fields);
    } else {
      read_list(element, plan, fields);
    }
    if (!fields.at_end()) {
      file_.fail_at_line(fields.position(), "more values than element " + quote(element.name) +
                                                " has properties: " + quote(fields.rest()));
    }
  }

  void read_vertex(const PlyElement& element, const Plan& plan, TextFields& fields) {
    Vec3 position{0.0};
    for (std::size_t i = 0; i < element.properties.size(); ++i) {
      if (i == plan.coordinates[0]) {
        position.x = read_number(element.properties[i], fields);
      } else if (i == plan.coordinates[1]) {
        position.y = read_number(element.properties[i], fields);
      } else if (i == plan.coordinates[2]) {
        position.z = read_number(element.properties[i], fields);
      } else {
        skip(element.properties[i], fields);
      }
    }
    geometry_.positions.add(position);
  }

  void read_list(const PlyElement& element, const Plan& plan, TextFields& fields) {
    for (std::size_t i = 0; i < element.properties.size(); ++i) {
      if (i != plan.list) {
        skip(element.properties[i], fields);
        continue;
      }
      items_.clear();
      const std::int64_t count = read_count(element.properties[i], fields);
      for (std::int64_t k = 0; k < count; ++k) {
        const char* const place = fields.position();
        const std::int64_t index = read_integer(element.properties[i], fields);
        const bool is_restart = plan.role == Role::strips && index == -1;
        if (!is_restart && !is_vertex(index)) file_.fail_at_line(place, index_rule(index));
        items_.push_back(is_restart ? kRestart : static_cast<std::uint32_t>(index));
      }
    }
    take_list(plan.role);
  }

  void skip(const PlyProperty& property, TextFields& fields) const {
    const std::int64_t values = property.is_list ? read_count(property, fields) : 1;
    for (std::int64_t k = 0; k < values; ++k) {
      if (fields.word().empty()) fail_value(property, fields);
    }
  }

  /// The length of a list. One that is too long is noticed at the end of the line.
  [[nodiscard]] std::int64_t read_count(const PlyProperty& property, TextFields& fields) const {
    const char* const place = fields.position();
    const std::int64_t count = read_integer(property, fields);
    if (count < 0) file_.fail_at_line(place, count_rule(property, count));
    return count;
  }

  [[nodiscard]] double read_number(const PlyProperty& property, TextFields& fields) const {
    double value = 0.0;
    if (!fields.number(value)) fail_value(property, fields);
    return value;
  }

  [[nodiscard]] std::int64_t read_integer(const PlyProperty& property, TextFields& fields) const {
    std::int64_t value = 0;
    if (!fields.integer(value)) fail_value(property, fields);
    return value;
  }

  [[noreturn]] void fail_value(const PlyProperty& property, const TextFields& fields) const {
    const std::string found = fields.at_end() ? "the line ends" : quote(fields.rest());
    file_.fail_at_line(fields.position(), "property " + quote(property.name) +
                                              (property.is_list ? " needs a whole number, but "
                                                                : " needs a number, but ") +
                                              (fields.at_end() ? found : "there is " + found));
  }

  TextLines lines_;
};

double load_number(PlyType type, const char* at, bool is_swapped) {
  switch (type) {
    case PlyType::int8:
      return load_bytes<std::int8_t>(at, is_swapped);
    case PlyType::uint8:
      return load_bytes<std::uint8_t>(at, is_swapped);
    case PlyType::int16:
      return load_bytes<std::int16_t>(at, is_swapped);
    case PlyType::uint16:
      return load_bytes<std::uint16_t>(at, is_swapped);
    case PlyType::int32:
      return load_bytes<std::int32_t>(at, is_swapped);
    case PlyType::uint32:
      return load_bytes<std::uint32_t>(at, is_swapped);
    case PlyType::float32:
      return static_cast<double>(load_bytes<float>(at, is_swapped));
    case PlyType::float64:
      break;
  }
  return load_bytes<double>(at, is_swapped);
}

/// Instances follow each other without gaps.
class BinaryReader : private PlyReader {
 public:
  BinaryReader(const FileBytes& file, const PlyHeader& header, RawGeometry& geometry)
      : PlyReader(file, header, geometry),
        at_(file.bytes().data() + header.size),
        end_(file.bytes().data() + file.bytes().size()),
        is_swapped_((header.encoding == PlyEncoding::little_endian) != kIsLittleEndian) {}

  void read(const Progress& progress) {
    for (const PlyElement& element : header_.elements) {
      const Plan plan = plan_for(element);
      if (plan.role == Role::ignored) note_ignored(element);
      if (!element.has_list() && plan.role != Role::faces && plan.role != Role::strips) {
        read_fixed(element, plan, progress);
        continue;
      }
      for (std::size_t i = 0; i < element.count && !element.properties.empty(); ++i) {
        if (i % kBlock == 0) progress.check_stop();
        read_instance(element, plan);
      }
    }
    // Some writers end the file with a line end or fill it up with zeros.
    const char* const more = std::find_if(
        at_, end_, [](char c) { return c != '\0' && c != '\n' && c != '\r' && c != ' '; });
    if (more != end_) {
      file_.fail_at_byte(at_, "the file goes on after the last element that its header promises: " +
                                  std::to_string(end_ - at_) + " bytes are left");
    }
  }

 private:
  [[nodiscard]] std::size_t left() const { return static_cast<std::size_t>(end_ - at_); }

  void need(std::size_t bytes, const PlyElement& element) const {
    if (left() < bytes) {
      file_.fail_at_byte(at_, "the file ends within element " + quote(element.name));
    }
  }

  /// Elements without lists: every instance has the same size.
  void read_fixed(const PlyElement& element, const Plan& plan, const Progress& progress) {
    const std::size_t stride = element.binary_size();
    if (stride == 0) return;
    if (element.count > left() / stride) {
      file_.fail_at_byte(end_, "the file ends after " + std::to_string(left() / stride) + " of " +
                                   std::to_string(element.count) + " of element " +
                                   quote(element.name));
    }
    if (plan.role == Role::vertices) foresee_origin(element, plan);
    const char* const element_end = at_ + element.count * stride;
    while (plan.role == Role::vertices && at_ != element_end) {
      progress.check_stop();
      const std::size_t in_block =
          std::min(kBlock, static_cast<std::size_t>(element_end - at_) / stride);
      read_positions(element, plan, {at_, in_block * stride});
      at_ += in_block * stride;
    }
    at_ = element_end;
  }

  /// The positions that decide the origin are at known places, unless some are not finite.
  void foresee_origin(const PlyElement& element, const Plan& plan) {
    const std::size_t stride = element.binary_size();
    const std::array<std::size_t, 3> offset = offsets_of(element, plan);
    LocalOrigin origin;
    for (std::size_t i = 0; i < element.count; i += LocalOrigin::stride_of(element.count)) {
      const Vec3 position = load_position(element, plan, offset, at_ + i * stride);
      if (is_usable(position)) origin.add(position);
    }
    geometry_.positions.foresee_origin(origin.origin());
  }

  /// Where in an instance the three coordinates are, in bytes.
  static std::array<std::size_t, 3> offsets_of(const PlyElement& element, const Plan& plan) {
    std::array<std::size_t, 3> offset{};
    for (std::size_t axis = 0; axis < 3; ++axis) {
      for (std::size_t i = 0; i < plan.coordinates[axis]; ++i)
        offset[axis] += size_of(element.properties[i].type);
    }
    return offset;
  }

  [[nodiscard]] Vec3 load_position(const PlyElement& element, const Plan& plan,
                                   const std::array<std::size_t, 3>& offset,
                                   const char* vertex) const {
    const auto coordinate = [&](std::size_t axis) {
      return load_number(element.properties[plan.coordinates[axis]].type, vertex + offset[axis],
                         is_swapped_);
    };
    return {coordinate(0), coordinate(1), coordinate(2)};
  }

  void read_positions(const PlyElement& element, const Plan& plan, std::string_view block) {
    const std::array<std::size_t, 3> offset = offsets_of(element, plan);
    bool is_float = !is_swapped_;
    bool is_double = !is_swapped_;
    for (std::size_t axis = 0; axis < 3; ++axis) {
      const PlyType type = element.properties[plan.coordinates[axis]].type;
      is_float = is_float && type == PlyType::float32;
      is_double = is_double && type == PlyType::float64;
    }
    const std::size_t stride = element.binary_size();
    if (is_float) {
      read_native<float>(block, stride, offset);
    } else if (is_double) {
      read_native<double>(block, stride, offset);
    } else {
      for (std::size_t i = 0; i < block.size(); i += stride) {
        geometry_.positions.add(load_position(element, plan, offset, block.data() + i));
      }
    }
  }

  /// All three coordinates of one type in the machine's own byte order.
  template <class T>
  void read_native(std::string_view block, std::size_t stride,
                   const std::array<std::size_t, 3>& offset) {
    constexpr std::size_t kInCache = 512;  // positions that stay in the nearest cache
    std::array<Vec3, kInCache> positions;
    while (!block.empty()) {
      const std::size_t count = std::min(kInCache, block.size() / stride);
      for (std::size_t i = 0; i < count; ++i) {
        const char* const vertex = block.data() + i * stride;
        positions[i] = {load_bytes<T>(vertex + offset[0], false),
                        load_bytes<T>(vertex + offset[1], false),
                        load_bytes<T>(vertex + offset[2], false)};
      }
      geometry_.positions.add(std::span(positions).first(count));
      block.remove_prefix(count * stride);
    }
  }

  /// Elements with lists: every instance has its own size.
  void read_instance(const PlyElement& element, const Plan& plan) {
    Vec3 position{0.0};
    for (std::size_t i = 0; i < element.properties.size(); ++i) {
      const PlyProperty& property = element.properties[i];
      if (property.is_list) {
        const std::size_t count = read_count(element, property);
        const char* const items = at_;
        at_ += count * size_of(property.type);
        const bool is_wanted = plan.role == Role::faces || plan.role == Role::strips;
        if (is_wanted && i == plan.list) read_items(property, plan.role, items, count);
      } else {
        need(size_of(property.type), element);
        for (std::size_t axis = 0; plan.role == Role::vertices && axis < 3; ++axis) {
          if (i != plan.coordinates[axis]) continue;
          position[static_cast<int>(axis)] = load_number(property.type, at_, is_swapped_);
        }
        at_ += size_of(property.type);
      }
    }
    if (plan.role == Role::vertices) geometry_.positions.add(position);
    if (plan.role == Role::faces || plan.role == Role::strips) take_list(plan.role);
  }

  [[nodiscard]] std::size_t read_count(const PlyElement& element, const PlyProperty& property) {
    need(size_of(property.count_type), element);
    const double count = load_number(property.count_type, at_, is_swapped_);
    const char* const place = at_;
    at_ += size_of(property.count_type);
    const std::size_t room = left() / size_of(property.type);
    if (count < 0.0 || count > static_cast<double>(room)) {
      file_.fail_at_byte(place, count_rule(property, static_cast<std::int64_t>(count)));
    }
    return static_cast<std::size_t>(count);
  }

  void read_items(const PlyProperty& property, Role role, const char* items, std::size_t count) {
    items_.clear();
    for (std::size_t k = 0; k < count; ++k) {
      const char* const place = items + k * size_of(property.type);
      const double value = load_number(property.type, place, is_swapped_);
      const bool is_whole = std::abs(value) <= 0x1p53 && value == std::trunc(value);
      if (!is_whole) file_.fail_at_byte(place, "a vertex index is a whole number");
      const auto index = static_cast<std::int64_t>(value);
      const bool is_restart = role == Role::strips && index == -1;
      if (!is_restart && !is_vertex(index)) file_.fail_at_byte(place, index_rule(index));
      items_.push_back(is_restart ? kRestart : static_cast<std::uint32_t>(index));
    }
  }

  const char* at_;
  const char* end_;
  bool is_swapped_;
};

}  // namespace

void read_ply(const FileBytes& file, RawGeometry& geometry, const Progress& progress) {
  const PlyHeader header = read_ply_header(file);
  switch (header.encoding) {
    case PlyEncoding::ascii:
      geometry.format = "ply ascii";
      return AsciiReader(file, header, geometry).read(progress);
    case PlyEncoding::little_endian:
      geometry.format = "ply binary_little_endian";
      break;
    case PlyEncoding::big_endian:
      geometry.format = "ply binary_big_endian";
      break;
  }
  BinaryReader(file, header, geometry).read(progress);
}

}  // namespace rangezip

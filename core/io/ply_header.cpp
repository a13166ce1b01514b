#include "core/io/ply_header.h"

#include <algorithm>
#include <array>
#include <optional>
#include <string_view>
#include <utility>

#include "core/io/text_fields.h"

namespace rangezip {

namespace {

std::optional<PlyType> type_named(std::string_view name) {
  static constexpr std::array<std::pair<std::string_view, PlyType>, 16> kNames{{
      {"char", PlyType::int8},
      {"int8", PlyType::int8},
      {"uchar", PlyType::uint8},
      {"uint8", PlyType::uint8},
      {"short", PlyType::int16},
      {"int16", PlyType::int16},
      {"ushort", PlyType::uint16},
      {"uint16", PlyType::uint16},
      {"int", PlyType::int32},
      {"int32", PlyType::int32},
      {"uint", PlyType::uint32},
      {"uint32", PlyType::uint32},
      {"float", PlyType::float32},
      {"float32", PlyType::float32},
      {"double", PlyType::float64},
      {"float64", PlyType::float64},
  }};
  for (const auto& [known, type] : kNames) {
    if (known == name) return type;
  }
  return std::nullopt;
}

/// Reads the lines of a header one after the other.
class HeaderReader {
 public:
  explicit HeaderReader(const FileBytes& file) : file_(file), lines_(file.bytes()) {}

  PlyHeader read() {
    if (next_line() != "ply") fail("a PLY file begins with the line 'ply'");
    while (true) {
      TextFields fields(next_line());
      const std::string_view keyword = fields.word();
      if (keyword == "end_header") break;
      read_line(keyword, fields);
    }
    if (!has_format_) fail("the header has no 'format' line");
    header_.size = static_cast<std::size_t>(lines_.position() - file_.bytes().data());
    return std::move(header_);
  }

 private:
  [[noreturn]] void fail(const std::string& rule) const { file_.fail_at_line(line_, rule); }

  std::string_view next_line() {
    std::string_view line;
    line_ = lines_.position();
    if (!lines_.next(line)) {
      file_.fail_at_line(line_, "the file ends within the header; 'end_header' is missing");
    }
    line_ = line.data();
    while (!line.empty() && (line.back() == ' ' || line.back() == '\t'))
      line.remove_suffix(1);
    return line;
  }

  void read_line(std::string_view keyword, TextFields& fields) {
    if (keyword == "comment" || keyword == "obj_info" || keyword.empty()) return;
    if (keyword == "format") {
      read_format(fields);
    } else if (keyword == "element") {
      read_element(fields);
    } else if (keyword == "property") {
      read_property(fields);
    } else {
      fail(
          "a header line begins with format, element, property, comment, obj_info or "
          "end_header, not with " +
          quote(keyword));
    }
  }

  void read_format(TextFields& fields) {
    const std::string_view encoding = fields.word();
    if (encoding == "ascii") {
      header_.encoding = PlyEncoding::ascii;
    } else if (encoding == "binary_little_endian") {
      header_.encoding = PlyEncoding::little_endian;
    } else if (encoding == "binary_big_endian") {
      header_.encoding = PlyEncoding::big_endian;
    } else {
      fail("the format is ascii, binary_little_endian or binary_big_endian, not " +
           quote(encoding));
    }
    if (const std::string_view version = fields.word(); version != "1.0") {
      fail("the only version of the format is 1.0, not " + quote(version));
    }
    has_format_ = true;
  }

  void read_element(TextFields& fields) {
    PlyElement element;
    element.name = fields.word();
    std::int64_t count = 0;
    const std::string_view count_text = fields.rest();
    if (element.name.empty() || !fields.integer(count) || !fields.at_end() || count < 0) {
      fail("an element has a name and a count that is a whole number, not " + quote(count_text));
    }
    if (header_.find(element.name) != nullptr) {
      fail("element " + quote(element.name) + " is declared twice");
    }
    element.count = static_cast<std::size_t>(count);
    header_.elements.push_back(std::move(element));
  }

  void read_property(TextFields& fields) {
    if (header_.elements.empty()) fail("a property stands before the first element");
    PlyElement& element = header_.elements.back();
    PlyProperty property;
    std::string_view type = fields.word();
    if (type == "list") {
      property.is_list = true;
      property.count_type = read_type(fields.word());
      if (property.count_type == PlyType::float32 || property.count_type == PlyType::float64) {
        fail("the length of a list is of a whole-number type");
      }
      type = fields.word();
    }
    property.type = read_type(type);
    property.name = fields.word();
    if (property.name.empty() || !fields.at_end()) fail("a property is a type and one name");
    if (element.find(property.name) != element.properties.size()) {
      fail("property " + quote(property.name) + " of element " + quote(element.name) +
           " is declared twice");
    }
    element.properties.push_back(std::move(property));
  }

  [[nodiscard]] PlyType read_type(std::string_view name) const {
    const std::optional<PlyType> type = type_named(name);
    if (!type) fail("unknown property type " + quote(name));
    return *type;
  }

  const FileBytes& file_;
  TextLines lines_;
  const char* line_ = nullptr;  ///< begin of the current one
  PlyHeader header_;
  bool has_format_ = false;
};

/// The rest of the file must be able to hold the instances that the header promises.
void check_counts(const FileBytes& file, const PlyHeader& header) {
  std::size_t left = file.bytes().size() - header.size;
  for (const PlyElement& element : header.elements) {
    // In text a value takes a digit and a blank or a line end; the last line may lack that.
    const std::size_t least = header.encoding == PlyEncoding::ascii ? 2 * element.properties.size()
                                                                    : element.binary_size();
    const std::size_t room = header.encoding == PlyEncoding::ascii ? left + 1 : left;
    if (least == 0) continue;
    if (element.count > room / least) {
      file.fail_at_byte(file.bytes().data() + header.size,
                        "the header promises " + std::to_string(element.count) + " of element " +
                            quote(element.name) + ", at least " + std::to_string(least) +
                            " bytes each, but only " + std::to_string(left) +
                            " bytes follow it: the file is cut or its header is wrong");
    }
    left -= std::min(left, element.count * least);
  }
}

}  // namespace

std::size_t size_of(PlyType type) {
  switch (type) {
    case PlyType::int8:
    case PlyType::uint8:
      return 1;
    case PlyType::int16:
    case PlyType::uint16:
      return 2;
    case PlyType::int32:
    case PlyType::uint32:
    case PlyType::float32:
      return 4;
    case PlyType::float64:
      break;
  }
  return 8;
}

bool PlyElement::has_list() const {
  return std::any_of(properties.begin(), properties.end(),
                     [](const PlyProperty& property) { return property.is_list; });
}

std::size_t PlyElement::binary_size() const {
  std::size_t size = 0;
  for (const PlyProperty& property : properties) {
    size += size_of(property.is_list ? property.count_type : property.type);
  }
  return size;
}

std::size_t PlyElement::find(const std::string& property) const {
  std::size_t index = 0;
  while (index < properties.size() && properties[index].name != property)
    ++index;
  return index;
}

const PlyElement* PlyHeader::find(const std::string& name) const {
  for (const PlyElement& element : elements) {
    if (element.name == name) return &element;
  }
  return nullptr;
}

PlyHeader read_ply_header(const FileBytes& file) {
  PlyHeader header = HeaderReader(file).read();
  check_counts(file, header);
  return header;
}

}  // namespace rangezip

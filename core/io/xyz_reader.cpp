#include <algorithm>
#include <array>
#include <optional>
#include <string>
#include <string_view>

#include "core/io/format_readers.h"
#include "core/io/text_fields.h"

namespace rangezip {

namespace {

constexpr std::size_t kMostHeaderLines = 64;  ///< a longer text before the first point is no header
constexpr std::size_t kShortestLine = 6;      ///< bytes of "0 0 0" and a line end
constexpr std::size_t kBlock = 65536;         ///< lines between two looks at the stop token
constexpr std::size_t kByteBlock = std::size_t{1} << 24U;  ///< the same in bytes, to count lines

/// How the columns of a file are parted and which are x, y and z.
struct Layout {
  char separator = ' ';  ///< blank (spaces and tabs), ',' or ';'
  std::array<std::size_t, 3> columns{0, 1, 2};
};

bool is_blank(char c) {
  return c == ' ' || c == '\t';
}

std::string_view trimmed(std::string_view text) {
  while (!text.empty() && is_blank(text.front()))
    text.remove_prefix(1);
  while (!text.empty() && (is_blank(text.back()) || text.back() == '\r'))
    text.remove_suffix(1);
  return text;
}

bool is_comment(std::string_view line) {
  return line.starts_with('#') || line.starts_with("//") || line.starts_with(';');
}

char separator_of(std::string_view line) {
  if (line.find(';') != std::string_view::npos) return ';';
  if (line.find(',') != std::string_view::npos) return ',';
  return ' ';
}

std::vector<std::string_view> split(std::string_view line, char separator) {
  std::vector<std::string_view> fields;
  std::string_view rest = trimmed(line);
  while (!rest.empty()) {
    const std::size_t end =
        separator == ' ' ? rest.find_first_of(" \t") : rest.find_first_of(separator);
    fields.push_back(trimmed(rest.substr(0, end)));
    rest = end == std::string_view::npos ? std::string_view{} : rest.substr(end + 1);
    if (separator == ' ') rest = trimmed(rest);
  }
  return fields;
}

void skip_blanks(const char*& at, const char* end) {
  while (at != end && is_blank(*at))
    ++at;
}

/// Moves over a column that is not read.
void skip_column(const char*& at, const char* end, char separator) {
  while (at != end && *at != separator && !(separator == ' ' && is_blank(*at)))
    ++at;
}

/// Reads the three columns of a line; the others are never looked at.
/// False if one is missing or no number; `at` is then where reading stopped.
bool read_columns(const char*& at, const char* end, const Layout& layout, Vec3& position) {
  const std::size_t last = *std::max_element(layout.columns.begin(), layout.columns.end());
  for (std::size_t column = 0; column <= last; ++column) {
    skip_blanks(at, end);
    const auto axis = std::find(layout.columns.begin(), layout.columns.end(), column);
    if (axis != layout.columns.end()) {
      double& value = position[static_cast<int>(axis - layout.columns.begin())];
      if (!parse_number(at, end, value, layout.separator)) return false;
    } else {
      skip_column(at, end, layout.separator);
    }
    if (column == last || layout.separator == ' ') continue;
    skip_blanks(at, end);
    if (at == end || *at != layout.separator) return false;
    ++at;
  }
  // With another separator than blanks a column holds one number only.
  skip_blanks(at, end);
  return layout.separator == ' ' || at == end || *at == layout.separator;
}

/// The columns named x, y and z by the line before the first point, if it names every column.
void apply_names(std::string_view header, std::string_view first_line, Layout& layout) {
  const std::size_t text = header.find_first_not_of("#/; \t");
  if (text == std::string_view::npos) return;
  header.remove_prefix(text);
  const std::vector<std::string_view> names = split(header, separator_of(header));
  if (names.size() != split(first_line, layout.separator).size()) return;
  std::array<std::size_t, 3> columns{};
  for (std::size_t axis = 0; axis < 3; ++axis) {
    const std::string wanted(1, static_cast<char>('x' + axis));
    const auto found = std::find_if(names.begin(), names.end(), [&](std::string_view name) {
      const std::string lower = to_lower(name);
      return lower == wanted || lower == '"' + wanted + '"';
    });
    if (found == names.end()) return;
    columns[axis] = static_cast<std::size_t>(found - names.begin());
  }
  layout.columns = columns;
}

/// How many lines a text has at most.
std::size_t count_lines(std::string_view text, const Progress& progress) {
  std::size_t ends = 0;
  for (std::size_t at = 0; at < text.size(); at += kByteBlock) {
    progress.check_stop();
    const std::string_view block = text.substr(at, kByteBlock);
    ends += static_cast<std::size_t>(std::count(block.begin(), block.end(), '\n'));
  }
  return ends + 1;
}

class XyzReader {
 public:
  XyzReader(const FileBytes& file, RawGeometry& geometry)
      : file_(file), geometry_(geometry), lines_(file.bytes()) {}

  void read(const Progress& progress) {
    constexpr std::string_view kByteOrderMark = "\xef\xbb\xbf";
    if (file_.bytes().starts_with(kByteOrderMark)) {
      lines_ = TextLines(file_.bytes().substr(kByteOrderMark.size()));
    }
    geometry_.positions.reserve(
        std::min(count_lines(file_.bytes(), progress), file_.bytes().size() / kShortestLine + 1));
    read_header();
    std::string_view line;
    for (std::size_t number = 0; lines_.next(line); ++number) {
      if (number % kBlock == 0) progress.check_stop();
      read_line(line);
    }
    check_count();
  }

 private:
  /// Up to the first point; it and the layout are known afterwards.
  void read_header() {
    std::string_view line;
    std::string_view last_text;
    const char* first_text = nullptr;
    std::size_t header_lines = 0;
    while (lines_.next(line)) {
      line = trimmed(line);
      if (line.empty()) continue;
      if (is_comment(line)) {
        last_text = line;
        continue;
      }
      if (take_count(line)) continue;
      layout_ = Layout{.separator = separator_of(line)};
      apply_names(last_text, line, layout_);
      Vec3 position{0.0};
      const char* at = line.data();
      if (read_columns(at, line.data() + line.size(), layout_, position)) {
        start_points(line, header_lines);
        return;
      }
      if (first_text == nullptr) first_text = line.data();
      last_text = line;
      if (++header_lines > kMostHeaderLines) break;
    }
    file_.fail_at_line(first_text == nullptr ? file_.bytes().data() : first_text,
                       "no line has three numbers, the coordinates of a point, here or in the "
                       "lines that follow");
  }

  void start_points(std::string_view line, std::size_t header_lines) {
    if (header_lines != 0) {
      geometry_.notes.push_back(std::to_string(header_lines) +
                                " header lines before the first point are skipped");
    }
    read_line(line);
  }

  void read_line(std::string_view line) {
    const char* at = line.data();
    const char* const end = at + line.size();
    Vec3 position{0.0};
    if (read_columns(at, end, layout_, position)) {
      if (geometry_.positions.size() == kMostPositions) {
        file_.fail_at_line(line.data(), "at most 2^32 - 1 points can be read");
      }
      geometry_.positions.add(position);
      return;
    }
    const std::string_view text = trimmed(line);
    if (text.empty() || is_comment(text)) return;
    if (file_type(file_.name()) == "pts" && take_count(text)) return;
    const std::string_view rest = trimmed({at, static_cast<std::size_t>(end - at)});
    file_.fail_at_line(at, "a point has three numbers; " +
                               (rest.empty() ? "the line ends before the third"
                                             : "there is " + quote(rest) + " instead of one"));
  }

  /// A line with one whole number says how many points follow.
  bool take_count(std::string_view text) {
    TextFields fields(text);
    std::int64_t count = 0;
    if (!fields.integer(count) || !fields.at_end() || count < 0) return false;
    const std::size_t room = (lines_.rest().size() + 1) / kShortestLine;
    if (static_cast<std::size_t>(count) > room) {
      file_.fail_at_line(text.data(), std::to_string(count) +
                                          " points are promised, but the file is too short for "
                                          "them: it is cut or the count is wrong");
    }
    count_line_ = text.data();
    promised_ = promised_.value_or(0) + static_cast<std::size_t>(count);
    return true;
  }

  void check_count() const {
    if (promised_ && *promised_ != geometry_.positions.size()) {
      file_.fail_at_line(count_line_, std::to_string(*promised_) + " points are promised, but " +
                                          std::to_string(geometry_.positions.size()) +
                                          " are in the file");
    }
  }

  const FileBytes& file_;
  RawGeometry& geometry_;
  TextLines lines_;
  Layout layout_;
  std::optional<std::size_t> promised_;
  const char* count_line_ = nullptr;
};

}  // namespace

void read_xyz(const FileBytes& file, RawGeometry& geometry, const Progress& progress) {
  geometry.format = "text";
  XyzReader(file, geometry).read(progress);
}

}  // namespace rangezip

#include <algorithm>
#include <array>
#include <string>
#include <string_view>

#include "core/io/format_readers.h"
#include "core/io/text_fields.h"

namespace rangezip {

namespace {

constexpr std::size_t kBlock = 65536;  ///< lines between two looks at the stop token

/// Statements of the format that say nothing about positions, points or polygons.
bool is_known_statement(std::string_view keyword) {
  static constexpr std::array<std::string_view, 40> kKnown{
      "vt",       "vn",         "vp",     "g",      "o",         "s",        "usemtl", "mtllib",
      "l",        "deg",        "bmat",   "step",   "cstype",    "curv",     "curv2",  "surf",
      "parm",     "trim",       "hole",   "scrv",   "sp",        "end",      "con",    "mg",
      "bevel",    "lod",        "usemap", "maplib", "trace_obj", "c_interp", "ctech",  "stech",
      "d_interp", "shadow_obj", "call",   "csh",    "bzp",       "bsp",      "cdc",    "res"};
  return std::find(kKnown.begin(), kKnown.end(), keyword) != kKnown.end();
}

/// Does `line` go on with the next one? A backslash at the end of a comment is part of it.
bool goes_on(std::string_view line) {
  return line.ends_with('\\') && line.find('#') == std::string_view::npos;
}

class ObjReader {
 public:
  ObjReader(const FileBytes& file, RawGeometry& geometry)
      : file_(file), geometry_(geometry), lines_(file.bytes()) {}

  void read(const Progress& progress) {
    std::string_view line;
    std::string joined;
    for (std::size_t number = 0; lines_.next(line); ++number) {
      if (number % kBlock == 0) progress.check_stop();
      place_ = line.data();
      if (goes_on(line)) {
        joined.clear();
        join_lines(line, joined);
        line = joined;
      }
      read_line(line);
    }
    if (geometry_.positions.size() == 0) {
      file_.fail_at_line(file_.bytes().data(), "there is no line 'v x y z' in the whole file");
    }
    if (largest_index_ > geometry_.positions.size()) {
      file_.fail_at_line(largest_place_, index_rule(static_cast<std::int64_t>(largest_index_)));
    }
    add_notes();
  }

 private:
  /// Puts a line that goes on behind a backslash together with the lines that follow.
  void join_lines(std::string_view line, std::string& joined) {
    while (goes_on(line)) {
      joined.append(line.substr(0, line.size() - 1)).push_back(' ');
      if (!lines_.next(line)) return;
    }
    joined.append(line);
  }

  void read_line(std::string_view line) {
    if (const std::size_t comment = line.find('#'); comment != std::string_view::npos) {
      line = line.substr(0, comment);
    }
    TextFields fields(line);
    const std::string_view keyword = fields.word();
    if (keyword.empty()) return;
    if (keyword == "v") {
      read_vertex(fields);
    } else if (keyword == "f" || keyword == "fo") {
      read_indices(fields);
      ++geometry_.polygons;
      geometry_.add_polygon(indices_);
    } else if (keyword == "p") {
      read_indices(fields);
      auto& points = geometry_.point_elements;
      points.insert(points.end(), indices_.begin(), indices_.end());
    } else if (!is_known_statement(keyword)) {
      if (unknown_++ == 0) first_unknown_ = keyword;
    } else if (keyword == "l") {
      ++lines_elements_;
    }
  }

  void read_vertex(TextFields& fields) {
    Vec3 position{0.0};
    if (!fields.number(position.x) || !fields.number(position.y) || !fields.number(position.z)) {
      file_.fail_at_line(
          place_, "a vertex has three numbers; " +
                      (fields.at_end() ? "the line ends before the third"
                                       : "there is " + quote(fields.rest()) + " instead of one"));
    }
    if (geometry_.positions.size() == kMostPositions) {
      file_.fail_at_line(place_, "at most 2^32 - 1 vertices can be read");
    }
    geometry_.positions.add(position);
  }

  /// All corners of a statement: "v", "v/vt", "v//vn" or "v/vt/vn"; only v is used.
  void read_indices(TextFields& fields) {
    indices_.clear();
    while (!fields.at_end()) {
      const std::string_view corner = fields.word();
      const char* at = corner.data();
      std::int64_t index = 0;
      if (!parse_integer(at, corner.data() + corner.size(), index, '/')) {
        file_.fail_at_line(place_,
                           "a corner begins with the number of a vertex, not " + quote(corner));
      }
      indices_.push_back(checked(index));
    }
    if (indices_.empty()) file_.fail_at_line(place_, "the statement has no vertex numbers");
  }

  /// Counted from 1, or backwards from the last vertex so far. A number may run ahead of the
  /// vertices; the largest is checked at the end.
  std::uint32_t checked(std::int64_t index) {
    const auto count = static_cast<std::int64_t>(geometry_.positions.size());
    const std::int64_t number = index < 0 ? count + 1 + index : index;
    if (number < 1 || number > static_cast<std::int64_t>(kMostPositions)) {
      file_.fail_at_line(place_, index_rule(index));
    }
    if (static_cast<std::uint64_t>(number) > largest_index_) {
      largest_index_ = static_cast<std::uint64_t>(number);
      largest_place_ = place_;
    }
    return static_cast<std::uint32_t>(number - 1);
  }

  [[nodiscard]] std::string index_rule(std::int64_t index) const {
    return "vertex number " + std::to_string(index) + " is out of range; the file has " +
           std::to_string(geometry_.positions.size()) + " vertices up to here";
  }

  void add_notes() {
    if (lines_elements_ != 0) {
      geometry_.notes.push_back(std::to_string(lines_elements_) + " line elements are ignored");
    }
    if (unknown_ != 0) {
      geometry_.notes.push_back(std::to_string(unknown_) +
                                " unknown statements are ignored, the first is " +
                                quote(first_unknown_));
    }
  }

  const FileBytes& file_;
  RawGeometry& geometry_;
  TextLines lines_;
  const char* place_ = nullptr;  ///< begin of the current statement
  std::vector<std::uint32_t> indices_;
  std::uint64_t largest_index_ = 0;  ///< counted from 1
  const char* largest_place_ = nullptr;
  std::size_t lines_elements_ = 0;
  std::size_t unknown_ = 0;
  std::string first_unknown_;
};

}  // namespace

void read_obj(const FileBytes& file, RawGeometry& geometry, const Progress& progress) {
  geometry.format = "obj";
  ObjReader(file, geometry).read(progress);
}

}  // namespace rangezip

#include <array>
#include <string>
#include <string_view>

#include "core/io/format_readers.h"
#include "core/io/text_fields.h"

namespace rangezip {

namespace {

constexpr std::size_t kShortestVertex = 6;  ///< bytes of "0 0 0" and a line end
constexpr std::size_t kShortestFace = 2;    ///< bytes of "0" and a line end
constexpr std::size_t kBlock = 65536;       ///< lines between two looks at the stop token

/// The keyword says which columns follow the position of a vertex; they are not read.
bool is_known_keyword(std::string_view keyword) {
  for (const std::string_view prefix : {"ST", "C", "N"}) {
    if (keyword.starts_with(prefix)) keyword.remove_prefix(prefix.size());
  }
  return keyword == "OFF";
}

class OffReader {
 public:
  OffReader(const FileBytes& file, RawGeometry& geometry)
      : file_(file), geometry_(geometry), lines_(file.bytes()) {}

  void read(const Progress& progress) {
    read_header();
    geometry_.positions.reserve(vertex_count_);
    for (std::size_t i = 0; i < vertex_count_; ++i) {
      if (i % kBlock == 0) progress.check_stop();
      read_vertex(next_line("vertices", i, vertex_count_));
    }
    for (std::size_t i = 0; i < face_count_; ++i) {
      if (i % kBlock == 0) progress.check_stop();
      read_face(next_line("faces", i, face_count_));
    }
    if (const std::string_view more = next_data(); !more.empty()) {
      file_.fail_at_line(more.data(), "the file goes on after the last face that it promises");
    }
  }

 private:
  /// The next line that is more than blanks and a comment, without the comment; empty at the end.
  std::string_view next_data() {
    std::string_view line = lines_.next_filled();
    while (!line.empty()) {
      line = line.substr(0, line.find('#'));
      if (line.find_first_not_of(" \t\r") != std::string_view::npos) break;
      line = lines_.next_filled();
    }
    return line;
  }

  std::string_view next_line(const char* what, std::size_t number, std::size_t count) {
    const std::string_view line = next_data();
    if (line.empty()) {
      file_.fail_at_line(lines_.position(), "the file ends after " + std::to_string(number) +
                                                " of " + std::to_string(count) + " " + what);
    }
    return line;
  }

  void read_header() {
    std::string_view line = next_data();
    TextFields fields(line);
    if (!is_known_keyword(fields.word())) {
      file_.fail_at_line(line.data(),
                         "an OFF file begins with OFF, COFF, NOFF, STOFF or a mix of "
                         "them in this order: ST, C, N");
    }
    if (to_lower(fields.rest()).starts_with("binary")) {
      file_.fail_at_line(line.data(), "binary OFF is not supported");
    }
    if (fields.at_end()) {
      line = next_line("lines of counts", 0, 1);
      fields = TextFields(line);
    }
    std::int64_t vertices = 0;
    std::int64_t faces = 0;
    std::int64_t edges = 0;
    const bool has_counts = fields.integer(vertices) && fields.integer(faces) && vertices >= 0 &&
                            faces >= 0 && (fields.at_end() || fields.integer(edges)) &&
                            fields.at_end();
    if (!has_counts) {
      file_.fail_at_line(line.data(),
                         "the counts of vertices, faces and edges are two or three whole numbers, "
                         "not " +
                             quote(line));
    }
    check_count(line, vertices, kShortestVertex, "vertices");
    check_count(line, faces, kShortestFace, "faces");
    vertex_count_ = static_cast<std::size_t>(vertices);
    face_count_ = static_cast<std::size_t>(faces);
  }

  void check_count(std::string_view line, std::int64_t count, std::size_t shortest,
                   const std::string& what) const {
    const std::size_t room = (lines_.rest().size() + 1) / shortest;
    if (static_cast<std::size_t>(count) > room ||
        static_cast<std::size_t>(count) > kMostPositions) {
      file_.fail_at_line(line.data(), std::to_string(count) + " " + what +
                                          " are promised, but the file is too short for them: it "
                                          "is cut or the count is wrong");
    }
  }

  void read_vertex(std::string_view line) {
    TextFields fields(line);
    Vec3 position{0.0};
    if (!fields.number(position.x) || !fields.number(position.y) || !fields.number(position.z)) {
      file_.fail_at_line(line.data(), "a vertex has three numbers, not " + quote(line));
    }
    geometry_.positions.add(position);
  }

  void read_face(std::string_view line) {
    TextFields fields(line);
    std::int64_t count = 0;
    if (!fields.integer(count) || count < 0) {
      file_.fail_at_line(line.data(),
                         "a face begins with its number of corners, not " + quote(line));
    }
    indices_.clear();
    for (std::int64_t i = 0; i < count; ++i) {
      std::int64_t index = 0;
      if (!fields.integer(index)) {
        file_.fail_at_line(line.data(), "a face of " + std::to_string(count) +
                                            " corners has as many vertex indices; " +
                                            std::to_string(i) + " were found");
      }
      if (index < 0 || static_cast<std::uint64_t>(index) >= vertex_count_) {
        file_.fail_at_line(line.data(), "vertex index " + std::to_string(index) +
                                            " is out of range; the file has " +
                                            std::to_string(vertex_count_) + " vertices");
      }
      indices_.push_back(static_cast<std::uint32_t>(index));
    }
    ++geometry_.polygons;
    geometry_.add_polygon(indices_);
  }

  const FileBytes& file_;
  RawGeometry& geometry_;
  TextLines lines_;
  std::size_t vertex_count_ = 0;
  std::size_t face_count_ = 0;
  std::vector<std::uint32_t> indices_;
};

}  // namespace

void read_off(const FileBytes& file, RawGeometry& geometry, const Progress& progress) {
  geometry.format = "off";
  OffReader(file, geometry).read(progress);
}

}  // namespace rangezip

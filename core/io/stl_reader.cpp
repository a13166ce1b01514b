#include <array>
#include <bit>
#include <string>
#include <string_view>

#include "core/io/byte_order.h"
#include "core/io/format_readers.h"
#include "core/io/text_fields.h"

namespace rangezip {

namespace {

constexpr std::size_t kHeaderSize = 80;
constexpr std::size_t kCountEnd = kHeaderSize + 4;
constexpr std::size_t kTriangleSize = 50;  ///< normal, three corners, two bytes of attributes
constexpr std::size_t kBlock = 65536;      ///< triangles between two looks at the stop token

/// Gives equal positions the same index. An open hash table of indices.
class JoinedPositions {
 public:
  explicit JoinedPositions(PositionList& positions) : positions_(positions) { grow(); }

  std::uint32_t index_of(const Vec3& position) {
    const Key key = key_of(position);
    std::size_t slot = first_slot(key);
    while (slots_[slot] != kEmpty) {
      if (keys_[slots_[slot]] == key) return slots_[slot];
      slot = (slot + 1) % slots_.size();
    }
    const auto index = static_cast<std::uint32_t>(keys_.size());
    slots_[slot] = index;
    keys_.push_back(key);
    positions_.add(position);
    if (2 * keys_.size() > slots_.size()) grow();
    return index;
  }

 private:
  using Key = std::array<std::uint64_t, 3>;
  static constexpr std::uint32_t kEmpty = 0xffff'ffffU;

  static Key key_of(const Vec3& position) {
    const Vec3 p = position + 0.0;  // -0 and 0 are one place
    return {std::bit_cast<std::uint64_t>(p.x), std::bit_cast<std::uint64_t>(p.y),
            std::bit_cast<std::uint64_t>(p.z)};
  }

  [[nodiscard]] std::size_t first_slot(const Key& key) const {
    constexpr std::uint64_t kOddMultiplier = 0x9e37'79b9'7f4a'7c15U;  // spreads all bits upwards
    std::uint64_t hash = 0;
    for (const std::uint64_t part : key) {
      hash = (hash ^ part) * kOddMultiplier;
      hash ^= hash >> 32U;
    }
    return hash % slots_.size();
  }

  void grow() {
    constexpr std::size_t kFirstSize = 1024;
    slots_.assign(std::max(kFirstSize, 2 * slots_.size()), kEmpty);
    for (std::uint32_t index = 0; index < keys_.size(); ++index) {
      std::size_t slot = first_slot(keys_[index]);
      while (slots_[slot] != kEmpty)
        slot = (slot + 1) % slots_.size();
      slots_[slot] = index;
    }
  }

  PositionList& positions_;
  std::vector<Key> keys_;  ///< of each position
  std::vector<std::uint32_t> slots_;
};

class StlReader {
 public:
  StlReader(const FileBytes& file, RawGeometry& geometry)
      : file_(file), geometry_(geometry), joined_(geometry.positions) {}

  void read(const Progress& progress) {
    const std::string_view bytes = file_.bytes();
    std::size_t promised = 0;
    if (bytes.size() >= kCountEnd)
      promised = load_little<std::uint32_t>(bytes.data() + kHeaderSize);
    // Binary files may begin with "solid" too, and text files may be of any length: only where the
    // size of the file is just that of its triangles is it binary for sure.
    const bool has_binary_size =
        bytes.size() >= kCountEnd && bytes.size() == kCountEnd + promised * kTriangleSize;
    const bool looks_like_text = to_lower(bytes.substr(0, 5)) == "solid" &&
                                 bytes.substr(0, kCountEnd).find('\0') == std::string_view::npos;
    if (has_binary_size) {
      read_binary(promised, progress);
    } else if (looks_like_text) {
      read_text(progress);
    } else {
      fail_size(promised);
    }
  }

 private:
  [[noreturn]] void fail_size(std::size_t promised) const {
    const std::size_t size = file_.bytes().size();
    if (size < kCountEnd) {
      file_.fail_at_byte(file_.bytes().data() + size,
                         "the file ends within the header of an STL file");
    }
    file_.fail_at_byte(file_.bytes().data() + kHeaderSize,
                       "the header promises " + std::to_string(promised) +
                           " triangles, a file of " +
                           std::to_string(kCountEnd + promised * kTriangleSize) +
                           " bytes, but it has " + std::to_string(size));
  }

  void read_binary(std::size_t count, const Progress& progress) {
    geometry_.format = "stl binary";
    const char* triangle = file_.bytes().data() + kCountEnd;
    for (std::size_t i = 0; i < count; ++i, triangle += kTriangleSize) {
      if (i % kBlock == 0) progress.check_stop();
      for (std::size_t corner = 0; corner < 3; ++corner) {
        const char* const at = triangle + 12 * (corner + 1);  // after the normal
        add_corner(
            {load_little<float>(at), load_little<float>(at + 4), load_little<float>(at + 8)});
      }
      end_polygon();
    }
  }

  void read_text(const Progress& progress) {
    geometry_.format = "stl ascii";
    TextLines lines(file_.bytes());
    std::string_view line;
    bool is_inside = false;  // of a solid
    for (std::size_t number = 0; lines.next(line); ++number) {
      if (number % kBlock == 0) progress.check_stop();
      TextFields fields(line);
      const char* const place = fields.position();
      const std::string keyword = to_lower(fields.word());
      if (keyword == "vertex") {
        add_text_corner(fields, place);
      } else if (keyword == "endloop") {
        if (polygon_.size() < 3) file_.fail_at_line(place, "a loop has at least three vertices");
        end_polygon();
      } else if (keyword == "solid" || keyword == "endsolid") {
        is_inside = keyword == "solid";
      } else if (keyword != "facet" && keyword != "outer" && keyword != "endfacet" &&
                 !keyword.empty()) {
        file_.fail_at_line(place, "unknown word " + quote(keyword) + " in an STL text file");
      }
      if (keyword != "vertex" && keyword != "endloop" && !polygon_.empty()) {
        file_.fail_at_line(place, "a loop of vertices ends with 'endloop'");
      }
    }
    if (is_inside)
      file_.fail_at_line(lines.position(), "the file ends without 'endsolid': it is cut");
  }

  void add_text_corner(TextFields& fields, const char* place) {
    Vec3 position{0.0};
    if (!fields.number(position.x) || !fields.number(position.y) || !fields.number(position.z) ||
        !fields.at_end()) {
      file_.fail_at_line(place, "a vertex has three numbers");
    }
    add_corner(position);
  }

  void add_corner(const Vec3& position) {
    if (geometry_.positions.size() == kMostPositions) {
      file_.fail("whole file: at most 2^32 - 1 vertices can be read");
    }
    polygon_.push_back(joined_.index_of(position));
  }

  void end_polygon() {
    ++geometry_.polygons;
    geometry_.add_polygon(polygon_);
    polygon_.clear();
  }

  const FileBytes& file_;
  RawGeometry& geometry_;
  JoinedPositions joined_;
  std::vector<std::uint32_t> polygon_;
};

}  // namespace

void read_stl(const FileBytes& file, RawGeometry& geometry, const Progress& progress) {
  StlReader(file, geometry).read(progress);
}

}  // namespace rangezip

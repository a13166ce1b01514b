#pragma once

#include <cmath>
#include <cstddef>
#include <cstdint>
#include <filesystem>
#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "core/base/geometry.h"
#include "core/base/progress.h"
#include "core/io/file_bytes.h"
#include "core/io/local_origin.h"

namespace rangezip {

/// Coordinates beyond this size count as not finite: products of three differences of them still
/// fit a double with room, and they fit a float.
inline constexpr double kLargestCoordinate = 1e30;

[[nodiscard]] inline bool is_usable(const Vec3& p) {
  return std::abs(p.x) <= kLargestCoordinate && std::abs(p.y) <= kLargestCoordinate &&
         std::abs(p.z) <= kLargestCoordinate;
}

/// The positions of one file in its order, with those that are not finite in their places: as
/// floats about an origin (12 bytes each) or as doubles.
class PositionList {
 public:
  enum class Precision { local_float, exact };

  /// Without `origin` it is 0, or what the reader foresees.
  explicit PositionList(Precision precision, const std::optional<Vec3>& origin = std::nullopt)
      : is_exact_(precision == Precision::exact),
        is_origin_given_(origin.has_value()),
        origin_(origin.value_or(Vec3{0.0})) {}

  /// For a reader that can look ahead: what best_origin() probably will be. @pre nothing was added
  void foresee_origin(const Vec3& origin) {
    if (!is_exact_ && !is_origin_given_) origin_ = origin;
  }

  void reserve(std::size_t count) { is_exact_ ? exact_.reserve(count) : local_.reserve(count); }
  void add(const Vec3& p) {
    if (!is_usable(p)) {
      add_unusable();
      return;
    }
    bounds_.add(p);
    local_origin_.add(p);
    if (is_exact_) {
      exact_.push_back(p);
    } else {
      local_.emplace_back(p - origin_);
    }
  }

  /// The same for many at once, which is faster.
  void add(std::span<const Vec3> block);

  [[nodiscard]] std::size_t size() const noexcept {
    return is_exact_ ? exact_.size() : local_.size();
  }
  [[nodiscard]] bool is_finite(std::size_t index) const {
    return std::isfinite(is_exact_ ? exact_[index].x : static_cast<double>(local_[index].x));
  }
  /// Position as it is stored, about origin().
  [[nodiscard]] Vec3 operator[](std::size_t index) const {
    return is_exact_ ? exact_[index] : Vec3(local_[index]);
  }
  [[nodiscard]] const Vec3& origin() const noexcept { return origin_; }
  /// The origin that would have been best (LocalOrigin).
  [[nodiscard]] Vec3 best_origin() const { return local_origin_.origin(); }
  /// Box of the finite ones, in the coordinates of the file.
  [[nodiscard]] const Box& bounds() const noexcept { return bounds_; }
  [[nodiscard]] std::size_t nonfinite() const noexcept { return nonfinite_; }

  /// Hands over the stored positions; this list is empty afterwards.
  [[nodiscard]] std::vector<Vec3f> take_local() { return std::move(local_); }
  [[nodiscard]] std::vector<Vec3> take_exact() { return std::move(exact_); }

 private:
  void add_unusable();

  bool is_exact_;
  bool is_origin_given_;
  Vec3 origin_;
  std::vector<Vec3f> local_;
  std::vector<Vec3> exact_;
  Box bounds_;
  LocalOrigin local_origin_;
  std::size_t nonfinite_ = 0;
};

/// What the reader of a format hands over: all that the file holds, nothing judged yet.
struct RawGeometry {
  std::string format;
  PositionList positions;
  std::vector<std::uint32_t> corners;         ///< of all polygons, one after the other; in range
  std::vector<std::uint32_t> polygon_sizes;   ///< corners of each
  std::vector<std::uint32_t> point_elements;  ///< indices of positions that are points (OBJ "p")
  std::size_t polygons = 0;                   ///< in the file; a strip is one
  std::vector<std::string> notes;

  void add_polygon(std::span<const std::uint32_t> polygon) {
    corners.insert(corners.end(), polygon.begin(), polygon.end());
    polygon_sizes.push_back(static_cast<std::uint32_t>(polygon.size()));
  }
};

/// Highest number of positions a file may have: indices have 32 bits, one value is kept free.
inline constexpr std::size_t kMostPositions = 0xffff'ffffU;

/// Reads `file` by the type in its name (file_type()). Positions are stored about `origin`; without
/// one, the reader chooses: see PositionList::best_origin().
/// @throws IoError naming file, place and rule
[[nodiscard]] RawGeometry read_geometry(const FileBytes& file, PositionList::Precision precision,
                                        const std::optional<Vec3>& origin,
                                        const Progress& progress);

/// For before a file is opened: what has no end, or unpacks to more than the memory, need not be
/// read to be refused.
/// @param also_known a type that the caller reads by itself, named with the others: "conf"
/// @throws IoError if read_geometry() does not know the type of `path`.
void check_geometry_type(const std::filesystem::path& path, std::string_view also_known = {});

/// The polygons as triangles, each within one polygon and in its orientation, in the order of the
/// file.
struct SplitPolygons {
  std::vector<Triangle> triangles;
  std::size_t nonfinite = 0;   ///< polygons left out: a corner is not finite
  std::size_t degenerate = 0;  ///< polygons left out: fewer than three distinct corners
};
/// @throws Cancelled if `progress` says so.
[[nodiscard]] SplitPolygons split_polygons(const RawGeometry& geometry,
                                           const Progress& progress = {});

}  // namespace rangezip

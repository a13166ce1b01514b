#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "core/base/geometry.h"
#include "core/base/grid.h"
#include "core/stitch/image_plane.h"

namespace rangezip {

/// Faces longer than this in the image are wide: the strip that replaces what is left of them
/// has to be wider than between two surfaces of the scan's own resolution. A face of the pixel
/// grid has sides of at most sqrt(2).
inline constexpr double kWideFace = 3.0;  // pixels

/// The longest side of a triangle in the image, pixels.
[[nodiscard]] double longest_side_in_image(const Triangle& face, const ImagePlane& image);

/// Removed wide faces, to be asked which one covers a place. Between a coarse old surface and a
/// fine patch the place of a removed face is known to be surface, so the strip may fill it
/// however long its triangles become.
class WideFaces {
 public:
  /// @param image must outlive this object
  WideFaces(std::vector<Triangle> faces, const ImagePlane& image);

  /// The longest side (pixels) of the longest face that covers the place; 0: none.
  [[nodiscard]] double longest_side_at(const GridPoint& place) const;

  [[nodiscard]] std::span<const Triangle> faces() const noexcept { return faces_; }

 private:
  struct Box {
    Pixel first, last;
  };
  [[nodiscard]] Box cells_of(const Triangle& face) const;
  [[nodiscard]] Pixel cell_of(const GridPoint& p) const;

  std::vector<Triangle> faces_;
  const ImagePlane* image_;
  GridPoint origin_;
  std::int64_t cell_side_ = 1;  ///< grid steps
  Extent cells_;
  std::vector<std::uint32_t> begins_;  ///< per cell, into listed_
  std::vector<std::uint32_t> listed_;
};

}  // namespace rangezip

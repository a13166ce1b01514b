#pragma once

#include <cstdint>
#include <vector>

#include "core/stitch/image_plane.h"
#include "core/stitch/patch_scan.h"

namespace rangezip {

/// What is known of the patch's surface at a pixel: a sample of the patch, or its continuation.
struct SheetSample {
  static constexpr std::uint8_t kUnknown = 255;

  double depth = kNoSample;
  glm::dvec2 slope{0.0, 0.0};
  double stretch = 1.0;          ///< stretch_of(slope), at most kMaxStretch
  std::uint8_t ring = kUnknown;  ///< pixels from the patch, 0 on it
  std::uint8_t cell = 0;         ///< which triangles the cell to the upper right has (GridCells)

  friend bool operator==(const SheetSample&, const SheetSample&) = default;
};

/// The surface that a patch lies on, as an image: the patch's own cells, and beyond its border the
/// depths that continue it for some pixels, along the samples of the range image where these go
/// on without a step and along the last slope elsewhere. Answers in constant time what the
/// stitcher asks about a place in the image plane. Covers the patch's box plus a margin.
class PatchSheet {
 public:
  /// @param radius pixels that the sheet is continued, 1..250
  PatchSheet(const PatchScan& scan, int radius);

  [[nodiscard]] int radius() const noexcept { return radius_; }
  [[nodiscard]] const RangeImage& image() const noexcept { return *image_; }

  /// Corners of the box around all cells of the patch.
  [[nodiscard]] Pixel first_pixel() const noexcept { return first_; }
  [[nodiscard]] Pixel last_pixel() const noexcept { return last_; }

  /// The sheet at a pixel; unknown outside of its window.
  [[nodiscard]] const SheetSample& operator[](Pixel p) const {
    const Pixel local{p.x - origin_.x, p.y - origin_.y};
    return samples_.extent().contains(local) ? samples_[local] : unknown_;
  }

  /// Whether the cell between the centres of p and p + (1, 1) has a triangle of the patch.
  [[nodiscard]] bool has_cell(Pixel p) const { return ((*this)[p].cell & kBothTriangles) != 0; }

  /// Whether a triangle of the patch covers the place (see in_pixels).
  [[nodiscard]] bool covers(const Vec2& place) const;

  /// Whether a triangle of a cell of the patch runs along the edge in this direction.
  /// @pre the pixels are neighbours
  [[nodiscard]] bool has_edge(Pixel from, Pixel to) const;

  /// Whether an edge of a triangle of the patch bounds it. Edges in blocks of cells
  /// (core/patch/decimate.h) do not.
  [[nodiscard]] bool is_boundary(Pixel from, Pixel to) const;

  /// Whether a depth somewhere in the cell belongs to the sheet: it differs from the mean of what
  /// is known at the cell's corners by at most `band` pixel sides times the largest stretch there,
  /// and half a pixel side more, since depths are compared between samples. False where nothing is
  /// known.
  [[nodiscard]] bool is_in_band(Pixel cell, double depth, double band) const;

  /// Half width of that band at a sample, model units.
  [[nodiscard]] double tolerance(double stretch, double depth, double band) const;

  /// Depth of the sheet at a place near the pixel. @pre the sheet is known at the pixel
  [[nodiscard]] double depth_at(const Vec2& place, Pixel pixel) const;

 private:
  static constexpr std::uint8_t kBothTriangles = kLowerTriangle | kUpperTriangle;

  void add_cells(const GridCells& cells);
  std::vector<Pixel> add_samples(const PatchScan& scan);
  void grow(std::vector<Pixel> front, const SlopeImage& slopes);
  [[nodiscard]] SheetSample& at(Pixel p) { return samples_[{p.x - origin_.x, p.y - origin_.y}]; }

  const RangeImage* image_;
  int radius_;
  Pixel first_, last_;
  Pixel origin_;
  Grid<SheetSample> samples_;
  SheetSample unknown_;
};

}  // namespace rangezip

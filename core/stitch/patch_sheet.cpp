#include "core/stitch/patch_sheet.h"

#include <algorithm>
#include <cmath>
#include <cstdlib>

#include "core/stitch/pixel_box.h"

namespace rangezip {

namespace {

/// Bands stop growing at this slope (the tangent of 76 degrees): beyond it a band would reach
/// other sheets.
constexpr double kMaxBandSlope = 4.0;

double limited_stretch(const glm::dvec2& slope) {
  return std::min(stretch_of(slope), std::sqrt(1.0 + kMaxBandSlope * kMaxBandSlope));
}

}  // namespace

PatchSheet::PatchSheet(const PatchScan& scan, int radius) : image_(&scan.image), radius_(radius) {
  const std::vector<Pixel>& pixels = scan.patch.pixels;
  if (pixels.empty()) return;
  const PixelBox box = box_around(pixels);
  first_ = box.first;
  last_ = box.last;
  const Extent extent = image_->extent();
  const int margin = radius + 1;
  origin_ = {std::max(0, first_.x - margin), std::max(0, first_.y - margin)};
  const Pixel end{std::min(extent.width, last_.x + margin + 1),
                  std::min(extent.height, last_.y + margin + 1)};
  samples_.reset({end.x - origin_.x, end.y - origin_.y});
  add_cells(scan.patch.cells);
  grow(add_samples(scan), scan.slopes);
}

void PatchSheet::add_cells(const GridCells& cells) {
  for (int y = first_.y; y < last_.y; ++y) {
    for (int x = first_.x; x < last_.x; ++x)
      at({x, y}).cell = cells[{x, y}];
  }
}

std::vector<Pixel> PatchSheet::add_samples(const PatchScan& scan) {
  std::vector<Pixel> front;
  const auto add = [&](Pixel p) {
    SheetSample& sample = at(p);
    if (sample.ring == 0) return;
    sample.ring = 0;
    sample.depth = scan.image[p];
    sample.slope = scan.slopes[p];
    sample.stretch = limited_stretch(sample.slope);
    front.push_back(p);
  };
  for (int y = first_.y; y < last_.y; ++y) {
    for (Pixel cell{first_.x, y}; cell.x < last_.x; ++cell.x) {
      const std::uint8_t bits = at(cell).cell;
      for (const std::uint8_t which : {kLowerTriangle, kUpperTriangle}) {
        if ((bits & which) == 0) continue;
        for (const Pixel corner : grid_triangle(cell, bits, which))
          add(corner);
      }
    }
  }
  return front;
}

/// Continues the sheet ring by ring.
void PatchSheet::grow(std::vector<Pixel> front, const SlopeImage& slopes) {
  constexpr double kStepTolerance = 1.5;  // of pixel side times stretch: no step of depth
  std::vector<Pixel> next;
  for (int ring = 1; ring <= radius_; ++ring, front.swap(next)) {
    next.clear();
    for (const Pixel p : front) {
      for (int k = 0; k < 9; ++k) {
        const Pixel q{p.x + k % 3 - 1, p.y + k / 3 - 1};
        const Pixel local{q.x - origin_.x, q.y - origin_.y};
        if (!samples_.extent().contains(local)) continue;
        SheetSample& sample = samples_[local];
        if (sample.ring != SheetSample::kUnknown) continue;
        const SheetSample& known = (*this)[p];
        const double side = image_->view().pixel_size(known.depth);
        sample.ring = static_cast<std::uint8_t>(ring);
        sample.depth =
            known.depth + side * ((q.x - p.x) * known.slope.x + (q.y - p.y) * known.slope.y);
        sample.slope = known.slope;
        const double measured = (*image_)[q];
        if (std::abs(measured - sample.depth) < kStepTolerance * side * known.stretch) {
          sample.depth = measured;
          sample.slope = slopes[q];
        }
        sample.stretch = limited_stretch(sample.slope);
        next.push_back(q);
      }
    }
  }
}

bool PatchSheet::covers(const Vec2& place) const {
  const Pixel p{static_cast<int>(std::floor(place.x)), static_cast<int>(std::floor(place.y))};
  const std::uint8_t cell = (*this)[p].cell;
  if ((cell & kBothTriangles) == 0) return false;
  const double x = place.x - p.x;
  const double y = place.y - p.y;
  const bool is_lower = (cell & kFallingDiagonal) != 0 ? x + y <= 1.0 : y <= x;
  return (cell & (is_lower ? kLowerTriangle : kUpperTriangle)) != 0;
}

bool PatchSheet::has_edge(Pixel from, Pixel to) const {
  const int dx = to.x - from.x;
  const int dy = to.y - from.y;
  // The cell to the left of the edge, and which of its triangles has it, under a falling (from
  // upper left to lower right) or a rising diagonal.
  const auto cell_has = [&](Pixel p, std::uint8_t if_falling, std::uint8_t if_rising) {
    const std::uint8_t cell = (*this)[p].cell;
    return (cell & ((cell & kFallingDiagonal) != 0 ? if_falling : if_rising)) != 0;
  };
  constexpr std::uint8_t kNeither = 0;
  if (dy == 0) {
    return dx > 0 ? cell_has(from, kLowerTriangle, kLowerTriangle)
                  : cell_has({to.x, to.y - 1}, kUpperTriangle, kUpperTriangle);
  }
  if (dx == 0) {
    return dy > 0 ? cell_has({from.x - 1, from.y}, kUpperTriangle, kLowerTriangle)
                  : cell_has(to, kLowerTriangle, kUpperTriangle);
  }
  if (dx == dy) {
    return dx > 0 ? cell_has(from, kNeither, kUpperTriangle)
                  : cell_has(to, kNeither, kLowerTriangle);
  }
  return dx < 0 ? cell_has({to.x, from.y}, kLowerTriangle, kNeither)
                : cell_has({from.x, to.y}, kUpperTriangle, kNeither);
}

bool PatchSheet::is_boundary(Pixel from, Pixel to) const {
  const Pixel step{to.x - from.x, to.y - from.y};
  if (std::abs(step.x) > 1 || std::abs(step.y) > 1) return false;
  if (step.x != 0 && step.y != 0) {
    const Pixel cell{std::min(from.x, to.x), std::min(from.y, to.y)};
    if (((*this)[cell].cell & kBothTriangles) == kBothTriangles) return false;
  }
  return !has_edge(to, from);
}

double PatchSheet::tolerance(double stretch, double depth, double band) const {
  constexpr double kSampleTolerance = 0.5;  // pixel sides
  return image_->view().pixel_size(depth) * (band * stretch + kSampleTolerance);
}

bool PatchSheet::is_in_band(Pixel cell, double depth, double band) const {
  double sum = 0.0;
  double stretch = 0.0;
  int known = 0;
  for (int k = 0; k < 4; ++k) {
    const SheetSample& sample = (*this)[{cell.x + k % 2, cell.y + k / 2}];
    if (sample.ring == SheetSample::kUnknown) continue;
    sum += sample.depth;
    stretch = std::max(stretch, sample.stretch);
    ++known;
  }
  if (known == 0) return false;
  const double expected = sum / known;
  return std::abs(depth - expected) <= tolerance(stretch, expected, band);
}

double PatchSheet::depth_at(const Vec2& place, Pixel pixel) const {
  const SheetSample& sample = (*this)[pixel];
  const double side = image_->view().pixel_size(sample.depth);
  return sample.depth +
         side * ((place.x - pixel.x) * sample.slope.x + (place.y - pixel.y) * sample.slope.y);
}

}  // namespace rangezip

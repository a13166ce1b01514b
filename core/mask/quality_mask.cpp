#include "core/mask/quality_mask.h"

#include <algorithm>
#include <cmath>
#include <string>
#include <vector>

#include "core/base/error.h"
#include "core/base/parallel.h"

namespace rangezip {

namespace {

void check_extents(const char* function, std::initializer_list<Extent> extents) {
  for (const Extent extent : extents) {
    if (extent != *extents.begin()) {
      throw InvalidArgument(std::string(function) + ": all images must have the same extent");
    }
  }
}

/// Longest edge at the pixel of the triangles of `cells`, or kNoSample if it has none.
double longest_edge_at(const RangeImage& image, const GridCells& cells, Pixel pixel) {
  const Vec3 here = eye_position(image, pixel);
  double longest = 0.0;  // squared
  bool has_triangle = false;
  for_each_triangle_at(cells, pixel, [&](const std::array<Pixel, 3>& corners) {
    has_triangle = true;
    for (const Pixel corner : corners) {
      const Vec3 edge = eye_position(image, corner) - here;
      longest = std::max(longest, glm::dot(edge, edge));
    }
  });
  return has_triangle ? std::sqrt(longest) : kNoSample;
}

/// Longest side of a grid cell at a slope: its diagonal, over the slope's mean effect on it.
double side_at_slope(double pixel_size, const glm::dvec2& slope) {
  return pixel_size * std::sqrt(2.0 + 1.5 * glm::dot(slope, slope));
}

/// The pixels of the piece (8 neighbours) around `seed`; unmarks them in `unvisited`.
std::vector<Pixel> take_piece(Mask& unvisited, Pixel seed) {
  std::vector<Pixel> piece{seed};
  unvisited[seed] = 0;
  for (std::size_t next = 0; next < piece.size(); ++next) {
    const Pixel p = piece[next];
    for (int y = p.y - 1; y <= p.y + 1; ++y) {
      for (int x = p.x - 1; x <= p.x + 1; ++x) {
        const Pixel there{x, y};
        if (!unvisited.extent().contains(there) || unvisited[there] == 0) continue;
        unvisited[there] = 0;
        piece.push_back(there);
      }
    }
  }
  return piece;
}

}  // namespace

Grid<double> sample_quality(const RangeImage& image, const SlopeImage& slopes, const Mask& active,
                            bool smooth, const GridCellOptions& cells) {
  check_extents("sample_quality", {image.extent(), slopes.extent(), active.extent()});
  const GridCells grid = build_grid_cells(image, active, cells);
  Grid<double> quality(image.extent(), kNoSample);
  for_each_row(image.extent().height, [&](int y) {
    for (Pixel p{0, y}; p.x < image.extent().width; ++p.x) {
      if (active[p] == 0 || !image.has_sample(p)) continue;
      const double longest = longest_edge_at(image, grid, p);
      quality[p] =
          smooth ? 0.5 * (longest + side_at_slope(image.pixel_size(p), slopes[p])) : longest;
    }
  });
  return quality;
}

Mask keep_better_samples(const Grid<double>& quality, const SlopeImage& slopes, const Mask& active,
                         const TriangleMesh& mesh, const Correspondence& correspondence,
                         const QualityMaskOptions& options) {
  check_extents("keep_better_samples",
                {quality.extent(), slopes.extent(), active.extent(), correspondence.face.extent(),
                 correspondence.from_behind.extent()});
  const double max_slope = options.max_replacing_slope;
  const auto replaces = [&](Pixel p, const Triangle& old) {
    return glm::dot(slopes[p], slopes[p]) <= max_slope * max_slope &&
           quality[p] < options.hysteresis * sampling_of(mesh, old);
  };
  Mask kept(active.extent(), 0);
  for_each_row(active.extent().height, [&](int y) {
    for (Pixel p{0, y}; p.x < active.extent().width; ++p.x) {
      if (active[p] == 0 || correspondence.from_behind[p] != 0) continue;
      const PrimitiveId face = correspondence.face[p];
      if (face == kNoPrimitive || replaces(p, mesh.triangles[face])) kept[p] = 1;
    }
  });
  return kept;
}

Mask keep_unmatched_samples(const Mask& active, const Correspondence& correspondence,
                            int min_pixels) {
  check_extents("keep_unmatched_samples", {active.extent(), correspondence.face.extent(),
                                           correspondence.from_behind.extent()});
  Mask unvisited = active;
  for (std::size_t i = 0; i < unvisited.pixels().size(); ++i) {
    if (correspondence.face.pixels()[i] != kNoPrimitive ||
        correspondence.from_behind.pixels()[i] != 0) {
      unvisited.pixels()[i] = 0;
    }
  }
  Mask kept(active.extent(), 0);
  for (int y = 0; y < active.extent().height; ++y) {
    for (int x = 0; x < active.extent().width; ++x) {
      if (unvisited[{x, y}] == 0) continue;
      const std::vector<Pixel> piece = take_piece(unvisited, {x, y});
      if (static_cast<int>(piece.size()) < min_pixels) continue;
      for (const Pixel p : piece)
        kept[p] = 1;
    }
  }
  return kept;
}

}  // namespace rangezip

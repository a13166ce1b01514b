#include "core/patch/decimate.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <cstdlib>
#include <string>
#include <vector>

#include "core/base/check_number.h"
#include "core/base/error.h"
#include "core/base/parallel.h"
#include "core/raster/rasterizer.h"

namespace rangezip {

namespace {

/// Steeper blocks (56 degrees) are not made: seen from where a later scan sees them well they would
/// be wide faces, and what such a scan puts in the place of one may reach other sheets.
constexpr double kMaxBlockSlope = 1.5;

using PixelTriangle = std::array<Pixel, 3>;

/// A square of 2^level x 2^level cells, at a multiple of its side.
struct Block {
  Pixel origin;
  int level = 0;

  [[nodiscard]] int side() const { return 1 << level; }
};

void check(const DecimateOptions& options) {
  check_not_negative("decimate: tolerance", options.tolerance);
  if (options.max_block < 1 || options.max_block > kMaxRasterExtent) {
    throw InvalidArgument("decimate: max_block must lie in 1.." + std::to_string(kMaxRasterExtent) +
                          ", got " + std::to_string(options.max_block));
  }
}

/// Twice the area of the triangle, positive if it runs counter-clockwise.
int signed_area(Pixel a, Pixel b, Pixel c) {
  return (b.x - a.x) * (c.y - a.y) - (b.y - a.y) * (c.x - a.x);
}

/// The level of the block that each cell belongs to. Blocks are split only once they have been
/// made, so that the splitting ends.
class QuadTree {
 public:
  QuadTree(const RangeImage& image, const GridCells& cells, const DecimateOptions& options)
      : image_(image), cells_(cells), options_(options), level_(cells.extent(), 0) {}

  void build() {
    for (int level = 1; (1 << level) <= options_.max_block; ++level)
      merge(level);
    do {
      while (split_where([&](const Block& b) { return is_unbalanced(b); })) {
      }
    } while (split_where([&](const Block& b) { return !fits(triangles_of(b)); }));
  }

  template <class Visit>
  void for_each_block(const Visit& visit) const {
    for (int y = 0; y + 1 < cells_.extent().height; ++y) {
      for (int x = 0; x + 1 < cells_.extent().width; ++x) {
        const Block block{{x, y}, level_[{x, y}]};
        const int inside = block.side() - 1;
        if ((x & inside) == 0 && (y & inside) == 0) visit(block);
      }
    }
  }

  /// Triangles of a block, counter-clockwise: of a cell its own; of a larger block without vertices
  /// in its sides two, and else a fan around the first of these.
  [[nodiscard]] std::vector<PixelTriangle> triangles_of(const Block& block) const {
    return block.level == 0 ? cell_triangles(block.origin) : block_triangles(outline_of(block));
  }

 private:
  struct Outline {
    std::array<Pixel, 8> vertices;  ///< counter-clockwise
    std::size_t count = 0;
    std::size_t first = 0;  ///< the first in the middle of a side, or 0
    bool has_middles = false;
  };

  [[nodiscard]] bool is_inner(Pixel cell) const {
    constexpr std::uint8_t kBoth = kLowerTriangle | kUpperTriangle;
    for (int k = 0; k < 9; ++k) {
      const Pixel p{cell.x + k % 3 - 1, cell.y + k / 3 - 1};
      if (!cells_.extent().contains(p) || (cells_[p] & kBoth) != kBoth) return false;
    }
    return true;
  }

  /// Makes blocks of the level of four of the level below where they fit.
  void merge(int level) {
    const int side = 1 << level;
    const Extent cells{cells_.extent().width - 1, cells_.extent().height - 1};
    for_each_row(cells.height / side, [&](int row) {
      for (Block block{{0, row * side}, level}; block.origin.x + side <= cells.width;
           block.origin.x += side) {
        if (has_four_children(block) && !is_steep(block) &&
            fits(block_triangles(corners_of(block)))) {
          set_level(block, level);
        }
      }
    });
  }

  [[nodiscard]] bool has_four_children(const Block& block) const {
    const int half = block.side() / 2;
    for (int k = 0; k < 4; ++k) {
      const Pixel child{block.origin.x + k % 2 * half, block.origin.y + k / 2 * half};
      if (level_[child] != block.level - 1) return false;
      if (block.level == 1 && !is_inner(child)) return false;
    }
    return true;
  }

  [[nodiscard]] bool is_steep(const Block& block) const {
    const std::array<Pixel, 8> corners = corners_of(block).vertices;
    const double most = kMaxBlockSlope * block.side() * image_.pixel_size(block.origin);
    for (std::size_t k = 0; k < 4; ++k) {
      if (std::abs(image_[corners[k]] - image_[corners[(k + 1) % 4]]) > most) return true;
    }
    return false;
  }

  void set_level(const Block& block, int level) {
    for (int y = block.origin.y; y < block.origin.y + block.side(); ++y) {
      const auto first = level_.row(y).begin() + block.origin.x;
      std::fill(first, first + block.side(), static_cast<std::uint8_t>(level));
    }
  }

  /// Splits the blocks into four for which the predicate holds. @return whether there were any
  template <class Predicate>
  bool split_where(const Predicate& predicate) {
    std::vector<Block> found;
    for_each_block([&](const Block& block) {
      if (block.level > 0 && predicate(block)) found.push_back(block);
    });
    for (const Block& block : found)
      set_level(block, block.level - 1);
    return !found.empty();
  }

  /// Whether a cell that touches the block belongs to one of less than half its side.
  [[nodiscard]] bool is_unbalanced(const Block& block) const {
    const Pixel first{block.origin.x - 1, block.origin.y - 1};
    const int last = block.side() + 1;
    for (int i = 0; i <= last; ++i) {
      for (const Pixel offset : {Pixel{i, 0}, Pixel{i, last}, Pixel{0, i}, Pixel{last, i}}) {
        if (level_[{first.x + offset.x, first.y + offset.y}] < block.level - 1) return true;
      }
    }
    return false;
  }

  [[nodiscard]] std::vector<PixelTriangle> cell_triangles(Pixel cell) const {
    std::vector<PixelTriangle> triangles;
    for (const std::uint8_t which : {kLowerTriangle, kUpperTriangle}) {
      if ((cells_[cell] & which) != 0)
        triangles.push_back(grid_triangle(cell, cells_[cell], which));
    }
    return triangles;
  }

  [[nodiscard]] static Outline corners_of(const Block& block) {
    const auto [x, y] = block.origin;
    const int side = block.side();
    return {.vertices = {{{x, y}, {x + side, y}, {x + side, y + side}, {x, y + side}}}, .count = 4};
  }

  /// The corners, and the middles of those sides beyond which there are smaller blocks.
  [[nodiscard]] Outline outline_of(const Block& block) const {
    constexpr std::array<Pixel, 4> kOutward{{{0, -1}, {1, 0}, {0, 1}, {-1, 0}}};
    const Outline corners = corners_of(block);
    const int half = block.side() / 2;
    Outline outline;
    for (std::size_t k = 0; k < 4; ++k) {
      const Pixel a = corners.vertices[k], b = corners.vertices[(k + 1) % 4];
      outline.vertices[outline.count++] = a;
      // A cell of the block next to the middle of the side, and from there one outward.
      const Pixel beyond{
          block.origin.x + half + kOutward[k].x * (kOutward[k].x > 0 ? half : half + 1),
          block.origin.y + half + kOutward[k].y * (kOutward[k].y > 0 ? half : half + 1)};
      if (level_[beyond] >= block.level) continue;
      if (!outline.has_middles) outline.first = outline.count;
      outline.has_middles = true;
      outline.vertices[outline.count++] = {(a.x + b.x) / 2, (a.y + b.y) / 2};
    }
    return outline;
  }

  [[nodiscard]] std::vector<PixelTriangle> block_triangles(Outline outline) const {
    if (!outline.has_middles) {  // as in a cell, along the smaller step of depth
      const auto& [a, b, c, d] = std::array{outline.vertices[0], outline.vertices[1],
                                            outline.vertices[2], outline.vertices[3]};
      const bool is_falling = std::abs(image_[b] - image_[d]) < std::abs(image_[a] - image_[c]);
      outline.first = is_falling ? 1 : 0;
    }
    std::vector<PixelTriangle> triangles;
    const auto at = [&](std::size_t k) {
      return outline.vertices[(outline.first + k) % outline.count];
    };
    for (std::size_t k = 1; k + 1 < outline.count; ++k)
      triangles.push_back({at(0), at(k), at(k + 1)});
    return triangles;
  }

  [[nodiscard]] bool fits(const std::vector<PixelTriangle>& triangles) const {
    return std::all_of(triangles.begin(), triangles.end(),
                       [&](const PixelTriangle& t) { return fits(t); });
  }

  /// What is linear over the image of a plane: the depth, or under a lens its inverse. Also the way
  /// back.
  [[nodiscard]] double linear(double depth) const {
    return image_.view().is_perspective() ? 1.0 / depth : depth;
  }

  [[nodiscard]] bool fits(const PixelTriangle& t) const {
    const auto [x_first, x_last] = std::minmax({t[0].x, t[1].x, t[2].x});
    const auto [y_first, y_last] = std::minmax({t[0].y, t[1].y, t[2].y});
    const std::array<double, 3> corner{linear(image_[t[0]]), linear(image_[t[1]]),
                                       linear(image_[t[2]])};
    const double area = signed_area(t[0], t[1], t[2]);
    for (int y = y_first; y <= y_last; ++y) {
      for (Pixel p{x_first, y}; p.x <= x_last; ++p.x) {
        const int a = signed_area(t[1], t[2], p), b = signed_area(t[2], t[0], p),
                  c = signed_area(t[0], t[1], p);
        if (a < 0 || b < 0 || c < 0) continue;
        if (p == t[0] || p == t[1] || p == t[2]) continue;  // exact but for rounding
        const double depth = linear((a * corner[0] + b * corner[1] + c * corner[2]) / area);
        if (!(std::abs(depth - image_[p]) <= options_.tolerance * image_.pixel_size(p)))
          return false;
      }
    }
    return true;
  }

  const RangeImage& image_;
  const GridCells& cells_;
  DecimateOptions options_;
  Grid<std::uint8_t> level_;
};

}  // namespace

Patch decimate(const RangeImage& image, Patch patch, const DecimateOptions& options) {
  check(options);
  if (patch.mesh.empty()) return patch;
  QuadTree tree(image, patch.cells, options);
  tree.build();
  Grid<std::uint32_t> vertex_at(image.extent());
  for (std::uint32_t v = 0; v < patch.pixels.size(); ++v)
    vertex_at[patch.pixels[v]] = v;
  patch.mesh.triangles.clear();
  tree.for_each_block([&](const Block& block) {
    for (const PixelTriangle& t : tree.triangles_of(block))
      patch.mesh.triangles.push_back({vertex_at[t[0]], vertex_at[t[1]], vertex_at[t[2]]});
  });
  remove_unused_vertices(patch);
  return patch;
}

}  // namespace rangezip

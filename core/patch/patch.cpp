#include "core/patch/patch.h"

#include <algorithm>
#include <array>
#include <bit>
#include <cstdint>
#include <limits>
#include <utility>
#include <vector>

#include "core/base/disjoint_sets.h"
#include "core/image/grid_cells.h"

namespace rangezip {

namespace {

/// The surroundings of a grid vertex are eight wedges, counter-clockwise from the right: bit w is
/// set where a triangle covers wedge w. A triangle whose right or sharp corner is at the vertex
/// covers two wedges of a quadrant or one. Neighbouring wedges share an edge, so fans of triangles
/// are runs of bits.
constexpr int kWedges = 8;

/// A triangle of the quadrant's cell that has a corner at the vertex.
struct WedgeTriangle {
  std::uint8_t which = 0;   ///< kLowerTriangle or kUpperTriangle
  std::uint8_t wedges = 0;  ///< of the quadrant: 1 the first, 2 the second, counter-clockwise
};

/// For a cell with the vertex at its corner a, b, c, d (the vertex's quadrants 0, 1, 2, 3), cut
/// from a to c: through corners a and c, so that each triangle takes one wedge there.
constexpr std::array<std::array<WedgeTriangle, 2>, 4> kRisingWedges{{
    {{{kLowerTriangle, 1}, {kUpperTriangle, 2}}},
    {{{kLowerTriangle, 3}, {0, 0}}},
    {{{kUpperTriangle, 1}, {kLowerTriangle, 2}}},
    {{{kUpperTriangle, 3}, {0, 0}}},
}};
/// The same for a cell cut from b to d.
constexpr std::array<std::array<WedgeTriangle, 2>, 4> kFallingWedges{{
    {{{kLowerTriangle, 3}, {0, 0}}},
    {{{kUpperTriangle, 1}, {kLowerTriangle, 2}}},
    {{{kUpperTriangle, 3}, {0, 0}}},
    {{{kLowerTriangle, 1}, {kUpperTriangle, 2}}},
}};

/// The cell in quadrant q of a vertex.
constexpr Pixel cell_of_quadrant(Pixel vertex, int quadrant) {
  return {vertex.x - (quadrant == 1 || quadrant == 2 ? 1 : 0), vertex.y - (quadrant >= 2 ? 1 : 0)};
}

const std::array<WedgeTriangle, 2>& wedge_triangles(std::uint8_t bits, int quadrant) {
  const auto q = static_cast<std::size_t>(quadrant);
  return (bits & kFallingDiagonal) != 0 ? kFallingWedges[q] : kRisingWedges[q];
}

/// Removes triangles until no two fans touch in a vertex only. Each removal can only disturb the
/// corners of the removed triangle, so those are looked at again: O(pixels) in all.
class FanCleaner {
 public:
  explicit FanCleaner(GridCells& cells) : cells_(cells) {}

  void clean() {
    const Extent extent = cells_.extent();
    for (int y = 0; y < extent.height; ++y) {
      for (int x = 0; x < extent.width; ++x)
        keep_largest_fan({x, y});
    }
    while (!disturbed_.empty()) {
      const Pixel vertex = disturbed_.back();
      disturbed_.pop_back();
      keep_largest_fan(vertex);
    }
  }

 private:
  [[nodiscard]] std::uint8_t covered_wedges(Pixel vertex) const {
    unsigned wedges = 0;
    for (int quadrant = 0; quadrant < 4; ++quadrant) {
      const Pixel cell = cell_of_quadrant(vertex, quadrant);
      if (cell.x < 0 || cell.y < 0 || cells_[cell] == 0) continue;
      for (const WedgeTriangle& triangle : wedge_triangles(cells_[cell], quadrant)) {
        if ((cells_[cell] & triangle.which) != 0) {
          wedges |= static_cast<unsigned>(triangle.wedges) << (2 * quadrant);
        }
      }
    }
    return static_cast<std::uint8_t>(wedges);
  }

  /// The longest cyclic run of set bits; of equal ones the first.
  static std::uint8_t longest_run(std::uint8_t wedges) {
    std::uint8_t best = 0;
    for (int start = 0; start < kWedges; ++start) {
      const std::uint8_t turned = std::rotr(wedges, start);
      if ((turned & 0x80U) != 0) continue;  // the run begins before `start`
      const auto run = static_cast<std::uint8_t>((1U << std::countr_one(turned)) - 1U);
      if (std::popcount(run) > std::popcount(best)) best = std::rotl(run, start);
    }
    return best;
  }

  void keep_largest_fan(Pixel vertex) {
    const std::uint8_t wedges = covered_wedges(vertex);
    if (wedges == 0 || wedges == 0xffU) return;
    const std::uint8_t kept = longest_run(wedges);
    if (kept == wedges) return;
    for (int quadrant = 0; quadrant < 4; ++quadrant) {
      const Pixel cell = cell_of_quadrant(vertex, quadrant);
      if (cell.x < 0 || cell.y < 0) continue;
      for (const WedgeTriangle& triangle : wedge_triangles(cells_[cell], quadrant)) {
        const unsigned own = static_cast<unsigned>(triangle.wedges) << (2 * quadrant);
        if ((cells_[cell] & triangle.which) != 0 && (own & kept) == 0) remove(cell, triangle.which);
      }
    }
  }

  void remove(Pixel cell, std::uint8_t which) {
    for (const Pixel corner : grid_triangle(cell, cells_[cell], which)) {
      disturbed_.push_back(corner);
    }
    cells_[cell] = static_cast<std::uint8_t>(cells_[cell] & ~which);
  }

  GridCells& cells_;
  std::vector<Pixel> disturbed_;
};

/// Number of triangles in the piece that each vertex belongs to.
std::vector<std::size_t> sizes_of_pieces(const TriangleMesh& mesh) {
  DisjointSets pieces(mesh.positions.size());
  for (const Triangle& t : mesh.triangles) {
    pieces.join(t[0], t[1]);
    pieces.join(t[0], t[2]);
  }
  std::vector<std::size_t> size(mesh.positions.size(), 0);
  for (const Triangle& t : mesh.triangles)
    ++size[pieces.find(t[0])];
  for (std::uint32_t v = 0; v < size.size(); ++v)
    size[v] = size[pieces.find(v)];
  return size;
}

/// Takes the triangle of one cell out of the patch's cells.
void clear_cell_of(const Triangle& triangle, Patch& patch) {
  std::array<Pixel, 3> corners;
  std::transform(triangle.begin(), triangle.end(), corners.begin(),
                 [&](std::uint32_t v) { return patch.pixels[v]; });
  const Pixel cell{std::min({corners[0].x, corners[1].x, corners[2].x}),
                   std::min({corners[0].y, corners[1].y, corners[2].y})};
  std::uint8_t& bits = patch.cells[cell];
  const bool is_lower = grid_triangle(cell, bits, kLowerTriangle) == corners;
  bits = static_cast<std::uint8_t>(bits & ~(is_lower ? kLowerTriangle : kUpperTriangle));
}

void remove_small_pieces(Patch& patch, std::size_t min_triangles) {
  const std::vector<std::size_t> size = sizes_of_pieces(patch.mesh);
  for (const Triangle& t : patch.mesh.triangles) {
    if (size[t[0]] < min_triangles) clear_cell_of(t, patch);
  }
  std::erase_if(patch.mesh.triangles,
                [&](const Triangle& t) { return size[t[0]] < min_triangles; });
  remove_unused_vertices(patch);
}

}  // namespace

void remove_unused_vertices(Patch& patch) {
  std::vector<std::uint8_t> is_used(patch.pixels.size(), 0);
  for (const Triangle& t : patch.mesh.triangles) {
    for (const std::uint32_t v : t)
      is_used[v] = 1;
  }
  std::size_t kept = 0;
  for (std::size_t v = 0; v < is_used.size(); ++v) {
    if (is_used[v] != 0) patch.pixels[kept++] = patch.pixels[v];
  }
  patch.pixels.resize(kept);
  remove_unused_vertices(patch.mesh);
}

PixelSides pixel_sides_of(const Patch& patch, const RangeImage& image) {
  PixelSides sides;
  for (const Pixel p : patch.pixels) {
    const double side = image.pixel_size(p);
    sides = {std::min(sides.smallest, side), std::max(sides.largest, side)};
  }
  return sides;
}

Patch patch_from_cells(const RangeImage& image, GridCells cells) {
  const Extent extent = image.extent();
  constexpr std::uint32_t kNoVertex = std::numeric_limits<std::uint32_t>::max();
  Grid<std::uint32_t> vertex_at(extent, kNoVertex);
  std::size_t faces = 0;
  const auto for_each_triangle = [&](const auto& visit) {
    for (int y = 0; y + 1 < extent.height; ++y) {
      for (int x = 0; x + 1 < extent.width; ++x) {
        const std::uint8_t bits = cells[{x, y}];
        for (const std::uint8_t which : {kLowerTriangle, kUpperTriangle}) {
          if ((bits & which) != 0) visit(grid_triangle({x, y}, bits, which));
        }
      }
    }
  };
  for_each_triangle([&](const std::array<Pixel, 3>& corners) {
    ++faces;
    for (const Pixel p : corners)
      vertex_at[p] = 0;
  });

  Patch patch;
  for (int y = 0; y < extent.height; ++y) {
    for (int x = 0; x < extent.width; ++x) {
      const Pixel p{x, y};
      if (vertex_at[p] == kNoVertex) continue;
      vertex_at[p] = static_cast<std::uint32_t>(patch.pixels.size());
      patch.pixels.push_back(p);
      patch.mesh.positions.push_back(image.position(p));
    }
  }
  patch.mesh.triangles.reserve(faces);
  for_each_triangle([&](const std::array<Pixel, 3>& corners) {
    patch.mesh.triangles.push_back(
        {vertex_at[corners[0]], vertex_at[corners[1]], vertex_at[corners[2]]});
  });
  patch.cells = std::move(cells);
  return patch;
}

Patch triangulate(const RangeImage& image, const Mask& active, const TriangulateOptions& options) {
  GridCells cells = build_grid_cells(image, active, grid_cell_options(options));
  FanCleaner(cells).clean();
  Patch patch = patch_from_cells(image, std::move(cells));
  if (options.min_component > 1) remove_small_pieces(patch, options.min_component);
  return patch;
}

}  // namespace rangezip

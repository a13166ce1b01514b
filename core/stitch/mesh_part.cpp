#include "core/stitch/mesh_part.h"

#include <algorithm>
#include <cstdint>
#include <limits>
#include <numeric>
#include <optional>
#include <utility>

#include "core/base/grid.h"
#include "core/base/parallel.h"
#include "core/stitch/image_plane.h"

namespace rangezip {

namespace {

constexpr std::uint32_t kUnused = std::numeric_limits<std::uint32_t>::max();
constexpr std::size_t kItemsPerBlock = 16384;

/// A tile of the image, by its column and row.
struct Tile {
  std::int32_t x = 0;
  std::int32_t y = 0;
};

/// Of a vertex without an image.
constexpr Tile kNowhere{-1, -1};

/// A box of tiles, both ends included.
struct TileBox {
  Tile first;
  Tile last;
};

/// Marked tiles of the image and of a margin around it: any box is marked or asked for in constant
/// time. What lies farther outside counts to the outermost tiles, which nothing within the margin
/// does, nor a face of usual size that reaches there: or all that a small image does not show would
/// be near what touches its edge.
class TileMask {
 public:
  TileMask(Extent image, int margin)
      : border_(margin / kTile + 2 + kFaceTiles),
        tiles_{image.width / kTile + 1 + 2 * border_, image.height / kTile + 1 + 2 * border_},
        sums_({tiles_.width + 1, tiles_.height + 1}, 0) {}

  /// Of pixel coordinates.
  [[nodiscard]] Tile tile_at(std::int64_t x, std::int64_t y) const {
    return {place_along(x, tiles_.width), place_along(y, tiles_.height)};
  }

  /// @pre close() has not been called
  void mark(const TileBox& box) {
    const int x = box.first.x, y = box.first.y, end_x = box.last.x + 1, end_y = box.last.y + 1;
    sums_[{x, y}] += 1;
    sums_[{end_x, y}] -= 1;
    sums_[{x, end_y}] -= 1;
    sums_[{end_x, end_y}] += 1;
  }

  /// Turns what mark() has noted into the number of marked tiles below and to the left of each.
  void close() {
    sum_up();
    Grid<std::int32_t> is_marked(sums_.extent(), 0);
    for (int y = 0; y < tiles_.height; ++y) {
      for (int x = 0; x < tiles_.width; ++x)
        is_marked[{x + 1, y + 1}] = sums_[{x, y}] > 0 ? 1 : 0;
    }
    sums_ = std::move(is_marked);
    sum_up();
  }

  /// @pre close() has been called
  [[nodiscard]] bool meets(const TileBox& box) const {
    const int x = box.first.x, y = box.first.y, end_x = box.last.x + 1, end_y = box.last.y + 1;
    return sums_[{end_x, end_y}] - sums_[{x, end_y}] - sums_[{end_x, y}] + sums_[{x, y}] > 0;
  }

 private:
  static constexpr int kFaceTiles = 4;  ///< more than a face of usual size reaches over
  static constexpr int kTileBits = 2;
  static constexpr int kTile = 1 << kTileBits;  ///< pixels

  [[nodiscard]] std::int32_t place_along(std::int64_t pixel, int tiles) const {
    return static_cast<std::int32_t>(
        std::clamp<std::int64_t>((pixel >> kTileBits) + border_, 0, tiles - 1));
  }

  /// Makes of each value the sum of those below and to the left.
  void sum_up() {
    for (int y = 0; y <= tiles_.height; ++y) {
      for (int x = 0; x <= tiles_.width; ++x) {
        if (x > 0) sums_[{x, y}] += sums_[{x - 1, y}];
        if (y > 0) sums_[{x, y}] += sums_[{x, y - 1}];
        if (x > 0 && y > 0) sums_[{x, y}] -= sums_[{x - 1, y - 1}];
      }
    }
  }

  int border_;  ///< tiles on each side of the image
  Extent tiles_;
  Grid<std::int32_t> sums_;
};

/// The tile of each vertex: all that is asked about the whole mesh, in few bytes.
std::vector<Tile> tiles_of(const std::vector<Vec3>& positions, const View& view,
                           const TileMask& grid) {
  std::vector<Tile> tiles(positions.size());
  parallel_for(positions.size(), kItemsPerBlock, [&](std::size_t begin, std::size_t end) {
    const ImagePlane image =
        project_to_image(std::span(positions).subspan(begin, end - begin), view);
    for (std::size_t v = begin; v < end; ++v) {
      const auto local = static_cast<std::uint32_t>(v - begin);
      const GridPoint& p = image.points[local];
      tiles[v] =
          image.has_image(local) ? grid.tile_at(p.x >> kGridBits, p.y >> kGridBits) : kNowhere;
    }
  });
  return tiles;
}

/// The box around the image of a face; none if a corner has no image: it may be anywhere.
std::optional<TileBox> box_of(const Triangle& face, const std::vector<Tile>& tiles) {
  const Tile a = tiles[face[0]], b = tiles[face[1]], c = tiles[face[2]];
  const TileBox box{{std::min({a.x, b.x, c.x}), std::min({a.y, b.y, c.y})},
                    {std::max({a.x, b.x, c.x}), std::max({a.y, b.y, c.y})}};
  if (box.first.x == kNowhere.x) return std::nullopt;
  return box;
}

/// Flags of the faces that meet the mask, or may.
std::vector<std::uint8_t> faces_that_meet(const TileMask& mask,
                                          const std::vector<Triangle>& triangles,
                                          const std::vector<Tile>& tiles) {
  std::vector<std::uint8_t> meets(triangles.size());
  parallel_for(meets.size(), kItemsPerBlock, [&](std::size_t begin, std::size_t end) {
    for (std::size_t f = begin; f < end; ++f) {
      const std::optional<TileBox> box = box_of(triangles[f], tiles);
      meets[f] = !box || mask.meets(*box) ? 1 : 0;
    }
  });
  return meets;
}

/// What the boxes of the faces that meet `mask` cover.
/// @param empty of the same tiles as `mask`
TileMask mask_of_faces_in(const TileMask& mask, const std::vector<Triangle>& triangles,
                          const std::vector<Tile>& tiles, TileMask empty) {
  const std::vector<std::uint8_t> meets = faces_that_meet(mask, triangles, tiles);
  for (std::size_t f = 0; f < meets.size(); ++f) {
    if (meets[f] == 0) continue;
    if (const std::optional<TileBox> box = box_of(triangles[f], tiles)) empty.mark(*box);
  }
  empty.close();
  return empty;
}

/// Marks the corners of the faces that the part is about; those around get one ring of faces more.
std::vector<std::uint8_t> inner_vertices(const TriangleMesh& whole, const View& view,
                                         std::span<const Pixel> pixels, int margin) {
  const TileMask empty(view.extent(), margin);
  const std::vector<Tile> tiles = tiles_of(whole.positions, view, empty);
  TileMask near = empty;
  for (const Pixel p : pixels)
    near.mark({near.tile_at(p.x - margin, p.y - margin), near.tile_at(p.x + margin, p.y + margin)});
  near.close();
  const std::vector<std::uint8_t> meets = faces_that_meet(
      mask_of_faces_in(near, whole.triangles, tiles, empty), whole.triangles, tiles);
  std::vector<std::uint8_t> is_inner(whole.positions.size(), 0);
  for (std::size_t f = 0; f < meets.size(); ++f) {
    if (meets[f] == 0) continue;
    for (const std::uint32_t v : whole.triangles[f])
      is_inner[v] = 1;
  }
  return is_inner;
}

void remove_gone_faces(TriangleMesh& whole, const MeshPart& part, const FaceChanges& changes) {
  if (changes.gone.empty()) return;
  std::size_t kept = part.face_in_whole[changes.gone.front()];
  auto next = changes.gone.begin();
  for (std::size_t f = kept; f < whole.triangles.size(); ++f) {
    if (next != changes.gone.end() && part.face_in_whole[*next] == f) {
      ++next;
    } else {
      whole.triangles[kept++] = whole.triangles[f];
    }
  }
  whole.triangles.resize(kept);
}

/// Moves the vertices of the part, adds new ones, and marks those that are not used any more.
/// @return the number in the whole of each vertex of `changed`; of unused new ones kUnused
std::vector<std::uint32_t> put_back_vertices(TriangleMesh& whole, const MeshPart& part,
                                             const TriangleMesh& changed,
                                             std::vector<std::uint8_t>& is_dropped) {
  std::vector<std::uint8_t> is_used(changed.positions.size(), 0);
  for (const Triangle& face : changed.triangles) {
    for (const std::uint32_t v : face)
      is_used[v] = 1;
  }
  is_dropped.assign(whole.positions.size(), 0);
  const bool has_sources =
      !changed.sources.empty() && (whole.positions.empty() || !whole.sources.empty());
  std::vector<std::uint32_t> in_whole = part.vertex_in_whole;
  for (std::size_t v = 0; v < changed.positions.size(); ++v) {
    if (v < in_whole.size()) {
      whole.positions[in_whole[v]] = changed.positions[v];
      if (has_sources) whole.sources[in_whole[v]] = changed.sources[v];
      is_dropped[in_whole[v]] = is_used[v] != 0 ? 0 : 1;
    } else if (is_used[v] != 0) {
      in_whole.push_back(static_cast<std::uint32_t>(whole.positions.size()));
      whole.positions.push_back(changed.positions[v]);
      if (has_sources) whole.sources.push_back(changed.sources[v]);
    } else {
      in_whole.push_back(kUnused);
    }
  }
  is_dropped.resize(whole.positions.size(), 0);
  return in_whole;
}

}  // namespace

MeshPart cut_out_part(const TriangleMesh& whole, const View& view, std::span<const Pixel> pixels,
                      int margin) {
  const std::vector<std::uint8_t> is_inner = inner_vertices(whole, view, pixels, margin);
  MeshPart part;
  std::vector<std::uint32_t> local(whole.positions.size(), kUnused);
  for (std::uint32_t f = 0; f < whole.triangles.size(); ++f) {
    const Triangle& face = whole.triangles[f];
    if ((is_inner[face[0]] | is_inner[face[1]] | is_inner[face[2]]) == 0) continue;
    part.face_in_whole.push_back(f);
    for (const std::uint32_t v : face)
      local[v] = 0;
  }
  for (std::uint32_t v = 0; v < local.size(); ++v) {
    if (local[v] == kUnused) continue;
    local[v] = static_cast<std::uint32_t>(part.vertex_in_whole.size());
    part.vertex_in_whole.push_back(v);
    part.mesh.positions.push_back(whole.positions[v]);
    if (!whole.sources.empty()) part.mesh.sources.push_back(whole.sources[v]);
    part.is_rim.push_back(is_inner[v] != 0 ? 0 : 1);
  }
  for (const std::uint32_t f : part.face_in_whole) {
    const Triangle& face = whole.triangles[f];
    part.mesh.triangles.push_back({local[face[0]], local[face[1]], local[face[2]]});
  }
  return part;
}

MeshPart whole_as_part(const TriangleMesh& whole) {
  MeshPart part{.mesh = whole, .is_rim = std::vector<std::uint8_t>(whole.positions.size(), 0)};
  part.vertex_in_whole.resize(whole.positions.size());
  part.face_in_whole.resize(whole.triangles.size());
  std::iota(part.vertex_in_whole.begin(), part.vertex_in_whole.end(), 0U);
  std::iota(part.face_in_whole.begin(), part.face_in_whole.end(), 0U);
  return part;
}

void put_back(TriangleMesh& whole, const MeshPart& part, const TriangleMesh& changed,
              const FaceChanges& changes) {
  std::vector<std::uint8_t> is_dropped;
  const std::vector<std::uint32_t> in_whole = put_back_vertices(whole, part, changed, is_dropped);
  remove_gone_faces(whole, part, changes);
  for (const std::uint32_t f : changes.made) {
    const Triangle& face = changed.triangles[f];
    whole.triangles.push_back({in_whole[face[0]], in_whole[face[1]], in_whole[face[2]]});
  }
  remove_vertices(whole, is_dropped);
}

}  // namespace rangezip

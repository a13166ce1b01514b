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

/// A box of the image, on the grid of the stitcher.
struct GridBox {
  GridPoint lower{kGridLimit, kGridLimit};
  GridPoint upper{-kGridLimit, -kGridLimit};

  void add(const GridPoint& p) {
    lower = {std::min(lower.x, p.x), std::min(lower.y, p.y)};
    upper = {std::max(upper.x, p.x), std::max(upper.y, p.y)};
  }
};

GridBox grid_box_around(Pixel p, int margin) {
  GridBox box;
  box.add(grid_point({p.x - margin, p.y - margin}));
  box.add(grid_point({p.x + margin, p.y + margin}));
  return box;
}

/// Marked places of the image, in tiles: any box is marked or asked for in constant time. What lies
/// outside of the image counts to the nearest tile.
class TileMask {
 public:
  explicit TileMask(Extent image)
      : tiles_{image.width / kTile + 1, image.height / kTile + 1},
        sums_({tiles_.width + 1, tiles_.height + 1}, 0) {}

  /// @pre close() has not been called
  void mark(const GridBox& box) {
    const Pixel first = tile_of(box.lower), last = tile_of(box.upper);
    sums_[first] += 1;
    sums_[{last.x + 1, first.y}] -= 1;
    sums_[{first.x, last.y + 1}] -= 1;
    sums_[{last.x + 1, last.y + 1}] += 1;
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
  [[nodiscard]] bool meets(const GridBox& box) const {
    const Pixel first = tile_of(box.lower), last = tile_of(box.upper);
    return sums_[{last.x + 1, last.y + 1}] - sums_[{first.x, last.y + 1}] -
               sums_[{last.x + 1, first.y}] + sums_[first] >
           0;
  }

 private:
  static constexpr int kTile = 4;  ///< pixels

  [[nodiscard]] Pixel tile_of(const GridPoint& p) const {
    return {
        static_cast<int>(std::clamp<std::int64_t>((p.x >> kGridBits) / kTile, 0, tiles_.width - 1)),
        static_cast<int>(
            std::clamp<std::int64_t>((p.y >> kGridBits) / kTile, 0, tiles_.height - 1))};
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

  Extent tiles_;
  Grid<std::int32_t> sums_;
};

/// The image of a face; none if a corner has none, which may be anywhere.
std::optional<GridBox> box_of(const Triangle& face, const ImagePlane& image) {
  GridBox box;
  for (const std::uint32_t v : face) {
    if (!image.has_image(v)) return std::nullopt;
    box.add(image.points[v]);
  }
  return box;
}

/// Flags of the faces that meet the mask, or may.
std::vector<std::uint8_t> faces_that_meet(const TileMask& mask, const TriangleMesh& mesh,
                                          const ImagePlane& image) {
  std::vector<std::uint8_t> meets(mesh.triangles.size());
  parallel_for(meets.size(), kItemsPerBlock, [&](std::size_t begin, std::size_t end) {
    for (std::size_t f = begin; f < end; ++f) {
      const std::optional<GridBox> box = box_of(mesh.triangles[f], image);
      meets[f] = !box || mask.meets(*box) ? 1 : 0;
    }
  });
  return meets;
}

TileMask mask_around(std::span<const Pixel> pixels, int margin, Extent image) {
  TileMask mask(image);
  for (const Pixel p : pixels)
    mask.mark(grid_box_around(p, margin));
  mask.close();
  return mask;
}

/// What the boxes of the faces that meet `mask` cover.
TileMask mask_of_faces_in(const TileMask& mask, const TriangleMesh& mesh, const ImagePlane& image,
                          Extent extent) {
  const std::vector<std::uint8_t> meets = faces_that_meet(mask, mesh, image);
  TileMask around(extent);
  for (std::size_t f = 0; f < meets.size(); ++f) {
    if (meets[f] == 0) continue;
    if (const std::optional<GridBox> box = box_of(mesh.triangles[f], image)) around.mark(*box);
  }
  around.close();
  return around;
}

/// Marks the corners of the faces that the part is about; those around get one ring of faces more.
std::vector<std::uint8_t> inner_vertices(const TriangleMesh& whole, const View& view,
                                         std::span<const Pixel> pixels, int margin) {
  const ImagePlane image = project_to_image(whole.positions, view);
  const TileMask near = mask_around(pixels, margin, view.extent());
  const std::vector<std::uint8_t> meets =
      faces_that_meet(mask_of_faces_in(near, whole, image, view.extent()), whole, image);
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

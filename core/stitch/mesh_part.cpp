#include "core/stitch/mesh_part.h"

#include <algorithm>
#include <limits>

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
  void add(const GridBox& box) {
    add(box.lower);
    add(box.upper);
  }
};

GridBox grid_box_around(std::span<const Pixel> pixels, int margin) {
  GridBox box;
  for (const Pixel p : pixels) {
    box.add(grid_point({p.x - margin, p.y - margin}));
    box.add(grid_point({p.x + margin, p.y + margin}));
  }
  return box;
}

/// On which outer sides of the box a vertex lies: a face misses the box if its corners share one.
/// None for a vertex without image, which may be anywhere.
std::vector<std::uint8_t> sides_of(const ImagePlane& image, const GridBox& box) {
  std::vector<std::uint8_t> sides(image.points.size());
  parallel_for(sides.size(), kItemsPerBlock, [&](std::size_t begin, std::size_t end) {
    for (std::size_t v = begin; v < end; ++v) {
      const GridPoint& p = image.points[v];
      const unsigned code = (p.x < box.lower.x ? 1U : 0U) | (p.x > box.upper.x ? 2U : 0U) |
                            (p.y < box.lower.y ? 4U : 0U) | (p.y > box.upper.y ? 8U : 0U);
      sides[v] = image.has_image(static_cast<std::uint32_t>(v)) ? static_cast<std::uint8_t>(code)
                                                                : std::uint8_t{0};
    }
  });
  return sides;
}

bool meets_box(const Triangle& face, const std::vector<std::uint8_t>& sides) {
  return (sides[face[0]] & sides[face[1]] & sides[face[2]]) == 0;
}

/// The box around the images of all faces that meet `box`.
GridBox box_of_faces_in(const TriangleMesh& mesh, const ImagePlane& image, const GridBox& box) {
  const std::vector<std::uint8_t> sides = sides_of(image, box);
  GridBox around = box;
  for (const Triangle& face : mesh.triangles) {
    if (!meets_box(face, sides)) continue;
    for (const std::uint32_t v : face) {
      if (image.has_image(v)) around.add(image.points[v]);
    }
  }
  return around;
}

/// Marks the corners of the faces that the part is about; those around get one ring of faces more.
std::vector<std::uint8_t> inner_vertices(const TriangleMesh& whole, const View& view,
                                         std::span<const Pixel> pixels, int margin) {
  const ImagePlane image = project_to_image(whole.positions, view);
  const GridBox box = box_of_faces_in(whole, image, grid_box_around(pixels, margin));
  const std::vector<std::uint8_t> sides = sides_of(image, box);
  std::vector<std::uint8_t> is_inner(whole.positions.size(), 0);
  for (const Triangle& face : whole.triangles) {
    if (!meets_box(face, sides)) continue;
    for (const std::uint32_t v : face)
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

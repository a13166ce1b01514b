#include "core/session/erase_region.h"

#include <array>
#include <cstdint>
#include <utility>
#include <vector>

#include "core/mask/mask.h"
#include "core/mesh/drawable.h"
#include "core/view/view.h"

namespace rangezip {

namespace {

using FaceFlags = std::vector<std::uint8_t>;  // 1: erased

Mask lasso_mask(const EraseRegion& command) {
  return command.region.empty() ? full_mask(command.extent)
                                : mask_from_lasso(command.extent, command.region);
}

FaceFlags visible_faces(const TriangleMesh& mesh, const View& view, const Mask& lasso,
                        Rasterizer& rasterizer) {
  FaceFlags erased(mesh.triangles.size(), 0);
  const DrawableMesh drawable(mesh);
  const DrawItem item = drawable.item();
  const Framebuffer drawn = rasterizer.render(view, {&item, 1});
  for (std::size_t i = 0; i < lasso.pixels().size(); ++i) {
    const PrimitiveId face = drawn.id.pixels()[i];
    if (lasso.pixels()[i] != 0 && face != kNoPrimitive) erased[face] = 1;
  }
  return erased;
}

/// Whether the view sees the place of `point`, whatever may stand in front of it.
bool is_in_lasso(const Vec3& point, const View& view, const Mask& lasso) {
  if (view.is_perspective() && view.depth_of(point) <= 0.0) return false;
  for (const Plane& plane : view.camera().clip_planes) {
    if (plane.value(point) < 0.0) return false;
  }
  const Vec3 window = view.window_from_world(point);
  const Extent extent = lasso.extent();
  if (!(window.x >= 0.0 && window.x < extent.width && window.y >= 0.0 &&
        window.y < extent.height)) {
    return false;
  }
  return lasso[{static_cast<int>(window.x), static_cast<int>(window.y)}] != 0;
}

FaceFlags all_faces_inside(const TriangleMesh& mesh, const View& view, const Mask& lasso) {
  FaceFlags erased(mesh.triangles.size(), 0);
  for (std::size_t face = 0; face < mesh.triangles.size(); ++face) {
    const auto& [a, b, c] = mesh.triangles[face];
    const Vec3 centroid = (mesh.positions[a] + mesh.positions[b] + mesh.positions[c]) / 3.0;
    erased[face] = is_in_lasso(centroid, view, lasso) ? 1 : 0;
  }
  return erased;
}

/// The faces around every vertex, in one array.
struct VertexFaces {
  std::vector<std::size_t> first;  // one per vertex, and the end
  std::vector<std::uint32_t> faces;
};

VertexFaces vertex_faces_of(const TriangleMesh& mesh) {
  VertexFaces result;
  result.first.assign(mesh.positions.size() + 1, 0);
  for (const Triangle& triangle : mesh.triangles) {
    for (const std::uint32_t vertex : triangle)
      ++result.first[vertex + 1];
  }
  for (std::size_t i = 1; i < result.first.size(); ++i)
    result.first[i] += result.first[i - 1];
  result.faces.resize(result.first.back());
  std::vector<std::size_t> next(result.first.begin(), result.first.end() - 1);
  for (std::uint32_t face = 0; face < mesh.triangles.size(); ++face) {
    for (const std::uint32_t vertex : mesh.triangles[face])
      result.faces[next[vertex]++] = face;
  }
  return result;
}

/// Whether two faces around `vertex` share a second corner, and so an edge there.
bool share_edge_at(std::uint32_t vertex, const Triangle& a, const Triangle& b) {
  for (const std::uint32_t corner : a) {
    if (corner == vertex) continue;
    for (const std::uint32_t other : b) {
      if (corner == other) return true;
    }
  }
  return false;
}

/// The faces not erased around a vertex, grouped into fans over shared edges. The fans begin with
/// the lowest face.
std::vector<std::vector<std::uint32_t>> fans_at(const TriangleMesh& mesh,
                                                const VertexFaces& vertex_faces,
                                                const FaceFlags& erased, std::uint32_t vertex) {
  std::vector<std::uint32_t> left;
  for (std::size_t i = vertex_faces.first[vertex]; i < vertex_faces.first[vertex + 1]; ++i) {
    if (erased[vertex_faces.faces[i]] == 0) left.push_back(vertex_faces.faces[i]);
  }
  std::vector<std::vector<std::uint32_t>> fans;
  while (!left.empty()) {
    std::vector<std::uint32_t> fan{left.front()};
    left.erase(left.begin());
    for (std::size_t i = 0; i < fan.size(); ++i) {
      for (std::size_t j = 0; j < left.size();) {
        if (share_edge_at(vertex, mesh.triangles[fan[i]], mesh.triangles[left[j]])) {
          fan.push_back(left[j]);
          left.erase(left.begin() + static_cast<std::ptrdiff_t>(j));
        } else {
          ++j;
        }
      }
    }
    fans.push_back(std::move(fan));
  }
  return fans;
}

/// Erases all but the largest fan at every vertex; of equal ones the one with the lowest face
/// stays.
void keep_largest_fans(const TriangleMesh& mesh, FaceFlags& erased) {
  const VertexFaces vertex_faces = vertex_faces_of(mesh);
  // Only an erased face can part the fan of a vertex, so its corners are all that need a look.
  std::vector<std::uint32_t> to_check;
  const auto check_corners_of = [&](std::size_t face) {
    to_check.insert(to_check.end(), mesh.triangles[face].begin(), mesh.triangles[face].end());
  };
  for (std::size_t face = 0; face < erased.size(); ++face) {
    if (erased[face] != 0) check_corners_of(face);
  }
  while (!to_check.empty()) {
    const std::uint32_t vertex = to_check.back();
    to_check.pop_back();
    const auto fans = fans_at(mesh, vertex_faces, erased, vertex);
    std::size_t largest = 0;
    for (std::size_t i = 1; i < fans.size(); ++i) {
      if (fans[i].size() > fans[largest].size()) largest = i;
    }
    for (std::size_t i = 0; i < fans.size(); ++i) {
      if (i == largest) continue;
      for (const std::uint32_t face : fans[i]) {
        erased[face] = 1;
        check_corners_of(face);
      }
    }
  }
}

std::size_t remove_faces(TriangleMesh& mesh, const FaceFlags& erased) {
  std::size_t kept = 0;
  for (std::size_t face = 0; face < mesh.triangles.size(); ++face) {
    if (erased[face] == 0) mesh.triangles[kept++] = mesh.triangles[face];
  }
  const std::size_t removed = mesh.triangles.size() - kept;
  mesh.triangles.resize(kept);
  remove_unused_vertices(mesh);
  return removed;
}

}  // namespace

EraseResult erase_region(TriangleMesh mesh, Rasterizer& rasterizer, const EraseRegion& command) {
  const Mask lasso = lasso_mask(command);
  if (mesh.empty()) return {.mesh = std::move(mesh)};
  const View view(fit_depth_planes(command.camera, bounds_of(mesh)), command.extent);
  FaceFlags erased = command.visible_only ? visible_faces(mesh, view, lasso, rasterizer)
                                          : all_faces_inside(mesh, view, lasso);
  keep_largest_fans(mesh, erased);
  const std::size_t removed = remove_faces(mesh, erased);
  return {.mesh = std::move(mesh), .erased_faces = removed};
}

}  // namespace rangezip

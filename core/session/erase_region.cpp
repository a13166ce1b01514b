#include "core/session/erase_region.h"

#include <cstdint>
#include <utility>
#include <vector>

#include "core/finish/clean_topology.h"
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

void remove_faces(TriangleMesh& mesh, const FaceFlags& erased) {
  std::size_t kept = 0;
  for (std::size_t face = 0; face < mesh.triangles.size(); ++face) {
    if (erased[face] == 0) mesh.triangles[kept++] = mesh.triangles[face];
  }
  mesh.triangles.resize(kept);
}

}  // namespace

EraseResult erase_region(TriangleMesh mesh, Rasterizer& rasterizer, const EraseRegion& command) {
  const Mask lasso = lasso_mask(command);
  if (mesh.empty()) return {.mesh = std::move(mesh)};
  const View view(fit_depth_planes(command.camera, bounds_of(mesh)), command.extent);
  const FaceFlags erased = command.visible_only ? visible_faces(mesh, view, lasso, rasterizer)
                                                : all_faces_inside(mesh, view, lasso);
  const std::size_t faces_before = mesh.triangles.size();
  remove_faces(mesh, erased);
  clean_topology(mesh);
  remove_unused_vertices(mesh);
  const std::size_t erased_faces = faces_before - mesh.triangles.size();
  return {.mesh = std::move(mesh), .erased_faces = erased_faces};
}

}  // namespace rangezip

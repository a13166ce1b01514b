#include "core/session/erase_region.h"

#include <cstdint>
#include <optional>
#include <utility>
#include <vector>

#include "core/base/sphere_set.h"
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

/// The pixel of the lasso that a point projects into, whatever may stand in front of it.
std::optional<Pixel> lasso_pixel(const Vec3& point, const View& view, const Mask& lasso) {
  if (view.is_perspective() && view.depth_of(point) <= 0.0) return std::nullopt;
  for (const Plane& plane : view.camera().clip_planes) {
    if (plane.value(point) < 0.0) return std::nullopt;
  }
  const Vec3 window = view.window_from_world(point);
  const Extent extent = lasso.extent();
  const bool is_in_image =
      window.x >= 0.0 && window.x < extent.width && window.y >= 0.0 && window.y < extent.height;
  if (!is_in_image) return std::nullopt;
  const Pixel pixel{static_cast<int>(window.x), static_cast<int>(window.y)};
  if (lasso[pixel] == 0) return std::nullopt;
  return pixel;
}

bool faces_viewer(const TriangleMesh& mesh, std::size_t face, const View& view) {
  const auto& [a, b, c] = mesh.triangles[face];
  const Vec3 area = area_vector(mesh.positions[a], mesh.positions[b], mesh.positions[c]);
  return glm::dot(area, view.toward_viewer(mesh.positions[a])) > 0.0;
}

/// Whether a face that holds no pixel centre belongs to the sheet that its pixel shows: it lies
/// within a few pixel sides of it in depth and is turned to the same side.
bool is_on_visible_sheet(const TriangleMesh& mesh, std::size_t face, Pixel pixel, const View& view,
                         const Framebuffer& drawn) {
  constexpr double kReach = 4.0;  // pixel sides: the steepest slope over one pixel
  constexpr double kDepthUnit = 1.0 / (1U << static_cast<unsigned>(kDepthBits));
  const PrimitiveId seen = drawn.id[pixel];
  if (seen == kNoPrimitive) return true;  // nothing is in front of it
  const double depth = view.depth_from_window_z(drawn.depth[pixel] * kDepthUnit);
  const double behind = view.depth_of(centroid_of(mesh.positions, mesh.triangles[face])) - depth;
  return behind <= kReach * view.pixel_size(depth) &&
         faces_viewer(mesh, face, view) == faces_viewer(mesh, seen, view);
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
  for (std::size_t face = 0; face < erased.size(); ++face) {
    if (erased[face] != 0) continue;
    const auto pixel = lasso_pixel(centroid_of(mesh.positions, mesh.triangles[face]), view, lasso);
    if (pixel && is_on_visible_sheet(mesh, face, *pixel, view, drawn)) erased[face] = 1;
  }
  return erased;
}

FaceFlags all_faces_inside(const TriangleMesh& mesh, const View& view, const Mask& lasso) {
  FaceFlags erased(mesh.triangles.size(), 0);
  for (std::size_t face = 0; face < erased.size(); ++face) {
    if (lasso_pixel(centroid_of(mesh.positions, mesh.triangles[face]), view, lasso))
      erased[face] = 1;
  }
  return erased;
}

EraseResult without(TriangleMesh mesh, const FaceFlags& erased) {
  const std::size_t faces_before = mesh.triangles.size();
  remove_triangles(mesh.triangles, erased);
  clean_topology(mesh);
  remove_unused_vertices(mesh);
  const std::size_t erased_faces = faces_before - mesh.triangles.size();
  return {.mesh = std::move(mesh), .erased_faces = erased_faces};
}

}  // namespace

EraseResult erase_region(TriangleMesh mesh, Rasterizer& rasterizer, const EraseRegion& command) {
  const Mask lasso = lasso_mask(command);
  if (mesh.empty()) return {.mesh = std::move(mesh)};
  const View view(fit_depth_planes(command.camera, bounds_of(mesh)), command.extent);
  const FaceFlags erased = command.visible_only ? visible_faces(mesh, view, lasso, rasterizer)
                                                : all_faces_inside(mesh, view, lasso);
  return without(std::move(mesh), erased);
}

EraseResult erase_places(TriangleMesh mesh, std::span<const Sphere> places) {
  const SphereSet set(places);
  FaceFlags erased(mesh.triangles.size(), 0);
  for (std::size_t face = 0; face < erased.size(); ++face)
    erased[face] = set.contains(centroid_of(mesh.positions, mesh.triangles[face])) ? 1 : 0;
  return without(std::move(mesh), erased);
}

}  // namespace rangezip

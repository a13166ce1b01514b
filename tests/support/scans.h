#pragma once

#include <memory>

#include "core/scan/scan.h"
#include "raster_cpu/cpu_rasterizer.h"
#include "tests/support/shapes.h"

/// Scenes and requests for whole scans.
namespace rangezip::scans {

inline Scene scene_of(PointCloud cloud, const Mat4& placement = Mat4{1.0}) {
  Scene scene;
  scene.add(std::make_shared<const PointCloud>(std::move(cloud)), placement);
  return scene;
}

inline Scene scene_of(TriangleSoup soup, const Mat4& placement = Mat4{1.0}) {
  Scene scene;
  scene.add(std::make_shared<const TriangleSoup>(std::move(soup)), placement);
  return scene;
}

/// Frames the scene from a direction and runs no optional pass; the mask is taken as it is.
inline ScanRequest plain_request(const Scene& scene, const Vec3& toward_viewer, double pixel_size) {
  const FramedCamera framed = frame_box(scene.bounds(), toward_viewer, pixel_size);
  ScanRequest request;
  request.camera = framed.camera;
  request.extent = framed.extent;
  request.clean_mask = {.erosions = 0, .dilations = 0};
  request.triangulate = {.max_edge = 2.75, .max_slope_cosine = 0.2588};
  return request;
}

/// The same with the passes for clouds.
inline ScanRequest cloud_request(const Scene& scene, const Vec3& toward_viewer, double pixel_size) {
  ScanRequest request = plain_request(scene, toward_viewer, pixel_size);
  request.see_through = SeeThroughOptions{};
  request.plane_fit = PlaneFitOptions{};
  request.fill_holes = FillHolesOptions{};
  return request;
}

inline Scan run(const Scene& scene, const ScanRequest& request, const TriangleMesh& mesh = {},
                std::span<const std::int8_t> votes = {}) {
  CpuRasterizer rasterizer;
  return scan(rasterizer, scene, mesh, request, votes);
}

}  // namespace rangezip::scans

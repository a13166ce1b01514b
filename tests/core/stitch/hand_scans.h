#pragma once

#include <cmath>
#include <functional>
#include <utility>
#include <vector>

#include "core/mesh/mesh_report.h"
#include "core/stitch/stitch.h"
#include "raster_cpu/cpu_rasterizer.h"
#include "tests/support/images.h"

/// Scans made by hand, of surfaces and masks that are known in closed form. All look down -z on
/// pixels of side 1, so that sample (x, y) lies over the grid of the stitcher at (x, y).
namespace rangezip::test {

using DepthAt = std::function<double(Pixel)>;
using MaskAt = std::function<bool(Pixel)>;

inline constexpr Extent kExtent{64, 64};

/// A scan with the given samples and mask, with its correspondence to `mesh`.
inline Scan hand_scan(const DepthAt& depth, const MaskAt& is_active,
                      const TriangleMesh& mesh = {}) {
  const View view = images::parallel_view(kExtent);
  CpuRasterizer rasterizer;
  Scan scan{.scene_buffer = make_framebuffer(kExtent),
            .image = images::image_of(view, depth),
            .active = Mask(kExtent, 0)};
  for (int y = 0; y < kExtent.height; ++y) {
    for (int x = 0; x < kExtent.width; ++x) {
      scan.scene_buffer.id[{x, y}] = static_cast<PrimitiveId>(kExtent.index({x, y}));
      scan.active[{x, y}] = is_active({x, y}) ? 1 : 0;
    }
  }
  scan.slopes = estimate_slopes(scan.image);
  scan.correspondence = find_correspondence(rasterizer, scan.image, scan.slopes, mesh);
  scan.patch = triangulate(scan.image, scan.active);
  for (const Pixel pixel : scan.patch.pixels)
    scan.patch.mesh.sources.push_back({.primitive = scan.scene_buffer.id[pixel]});
  return scan;
}

/// The same with larger triangles where its patch is flat.
inline Scan decimated(Scan scan, double tolerance = 1e-6) {
  scan.patch = decimate(scan.image, std::move(scan.patch), {.tolerance = tolerance});
  return scan;
}

inline DepthAt plane(double depth) {
  return [depth](Pixel) { return depth; };
}

/// Pixels first..last, both included, in both axes.
inline MaskAt rectangle(Pixel first, Pixel last) {
  return
      [=](Pixel p) { return p.x >= first.x && p.y >= first.y && p.x <= last.x && p.y <= last.y; };
}

/// World position over a place of the grid (see in_pixels) at a depth.
inline Vec3 world(double x, double y, double depth) {
  return {x + 0.5 - 0.5 * kExtent.width, y + 0.5 - 0.5 * kExtent.height, -depth};
}

/// A flat rectangle of squares with the given side from `first`, cut along alternating diagonals.
inline TriangleMesh lattice(const Vec2& first, int columns, int rows, double side, double depth) {
  TriangleMesh mesh;
  const auto index = [&](int i, int j) {
    return static_cast<std::uint32_t>(j * (columns + 1) + i);
  };
  for (int j = 0; j <= rows; ++j) {
    for (int i = 0; i <= columns; ++i) {
      mesh.positions.push_back(world(first.x + i * side, first.y + j * side, depth));
    }
  }
  for (int j = 0; j < rows; ++j) {
    for (int i = 0; i < columns; ++i) {
      const std::uint32_t a = index(i, j), b = index(i + 1, j), c = index(i + 1, j + 1),
                          d = index(i, j + 1);
      if ((i + j) % 2 == 0) {
        mesh.triangles.push_back({a, b, c});
        mesh.triangles.push_back({a, c, d});
      } else {
        mesh.triangles.push_back({a, b, d});
        mesh.triangles.push_back({b, c, d});
      }
    }
  }
  return mesh;
}

inline TriangleMesh merged(TriangleMesh a, const TriangleMesh& b) {
  const auto base = static_cast<std::uint32_t>(a.positions.size());
  a.positions.insert(a.positions.end(), b.positions.begin(), b.positions.end());
  for (const Triangle& t : b.triangles)
    a.triangles.push_back({base + t[0], base + t[1], base + t[2]});
  return a;
}

inline double area_of(const TriangleMesh& mesh) {
  double area = 0.0;
  for (const Triangle& t : mesh.triangles) {
    area += 0.5 * glm::length(area_vector(mesh.positions[t[0]], mesh.positions[t[1]],
                                          mesh.positions[t[2]]));
  }
  return area;
}

/// Area of the shadow on the image plane, with sign: less than area_of() where faces fold over.
inline double projected_area(const TriangleMesh& mesh) {
  double area = 0.0;
  for (const Triangle& t : mesh.triangles) {
    area += 0.5 * area_vector(mesh.positions[t[0]], mesh.positions[t[1]], mesh.positions[t[2]]).z;
  }
  return area;
}

/// Share of the triangles with an angle below 10 degrees.
inline double sliver_share(const TriangleMesh& mesh) {
  constexpr double kCosine10Degrees = 0.984807753012208;
  std::size_t slivers = 0;
  for (const Triangle& t : mesh.triangles) {
    double largest_cosine = -1.0;
    for (std::size_t k = 0; k < 3; ++k) {
      const Vec3& tip = mesh.positions[t[k]];
      const Vec3 u = glm::normalize(mesh.positions[t[(k + 1) % 3]] - tip);
      const Vec3 v = glm::normalize(mesh.positions[t[(k + 2) % 3]] - tip);
      largest_cosine = std::max(largest_cosine, glm::dot(u, v));
    }
    slivers += largest_cosine > kCosine10Degrees ? 1 : 0;
  }
  return mesh.empty() ? 0.0
                      : static_cast<double>(slivers) / static_cast<double>(mesh.triangles.size());
}

}  // namespace rangezip::test

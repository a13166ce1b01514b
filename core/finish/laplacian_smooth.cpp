#include "core/finish/laplacian_smooth.h"

#include <string>

#include "core/base/error.h"
#include "core/base/parallel.h"
#include "core/finish/corner_table.h"
#include "core/mesh/mesh_report.h"

namespace rangezip {

TriangleMesh laplacian_smooth(TriangleMesh mesh, int iterations, double factor,
                              const Progress& progress) {
  if (iterations < 0) {
    throw InvalidArgument("laplacian_smooth: iterations must not be negative, got " +
                          std::to_string(iterations));
  }
  if (!(factor > 0.0 && factor <= 1.0)) {
    throw InvalidArgument("laplacian_smooth: factor must be in (0, 1], got " +
                          std::to_string(factor));
  }
  check_mesh(mesh);
  constexpr std::size_t kVerticesPerBlock = 4096;
  const CornerTable table(mesh.triangles, mesh.positions.size());
  std::vector<Vec3> moved = mesh.positions;
  for (int i = 0; i < iterations; ++i) {
    progress.at("smooth", static_cast<double>(i) / iterations);
    parallel_for(moved.size(), kVerticesPerBlock, [&](std::size_t begin, std::size_t end) {
      for (std::size_t v = begin; v < end; ++v) {
        const auto vertex = static_cast<std::uint32_t>(v);
        if (table.is_boundary(vertex)) continue;
        Vec3 sum{0.0};
        int count = 0;
        table.for_each_neighbor(vertex, [&](std::uint32_t w) {
          sum += mesh.positions[w];
          ++count;
        });
        const Vec3& p = mesh.positions[v];
        moved[v] = p + factor * (sum / static_cast<double>(count) - p);
      }
    });
    mesh.positions.swap(moved);
  }
  return mesh;
}

}  // namespace rangezip

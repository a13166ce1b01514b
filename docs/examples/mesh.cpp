// From raw data to a clean mesh in one call:
//   mesh INPUT... OUTPUT.ply
#include <exception>
#include <filesystem>
#include <iostream>
#include <vector>

#include "core/io/input_file.h"
#include "core/io/mesh_file.h"
#include "core/reconstruct/reconstruct.h"
#include "raster_cpu/cpu_rasterizer.h"

int main(int argc, char** argv) try {
  if (argc < 3) {
    std::cerr << "usage: mesh INPUT... OUTPUT\n";
    return 2;
  }
  const std::vector<std::filesystem::path> inputs(argv + 1, argv + argc - 1);
  const rangezip::SceneInput input = rangezip::read_scene(inputs);

  rangezip::CpuRasterizer rasterizer;
  const rangezip::ReconstructResult result = rangezip::reconstruct(input.scene, rasterizer);

  rangezip::write_mesh(argv[argc - 1], result.mesh);
  const rangezip::ReconstructReport& report = result.report;
  std::cout << report.views.size() << " views, " << report.mesh.faces << " triangles, "
            << report.mesh.boundary_loops << " boundary loops, " << report.mesh.nonmanifold_edges
            << " non-manifold edges, " << report.self_intersections << " self-intersections\n";
  return 0;
} catch (const std::exception& error) {
  std::cerr << "mesh: " << error.what() << '\n';
  return 1;
}

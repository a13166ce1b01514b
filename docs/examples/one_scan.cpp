// One virtual scan of a point cloud, from the front, with the passes of the paper:
//   one_scan INPUT OUTPUT.ply
#include <array>
#include <exception>
#include <filesystem>
#include <iostream>

#include "core/io/input_file.h"
#include "core/io/mesh_file.h"
#include "core/plan/spacing.h"
#include "core/scan/scan.h"
#include "raster_cpu/cpu_rasterizer.h"

int main(int argc, char** argv) try {
  if (argc != 3) {
    std::cerr << "usage: one_scan INPUT OUTPUT\n";
    return 2;
  }
  const std::array<std::filesystem::path, 1> inputs{argv[1]};
  const rangezip::Scene scene = rangezip::read_scene(inputs).scene;

  // The pixels about twice as wide as the points are apart, so that few stay empty.
  const double pixel_size =
      rangezip::pixel_size_from_spacing(rangezip::estimate_spacing(scene.points()));
  const rangezip::FramedCamera front =
      rangezip::frame_box(scene.bounds(), {0.0, 0.0, 1.0}, pixel_size);

  rangezip::CpuRasterizer rasterizer;
  const rangezip::Scan scan = rangezip::scan(rasterizer, scene, rangezip::TriangleMesh{},
                                             {.camera = front.camera,
                                              .extent = front.extent,
                                              .back_side = rangezip::BackSideOptions{},
                                              .fill_holes = rangezip::FillHolesOptions{},
                                              .median = rangezip::MedianFilterOptions{},
                                              .steep_cells = rangezip::SteepCellsOptions{}});

  rangezip::write_mesh(argv[2], scan.patch.mesh);
  std::cout << scan.report.samples << " samples, " << scan.report.patch_faces << " triangles\n";
  return 0;
} catch (const std::exception& error) {
  std::cerr << "one_scan: " << error.what() << '\n';
  return 1;
}

// Writes the images, the bodies and the cloud that the tests of the programs read, into the current
// folder.
#include <fstream>
#include <limits>

#include "core/image/range_image.h"
#include "core/io/image_file.h"
#include "core/io/mesh_file.h"
#include "tests/support/shapes.h"

using namespace rangezip;

namespace {

/// A torus cut into slices 0.0625 apart, with points 0.0156 apart along each.
void write_contours() {
  std::ofstream file("contours.xyz");
  file.precision(std::numeric_limits<float>::max_digits10);
  for (const Vec3& p : shapes::to_points(shapes::sliced_torus(1.0, 0.4, 0.0625, 0.015625)))
    file << p.x << ' ' << p.y << ' ' << p.z << '\n';
}

}  // namespace

int main() {
  Grid<double> depths({4, 3}, 2.0);
  depths[{0, 0}] = kNoSample;
  write_pfm("depths.pfm", depths);
  depths[{3, 1}] = 2.5;
  write_pfm("deeper.pfm", depths);
  write_pfm("larger.pfm", Grid<double>({5, 3}, 2.0));

  Grid<PrimitiveId> ids({4, 3}, 0x80000000U);
  write_id_png("ids.png", ids);
  ids[{1, 2}] = 0x80000001U;
  ids[{2, 2}] = kNoPrimitive;
  write_id_png("other_ids.png", ids);

  Mask mask({4, 3}, 1);
  write_mask_png("mask.png", mask);
  mask[{2, 0}] = 0;
  write_mask_png("other_mask.png", mask);

  write_rgb_png("picture.png", Grid<Rgb>({4, 3}));
  write_mesh("torus.ply", shapes::to_mesh(shapes::torus()));
  write_mesh("cube.ply", shapes::to_mesh(shapes::moved(shapes::cube(), shapes::tilt())));
  write_mesh("plate.ply", shapes::to_mesh(shapes::moved(shapes::plate(0.06), shapes::tilt())));
  write_contours();
}

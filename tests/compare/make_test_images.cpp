// Writes the images and the body that the tests of the program read, into the current folder.
#include "core/image/range_image.h"
#include "core/io/image_file.h"
#include "core/io/mesh_file.h"
#include "tests/support/shapes.h"

using namespace rangezip;

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
}

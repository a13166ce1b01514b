#include "benchmarks/speed/raster_cases.h"

#include <memory>

#include "raster_cpu/cpu_rasterizer.h"

namespace rangezip::benchmark {

std::string widest_instructions() {
  return cpu_instructions().front();
}

std::function<void()> rendering(const std::string& instructions, const View& view,
                                const DrawItem& item) {
  const auto rasterizer = std::make_shared<CpuRasterizer>(instructions);
  const auto out = std::make_shared<Framebuffer>();
  return [=] { rasterizer->render(view, {&item, 1}, *out); };
}

Case points_case(const Cloud& cloud, const PointsSetup& setup) {
  return {.name = {{"what", "points"},
                   {"instructions", setup.instructions},
                   {"order", name_of(cloud.order)},
                   {"size", setup.size},
                   {"point_size", setup.point_size},
                   {"projection", setup.is_central ? "perspective" : "parallel"},
                   {"count", cloud.positions.size()},
                   {"bytes", size_of(bytes_of(cloud))}},
          .items = static_cast<double>(cloud.positions.size()),
          .work = rendering(setup.instructions, make_view(setup.size, setup.is_central),
                            draw(cloud, setup.point_size, setup.is_central))};
}

FieldSetup make_field_setup(double pixels, int size) {
  return {.pixels = pixels, .size = size, .field = make_field(pixels, size)};
}

Case triangles_case(const FieldSetup& setup, const std::string& instructions) {
  const View view = make_view(setup.size, false);
  const DrawItem item = draw(setup.field);
  // The triangles do not overlap, so a fragment is a pixel.
  const std::size_t fragments = covered_pixels(CpuRasterizer().render(view, {&item, 1}).id);
  return {.name = {{"what", "triangles"},
                   {"instructions", instructions},
                   {"pixels", setup.pixels},
                   {"size", setup.size},
                   {"count", setup.field.triangles.size()},
                   {"bytes", size_of(bytes_of(setup.field))}},
          .items = static_cast<double>(setup.field.triangles.size()),
          .work = rendering(instructions, view, item),
          .fragments = static_cast<double>(fragments)};
}

Case accumulate_case(const Cloud& cloud, const std::string& instructions) {
  const auto rasterizer = std::make_shared<CpuRasterizer>(instructions);
  const auto window = std::make_shared<AccumulateWindow>(make_open_window(kSize));
  const auto out = std::make_shared<Grid<PixelMoments>>();
  const View view = make_view(kSize, false);
  const DrawItem item = draw(cloud, 1, false);
  return {.name = {{"what", "accumulate"},
                   {"instructions", instructions},
                   {"order", name_of(cloud.order)},
                   {"size", kSize},
                   {"count", cloud.positions.size()},
                   {"bytes", size_of(bytes_of(cloud))}},
          .items = static_cast<double>(cloud.positions.size()),
          .work = [=] {
            rasterizer->accumulate(view, {&item, 1}, *window, *out);
          }};
}

}  // namespace rangezip::benchmark

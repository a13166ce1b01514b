#include "benchmarks/speed/backend_cases.h"

#include <algorithm>
#include <set>
#include <thread>

#include "core/base/error.h"
#include "raster_cpu/cpu_rasterizer.h"

namespace rangezip::benchmark {

namespace {

using Json = nlohmann::ordered_json;

int all_threads() {
  return static_cast<int>(std::max(1U, std::thread::hardware_concurrency()));
}

DrawItem with_content_key(DrawItem item) {
  static std::uint64_t last_key = 0;
  std::visit([key = ++last_key](auto& one) { one.content_key = key; }, item);
  return item;
}

Json joined(Json name, const Json& more) {
  name.update(more);
  return name;
}

std::size_t count_differences(const Framebuffer& a, const Framebuffer& b) {
  std::size_t count = 0;
  for (std::size_t i = 0; i < a.id.pixels().size(); ++i) {
    count += a.id.pixels()[i] != b.id.pixels()[i] || a.depth.pixels()[i] != b.depth.pixels()[i];
  }
  return count;
}

void check_image(const Scene& scene, const GlBackend& backend, GlStrategy strategy,
                 const Framebuffer& image) {
  if (strategy == GlStrategy::native) return;
  const Framebuffer ours = CpuRasterizer().render(scene.view, {&scene.item, 1});
  const std::size_t differences = count_differences(image, ours);
  if (differences == 0) return;
  throw Error(backend.context + " (" + backend.renderer + "), " + name_of(strategy) + ": " +
              std::to_string(differences) + " pixels differ from those of the CPU rasterizer in " +
              scene.name.dump());
}

}  // namespace

Scene make_scene(const Cloud& cloud, int point_size, int size) {
  return {.name = {{"what", "drawing"},
                   {"scene", "points"},
                   {"order", name_of(cloud.order)},
                   {"point_size", point_size},
                   {"size", size},
                   {"count", cloud.positions.size()},
                   {"bytes", size_of(bytes_of(cloud))}},
          .view = make_view(size, false),
          .item = draw(cloud, point_size, false)};
}

Scene make_scene(const Field& field, double pixels, int size) {
  return {.name = {{"what", "drawing"},
                   {"scene", "triangles"},
                   {"pixels", pixels},
                   {"size", size},
                   {"count", field.triangles.size()},
                   {"bytes", size_of(bytes_of(field))}},
          .view = make_view(size, false),
          .item = draw(field)};
}

std::vector<Case> cpu_cases(const Scene& scene) {
  const auto rasterizer = std::make_shared<CpuRasterizer>();
  const auto out = std::make_shared<Framebuffer>();
  std::vector<Case> cases;
  for (const int threads : std::set{1, all_threads()}) {
    cases.push_back({.name = joined(scene.name, {{"by", "cpu"}, {"threads", threads}}),
                     .items = static_cast<double>(primitive_count(scene.item)),
                     .work =
                         [=] {
                           rasterizer->render(scene.view, {&scene.item, 1}, *out);
                         },
                     .threads = threads,
                     .is_by_wall = threads > 1});
  }
  return cases;
}

std::vector<Case> gl_cases(const Scene& scene, const GlBackend& backend, TimedGl& gl) {
  const DrawItem kept = with_content_key(scene.item);
  check_image(scene, backend, gl.strategy(), gl.render(scene.view, kept));
  const auto make_case = [&](const char* content, const DrawItem& item) {
    return Case{.name = joined(scene.name, {{"by", name_of(gl.strategy())},
                                            {"context", backend.context},
                                            {"content", content}}),
                .items = static_cast<double>(primitive_count(item)),
                .work = [&gl, view = scene.view, item] { gl.render(view, item); },
                .threads = backend.is_by_wall ? all_threads() : 1,
                .is_by_wall = backend.is_by_wall,
                .parts = [&gl] { return gl.parts(); }};
  };
  return {make_case("resident", kept), make_case("one-shot", scene.item)};
}

}  // namespace rangezip::benchmark

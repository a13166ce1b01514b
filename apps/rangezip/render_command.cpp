#include <filesystem>
#include <utility>
#include <vector>

#include "apps/rangezip/backend.h"
#include "apps/rangezip/commands.h"
#include "apps/rangezip/exit_code.h"
#include "apps/rangezip/outputs.h"
#include "apps/rangezip/values.h"
#include "core/base/parallel.h"
#include "core/io/image_file.h"
#include "core/io/input_with_mesh.h"
#include "core/render/picture.h"

namespace rangezip::app {

namespace {

struct RenderOptions {
  std::vector<std::filesystem::path> files;
  std::filesystem::path output;
  Vec3 direction{0.3, 0.25, 1.0};
  std::optional<Vec3> up;
  std::optional<Vec3> zoom;  // where in the picture, and how much
  bool only_points = false;
  PictureOptions picture;
  CommonOptions common;
};

void append_mesh(TriangleMesh& onto, TriangleMesh mesh) {
  const auto offset = static_cast<std::uint32_t>(onto.positions.size());
  onto.positions.insert(onto.positions.end(), mesh.positions.begin(), mesh.positions.end());
  for (const auto& [a, b, c] : mesh.triangles) {
    onto.triangles.push_back({a + offset, b + offset, c + offset});
  }
}

void append_cloud(std::vector<Vec3>& onto, const InputItem& item) {
  for (const Vec3f& position : item.cloud->positions) {
    onto.emplace_back(item.world_from_item * Vec4(Vec3(position), 1.0));
  }
}

/// The faces of a list of scans, each with the corners that its file gives it.
void append_soup(TriangleMesh& onto, const InputItem& item) {
  TriangleMesh mesh{.triangles = item.soup->triangles};
  for (const Vec3f& position : item.soup->positions)
    mesh.positions.emplace_back(item.world_from_item * Vec4(Vec3(position), 1.0));
  append_mesh(onto, std::move(mesh));
}

/// Points as the readers of clouds give them; faces with the connectivity that their file has.
PictureContent read_content(const RenderOptions& options, const Progress& progress) {
  PictureContent content;
  for (const std::filesystem::path& path : options.files) {
    InputWithMesh file = read_input_with_mesh(path, progress);
    for (const InputItem& item : file.input.items) {
      if (item.cloud) append_cloud(content.points, item);
      if (item.soup && file.mesh.empty()) append_soup(content.mesh, item);
    }
    append_mesh(content.mesh, std::move(file.mesh));
  }
  if (options.only_points) {
    const auto& vertices = content.mesh.positions;
    content.points.insert(content.points.end(), vertices.begin(), vertices.end());
    content.mesh = {};
  }
  return content;
}

/// Enlarges what is seen around a place of the picture, given as shares of its width and height.
void zoom_in(Camera& camera, const Vec3& zoom, Extent extent) {
  const double factor = zoom.z;
  if (!(factor >= 1.0)) throw UsageError("--zoom: the factor must be at least 1");
  auto& lens = std::get<Orthographic>(camera.lens);
  const double width = lens.height * extent.width / extent.height;
  camera.eye_from_world[3].x -= (zoom.x - 0.5) * width;
  camera.eye_from_world[3].y -= (zoom.y - 0.5) * lens.height;
  lens.height /= factor;
}

void render(const RenderOptions& options, const Context& context) {
  const auto rasterizer = make_rasterizer(options.common.backend);
  Outputs outputs;
  outputs.add("-o", options.output, {"png"});
  Console console(options.common.quiet, context.stop);
  Progress progress = console.start_task("render", 0.0, "");
  progress.report = nullptr;  // over before a bar could be read

  const PictureContent content = read_content(options, progress);
  Camera camera = frame_picture(content, options.direction, options.picture.extent, options.up);
  if (options.zoom) zoom_in(camera, *options.zoom, options.picture.extent);
  const Picture picture = draw_picture(*rasterizer, content, camera, options.picture);
  progress.check_stop();
  write_output([&] { write_rgb_png(options.output, picture); });
}

}  // namespace

void add_render_command(CLI::App& app, Action& action) {
  auto options = std::make_shared<RenderOptions>();
  CLI::App& command =
      *app.add_subcommand("render", "Draws meshes and point clouds into a shaded picture (PNG)");
  command.add_option("FILE", options->files, "Meshes and clouds, of any type that 'mesh' reads")
      ->required();
  command.add_option("-o,--output", options->output, "The picture to write")
      ->required()
      ->type_name("F.png");
  add_parsed(command, "--direction", options->direction, parse_vector,
             "From the object toward the viewer [0.3,0.25,1]", "X,Y,Z");
  add_parsed(command, "--up", options->up, parse_vector,
             "What points upwards in the picture [y, or x if looking along y]", "X,Y,Z");
  add_parsed(command, "--size", options->picture.extent, parse_extent, "In pixels [1200,900]",
             "W,H");
  add_parsed(command, "--zoom", options->zoom, parse_vector,
             "Show the surroundings of a place of the picture, F times larger: its shares of width "
             "and height, from the lower left (0.5,0.5,1: all)",
             "U,V,F");
  command.add_flag("--edges", options->picture.edges, "Draw the edges of all faces");
  command.add_flag("--boundary", options->picture.boundary,
                   "Mark edges that belong to one face only, in red");
  command.add_flag("--flat", options->picture.flat,
                   "Shade every face with its own normal instead of smoothly");
  command.add_flag("--points", options->only_points, "Draw vertices instead of faces");
  command
      .add_option("--point-size", options->picture.point_size, "Size of a drawn point, in pixels")
      ->check(CLI::Range(1, 60))
      ->capture_default_str();
  add_common_options(command, options->common);
  command.footer(
      "Faces seen from behind are orange. The camera looks from --direction at the middle "
      "of all files and shows them whole.");
  command.callback([options, &action] {
    action = [options](const Context& context) {
      run_with_threads(options->common.threads, [&] { render(*options, context); });
    };
  });
}

}  // namespace rangezip::app

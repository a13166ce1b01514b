#include <algorithm>
#include <filesystem>
#include <optional>
#include <utility>
#include <vector>

#include <fmt/format.h>

#include "apps/rangezip/backend.h"
#include "apps/rangezip/commands.h"
#include "apps/rangezip/exit_code.h"
#include "apps/rangezip/inputs.h"
#include "apps/rangezip/outputs.h"
#include "apps/rangezip/scan_request.h"
#include "apps/rangezip/verify.h"
#include "core/base/parallel.h"
#include "core/io/image_file.h"
#include "core/io/mesh_file.h"
#include "core/session/session.h"

namespace rangezip::app {

namespace {

using OptionalPath = std::optional<std::filesystem::path>;

struct ScanOptions {
  std::vector<std::filesystem::path> inputs;
  OptionalPath into;
  OptionalPath output;
  OptionalPath range_image;
  OptionalPath depth;
  OptionalPath mask;
  OptionalPath ids;
  OptionalPath session;
  ScanChoices choices;
  MeshFileOptions file;
  CommonOptions common;
};

Outputs outputs_of(const ScanOptions& options) {
  Outputs outputs;
  if (options.output) outputs.add("-o", *options.output, {"ply", "obj", "off", "stl"});
  if (options.range_image) outputs.add("--range-image", *options.range_image, {"pfm"});
  if (options.depth) outputs.add("--depth", *options.depth, {"pfm"});
  if (options.mask) outputs.add("--mask", *options.mask, {"png"});
  if (options.ids) outputs.add("--ids", *options.ids, {"png"});
  if (outputs.empty()) {
    throw UsageError("scan: needs at least one of -o, --range-image, --depth, --mask, --ids");
  }
  if (options.session) {
    outputs.add("--session", *options.session, {"json"});
    std::vector<std::filesystem::path> needed = options.inputs;
    if (options.into) needed.push_back(*options.into);
    require_rereadable(needed, options.session);
    outputs.refuse_overwriting(needed);
  }
  return outputs;
}

/// The depth buffer as drawn: window z in [0, 1), kNoSample where nothing is.
Grid<double> window_depths(const Framebuffer& drawn) {
  Grid<double> depths(drawn.depth.extent(), kNoSample);
  constexpr double kUnit = 1.0 / (1U << static_cast<unsigned>(kDepthBits));
  for (std::size_t i = 0; i < depths.pixels().size(); ++i) {
    const std::uint32_t depth = drawn.depth.pixels()[i];
    if (depth != kNoDepth) depths.pixels()[i] = depth * kUnit;
  }
  return depths;
}

/// As the files count their points and triangles.
Grid<PrimitiveId> numbers_of(const Scene& scene, const Grid<PrimitiveId>& drawn) {
  Grid<PrimitiveId> numbers(drawn.extent());
  std::transform(drawn.pixels().begin(), drawn.pixels().end(), numbers.pixels().begin(),
                 [&](PrimitiveId id) { return scene.number_of(id); });
  return numbers;
}

void write_images(const ScanOptions& options, const Scene& scene, const Scan& scan) {
  if (options.range_image) write_pfm(*options.range_image, scan.image.depth());
  if (options.depth) write_pfm(*options.depth, window_depths(scan.scene_buffer));
  if (options.mask) write_mask_png(*options.mask, scan.active);
  if (options.ids) write_id_png(*options.ids, numbers_of(scene, scan.scene_buffer.id));
}

void print_summary(Console& console, const Scene& scene, const AddScan& command,
                   const CommandReport& report, const TriangleMesh& mesh) {
  const Extent extent = command.scan.extent;
  console.print(fmt::format("input     {}", amount_text(scene)));
  console.print(fmt::format("image     {} x {} pixels, {} with a sample, {} taken", extent.width,
                            extent.height, with_commas(report.scan.samples),
                            with_commas(report.scan.active)));
  console.print(fmt::format("stitch    {} faces added, {} replaced",
                            with_commas(report.stitch.patch_faces + report.stitch.strip_faces),
                            with_commas(report.stitch.removed_faces)));
  console.print(fmt::format("mesh      {}", topology_text(report_mesh(mesh))));
}

void scan(const ScanOptions& options, const Context& context) {
  const auto rasterizer = make_rasterizer(options.common.backend);
  const Outputs outputs = outputs_of(options);
  Console console(options.common.quiet, context.stop);
  const SceneInput input = read_inputs(options.inputs, console);
  if (options.session) {
    require_rereadable(files_of(input), options.session);
    outputs.refuse_overwriting(files_of(input));
  }
  TriangleMesh initial;
  if (options.into) initial = read_given_mesh(*options.into, Progress{.stop = context.stop});

  const auto [amount, unit] = workload_of(input.scene);
  const Progress progress = console.start_task("scanning", amount, unit);
  AddScan command = make_scan(input.scene, options.choices);
  if (options.choices.align) {
    command = aligned(std::move(command), input.scene, *rasterizer, progress);
    progress.check_stop();
  }
  Session session(input.scene, std::move(initial), SessionOptions{.history_bytes = 0});
  const CommandReport report = session.apply(command, *rasterizer, progress);
  console.end_task();
  progress.check_stop();

  std::optional<SessionFile> file;
  if (options.session)
    file = record_session(options.inputs, input, options.into, {command}, progress);
  write_output([&] { write_images(options, input.scene, *session.last_scan()); });
  if (options.output) {
    require_faces(*session.mesh(), *options.output, "nothing of the input is seen and taken");
    write_output([&] { write_mesh(*options.output, *session.mesh(), options.file, progress); });
  }
  if (file) write_output([&] { write_session(*options.session, *file); });
  print_summary(console, input.scene, command, report, *session.mesh());
}

void add_output_options(CLI::App& command, ScanOptions& options) {
  const auto add = [&](const char* name, OptionalPath& target, const char* text, const char* form) {
    command.add_option(name, target, text)->type_name(form)->group("Output");
  };
  add("-o,--output", options.output, "The mesh: the patch, stitched into --into if that is given",
      "OUT.{ply,obj,off,stl}");
  add("--range-image", options.range_image, "Distance along the line of sight, after all passes",
      "F.pfm");
  add("--depth", options.depth, "The depth buffer as drawn, 0 at the front plane, 1 at the back",
      "F.pfm");
  add("--mask", options.mask, "The pixels that were taken, white", "F.png");
  add("--ids", options.ids, "Number of the nearest point or triangle, 32 bits as RGBA", "F.png");
  add("--session", options.session, "Record the run, for 'rangezip play'", "S.json");
}

}  // namespace

void add_scan_command(CLI::App& app, Action& action) {
  auto options = std::make_shared<ScanOptions>();
  CLI::App& command = *app.add_subcommand(
      "scan", "Makes one virtual scan of clouds and polygons and stitches it into a mesh");
  command.add_option("INPUT", options->inputs, "What 'mesh' reads: clouds and polygons")
      ->required();
  command
      .add_option("--into", options->into,
                  "The mesh to stitch into, such as the CAD model of what was scanned")
      ->type_name("MESH");
  add_output_options(command, *options);
  add_scan_choices(command, options->choices);
  add_mesh_file_options(command, options->file);
  add_common_options(command, options->common);
  command.footer(
      "Each pass that is a flag has its opposite: --median, --no-median.\n"
      "The camera looks from --direction at the middle of the input. Lengths are in the units of "
      "the input.\nImages: bottom row first in PFM, top row first in PNG; infinity in a PFM is a "
      "pixel that saw nothing.");
  command.callback([options, &action] {
    action = [options](const Context& context) {
      run_with_threads(options->common.threads, [&] { scan(*options, context); });
    };
  });
}

}  // namespace rangezip::app

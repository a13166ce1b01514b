#include <filesystem>
#include <map>
#include <optional>
#include <span>
#include <string>
#include <utility>
#include <vector>

#include <fmt/format.h>

#include "apps/rangezip/backend.h"
#include "apps/rangezip/commands.h"
#include "apps/rangezip/exit_code.h"
#include "apps/rangezip/handle_changes.h"
#include "apps/rangezip/inputs.h"
#include "apps/rangezip/outputs.h"
#include "apps/rangezip/referee.h"
#include "apps/rangezip/report_json.h"
#include "apps/rangezip/values.h"
#include "apps/rangezip/verify.h"
#include "core/base/parallel.h"
#include "core/io/mesh_file.h"
#include "core/io/session_file.h"
#include "core/reconstruct/reconstruct.h"
#include "core/reconstruct/stage_clock.h"

namespace rangezip::app {

namespace {

struct MeshOptions {
  std::vector<std::filesystem::path> inputs;
  std::filesystem::path output;
  std::optional<std::filesystem::path> report;
  std::optional<std::filesystem::path> session;
  bool verify = false;
  ReconstructOptions reconstruct;
  MeshFileOptions file;
  CommonOptions common;
};

const std::map<std::string, ReconstructMethod> kMethods{{"auto", ReconstructMethod::automatic},
                                                        {"paper", ReconstructMethod::paper}};
const std::map<std::string, std::optional<FinishMethod>> kFinishes{
    {"none", std::nullopt}, {"fast", FinishMethod::fast}, {"full", FinishMethod::full}};

std::optional<int> parse_views(const std::string& text) {
  if (text == "auto") return std::nullopt;
  const double number = parse_number(text);
  constexpr double kMostViews = 1000.0;
  if (!(number >= 1.0 && number <= kMostViews) || number != static_cast<int>(number)) {
    throw CLI::ValidationError("must be 'auto' or a whole number in [1, 1000], got '" + text + "'");
  }
  return static_cast<int>(number);
}

Outputs outputs_of(const MeshOptions& options) {
  Outputs outputs;
  outputs.add("-o", options.output, {"ply", "obj", "off", "stl"});
  if (options.report) outputs.add("--report", *options.report, {"json"});
  if (options.session) outputs.add("--session", *options.session, {"json"});
  return outputs;
}

std::string places_text(std::span<const Place> places, double area) {
  const Place& largest = places.front();
  return fmt::format("{} {}, area {:.4g}; largest at ({:.4g}, {:.4g}, {:.4g}), radius {:.4g}",
                     places.size(), places.size() == 1 ? "place" : "places", area, largest.center.x,
                     largest.center.y, largest.center.z, largest.radius);
}

void print_coverage(Console& console, const CoverageReport& coverage) {
  console.print(
      fmt::format("coverage  {:.2f} % of the input within a pixel size", 100.0 * coverage.share));
  if (!coverage.uncovered.empty()) {
    console.print(
        fmt::format("missing   {}", places_text(coverage.uncovered, coverage.uncovered_area)));
  }
  if (!coverage.unsupported.empty()) {
    console.print(
        fmt::format("no data   {}", places_text(coverage.unsupported, coverage.unsupported_area)));
  }
  if (!coverage.papered.empty()) {
    console.print(
        fmt::format("papered   {}", places_text(coverage.papered, coverage.papered_area)));
  }
}

void print_summary(Console& console, const MeshOptions& options, const Scene& scene,
                   const MeshRunReport& run, const StageTime& total) {
  const ReconstructReport& report = run.reconstruction;
  console.print(fmt::format("input     {}", amount_text(scene)));
  const std::string skipped = skipped_text(run.inputs);
  if (!skipped.empty()) console.print(fmt::format("skipped   {}", skipped));
  console.print(fmt::format("scans     {} views, {} into holes, pixel size {:.4g}",
                            report.views.size(), report.views.size() - report.planned_views,
                            report.pixel_size));
  console.print(fmt::format("mesh      {}", topology_text(report.mesh)));
  if (report.turned_components > 0)
    console.print(
        fmt::format("turned    {} of them toward the scanners", report.turned_components));
  const std::string handles = handles_text(report);
  if (!handles.empty()) console.print(fmt::format("handles   {}", handles));
  print_coverage(console, report.coverage);
  console.print(fmt::format("written   {} ({:.1f} s, {:.1f} s of processor time)",
                            options.output.string(), total.seconds, total.cpu_seconds));
}

/// What a run without finish leaves crossing is no fault of it: it is counted, not judged.
void verify(const MeshOptions& options, const ReconstructReport& report) {
  const bool may_cross = !options.reconstruct.finish.has_value();
  const std::string faults = faults_text(report.mesh, may_cross ? 0 : report.self_intersections);
  if (faults.empty()) return;
  throw NotVerified(options.output.string() + ": the mesh is written, but is not clean: " + faults);
}

/// Refuses `files` that the run could not be recorded with, for --session and for the referee.
void check_replay(const MeshOptions& options, const Outputs& outputs,
                  const std::vector<std::filesystem::path>& files) {
  if (!options.session && !options.verify) return;
  require_rereadable(files, options.session);
  if (options.verify) require_rereadable(files, session_for_referee(options.output));
  outputs.refuse_overwriting(files);
}

void mesh(const MeshOptions& options, const Context& context) {
  const auto rasterizer = make_rasterizer(options.common.backend);
  const Outputs outputs = outputs_of(options);
  check_replay(options, outputs, options.inputs);
  const auto referee = options.verify ? std::optional(find_referee()) : std::nullopt;
  Console console(options.common.quiet, context.stop);
  const StageClock total;

  MeshRunReport run{.rasterizer = rasterizer->info()};
  SceneInput input = read_inputs(options.inputs, console);
  check_replay(options, outputs, files_of(input));
  run.stages.push_back(total.stage("read"));

  const auto [amount, unit] = workload_of(input.scene);
  const Progress progress = console.start_task("meshing", amount, unit);
  ReconstructResult result = reconstruct(input.scene, *rasterizer, options.reconstruct, progress);
  console.end_task();
  run.stages.insert(run.stages.end(), result.report.stages.begin(), result.report.stages.end());
  progress.check_stop();

  require_faces(result.mesh, options.output,
                "the scans were too small: use a smaller --pixel-size or more --triangles");
  std::optional<SessionFile> session;
  if (options.session || options.verify) {
    session =
        record_session(options.inputs, input, std::nullopt, std::move(result.commands), progress);
  }
  const StageClock write_clock;
  write_output([&] { write_mesh(options.output, result.mesh, options.file, progress); });
  run.stages.push_back(write_clock.stage("write"));
  if (options.session) write_output([&] { write_session(*options.session, *session); });
  run.inputs = std::move(input.reports);
  run.reconstruction = std::move(result.report);
  if (options.report) write_output([&] { write_report(*options.report, run); });
  print_summary(console, options, input.scene, run, total.stage("total"));
  if (referee) {
    let_referee_judge(*referee, *session, options.output, options.common.backend,
                      options.common.quiet, context.stop);
  }
  verify(options, run.reconstruction);
}

void add_resolution_options(CLI::App& command, MeshOptions& options) {
  CLI::Option* pixel_size =
      add_parsed(command, "--pixel-size", options.reconstruct.pixel_size, parse_positive,
                 "Side of a pixel of the virtual scans, in the units of the input [from the "
                 "spacing of the points]",
                 "H");
  add_parsed(
      command, "--triangles", options.reconstruct.triangles, parse_count,
      "How many triangles to make, within 5 %, instead of a pixel size; without the full finish "
      "by trying a few sizes of pixels",
      "N")
      ->excludes(pixel_size);
}

}  // namespace

void add_mesh_command(CLI::App& app, Action& action) {
  auto options = std::make_shared<MeshOptions>();
  CLI::App& command =
      *app.add_subcommand("mesh", "Turns clouds and polygons into one clean triangle mesh");
  command
      .add_option("INPUT", options->inputs,
                  "PLY, XYZ/PTS/ASC/CSV/TXT, OBJ, OFF, STL, each also as .gz; .conf lists of "
                  "Stanford range scans; points and polygons may be mixed")
      ->required();
  command.add_option("-o,--output", options->output, "The mesh to write, of the type of its name")
      ->required()
      ->type_name("OUT.{ply,obj,off,stl}");
  add_parsed(command, "--method", options->reconstruct.method, one_of(kMethods),
             "auto, or paper: the passes of Kobbelt and Botsch 2000 as written [auto]", "METHOD");
  add_resolution_options(command, *options);
  add_parsed(command, "--decimate", options->reconstruct.decimate, parse_positive,
             "Let triangles grow where they stay within this of the surface, in pixel sizes: fewer "
             "where it is flat, such as 0.05 [all of about one size]",
             "TOLERANCE");
  add_parsed(
      command, "--close-holes", options->reconstruct.close_holes, parse_positive,
      "Close holes up to this perimeter, in pixel sizes, even where no points show a surface: "
      "such as 60 [those that points show, and gaps of the sampling]",
      "PERIMETER");
  add_parsed(command, "--views", options->reconstruct.views, parse_views,
             "How many views to plan at most, or auto: until the input is covered [auto]",
             "N|auto");
  add_parsed(command, "--finish", options->reconstruct.finish, one_of(kFinishes),
             "none; fast: close holes and remove self-intersections; full: also improve the "
             "triangles and restore sharp edges [full]",
             "FINISH");
  add_repeated(
      command, "--scanner", options->reconstruct.scanners, parse_position,
      "Where a scanner stood, in the units of the input: what shows it its back is turned, "
      "as a room scanned from within; may be given several times [all faces the outside]",
      "X,Y,Z");
  add_mesh_file_options(command, options->file);
  command.add_option("--report", options->report, "Write what was done and measured")
      ->type_name("R.json");
  command.add_option("--session", options->session, "Record the run, for 'rangezip play'")
      ->type_name("S.json");
  command.add_flag("--verify", options->verify,
                   "Let rangezip-compare, if installed, judge every stitch with CGAL");
  add_common_options(command, options->common);
  command.footer(
      "The same input gives the same bytes on every machine and for any number of threads.\n"
      "The mesh is checked: exit code 5 says that it is written but not manifold, or crosses "
      "itself; with --verify also that a stitch is not good.");
  command.callback([options, &action] {
    options->reconstruct.threads = options->common.threads;
    action = [options](const Context& context) {
      run_with_threads(options->common.threads, [&] { mesh(*options, context); });
    };
  });
}

}  // namespace rangezip::app

// rangezip-compare: the referee on the command line. Exit codes: see kFooter.
#include <CLI/CLI.hpp>
#include <algorithm>
#include <array>
#include <exception>
#include <filesystem>
#include <functional>
#include <iostream>
#include <new>
#include <stdexcept>
#include <string>
#include <vector>

#include "apps/rangezip-compare/draw_command.h"
#include "apps/rangezip-compare/images_command.h"
#include "apps/rangezip-compare/mesh_command.h"
#include "apps/rangezip-compare/sample_command.h"
#include "apps/rangezip-compare/stages_command.h"
#include "apps/rangezip-compare/stitch_command.h"
#include "apps/rangezip/backend.h"
#include "apps/rangezip/exit_code.h"
#include "apps/rangezip/interrupt.h"
#include "apps/rangezip/values.h"
#include "core/base/error.h"
#include "core/base/progress.h"

namespace {

using namespace rangezip;
using namespace rangezip::compare;

/// As with cmp and diff, 1 is a verdict and all above is trouble. Trouble has the numbers that it
/// has with `rangezip`, but for wrong usage, which is 1 there.
enum ExitCode {
  good = 0,
  different = 1,
  bad_input = 2,
  bad_output = 3,
  bad_backend = 4,
  usage = 5,
  failure = 6,
  cancelled = 130
};

constexpr const char* kFooter =
    "Without the name of a command, 'draw' is meant.\n\n"
    "Exit codes:\n"
    "  0  nothing differs that must not; the mesh is clean; the stitches are good\n"
    "  1  images, stages or drawings differ that must not; the mesh is not clean; a stitch is not\n"
    "     good\n"
    "  2  an input is missing or not what it claims to be\n"
    "  3  an output cannot be written\n"
    "  4  a backend is unknown or failed\n"
    "  5  wrong option or argument\n"
    "  6  anything else, such as memory that ran out\n"
    "  130  interrupted (Ctrl-C); no file is left half written\n\n"
    "This program contains code of CGAL and is under the GNU General Public License, version 3 or\n"
    "later; rangezip's own code in it is BSD-3-Clause.";

constexpr int kMostViews = 10'000;
constexpr int kMostEdge = 256;  // a pixel

int fail(ExitCode code, const char* text) {
  std::cerr << "rangezip-compare: " << text << '\n';
  return code;
}

/// A usage error is one exit code here, whatever CLI11 calls it; asking for help is none.
int report_parse_error(const CLI::App& app, const CLI::ParseError& error) {
  return app.exit(error) == 0 ? good : usage;
}

/// Each add_* describes one subcommand; the values land in the command it fills.
CLI::App* add_mesh(CLI::App& app, MeshCommand& command) {
  CLI::App* judge = app.add_subcommand(
      "mesh", "Judge a mesh: manifold, oriented, self-intersections, distance to a truth");
  judge->add_option("MESH", command.mesh, "PLY, OBJ, OFF or STL (.gz of each)")->required();
  judge->add_option("--truth", command.truth, "Mesh to measure the distance to, both ways");
  judge->add_option("--cloud", command.cloud, "Point cloud whose distance to the mesh is measured");
  judge->add_option("--json", command.json,
                    "Write the figures to this file; lengths are shares of the truth's (else the "
                    "cloud's) diagonal");
  app::add_parsed(*judge, "--samples", command.samples, app::parse_count,
                  "Samples of each surface [" + std::to_string(command.samples) + "]", "N");
  judge->add_option("--seed", command.seed, "Of the samples")->capture_default_str();
  return judge;
}

/// "A,B,C"
std::vector<std::string> parse_names(const std::string& text) {
  std::vector<std::string> names = CLI::detail::split(text, ',');
  for (const std::string& name : names) {
    if (name.empty()) {
      throw CLI::ValidationError("must be names separated by commas, got '" + text + "'");
    }
  }
  return names;
}

/// "EDGE,DEPTH"
DrawingTolerance parse_tolerance(const std::string& text) {
  const std::vector<std::string> numbers = CLI::detail::split(text, ',');
  DrawingTolerance tolerance;
  if (numbers.size() != 2 || !CLI::detail::lexical_cast(numbers[0], tolerance.edge) ||
      !CLI::detail::lexical_cast(numbers[1], tolerance.depth) || tolerance.edge < 0 ||
      tolerance.edge > kMostEdge || tolerance.depth < 0 || tolerance.depth > kMaxDepth) {
    throw CLI::ValidationError("must be two whole numbers, in 0..256 and 0..16777215, got '" +
                               text + "'");
  }
  tolerance.slope = tolerance.edge;
  return tolerance;
}

CLI::App* add_draw(CLI::App& app, DrawCommand& command) {
  CLI::App* draw =
      app.add_subcommand("draw", "Draw the same views with several backends and judge each pixel");
  draw->add_option("INPUT", command.inputs, "Clouds and polygons, as `rangezip scan` reads them")
      ->required();
  app::add_parsed(*draw, "--backends", command.backends, parse_names,
                  "The reference, then what is compared with it: " + app::known_backends(), "A,B")
      ->required();
  app::add_parsed(*draw, "--strategy", command.strategies, parse_names,
                  "How OpenGL draws: " + app::known_strategies() +
                      "; each backend with OpenGL draws by each of them [the first that is exact "
                      "there]",
                  "A,B");
  draw->add_option("--views", command.views, "How many, from evenly spread directions")
      ->check(CLI::Range(1, kMostViews))
      ->capture_default_str();
  app::add_parsed(*draw, "--size", command.size, app::parse_extent, "Of each view [512,512]",
                  "W,H");
  draw->add_option("--point-size", command.point_size, "Pixels")
      ->check(CLI::Range(1, kMaxPointSize))
      ->capture_default_str();
  CLI::Option* view_of =
      draw->add_option("--view-of", command.view_of,
                       "The view, size and point size of the first scan of this session instead");
  for (const char* other : {"--views", "--size", "--point-size"})
    view_of->excludes(draw->get_option(other));
  draw->add_option("--depth", command.depth,
                   "Also judge the drawing of another program: depths of that view, 0 at the front "
                   "plane, 1 at the back (.pfm)");
  draw->add_option("--ids", command.ids, "And its IDs, 32 bits as RGBA (.png)");
  app::add_parsed(*draw, "--tolerance", command.tolerance, parse_tolerance,
                  "For all but exact backends: edges in 1/256 px, depths in 2^-24 of the depth "
                  "range [by the backend's subpixel bits; of files 3,16]",
                  "EDGE,DEPTH");
  draw->add_option("--json", command.json, "Write the figures to this file");
  draw->add_option("--images", command.images,
                   "Folder for a picture of each view that differs: edge blue, depth tie green, "
                   "depth rounding yellow, depth plane violet, unexplained red");
  return draw;
}

CLI::App* add_images(CLI::App& app, ImagesCommand& command) {
  CLI::App* images =
      app.add_subcommand("images", "Compare two images that `rangezip scan` wrote, pixel by pixel");
  images->add_option("REFERENCE", command.reference, "Depths (.pfm), IDs or a mask (.png)")
      ->required();
  images->add_option("CANDIDATE", command.candidate, "Another of the same kind and size")
      ->required();
  return images;
}

CLI::App* add_sample(CLI::App& app, SampleCommand& command) {
  CLI::App* sample =
      app.add_subcommand("sample", "Write a cloud of points spread evenly over a mesh");
  sample->add_option("MESH", command.mesh, "PLY, OBJ, OFF or STL (.gz of each)")->required();
  sample->add_option("-o,--output", command.cloud, "Text, one point a line")->required();
  app::add_parsed(*sample, "--points", command.points, app::parse_count,
                  "How many [" + std::to_string(command.points) + "]", "N");
  sample->add_option("--seed", command.seed, "Of their places")->capture_default_str();
  return sample;
}

CLI::App* add_stages(CLI::App& app, StagesCommand& command) {
  CLI::App* stages = app.add_subcommand(
      "stages", "Play a session with several backends and name the first stage that differs");
  stages->add_option("SESSION", command.session, "From --session of `rangezip mesh` or `scan`")
      ->required();
  app::add_parsed(*stages, "--backends", command.backends, parse_names,
                  "The reference, then what is compared with it: " + app::known_backends(), "A,B")
      ->required();
  stages->add_option("--json", command.json, "Write the verdicts to this file");
  return stages;
}

CLI::App* add_stitch(CLI::App& app, StitchCommand& command) {
  CLI::App* stitch = app.add_subcommand(
      "stitch", "Play a session and judge every stitch: location, geodesics, manifold, crossings");
  stitch->add_option("SESSION", command.session, "From --session of `rangezip mesh` or `scan`")
      ->required();
  stitch->add_option("--backend", command.backend, "Draws the scans: " + app::known_backends())
      ->capture_default_str();
  stitch->add_option("--seed", command.seed, "Of the segments chosen where there are many")
      ->capture_default_str();
  stitch->add_option("--json", command.json, "Write the verdicts to this file");
  return stitch;
}

/// "rangezip-compare mesh --help", of the command on the command line.
std::string help_of(const CLI::App& app) {
  std::string line = app.get_name();
  for (const CLI::App* command : app.get_subcommands())
    line += " " + command->get_name();
  return line + " --help";
}

/// A word that is neither a command nor looks like a file is a mistyped command.
void check_command_name(const CLI::App& app, const std::string& word) {
  if (word.starts_with("-") || word.find('.') != std::string::npos ||
      std::filesystem::exists(word)) {
    return;
  }
  std::string known;
  for (const CLI::App* command : app.get_subcommands({}))
    known += (known.empty() ? "" : ", ") + command->get_name();
  throw CLI::ValidationError(word, "is no command, and no file; there are " + known);
}

/// The arguments in CLI11's order, the last first.
std::vector<std::string> arguments_of(const CLI::App& app, int argc, char** argv) {
  std::vector<std::string> arguments(argv + 1, argv + argc);
  const auto is_command = [&](const std::string& word) {
    const auto commands = app.get_subcommands({});
    return std::any_of(commands.begin(), commands.end(),
                       [&](const CLI::App* command) { return command->get_name() == word; });
  };
  const std::array<std::string, 3> of_program{"-h", "--help", "--version"};
  const auto is_of_program = [&](const std::string& word) {
    return std::find(of_program.begin(), of_program.end(), word) != of_program.end();
  };
  if (!arguments.empty() && !is_of_program(arguments[0]) && !is_command(arguments[0])) {
    check_command_name(app, arguments[0]);
    arguments.insert(arguments.begin(), "draw");
  }
  std::reverse(arguments.begin(), arguments.end());
  return arguments;
}

/// The command that was asked for, as a function; true if its verdict is good.
using Action = std::function<bool(std::ostream&, const Progress&)>;

int carry_out(const Action& action) {
  const app::InterruptWatch interrupts;
  const bool is_good = action(std::cout, {.stop = interrupts.token()});
  std::cout.flush();
  if (!std::cout) throw app::OutputError("standard output: cannot be written in full");
  return is_good ? good : different;
}

int run(const Action& action) {
  try {
    return carry_out(action);
  } catch (const app::UsageError& error) {
    return fail(usage, error.what());
  } catch (const app::OutputError& error) {
    return fail(bad_output, error.what());
  } catch (const BackendError& error) {
    return fail(bad_backend, error.what());
  } catch (const IoError& error) {
    return fail(bad_input, error.what());
  } catch (const Cancelled&) {
    return fail(cancelled, "interrupted");
  } catch (const std::bad_alloc&) {
    return fail(failure, "not enough memory");
  } catch (const std::length_error&) {  // a number of elements that no memory could hold
    return fail(failure, "not enough memory");
  } catch (const std::exception& error) {
    return fail(failure, error.what());
  }
}

int parse_and_run(int argc, char** argv) {
  CLI::App app{"Judges what rangezip makes, with CGAL as an independent witness.",
               "rangezip-compare"};
  app.footer(kFooter);
  app.set_version_flag("--version", "rangezip-compare " RANGEZIP_VERSION);
  app.require_subcommand(1);
  app.failure_message([](const CLI::App* failing, const CLI::Error& error) {
    return "rangezip-compare: " + std::string(error.what()) + "\nSee " + help_of(*failing) + "\n";
  });
  DrawCommand draw;
  MeshCommand mesh;
  ImagesCommand images;
  SampleCommand sample;
  StagesCommand stages;
  StitchCommand stitch;
  const CLI::App* judge_drawings = add_draw(app, draw);
  const CLI::App* judge_mesh = add_mesh(app, mesh);
  const CLI::App* compare_images = add_images(app, images);
  add_sample(app, sample);
  const CLI::App* judge_stages = add_stages(app, stages);
  const CLI::App* judge_stitching = add_stitch(app, stitch);

  try {
    app.parse(arguments_of(app, argc, argv));
  } catch (const CLI::ParseError& error) {
    return report_parse_error(app, error);
  }
  return run([&](std::ostream& out, const Progress& progress) {
    if (judge_drawings->parsed()) return run_draw_command(draw, out, progress);
    if (judge_mesh->parsed()) return run_mesh_command(mesh, out, progress);
    if (compare_images->parsed()) return run_images_command(images, out);
    if (judge_stages->parsed()) return run_stages_command(stages, out, progress);
    if (judge_stitching->parsed()) return run_stitch_command(stitch, out, progress);
    run_sample_command(sample, progress);
    return true;
  });
}

}  // namespace

int main(int argc, char** argv) {
  try {
    return parse_and_run(argc, argv);
  } catch (const std::exception& error) {
    return fail(failure, error.what());
  }
}

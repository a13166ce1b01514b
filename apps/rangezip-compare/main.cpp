// rangezip-compare: the referee on the command line. Exit codes: see kFooter.
#include <CLI/CLI.hpp>
#include <algorithm>
#include <exception>
#include <iostream>
#include <string>
#include <vector>

#include "apps/rangezip-compare/draw_command.h"
#include "apps/rangezip-compare/images_command.h"
#include "apps/rangezip-compare/mesh_command.h"
#include "apps/rangezip-compare/sample_command.h"
#include "apps/rangezip-compare/stages_command.h"
#include "apps/rangezip/backend.h"
#include "apps/rangezip/exit_code.h"
#include "apps/rangezip/values.h"
#include "core/base/error.h"

namespace {

using namespace rangezip;
using namespace rangezip::compare;

/// The numbers that `rangezip` returns for the same things.
enum ExitCode {
  good = 0,
  usage = 1,
  bad_input = 2,
  bad_output = 3,
  bad_backend = 4,
  bad = 5,
  failure = 6
};

constexpr const char* kFooter =
    "Without the name of a command, 'draw' is meant.\n"
    "Exit codes: 0 the mesh is clean, or nothing differs that must not; 1 wrong usage; 2 an input\n"
    "cannot be read; 3 an output cannot be written; 4 a backend is unknown or failed; 5 the mesh "
    "is\n"
    "not clean, or images, drawings or stages differ; 6 any other failure.\n"
    "This program contains code of CGAL and is under the GNU General Public License, version 3 or\n"
    "later; rangezip's own code in it is BSD-3-Clause.";

constexpr int kMostViews = 10'000;
constexpr int kMostEdge = 256;  // a pixel

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
  judge->add_option("--samples", command.samples, "Samples of each surface")
      ->check(CLI::PositiveNumber)
      ->capture_default_str();
  judge->add_option("--seed", command.seed, "Of the samples")->capture_default_str();
  return judge;
}

/// "A,B,C"
std::vector<std::string> parse_names(const std::string& text) {
  std::vector<std::string> names = CLI::detail::split(text, ',');
  for (const std::string& name : names) {
    if (name.empty()) throw CLI::ValidationError("must be names separated by commas", text);
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
  sample->add_option("--points", command.points, "How many")
      ->check(CLI::PositiveNumber)
      ->capture_default_str();
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
  return stages;
}

/// The arguments in CLI11's order, the last first.
std::vector<std::string> arguments_of(const CLI::App& app, int argc, char** argv) {
  std::vector<std::string> arguments(argv + 1, argv + argc);
  const auto is_command = [&](const std::string& word) {
    const auto commands = app.get_subcommands({});
    return std::any_of(commands.begin(), commands.end(),
                       [&](const CLI::App* command) { return command->get_name() == word; });
  };
  const bool asks_for_help =
      !arguments.empty() && (arguments[0] == "-h" || arguments[0] == "--help");
  if (!arguments.empty() && !asks_for_help && !is_command(arguments[0])) {
    arguments.insert(arguments.begin(), "draw");
  }
  std::reverse(arguments.begin(), arguments.end());
  return arguments;
}

int run(int argc, char** argv) {
  CLI::App app{"Judges what rangezip makes, with CGAL as an independent witness."};
  app.footer(kFooter);
  app.require_subcommand(1);
  DrawCommand draw;
  MeshCommand mesh;
  ImagesCommand images;
  SampleCommand sample;
  StagesCommand stages;
  const CLI::App* judge_drawings = add_draw(app, draw);
  const CLI::App* judge_mesh = add_mesh(app, mesh);
  const CLI::App* compare_images = add_images(app, images);
  add_sample(app, sample);
  const CLI::App* judge_stages = add_stages(app, stages);

  try {
    app.parse(arguments_of(app, argc, argv));
  } catch (const CLI::ParseError& error) {
    return report_parse_error(app, error);
  }
  if (judge_drawings->parsed()) return run_draw_command(draw, std::cout) ? good : bad;
  if (judge_mesh->parsed()) return run_mesh_command(mesh, std::cout) ? good : bad;
  if (compare_images->parsed()) return run_images_command(images, std::cout) ? good : bad;
  if (judge_stages->parsed()) return run_stages_command(stages, std::cout) ? good : bad;
  run_sample_command(sample);
  return good;
}

}  // namespace

int main(int argc, char** argv) {
  try {
    return run(argc, argv);
  } catch (const app::UsageError& error) {
    std::cerr << "rangezip-compare: " << error.what() << '\n';
    return usage;
  } catch (const app::OutputError& error) {
    std::cerr << "rangezip-compare: " << error.what() << '\n';
    return bad_output;
  } catch (const BackendError& error) {
    std::cerr << "rangezip-compare: " << error.what() << '\n';
    return bad_backend;
  } catch (const IoError& error) {
    std::cerr << "rangezip-compare: " << error.what() << '\n';
    return bad_input;
  } catch (const std::exception& error) {
    std::cerr << "rangezip-compare: " << error.what() << '\n';
    return failure;
  }
}

// rangezip-compare: the referee on the command line. Exit codes: see kFooter.
#include <CLI/CLI.hpp>
#include <exception>
#include <iostream>
#include <string>

#include "apps/rangezip-compare/images_command.h"
#include "apps/rangezip-compare/mesh_command.h"
#include "apps/rangezip-compare/output_error.h"
#include "apps/rangezip-compare/sample_command.h"
#include "core/base/error.h"

namespace {

using namespace rangezip;
using namespace rangezip::compare;

/// The numbers that `rangezip` returns for the same things.
enum ExitCode { good = 0, usage = 1, bad_input = 2, bad_output = 3, bad = 5, failure = 6 };

constexpr const char* kFooter =
    "Exit codes: 0 the mesh is clean, or the images are identical; 1 wrong usage; 2 an input "
    "cannot\n"
    "be read; 3 an output cannot be written; 5 the mesh is not clean, or the images differ; 6 any\n"
    "other failure.\n"
    "This program contains code of CGAL and is under the GNU General Public License, version 3 or\n"
    "later; rangezip's own code in it is BSD-3-Clause.";

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

int run(int argc, char** argv) {
  CLI::App app{"Judges what rangezip makes, with CGAL as an independent witness."};
  app.footer(kFooter);
  app.require_subcommand(1);
  MeshCommand mesh;
  ImagesCommand images;
  SampleCommand sample;
  const CLI::App* judge_mesh = add_mesh(app, mesh);
  const CLI::App* compare_images = add_images(app, images);
  add_sample(app, sample);

  try {
    app.parse(argc, argv);
  } catch (const CLI::ParseError& error) {
    return report_parse_error(app, error);
  }
  if (judge_mesh->parsed()) return run_mesh_command(mesh, std::cout) ? good : bad;
  if (compare_images->parsed()) return run_images_command(images, std::cout) ? good : bad;
  run_sample_command(sample);
  return good;
}

}  // namespace

int main(int argc, char** argv) {
  try {
    return run(argc, argv);
  } catch (const OutputError& error) {
    std::cerr << "rangezip-compare: " << error.what() << '\n';
    return bad_output;
  } catch (const IoError& error) {
    std::cerr << "rangezip-compare: " << error.what() << '\n';
    return bad_input;
  } catch (const std::exception& error) {
    std::cerr << "rangezip-compare: " << error.what() << '\n';
    return failure;
  }
}

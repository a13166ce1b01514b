// rangezip-compare: the referee on the command line. Exit codes: see kFooter.
#include <CLI/CLI.hpp>
#include <array>
#include <exception>
#include <filesystem>
#include <iostream>
#include <string>

#include "apps/rangezip-compare/images_command.h"
#include "apps/rangezip-compare/mesh_command.h"
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

int run(int argc, char** argv) {
  CLI::App app{"Judges what rangezip makes, with CGAL as an independent witness."};
  app.footer(kFooter);
  app.require_subcommand(1);

  MeshCommand mesh;
  CLI::App* judge = app.add_subcommand(
      "mesh", "Judge a mesh: manifold, oriented, self-intersections, distance to a truth");
  judge->footer(kFooter);
  judge->add_option("MESH", mesh.mesh, "PLY, OBJ, OFF or STL (.gz of each)")->required();
  judge->add_option("--truth", mesh.truth, "Mesh to measure the distance to, both ways");
  judge->add_option("--cloud", mesh.cloud, "Point cloud whose distance to the mesh is measured");
  judge->add_option("--json", mesh.json,
                    "Write the figures to this file; lengths are shares of "
                    "the truth's (else the cloud's) diagonal");
  judge->add_option("--samples", mesh.samples, "Samples of each surface")
      ->check(CLI::PositiveNumber)
      ->capture_default_str();
  judge->add_option("--seed", mesh.seed, "Of the samples")->capture_default_str();

  std::array<std::filesystem::path, 2> image;
  CLI::App* images =
      app.add_subcommand("images", "Compare two images that `rangezip scan` wrote, pixel by pixel");
  images->footer(kFooter);
  images->add_option("REFERENCE", image[0], "Depths (.pfm), IDs or a mask (.png)")->required();
  images->add_option("CANDIDATE", image[1], "Another of the same kind and size")->required();

  try {
    app.parse(argc, argv);
  } catch (const CLI::ParseError& error) {
    return report_parse_error(app, error);
  }
  const bool is_good = images->parsed() ? run_images_command(image[0], image[1], std::cout)
                                        : run_mesh_command(mesh, std::cout);
  return is_good ? good : bad;
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

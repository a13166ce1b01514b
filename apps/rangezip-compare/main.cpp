// rangezip-compare: the referee on the command line. Exit codes: see kFooter.
#include <CLI/CLI.hpp>
#include <exception>
#include <iostream>
#include <string>

#include "apps/rangezip-compare/mesh_command.h"
#include "core/base/error.h"

namespace {

using namespace rangezip;
using namespace rangezip::compare;

enum ExitCode { kGood = 0, kBad = 1, kUsage = 2, kFile = 3, kFailure = 4 };

constexpr const char* kFooter =
    "Exit codes: 0 the mesh is clean, or the images are identical; 1 it is not, or they differ;\n"
    "2 wrong usage; 3 a file cannot be read or written; 4 any other failure.\n"
    "This program contains code of CGAL and is under the GNU General Public License, version 3 or\n"
    "later; rangezip's own code in it is BSD-3-Clause.";

/// A usage error is one exit code here, whatever CLI11 calls it; asking for help is none.
int report_parse_error(const CLI::App& app, const CLI::ParseError& error) {
  return app.exit(error) == 0 ? kGood : kUsage;
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

  try {
    app.parse(argc, argv);
  } catch (const CLI::ParseError& error) {
    return report_parse_error(app, error);
  }
  return run_mesh_command(mesh, std::cout) ? kGood : kBad;
}

}  // namespace

int main(int argc, char** argv) {
  try {
    return run(argc, argv);
  } catch (const IoError& error) {
    std::cerr << "rangezip-compare: " << error.what() << '\n';
    return kFile;
  } catch (const std::exception& error) {
    std::cerr << "rangezip-compare: " << error.what() << '\n';
    return kFailure;
  }
}

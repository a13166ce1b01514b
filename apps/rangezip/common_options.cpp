#include "apps/rangezip/backend.h"
#include "apps/rangezip/commands.h"

namespace rangezip::app {

void add_common_options(CLI::App& command, CommonOptions& options) {
  command.add_option("--backend", options.backend, "Rasterizer to draw with: " + known_backends())
      ->envname("RANGEZIP_BACKEND")
      ->capture_default_str();
  command
      .add_option("--threads", options.threads,
                  "Threads to use, 0: all of the machine; the result is the same for any number")
      ->check(CLI::Range(0, 1024))
      ->capture_default_str();
  command.add_flag("-q,--quiet", options.quiet, "No progress and no summary; errors only");
}

void add_mesh_file_options(CLI::App& command, MeshFileOptions& options) {
  command.add_flag("--ascii", options.ascii, "Write PLY or STL as text");
  command.add_flag("--sources", options.with_sources,
                   "Write the input primitive and the view of every vertex (PLY)");
}

}  // namespace rangezip::app

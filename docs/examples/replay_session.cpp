// Plays a recorded or hand-written session again; the mesh has the same bytes as the recorded one:
//   replay_session SESSION.json OUTPUT.ply
#include <exception>
#include <filesystem>
#include <iostream>
#include <vector>

#include "core/io/input_file.h"
#include "core/io/mesh_file.h"
#include "core/io/session_file.h"
#include "core/session/session.h"
#include "raster_cpu/cpu_rasterizer.h"

int main(int argc, char** argv) try {
  if (argc != 3) {
    std::cerr << "usage: replay_session SESSION.json OUTPUT\n";
    return 2;
  }
  const rangezip::SessionFile recorded = rangezip::read_session(argv[1]);
  rangezip::check_session_inputs(recorded);

  std::vector<std::filesystem::path> inputs;
  for (const rangezip::SessionInput& input : recorded.inputs)
    inputs.push_back(input.path);
  rangezip::TriangleMesh initial;
  if (recorded.initial_mesh) initial = rangezip::read_mesh(recorded.initial_mesh->path);
  rangezip::Session session(rangezip::read_scene(inputs).scene, std::move(initial));

  rangezip::CpuRasterizer rasterizer;
  for (const rangezip::Command& command : recorded.commands)
    session.apply(command, rasterizer);

  rangezip::write_mesh(argv[2], *session.mesh());
  std::cout << session.history().size() << " commands, " << session.mesh()->triangles.size()
            << " triangles\n";
  return 0;
} catch (const std::exception& error) {
  std::cerr << "replay_session: " << error.what() << '\n';
  return 1;
}

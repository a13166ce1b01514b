#include "apps/rangezip/verify.h"

#include "apps/rangezip/console.h"
#include "apps/rangezip/exit_code.h"
#include "core/io/mesh_file.h"

namespace rangezip::app {

namespace {

std::string counted(std::size_t count, const std::string& one, const std::string& many) {
  return with_commas(count) + ' ' + (count == 1 ? one : many);
}

std::string counted(std::size_t count, const std::string& one) {
  return counted(count, one, one + 's');
}

}  // namespace

std::string topology_text(const MeshReport& report) {
  return counted(report.vertices, "vertex", "vertices") + ", " + counted(report.faces, "face") +
         ", " + counted(report.components, "component") + ", " +
         counted(report.boundary_loops, "boundary loop") + ", Euler number " +
         std::to_string(report.euler);
}

std::string faults_text(const MeshReport& report, std::size_t self_intersections) {
  std::string text;
  const auto add = [&](std::size_t count, const char* thing) {
    if (count > 0) text += (text.empty() ? "" : ", ") + counted(count, thing);
  };
  add(report.nonmanifold_edges, "non-manifold edge");
  add(report.nonmanifold_vertices, "non-manifold fan");
  add(report.misoriented_edges, "misoriented edge");
  add(report.degenerate_faces, "degenerate face");
  add(self_intersections, "self-intersecting pair");
  return text;
}

void require_faces(const TriangleMesh& mesh, const std::filesystem::path& output,
                   const std::string& advice) {
  if (!mesh.empty()) return;
  throw NotVerified(output.string() + ": is not written: no face came out; " + advice);
}

TriangleMesh read_given_mesh(const std::filesystem::path& path, const Progress& progress) {
  TriangleMesh mesh = read_mesh(path, progress);
  try {
    check_mesh(mesh, progress);
    return mesh;
  } catch (const TopologyError& error) {
    throw TopologyError(path.string() + ": " + error.what());
  }
}

}  // namespace rangezip::app

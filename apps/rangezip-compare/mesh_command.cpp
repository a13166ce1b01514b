#include "apps/rangezip-compare/mesh_command.h"

#include <array>
#include <iomanip>
#include <nlohmann/json.hpp>
#include <optional>
#include <ostream>
#include <span>
#include <string>
#include <vector>

#include "apps/rangezip-compare/json_file.h"
#include "compare/mesh_distance.h"
#include "compare/mesh_judge.h"
#include "core/base/error.h"
#include "core/io/input_file.h"
#include "core/io/mesh_file.h"
#include "core/mesh/mesh_report.h"

namespace rangezip::compare {

namespace {

using Json = nlohmann::ordered_json;

// Shares of the diagonal within which a distance counts as small, as the JSON names them.
constexpr double kTight = 0.001;
constexpr double kLoose = 0.005;

/// Lengths as shares of the diagonal.
Json to_json(std::span<const double> distances, double diagonal) {
  const DistanceSummary summary = summarize(distances);
  return {{"count", summary.count},
          {"mean", summary.mean / diagonal},
          {"rms", summary.rms / diagonal},
          {"p95", summary.p95 / diagonal},
          {"max", summary.max / diagonal},
          {"within_0.1_percent", share_within(distances, kTight * diagonal)},
          {"within_0.5_percent", share_within(distances, kLoose * diagonal)}};
}

/// CGAL's verdict, with the library's own counts of what is wrong with a mesh that is no manifold.
Json to_json(const MeshVerdict& verdict, const MeshReport& report) {
  Json json{{"vertices", verdict.vertices},
            {"faces", verdict.faces},
            {"clean", verdict.is_clean()},
            {"manifold", verdict.is_manifold},
            {"nonmanifold_edges", report.nonmanifold_edges},
            {"nonmanifold_vertices", report.nonmanifold_vertices},
            {"misoriented_edges", report.misoriented_edges}};
  if (!verdict.is_manifold) return json;
  json["components"] = verdict.components;
  json["boundary_loops"] = verdict.boundary_loops;
  json["longest_loop"] = report.longest_loop;
  json["euler"] = verdict.euler;
  if (verdict.volume) json["volume"] = *verdict.volume;
  json["degenerate_faces"] = verdict.degenerate_faces;
  json["self_intersections"] = verdict.self_intersections;
  return json;
}

void print_distances(std::ostream& out, const char* title, const Json& figures) {
  constexpr double kPercent = 100.0;
  const auto percent = [&](const char* key) { return kPercent * figures.at(key).get<double>(); };
  out << title << std::fixed << std::setprecision(4) << "mean " << percent("mean") << "  rms "
      << percent("rms") << "  p95 " << percent("p95") << "  max " << percent("max")
      << std::setprecision(2) << "  (% of the diagonal); " << percent("within_0.1_percent")
      << " % within 0.1 %, " << percent("within_0.5_percent") << " % within 0.5 %\n";
}

void print_verdict(std::ostream& out, const Json& mesh) {
  out << mesh.at("faces") << " faces, " << mesh.at("vertices") << " vertices";
  if (!mesh.at("manifold").get<bool>()) {
    out << "\nNOT MANIFOLD: " << mesh.at("nonmanifold_edges") << " edges with three faces or more, "
        << mesh.at("nonmanifold_vertices") << " vertices with several fans, "
        << mesh.at("misoriented_edges") << " edges between faces of opposite orientation\n";
    return;
  }
  out << ", " << mesh.at("components") << " components, " << mesh.at("boundary_loops")
      << " boundary loops, Euler number " << mesh.at("euler") << "\nmanifold, oriented; "
      << mesh.at("self_intersections") << " self-intersecting pairs, "
      << mesh.at("degenerate_faces") << " degenerate faces\n";
}

struct Cloud {
  std::vector<Vec3> points;
  double diagonal = 0.0;
};

Cloud read_cloud(const std::filesystem::path& path, const Progress& progress) {
  const Scene scene = read_scene(std::array{path}, progress).scene;
  if (scene.point_count() == 0) throw IoError(path.string() + ": must have points");
  return {.points = scene.points(), .diagonal = scene.bounds().diagonal()};
}

/// A mesh with its file, for messages.
struct Surface {
  std::filesystem::path path;
  TriangleMesh mesh;

  Surface(const std::filesystem::path& file, const Progress& progress)
      : path(file), mesh(read_mesh(file, progress)) {}
};

/// Calls `measure` on the mesh. @throws IoError with the name of the file if it has no area
template <class Measure>
auto measured(const Surface& surface, const Measure& measure) {
  try {
    return measure(surface.mesh);
  } catch (const TopologyError& error) {
    throw IoError(surface.path.string() + ": " + error.what());
  }
}

std::vector<Vec3> samples_of(const Surface& surface, const SurfaceSampleOptions& sampling) {
  return measured(surface, [&](const TriangleMesh& m) { return sample_surface(m, sampling); });
}

std::vector<double> distances_to(const Surface& surface, const std::vector<Vec3>& points) {
  return measured(surface, [&](const TriangleMesh& m) { return distances_to_mesh(points, m); });
}

void compare_with_truth(const MeshCommand& command, const Surface& surface, const Surface& truth,
                        Json& json, std::ostream& out, const Progress& progress) {
  const SurfaceSampleOptions sampling{.count = command.samples, .seed = command.seed};
  const double diagonal = bounds_of(truth.mesh).diagonal();
  json["diagonal"] = diagonal;
  json["accuracy"] = to_json(distances_to(truth, samples_of(surface, sampling)), diagonal);
  progress.check_stop();
  json["completeness"] = to_json(distances_to(surface, samples_of(truth, sampling)), diagonal);
  print_distances(out, "mesh to truth:  ", json["accuracy"]);
  print_distances(out, "truth to mesh:  ", json["completeness"]);
}

void compare_with_cloud(const Surface& surface, const Cloud& cloud, Json& json, std::ostream& out) {
  if (!json.contains("diagonal")) json["diagonal"] = cloud.diagonal;
  json["cloud"] = to_json(distances_to(surface, cloud.points), json["diagonal"].get<double>());
  print_distances(out, "cloud to mesh:  ", json["cloud"]);
}

}  // namespace

bool run_mesh_command(const MeshCommand& command, std::ostream& out, const Progress& progress) {
  if (command.json) check_json_place(*command.json);
  const Surface surface(command.mesh, progress);
  const auto truth = command.truth ? std::optional<Surface>(std::in_place, *command.truth, progress)
                                   : std::nullopt;
  const auto cloud =
      command.cloud ? std::optional<Cloud>(read_cloud(*command.cloud, progress)) : std::nullopt;
  progress.check_stop();
  Json json{{"file", command.mesh.string()},
            {"mesh", to_json(judge_mesh(surface.mesh), report_mesh(surface.mesh, progress))}};
  print_verdict(out, json["mesh"]);
  progress.check_stop();
  if (truth) compare_with_truth(command, surface, *truth, json, out, progress);
  progress.check_stop();
  if (cloud) compare_with_cloud(surface, *cloud, json, out);
  progress.check_stop();
  if (command.json) write_json(*command.json, json);
  return json["mesh"]["clean"].get<bool>();
}

}  // namespace rangezip::compare

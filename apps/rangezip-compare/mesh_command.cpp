#include "apps/rangezip-compare/mesh_command.h"

#include <array>
#include <fstream>
#include <iomanip>
#include <nlohmann/json.hpp>
#include <ostream>
#include <span>
#include <string>
#include <vector>

#include "apps/rangezip/exit_code.h"
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

void write_json(const std::filesystem::path& path, const Json& json) {
  std::ofstream file(path);
  file << json.dump(2) << '\n';
  file.close();
  if (!file) throw app::OutputError(path.string() + ": the report cannot be written in full");
}

struct Cloud {
  std::vector<Vec3> points;
  double diagonal = 0.0;
};

Cloud read_cloud(const std::filesystem::path& path) {
  const Scene scene = read_scene(std::array{path}).scene;
  if (scene.point_count() == 0) throw IoError(path.string() + ": must have points");
  return {.points = scene.points(), .diagonal = scene.bounds().diagonal()};
}

}  // namespace

bool run_mesh_command(const MeshCommand& command, std::ostream& out) {
  const TriangleMesh mesh = read_mesh(command.mesh);
  const SurfaceSampleOptions sampling{.count = command.samples, .seed = command.seed};
  Json json{{"file", command.mesh.string()},
            {"mesh", to_json(judge_mesh(mesh), report_mesh(mesh))}};
  print_verdict(out, json["mesh"]);

  double diagonal = 0.0;  // of the truth, else of the cloud
  if (command.truth) {
    const TriangleMesh truth = read_mesh(*command.truth);
    diagonal = bounds_of(truth).diagonal();
    json["diagonal"] = diagonal;
    json["accuracy"] = to_json(distances_to_mesh(sample_surface(mesh, sampling), truth), diagonal);
    json["completeness"] =
        to_json(distances_to_mesh(sample_surface(truth, sampling), mesh), diagonal);
    print_distances(out, "mesh to truth:  ", json["accuracy"]);
    print_distances(out, "truth to mesh:  ", json["completeness"]);
  }
  if (command.cloud) {
    const Cloud cloud = read_cloud(*command.cloud);
    if (!command.truth) diagonal = cloud.diagonal;
    json["diagonal"] = diagonal;
    json["cloud"] = to_json(distances_to_mesh(cloud.points, mesh), diagonal);
    print_distances(out, "cloud to mesh:  ", json["cloud"]);
  }
  if (command.json) write_json(*command.json, json);
  return json["mesh"]["clean"].get<bool>();
}

}  // namespace rangezip::compare

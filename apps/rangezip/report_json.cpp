#include "apps/rangezip/report_json.h"

#include <sys/resource.h>

#include <nlohmann/json.hpp>

#include "apps/rangezip/handle_changes.h"
#include "core/io/atomic_file.h"

namespace rangezip::app {

namespace {

using Json = nlohmann::ordered_json;

Json json_of(const InputReport& input) {
  return {{"path", input.path},
          {"format", input.format},
          {"points", input.points},
          {"triangles", input.triangles},
          {"polygons", input.polygons},
          {"skipped",
           {{"nonfinite_points", input.nonfinite_points},
            {"repeated_points", input.repeated_points},
            {"nonfinite_polygons", input.nonfinite_polygons},
            {"degenerate_polygons", input.degenerate_polygons}}},
          {"notes", input.notes}};
}

Json json_of(const ScanReport& scan) {
  return {{"samples", scan.samples},        {"see_through", scan.see_through},
          {"back_side", scan.back_side},    {"inside", scan.inside},
          {"filled", scan.filled},          {"steep", scan.steep},
          {"matched", scan.matched},        {"active", scan.active},
          {"patch_faces", scan.patch_faces}};
}

Json json_of(const StitchReport& stitch) {
  return {{"removed_faces", stitch.removed_faces},
          {"patch_faces", stitch.patch_faces},
          {"strip_faces", stitch.strip_faces},
          {"rejected_strip_faces", stitch.rejected_strip_faces},
          {"inserted_vertices", stitch.inserted_vertices},
          {"inserted_segments", stitch.inserted_segments},
          {"skipped_vertices", stitch.skipped_vertices},
          {"skipped_segments", stitch.skipped_segments},
          {"flipped_edges", stitch.flipped_edges},
          {"collapsed_edges", stitch.collapsed_edges},
          {"opened_fans", stitch.opened_fans},
          {"split_vertices", stitch.split_vertices},
          {"dropped_components", stitch.dropped_components},
          {"dropped_faces", stitch.dropped_faces},
          {"crossing_seam_faces", stitch.crossing_seam_faces},
          {"crossing_patch_faces", stitch.crossing_patch_faces},
          {"withdrawn_faces", stitch.withdrawn_faces}};
}

Json json_of(const FinishReport& finish) {
  return {{"self_intersections_cut", finish.self_intersections_cut},
          {"bridged_loops", finish.bridged_loops},
          {"papered_faces", finish.papered_faces},
          {"joined_loops", finish.joined_loops},
          {"cut_handles", finish.cut_handles},
          {"turned_pieces", finish.turned_pieces},
          {"filled_holes", finish.filled_holes},
          {"filled_faces", finish.filled_faces},
          {"open_loops", finish.open_loops},
          {"untangled_pairs", finish.untangled_pairs},
          {"noise", finish.noise},
          {"fit_radius", finish.fit_radius},
          {"split_edges", finish.split_edges},
          {"collapsed_edges", finish.collapsed_edges},
          {"flipped_edges", finish.flipped_edges},
          {"flattened_spikes", finish.flattened_spikes},
          {"unfolded", finish.unfolded},
          {"snapped_vertices", finish.snapped_vertices},
          {"rim_moves", finish.rim_moves},
          {"regrown_faces", finish.regrown_faces},
          {"grown_bodies", finish.grown_bodies},
          {"border_steps", finish.border_steps},
          {"small_angles", finish.small_angles},
          {"dropped_components", finish.dropped_components},
          {"dropped_faces", finish.dropped_faces}};
}

Json views_of(const ReconstructReport& report) {
  Json views = Json::array();
  for (std::size_t i = 0; i < report.views.size(); ++i) {
    const Vec3& direction = report.views[i];
    const CommandReport& command = report.commands.at(report.view_commands.at(i));
    views.push_back({{"toward_viewer", {direction.x, direction.y, direction.z}},
                     {"kind", i < report.planned_views ? "planned" : "fill"},
                     {"seconds", command.seconds},
                     {"scan", json_of(command.scan)},
                     {"stitch", json_of(command.stitch)}});
  }
  return views;
}

Json mesh_of(const ReconstructReport& report) {
  const MeshReport& mesh = report.mesh;
  return {{"vertices", mesh.vertices},
          {"faces", mesh.faces},
          {"edges", mesh.edges},
          {"components", mesh.components},
          {"boundary_loops", mesh.boundary_loops},
          {"boundary_edges", mesh.boundary_edges},
          {"longest_loop", mesh.longest_loop},
          {"euler_number", mesh.euler},
          {"nonmanifold_edges", mesh.nonmanifold_edges},
          {"nonmanifold_vertices", mesh.nonmanifold_vertices},
          {"misoriented_edges", mesh.misoriented_edges},
          {"degenerate_faces", mesh.degenerate_faces},
          {"self_intersections", report.self_intersections}};
}

Json handles_of(const ReconstructReport& report) {
  Json changes = Json::array();
  for (const HandleChange& change : handle_changes(report))
    changes.push_back({{"by", change.by}, {"change", change.handles}});
  const std::size_t count = report.commands.empty() ? 0 : report.commands.back().handles;
  return {{"count", count}, {"changes", changes}};
}

Json json_of(const std::vector<Place>& places) {
  Json list = Json::array();
  for (const Place& place : places) {
    list.push_back({{"center", {place.center.x, place.center.y, place.center.z}},
                    {"radius", place.radius},
                    {"count", place.points},
                    {"area", place.area}});
  }
  return list;
}

Json uncovered_of(const CoverageReport& coverage) {
  return {{"points", coverage.uncovered_points},
          {"scattered_points", coverage.scattered_points},
          {"area", coverage.uncovered_area},
          {"places", json_of(coverage.uncovered)}};
}

Json stages_of(const std::vector<StageTime>& stages) {
  Json list = Json::array();
  for (const StageTime& stage : stages) {
    list.push_back(
        {{"stage", stage.stage}, {"seconds", stage.seconds}, {"cpu_seconds", stage.cpu_seconds}});
  }
  return list;
}

/// Pieces that were too small to keep, over all scans and the finish.
Json dropped_of(const ReconstructReport& report) {
  std::size_t components = 0;
  std::size_t faces = 0;
  for (const CommandReport& command : report.commands) {
    components += command.stitch.dropped_components + command.finish.dropped_components;
    faces += command.stitch.dropped_faces + command.finish.dropped_faces;
  }
  return {{"components", components}, {"faces", faces}};
}

std::size_t peak_memory_bytes() {
  rusage usage{};
  getrusage(RUSAGE_SELF, &usage);
  return static_cast<std::size_t>(usage.ru_maxrss) * 1024;  // Linux counts in KiB
}

Json json_of(const MeshRunReport& run) {
  const ReconstructReport& report = run.reconstruction;
  Json json{{"program", "rangezip " RANGEZIP_VERSION}, {"backend", run.rasterizer.name}};
  json["inputs"] = Json::array();
  for (const InputReport& input : run.inputs)
    json["inputs"].push_back(json_of(input));
  json["pixel_size"] = report.pixel_size;
  json["planned_coverage"] = report.planned_coverage;
  json["views"] = views_of(report);
  if (report.finish_command) {
    json["finish"] = json_of(report.commands.at(*report.finish_command).finish);
  }
  json["coverage"] = report.coverage.share;
  json["uncovered"] = uncovered_of(report.coverage);
  json["unsupported"] = {{"area", report.coverage.unsupported_area},
                         {"places", json_of(report.coverage.unsupported)}};
  json["papered"] = {{"area", report.coverage.papered_area},
                     {"places", json_of(report.coverage.papered)}};
  json["mesh"] = mesh_of(report);
  json["handles"] = handles_of(report);
  json["dropped"] = dropped_of(report);
  json["turned_components"] = report.turned_components;
  json["stages"] = stages_of(run.stages);
  json["peak_memory_bytes"] = peak_memory_bytes();
  return json;
}

}  // namespace

void write_report(const std::filesystem::path& path, const MeshRunReport& report) {
  AtomicFile file(path);
  file.write(json_of(report).dump(2, ' ', false, Json::error_handler_t::replace) + '\n');
  file.commit();
}

}  // namespace rangezip::app

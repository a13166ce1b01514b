#include "core/session/run_command.h"

#include <algorithm>
#include <chrono>
#include <cmath>
#include <limits>
#include <span>
#include <variant>

#include "core/base/error.h"
#include "core/base/progress_part.h"
#include "core/finish/hidden_layers.h"
#include "core/finish/hole_filling.h"
#include "core/finish/laplacian_smooth.h"
#include "core/finish/unsupported_faces.h"
#include "core/mesh/handles.h"
#include "core/plan/hidden_samples.h"
#include "core/plan/spacing.h"
#include "core/session/erase_region.h"
#include "core/session/turn_to_scanners.h"
#include "core/view/view.h"

namespace rangezip {

namespace {

constexpr double kVoteShare = 0.5;  ///< of an AddScan that has to vote first

/// Unit vector along the line of sight, toward the scanner; of the middle ray for a central
/// projection.
Vec3 toward_viewer(const Camera& camera) {
  const Mat4& m = camera.eye_from_world;
  return {m[0][2], m[1][2], m[2][2]};
}

/// One overload for each command; all leave the mesh and their part of the report in result_.
class CommandRun {
 public:
  CommandRun(const Scene& scene, TriangleMesh mesh, VoteCache& votes, Rasterizer& rasterizer,
             const Progress& progress)
      : scene_(scene), votes_(votes), rasterizer_(rasterizer), progress_(progress) {
    result_.mesh = std::move(mesh);
  }

  CommandResult take() { return std::move(result_); }

  void operator()(const AddScan& command) {
    std::vector<std::int8_t> votes;
    double begin = 0.0;
    if (command.vote && command.scan.plane_fit) {  // which is what asks the votes
      begin = kVoteShare;
      votes = votes_toward(
          votes_.votes(rasterizer_, scene_, *command.vote, part_of(progress_, 0.0, kVoteShare)),
          toward_viewer(command.scan.camera));
    }
    result_.scan = scan(rasterizer_, scene_, result_.mesh, command.scan, votes,
                        part_of(progress_, begin, 1.0));
    result_.report.scan = result_.scan->report;
    StitchResult stitched =
        stitch(std::move(result_.mesh), *result_.scan, command.stitch, progress_);
    result_.mesh = std::move(stitched.mesh);
    result_.report.stitch = stitched.report;
  }

  void operator()(const EraseRegion& command) {
    EraseResult erased = erase_region(std::move(result_.mesh), rasterizer_, command);
    result_.mesh = std::move(erased.mesh);
    result_.report.erased_faces = erased.erased_faces;
  }

  void operator()(const ErasePlaces& command) {
    EraseResult erased = erase_places(std::move(result_.mesh), command.places);
    result_.mesh = std::move(erased.mesh);
    result_.report.erased_faces = erased.erased_faces;
  }

  void operator()(const SmoothMesh& command) {
    result_.mesh =
        laplacian_smooth(std::move(result_.mesh), command.iterations, command.factor, progress_);
  }

  void operator()(const FillMeshHoles& command) {
    const double max_perimeter =
        std::min(command.max_perimeter, std::numeric_limits<double>::max());
    FilledMesh filled = fill_mesh_holes(std::move(result_.mesh), command.pixel_size, max_perimeter);
    result_.mesh = std::move(filled.mesh);
    result_.report.filled_holes = filled.filled_holes;
  }

  void operator()(const DropUnsupported& command) {
    if (result_.mesh.empty()) return;
    const double h = command.pixel_size > 0.0 ? command.pixel_size : mean_edge_length(result_.mesh);
    result_.report.erased_faces =
        drop_unsupported_faces(result_.mesh, evidence_points(scene_, h), h);
  }

  void operator()(const FinishMesh& command) {
    FinishOptions options = command.options;
    if (options.pixel_size == 0.0) options.pixel_size = mean_edge_length(result_.mesh);
    const std::vector<Vec3> points = finish_points(options.pixel_size);
    SeenPoints seen{.points = points};
    if (command.vote) seen.votes = votes_.votes(rasterizer_, scene_, *command.vote, progress_);
    FinishResult finished = finish(std::move(result_.mesh), seen, options, progress_);
    result_.mesh = std::move(finished.mesh);
    result_.report.finish = finished.report;
  }

  void operator()(const TurnToScanners& command) {
    result_.report.turned_components =
        turn_to_scanners(result_.mesh, rasterizer_, command.scanners, progress_);
  }

  void operator()(const UndoSteps&) {
    throw InvalidArgument("run_command: UndoSteps needs the history of a Session");
  }

 private:
  /// evidence_points() without the layers that polygons have behind the mesh.
  [[nodiscard]] std::vector<Vec3> finish_points(double pixel_size) const {
    std::vector<Vec3> points = evidence_points(scene_, pixel_size);
    const bool is_finished = !result_.mesh.empty() && pixel_size > 0.0 && std::isfinite(pixel_size);
    if (scene_.triangle_count() == 0 || !is_finished) return points;
    const std::size_t scanned = scene_.point_count();
    std::vector<std::uint8_t> is_hidden(scanned, 0);
    const std::vector<std::uint8_t> hidden = hidden_samples(
        rasterizer_, scene_, std::span(points).subspan(scanned), pixel_size, progress_);
    is_hidden.insert(is_hidden.end(), hidden.begin(), hidden.end());
    drop_hidden_layers(points, is_hidden, result_.mesh, pixel_size);
    return points;
  }

  const Scene& scene_;
  VoteCache& votes_;
  Rasterizer& rasterizer_;
  const Progress& progress_;
  CommandResult result_;
};

}  // namespace

const VisibilityVotes& VoteCache::votes(Rasterizer& rasterizer, const Scene& scene,
                                        const VoteOptions& options, const Progress& progress) {
  const auto known = std::find_if(entries_.begin(), entries_.end(),
                                  [&](const auto& entry) { return entry.first == options; });
  if (known != entries_.end()) return known->second;
  entries_.emplace_back(options, visibility_votes(rasterizer, scene, options.pixel_size,
                                                  options.directions, progress));
  return entries_.back().second;
}

CommandResult run_command(const Command& command, const Scene& scene, TriangleMesh mesh,
                          VoteCache& votes, Rasterizer& rasterizer, const Progress& progress) {
  progress.check_stop();
  const auto start = std::chrono::steady_clock::now();
  CommandRun run(scene, std::move(mesh), votes, rasterizer, progress);
  std::visit(run, command);
  CommandResult result = run.take();
  result.report.handles = count_handles(result.mesh);
  const std::chrono::duration<double> seconds = std::chrono::steady_clock::now() - start;
  result.report.seconds = seconds.count();
  return result;
}

std::vector<Vec3> evidence_points(const Scene& scene, double pixel_size) {
  std::vector<Vec3> points = scene.points();
  if (scene.triangle_count() > 0) {
    const std::vector<Vec3> on_triangles =
        area_samples(scene, area_sample_count(scene, pixel_size));
    points.insert(points.end(), on_triangles.begin(), on_triangles.end());
  }
  return points;
}

double mean_edge_length(const TriangleMesh& mesh) {
  if (mesh.empty()) {
    throw InvalidArgument("mean_edge_length: the mesh must have at least 1 triangle, got 0");
  }
  double sum = 0.0;
  for (const auto& [a, b, c] : mesh.triangles) {
    sum += glm::length(mesh.positions[b] - mesh.positions[a]) +
           glm::length(mesh.positions[c] - mesh.positions[b]) +
           glm::length(mesh.positions[a] - mesh.positions[c]);
  }
  return sum / (3.0 * static_cast<double>(mesh.triangles.size()));
}

}  // namespace rangezip

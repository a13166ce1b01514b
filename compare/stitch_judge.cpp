#include "compare/stitch_judge.h"

#include <algorithm>
#include <string>

#include "compare/random.h"
#include "compare/surface_path.h"
#include "core/base/error.h"
#include "core/session/session.h"
#include "core/stitch/stitch.h"

namespace rangezip::compare {

namespace {

/// A sample that has no face although one is so near in its line of sight was not located; a third
/// of the band of correspondence, pixel sides.
constexpr double kMissedDistance = 0.5;

void judge_samples(const TriangleMesh& before, const Scan& scan, StitchVerdict& verdict) {
  std::vector<PrimitiveId> faces;
  for (const Pixel p : scan.patch.pixels)
    faces.push_back(scan.correspondence.face[p]);
  const std::vector<Vec3>& points = scan.patch.mesh.positions;
  verdict.samples = judge_location(before, points, faces, verdict.slack);
  verdict.samples.missed =
      count_missed(before, scan.image.view(), points, faces, kMissedDistance * verdict.pixel_size);
}

void judge_insertions(const TriangleMesh& before, const Scan& scan, const StitchRecord& record,
                      StitchVerdict& verdict) {
  std::vector<Vec3> points;
  std::vector<PrimitiveId> faces;
  for (const auto& [patch_vertex, old_face] : record.vertices) {
    points.push_back(scan.patch.mesh.positions[patch_vertex]);
    faces.push_back(old_face);
  }
  verdict.insertions =
      judge_location_in_sight(before, scan.image.view(), points, faces, verdict.slack);
  verdict.nearest = judge_location(before, points, faces, verdict.slack);
}

/// One of each of `count` equal parts of the segments.
std::vector<std::array<std::uint32_t, 2>> sampled(
    const std::vector<std::array<std::uint32_t, 2>>& segments, std::size_t count,
    std::uint64_t seed) {
  std::vector<std::array<std::uint32_t, 2>> chosen;
  for (std::size_t i = 0; i < count; ++i) {
    const double place = static_cast<double>(i) + uniform_in_unit_interval(seed, i);
    const double index = place / static_cast<double>(count) * static_cast<double>(segments.size());
    chosen.push_back(segments[std::min(static_cast<std::size_t>(index), segments.size() - 1)]);
  }
  return chosen;
}

/// Lines over the old surface; those that do not arrive are counted.
std::vector<SurfacePath> follow(const TriangleMesh& before, const Scan& scan,
                                const StitchRecord& record,
                                std::span<const std::array<std::uint32_t, 2>> segments,
                                std::size_t& lost) {
  const ViewedMesh seen(before, scan.image.view());
  const auto place_of = [&](std::uint32_t vertex) {
    const auto found = std::lower_bound(record.vertices.begin(), record.vertices.end(), vertex,
                                        [](const StitchRecord::Vertex& v, std::uint32_t wanted) {
                                          return v.patch_vertex < wanted;
                                        });
    if (found == record.vertices.end() || found->patch_vertex != vertex) {
      throw InvalidArgument("judge_stitch: a segment ends in vertex " + std::to_string(vertex) +
                            ", which was not inserted");
    }
    return SeenPlace{.pixel = scan.patch.pixels[vertex], .face = found->old_face};
  };
  std::vector<SurfacePath> paths;
  for (const auto& [from, to] : segments) {
    auto path = follow_line(seen, place_of(from), place_of(to));
    if (path) {
      paths.push_back(std::move(*path));
    } else {
      ++lost;
    }
  }
  return paths;
}

SegmentVerdict judge_segments(const TriangleMesh& before, const Scan& scan,
                              const StitchRecord& record, double pixel_size,
                              const StitchJudgeOptions& options) {
  SegmentVerdict verdict{.inserted = record.segments.size()};
  std::vector<std::array<std::uint32_t, 2>> segments = record.segments;
  if (before.triangles.size() > options.sample_above && segments.size() > options.sample) {
    segments = sampled(segments, options.sample, options.seed);
  }
  verdict.followed = segments.size();
  const std::vector<SurfacePath> paths = follow(before, scan, record, segments, verdict.lost);
  for (const GeodesicMatch& match : judge_geodesics(before, paths)) {
    if (!match.is_judged) {
      ++verdict.lost;
      continue;
    }
    verdict.ratios.push_back(match.length / match.shortest);
    verdict.line_ratios.push_back(match.line / match.shortest);
    verdict.deviations.push_back(match.deviation / pixel_size);
  }
  return verdict;
}

void check_record(const Scan& scan, const StitchRecord& record) {
  for (const StitchRecord::Vertex& vertex : record.vertices) {
    if (vertex.patch_vertex < scan.patch.pixels.size()) continue;
    throw InvalidArgument("judge_stitch: a vertex must be less than the " +
                          std::to_string(scan.patch.pixels.size()) + " of the patch, got " +
                          std::to_string(vertex.patch_vertex));
  }
}

CommandReport apply(Session& session, const Command& command, Rasterizer& rasterizer,
                    std::size_t number, const Progress& progress) {
  try {
    return session.apply(command, rasterizer, progress);
  } catch (const InvalidArgument& error) {
    throw InvalidArgument("/commands/" + std::to_string(number) + ": " + error.what());
  }
}

}  // namespace

StitchVerdict judge_stitch(const TriangleMesh& before, const Scan& scan, const StitchRecord& record,
                           const StitchJudgeOptions& options) {
  check_record(scan, record);
  StitchVerdict verdict;
  if (before.empty() || scan.patch.mesh.empty()) return verdict;
  verdict.pixel_size = pixel_sides_of(scan.patch, scan.image).smallest;
  verdict.slack = options.slack * verdict.pixel_size;
  judge_samples(before, scan, verdict);
  judge_insertions(before, scan, record, verdict);
  verdict.segments = judge_segments(before, scan, record, verdict.pixel_size, options);
  return verdict;
}

std::vector<StitchStep> judge_stitches(const Scene& scene, const TriangleMesh& initial,
                                       std::span<const Command> commands, Rasterizer& rasterizer,
                                       const StitchJudgeOptions& options,
                                       const Progress& progress) {
  Session session(scene, initial);
  std::vector<StitchStep> steps;
  std::size_t crossings = initial.empty() ? 0 : judge_mesh(initial).self_intersections;
  for (std::size_t i = 0; i < commands.size(); ++i) {
    const auto before = session.mesh();
    apply(session, commands[i], rasterizer, i, progress);
    StitchStep& step = steps.emplace_back();
    step.mesh = judge_mesh(*session.mesh());
    step.is_finished = std::holds_alternative<FinishMesh>(commands[i]);
    if (const auto* add = std::get_if<AddScan>(&commands[i])) {
      const StitchResult again = stitch(*before, *session.last_scan(), add->stitch);
      step.is_repeatable = again.mesh == *session.mesh();
      step.stitch = judge_stitch(*before, *session.last_scan(), again.record, options);
      step.new_crossings =
          step.mesh.self_intersections - std::min(crossings, step.mesh.self_intersections);
    }
    crossings = step.mesh.self_intersections;
    progress.check_stop();
  }
  return steps;
}

}  // namespace rangezip::compare

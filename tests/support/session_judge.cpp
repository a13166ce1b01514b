#include "tests/support/session_judge.h"

#include <algorithm>
#include <array>
#include <exception>
#include <span>
#include <utility>

#include "compare/mesh_judge.h"
#include "core/mask/correspondence.h"
#include "core/mesh/coverage.h"
#include "core/mesh/drawable.h"
#include "core/mesh/mesh_report.h"
#include "core/session/run_command.h"
#include "core/view/view.h"
#include "raster_cpu/cpu_rasterizer.h"

namespace rangezip::sessions {

namespace {

/// Points that are asked for a face near them, at most.
constexpr std::size_t kMostPoints = 2'000;

std::vector<Vec3> some_points(const Scene& scene) {
  std::vector<Vec3> points = scene.points();  // in random order
  points.resize(std::min(points.size(), kMostPoints));
  return points;
}

Framebuffer draw(const TriangleMesh& mesh, const View& view) {
  CpuRasterizer rasterizer;
  const DrawableMesh drawable(mesh);
  const DrawItem item = drawable.item();
  return rasterizer.render(view, {&item, 1});
}

/// Whether the image of a face comes within `reach` pixels of the place in the window.
bool touches(const TriangleMesh& mesh, const View& view, const Vec2& place, double reach) {
  return std::ranges::any_of(mesh.triangles, [&](const Triangle& face) {
    std::array<Vec3, 3> corners;
    for (std::size_t k = 0; k < 3; ++k) {
      const Vec3& p = mesh.positions[face[k]];
      if (view.is_perspective() && view.depth_of(p) <= 0.0) return false;
      corners[k] = view.window_from_world(p);
      corners[k].z = 0.0;
    }
    const Vec3 at{place, 0.0};
    const Vec3 nearest = closest_point_on_triangle(at, corners[0], corners[1], corners[2]);
    return glm::dot(nearest - at, nearest - at) <= reach * reach;
  });
}

/// Whether the centre of a pixel that a rasterizer found covered before and not after has lost the
/// surface. The rasterizer snaps corners to 1/256 of a pixel, and centres on the border of the mesh
/// to either side; so it must have been that far inside and is now that far outside.
bool has_lost(const TriangleMesh& before, const TriangleMesh& after, const View& view,
              Pixel pixel) {
  constexpr double kSnap = 0.02;
  constexpr double kExact = 1e-9;
  const Vec2 centre{pixel.x + 0.5, pixel.y + 0.5};
  for (const Vec2& offset :
       {Vec2{kSnap, kSnap}, Vec2{-kSnap, kSnap}, Vec2{kSnap, -kSnap}, Vec2{-kSnap, -kSnap}}) {
    if (!touches(before, view, centre + offset, kExact)) return false;
  }
  return !touches(after, view, centre, kSnap);
}

/// Pixels that had a face before and have none after, as far as that is certain.
std::size_t count_lost(const Grid<PrimitiveId>& had, const Grid<PrimitiveId>& has,
                       const TriangleMesh& before, const TriangleMesh& after, const View& view) {
  std::size_t lost = 0;
  for (int y = 0; y < view.extent().height; ++y) {
    for (Pixel p{0, y}; p.x < view.extent().width; ++p.x) {
      if (had[p] == kNoPrimitive || has[p] != kNoPrimitive) continue;
      lost += has_lost(before, after, view, p) ? 1 : 0;
    }
  }
  return lost;
}

std::size_t count_lost_pixels(const TriangleMesh& before, const TriangleMesh& after,
                              const View& view) {
  return count_lost(draw(before, view).id, draw(after, view).id, before, after, view);
}

/// Samples on a face before, none of which lies twice as far from the surface after.
std::size_t count_lost_matches(const TriangleMesh& before, const TriangleMesh& after,
                               const Scan& scan) {
  constexpr double kBand = 1.5;
  CpuRasterizer rasterizer;
  const auto faces = [&](const TriangleMesh& mesh, double band) {
    return find_correspondence(rasterizer, scan.image, scan.slopes, mesh, {.band = band}).face;
  };
  return count_lost(faces(before, kBand), faces(after, 2.0 * kBand), before, after,
                    scan.image.view());
}

std::size_t count_lost_points(const TriangleMesh& before, const TriangleMesh& after,
                              std::span<const Vec3> points, double pixel_size) {
  const std::vector<std::uint8_t> covered = covered_points(points, before, pixel_size);
  const std::vector<std::uint8_t> left = covered_points(points, after, 2.0 * pixel_size);
  std::size_t lost = 0;
  for (std::size_t i = 0; i < points.size(); ++i)
    lost += covered[i] != 0 && left[i] == 0 ? 1 : 0;
  return lost;
}

/// The corners' coordinates, from the lowest corner on.
using FacePlace = std::array<double, 9>;

FacePlace place_of(const TriangleMesh& mesh, const Triangle& face) {
  FacePlace lowest{};
  for (std::size_t first = 0; first < 3; ++first) {
    FacePlace place{};
    for (std::size_t k = 0; k < 9; ++k)
      place[k] = mesh.positions[face[(first + k / 3) % 3]][static_cast<int>(k % 3)];
    if (first == 0 || place < lowest) lowest = place;
  }
  return lowest;
}

/// Whether the image of the face keeps away from the box of the patch.
bool is_outside(const TriangleMesh& mesh, const Triangle& face, const View& view,
                const Box& patch) {
  constexpr double kReach = 10.0;  // pixels
  Box image;
  for (const std::uint32_t v : face) {
    const Vec3& p = mesh.positions[v];
    if (view.is_perspective() && view.depth_of(p) <= 0.0) return false;
    image.add(view.window_from_world(p));
  }
  return image.upper.x < patch.lower.x - kReach || image.lower.x > patch.upper.x + kReach ||
         image.upper.y < patch.lower.y - kReach || image.lower.y > patch.upper.y + kReach;
}

std::size_t count_changed_outside(const TriangleMesh& before, const TriangleMesh& after,
                                  const Scan& scan) {
  Box patch;
  for (const Pixel p : scan.patch.pixels)
    patch.add(Vec3{p.x + 0.5, p.y + 0.5, 0.0});
  std::vector<FacePlace> places;
  for (const Triangle& face : after.triangles)
    places.push_back(place_of(after, face));
  std::ranges::sort(places);
  return static_cast<std::size_t>(
      std::ranges::count_if(before.triangles, [&](const Triangle& face) {
        return is_outside(before, face, scan.image.view(), patch) &&
               !std::ranges::binary_search(places, place_of(before, face));
      }));
}

void judge_topology(const TriangleMesh& mesh, Faults& faults) {
  const compare::MeshVerdict verdict = compare::judge_mesh(mesh);
  if (!verdict.is_manifold) {
    faults.not_manifold = 1;
    faults.misoriented_edges = report_mesh(mesh).misoriented_edges;
    return;
  }
  faults.self_intersections = verdict.self_intersections;
  faults.degenerate_faces = verdict.degenerate_faces;
}

void judge_coverage(const TriangleMesh& before, const TriangleMesh& after, const Scan& scan,
                    std::span<const Vec3> points, double pixel_size, Faults& faults) {
  pixel_size = std::max(pixel_size, pixel_sides_of(scan.patch, scan.image).largest);
  faults.lost_pixels = count_lost_pixels(before, after, scan.image.view());
  faults.lost_matches = count_lost_matches(before, after, scan);
  faults.lost_points = count_lost_points(before, after, points, pixel_size);
  faults.changed_outside = count_changed_outside(before, after, scan);
}

void add_repairs(const StitchReport& report, Outcome& outcome) {
  outcome.repairs["crossing_seam_faces"] += report.crossing_seam_faces;
  outcome.repairs["crossing_patch_faces"] += report.crossing_patch_faces;
  outcome.repairs["withdrawn_faces"] += report.withdrawn_faces;
  outcome.repairs["patch_faces"] += report.patch_faces;
  outcome.repairs["patches"] += report.patch_faces + report.withdrawn_faces > 0 ? 1 : 0;
  outcome.repairs["patches_given_up"] +=
      report.patch_faces == 0 && report.withdrawn_faces > 0 ? 1 : 0;
}

std::string kind_of(const Command& command) {
  const auto* scan = std::get_if<AddScan>(&command);
  if (scan == nullptr) return "erase";
  return scan->stitch.method == StitchMethod::zipper ? "zipper" : "clear_and_fill";
}

}  // namespace

std::map<std::string, std::size_t> Faults::by_cause() const {
  return {{"exceptions", exceptions},
          {"not_manifold", not_manifold},
          {"misoriented_edges", misoriented_edges},
          {"self_intersections", self_intersections},
          {"degenerate_faces", degenerate_faces},
          {"lost_pixels", lost_pixels},
          {"lost_matches", lost_matches},
          {"lost_points", lost_points},
          {"changed_outside", changed_outside}};
}

bool Faults::any() const {
  return std::ranges::any_of(by_cause(), [](const auto& entry) { return entry.second > 0; });
}

Outcome run_session(const RandomSession& session) {
  const std::vector<Vec3> points = some_points(session.scene);
  CpuRasterizer rasterizer;
  VoteCache votes;
  TriangleMesh mesh;
  Outcome outcome;
  for (const Command& command : session.commands) {
    Step step{.kind = kind_of(command)};
    try {
      CommandResult result = run_command(command, session.scene, mesh, votes, rasterizer);
      judge_topology(result.mesh, step.faults);
      if (result.scan) {
        add_repairs(result.report.stitch, outcome);
        judge_coverage(mesh, result.mesh, *result.scan, points, session.pixel_size, step.faults);
      }
      mesh = std::move(result.mesh);
    } catch (const std::exception& e) {
      step.faults.exceptions = 1;
      step.what = e.what();
    }
    const bool has_ended = step.faults.exceptions > 0;
    outcome.steps.push_back(std::move(step));
    if (has_ended) break;
  }
  outcome.faces = mesh.triangles.size();
  return outcome;
}

}  // namespace rangezip::sessions

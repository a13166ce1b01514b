#include "tests/support/random_sessions.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <exception>
#include <memory>
#include <numbers>
#include <optional>
#include <utility>

#include "compare/mesh_judge.h"
#include "core/mask/correspondence.h"
#include "core/mesh/coverage.h"
#include "core/mesh/drawable.h"
#include "core/mesh/mesh_report.h"
#include "core/session/run_command.h"
#include "core/view/view.h"
#include "raster_cpu/cpu_rasterizer.h"
#include "tests/support/shapes.h"

namespace rangezip::sessions {

namespace {

using shapes::Random;

bool coin(Random& random, double probability) {
  return random.unit() < probability;
}

std::size_t below(Random& random, std::size_t count) {
  return static_cast<std::size_t>(random.bits() % count);
}

// Models

/// An open sheet z = a (x^2 - y^2) over the square [-1, 1]^2.
TriangleSoup saddle(double bend) {
  constexpr int kCells = 24;
  TriangleSoup soup;
  for (int j = 0; j <= kCells; ++j) {
    for (int i = 0; i <= kCells; ++i) {
      const double x = 2.0 * i / kCells - 1.0;
      const double y = 2.0 * j / kCells - 1.0;
      soup.positions.emplace_back(x, y, bend * (x * x - y * y));
    }
  }
  for (std::uint32_t j = 0; j < kCells; ++j) {
    for (std::uint32_t i = 0; i < kCells; ++i) {
      const std::uint32_t a = j * (kCells + 1) + i;
      shapes::add_quad(soup, a, a + 1, a + kCells + 2, a + kCells + 1);
    }
  }
  return soup;
}

/// Overlapping spheres, the inner parts of which are left in.
TriangleSoup spheres(Random& random) {
  TriangleSoup soup;
  const std::size_t count = 2 + below(random, 4);
  for (std::size_t i = 0; i < count; ++i) {
    const double distance = 0.8 * random.unit();
    const Vec3 centre = distance * random.direction();
    soup = shapes::merged(
        std::move(soup),
        shapes::moved(shapes::sphere(random.between(0.3, 0.8), 20), shapes::translation(centre)));
  }
  return soup;
}

TriangleSoup make_body(Random& random, std::string& name) {
  constexpr std::array<const char*, 11> kNames{"sphere",      "torus",  "box",    "plate",
                                               "two spheres", "saddle", "washer", "spheres",
                                               "pocket",      "bowl",   "shell"};
  const std::size_t which = below(random, kNames.size());
  name = kNames[which];
  switch (which) {
    case 0:
      return shapes::sphere(1.0, 24);
    case 1:
      return shapes::torus(1.0, random.between(0.2, 0.6), 48);
    case 2:
      return shapes::box({-1.0, -0.7, -0.4}, {1.0, 0.6, random.between(0.0, 1.0)});
    case 3:
      return shapes::plate(random.between(0.01, 0.15));
    case 4:
      return shapes::two_spheres(random.between(0.0, 0.1), 20);
    case 5:
      return saddle(random.between(0.0, 1.0));
    case 6:
      return shapes::washer(1.0, random.between(0.1, 0.8), random.between(0.1, 1.0));
    case 7:
      return spheres(random);
    case 8:
      return shapes::pocket(random.between(0.2, 1.5), random.between(0.2, 0.6));
    case 9:
      return shapes::bowl(1.0, 16);
    default:
      return shapes::shell(random.between(0.02, 0.3), 1.0, 16);
  }
}

Scene make_scene(Random& random, std::string& name) {
  TriangleSoup body = shapes::moved(make_body(random, name), shapes::tilt());
  Scene scene;
  if (coin(random, 0.3)) {
    name += " of polygons";
    scene.add(std::make_shared<const TriangleSoup>(std::move(body)));
    return scene;
  }
  constexpr double kMostNoise = 0.003;  // of the diagonal
  Box bounds;
  for (const Vec3f& p : body.positions)
    bounds.add(Vec3(p));
  const double diagonal = glm::length(bounds.upper - bounds.lower);
  const double noise = coin(random, 0.4) ? 0.0 : random.between(0.0, kMostNoise) * diagonal;
  const auto points = static_cast<std::size_t>(random.between(2'000.0, 20'000.0));
  scene.add(
      std::make_shared<const PointCloud>(shapes::sampled(body, points, random.bits(), noise)));
  return scene;
}

/// The pixel side at which a cloud is dense enough to be scanned; any for polygons.
double choose_pixel_size(const Scene& scene, Random& random) {
  const Vec3 size = scene.bounds().upper - scene.bounds().lower;
  const double longest = std::max({size.x, size.y, size.z});
  double pixels = random.between(30.0, 100.0);
  if (scene.point_count() > 0) {
    // A body of n points over about four times the square of its length: two points a pixel.
    const double dense = std::sqrt(static_cast<double>(scene.point_count()) / 8.0);
    pixels = std::clamp(dense, 25.0, 100.0) * random.between(0.7, 1.2);
  }
  return longest / pixels;
}

// Commands

/// A polygon around a random place of the image.
std::vector<Vec2> make_lasso(Random& random, Extent extent) {
  const Vec2 centre{random.between(0.2, 0.8) * extent.width,
                    random.between(0.2, 0.8) * extent.height};
  const double radius = random.between(0.1, 0.4) * std::min(extent.width, extent.height);
  const std::size_t corners = 3 + below(random, 10);
  std::vector<Vec2> lasso;
  for (std::size_t i = 0; i < corners; ++i) {
    const double angle =
        2.0 * std::numbers::pi * static_cast<double>(i) / static_cast<double>(corners);
    lasso.push_back(centre +
                    radius * random.between(0.4, 1.0) * Vec2{std::cos(angle), std::sin(angle)});
  }
  return lasso;
}

struct Shot {
  Camera camera;
  Extent extent;
};

/// A part of the scene at a finer resolution, or all of it.
Shot make_shot(Random& random, const Scene& scene, double pixel_size) {
  Box bounds = scene.bounds();
  const Vec3 direction = random.direction();
  if (coin(random, 0.25)) {
    const Vec3 middle = bounds.center();
    const double radius = 0.5 * glm::length(bounds.upper - bounds.lower);
    const double fov = random.between(0.4, 1.2);
    const double distance = radius * random.between(1.1, 1.6) / std::sin(0.5 * fov);
    const Vec3 up = std::abs(direction.y) < 0.9 ? Vec3{0, 1, 0} : Vec3{1, 0, 0};
    const int side =
        std::clamp(static_cast<int>(2.0 * distance * std::tan(0.5 * fov) / pixel_size), 24, 160);
    return {
        fit_depth_planes(
            look_at(middle + distance * direction, middle, up, Perspective{.fov_y = fov}), bounds),
        {side, side}};
  }
  double pixel = pixel_size;
  if (coin(random, 0.3)) {  // a zoom
    const double zoom = random.between(1.5, 4.0);
    const Vec3 size = bounds.upper - bounds.lower;
    const Vec3 place = bounds.lower + size * Vec3{random.unit(), random.unit(), random.unit()};
    pixel /= zoom;
    bounds = {place - 0.5 * size / zoom, place + 0.5 * size / zoom};
  }
  FramedCamera framed = frame_box(bounds, direction, pixel);
  framed.camera = fit_depth_planes(framed.camera, scene.bounds());
  return {std::move(framed.camera), framed.extent};
}

AddScan make_scan(Random& random, const Scene& scene, double pixel_size, std::uint32_t view) {
  const bool has_points = scene.point_count() > 0;
  AddScan command;
  Shot shot = make_shot(random, scene, pixel_size);
  command.scan.camera = std::move(shot.camera);
  command.scan.extent = shot.extent;
  if (coin(random, 0.35)) command.scan.region = make_lasso(random, shot.extent);
  if (has_points) {
    if (coin(random, 0.8)) command.scan.see_through = SeeThroughOptions{};
    if (coin(random, 0.8)) command.scan.plane_fit = PlaneFitOptions{};
    if (coin(random, 0.8)) command.scan.fill_holes = FillHolesOptions{};
    if (coin(random, 0.2)) command.scan.median = MedianFilterOptions{};
    if (coin(random, 0.15)) command.scan.back_side = BackSideOptions{};
    if (coin(random, 0.2)) command.scan.point_size = 2;
  }
  if (coin(random, 0.15)) {
    command.scan.correspondence.method = CorrespondenceMethod::id_buffer;
  }
  if (coin(random, 0.1)) {
    command.scan.unmatched_only = true;
    command.scan.clean_mask = {.erosions = 0, .dilations = 0};
  } else {
    if (coin(random, 0.6)) command.scan.quality = QualityMaskOptions{};
    const int erosions = static_cast<int>(below(random, 2));
    command.scan.clean_mask = {.erosions = erosions,
                               .dilations = erosions + static_cast<int>(below(random, 2))};
  }
  command.scan.triangulate = {.max_edge = 2.75,
                              .max_slope_cosine = 0.2588,
                              .min_component = coin(random, 0.7) ? std::size_t{40} : 3};
  command.stitch.method = coin(random, 0.5) ? StitchMethod::zipper : StitchMethod::clear_and_fill;
  command.stitch.view = view;
  return command;
}

EraseRegion make_erasure(Random& random, const Scene& scene, double pixel_size) {
  Shot shot = make_shot(random, scene, pixel_size);
  return {.camera = std::move(shot.camera),
          .extent = shot.extent,
          .region = make_lasso(random, shot.extent),
          .visible_only = coin(random, 0.7)};
}

// Judging

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

std::size_t count_lost_pixels(const TriangleMesh& before, const TriangleMesh& after,
                              const View& view) {
  const Framebuffer shown = draw(before, view);
  const Framebuffer left = draw(after, view);
  std::size_t lost = 0;
  for (int y = 0; y < view.extent().height; ++y) {
    for (int x = 0; x < view.extent().width; ++x) {
      if (shown.id[{x, y}] == kNoPrimitive || left.id[{x, y}] != kNoPrimitive) continue;
      lost += has_lost(before, after, view, {x, y}) ? 1 : 0;
    }
  }
  return lost;
}

/// Samples on a face before, none of which lies twice as far from the surface after.
std::size_t count_lost_matches(const TriangleMesh& before, const TriangleMesh& after,
                               const Scan& scan) {
  constexpr double kBand = 1.5;
  CpuRasterizer rasterizer;
  const auto faces = [&](const TriangleMesh& mesh, double band) {
    return find_correspondence(rasterizer, scan.image, scan.slopes, mesh, {.band = band}).face;
  };
  const Grid<PrimitiveId> matched = faces(before, kBand);
  const Grid<PrimitiveId> left = faces(after, 2.0 * kBand);
  const View& view = scan.image.view();
  std::size_t lost = 0;
  for (int y = 0; y < view.extent().height; ++y) {
    for (int x = 0; x < view.extent().width; ++x) {
      if (matched[{x, y}] == kNoPrimitive || left[{x, y}] != kNoPrimitive) continue;
      lost += has_lost(before, after, view, {x, y}) ? 1 : 0;
    }
  }
  return lost;
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
  for (const Pixel p : scan.patch.pixels)
    pixel_size = std::max(pixel_size, scan.image.pixel_size(p));
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
}

std::string kind_of(const Command& command) {
  const auto* scan = std::get_if<AddScan>(&command);
  if (scan == nullptr) return "erase";
  return scan->stitch.method == StitchMethod::zipper ? "zipper" : "clear_and_fill";
}

}  // namespace

RandomSession make_session(std::uint64_t seed, std::uint64_t number) {
  Random random(seed ^ (number * 0x9e37'79b9'7f4a'7c15U));
  RandomSession session;
  session.scene = make_scene(random, session.model);
  session.pixel_size = choose_pixel_size(session.scene, random);
  const std::size_t count = 3 + below(random, 5);
  for (std::uint32_t i = 0; i < count; ++i) {
    if (i > 0 && coin(random, 0.12)) {
      session.commands.emplace_back(make_erasure(random, session.scene, session.pixel_size));
    } else if (i > 0 && coin(random, 0.15)) {
      session.commands.push_back(session.commands.back());
    } else {
      session.commands.emplace_back(make_scan(random, session.scene, session.pixel_size, i));
    }
  }
  return session;
}

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

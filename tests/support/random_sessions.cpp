#include "tests/support/random_sessions.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <memory>
#include <numbers>
#include <utility>

#include "core/view/view.h"
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
    case 6: {
      const double height = random.between(0.1, 1.0);  // arguments have no order
      return shapes::washer(1.0, random.between(0.1, 0.8), height);
    }
    case 7:
      return spheres(random);
    case 8: {
      const double radius = random.between(0.2, 0.6);
      return shapes::pocket(random.between(0.2, 1.5), radius);
    }
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

/// All of a box under a lens, from outside.
Shot perspective_shot(Random& random, const Box& bounds, const Vec3& direction, double pixel_size) {
  const Vec3 middle = bounds.center();
  const double radius = 0.5 * glm::length(bounds.upper - bounds.lower);
  const double fov = random.between(0.4, 1.2);
  const double distance = radius * random.between(1.1, 1.6) / std::sin(0.5 * fov);
  const Vec3 up = std::abs(direction.y) < 0.9 ? Vec3{0, 1, 0} : Vec3{1, 0, 0};
  const Camera camera =
      look_at(middle + distance * direction, middle, up, Perspective{.fov_y = fov});
  const int side =
      std::clamp(static_cast<int>(2.0 * distance * std::tan(0.5 * fov) / pixel_size), 24, 160);
  return {fit_depth_planes(camera, bounds), {side, side}};
}

/// From anywhere, parallel or in perspective: all of the scene, or in parallel also a part of it at
/// a finer resolution.
Shot make_shot(Random& random, const Scene& scene, double pixel_size) {
  Box bounds = scene.bounds();
  const Vec3 direction = random.direction();
  if (coin(random, 0.25)) return perspective_shot(random, bounds, direction, pixel_size);
  double pixel = pixel_size;
  if (coin(random, 0.3)) {
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

/// Passes for what is wrong with points.
void choose_passes(Random& random, ScanRequest& scan) {
  if (coin(random, 0.8)) scan.see_through = SeeThroughOptions{};
  if (coin(random, 0.8)) scan.plane_fit = PlaneFitOptions{};
  if (coin(random, 0.8)) scan.fill_holes = FillHolesOptions{};
  if (coin(random, 0.2)) scan.median = MedianFilterOptions{};
  if (coin(random, 0.15)) scan.back_side = BackSideOptions{};
  if (coin(random, 0.2)) scan.point_size = 2;
}

/// What of the image the patch is made of.
void choose_mask(Random& random, ScanRequest& scan) {
  if (coin(random, 0.1)) {
    scan.unmatched_only = true;
    scan.clean_mask = {.erosions = 0, .dilations = 0};
    return;
  }
  if (coin(random, 0.6)) scan.quality = QualityMaskOptions{};
  const int erosions = static_cast<int>(below(random, 2));
  scan.clean_mask = {.erosions = erosions,
                     .dilations = erosions + static_cast<int>(below(random, 2))};
}

AddScan make_scan(Random& random, const Scene& scene, double pixel_size, std::uint32_t view) {
  AddScan command;
  Shot shot = make_shot(random, scene, pixel_size);
  command.scan.camera = std::move(shot.camera);
  command.scan.extent = shot.extent;
  if (coin(random, 0.35)) command.scan.region = make_lasso(random, shot.extent);
  if (scene.point_count() > 0) choose_passes(random, command.scan);
  if (coin(random, 0.15)) {
    command.scan.correspondence.method = CorrespondenceMethod::id_buffer;
  }
  choose_mask(random, command.scan);
  command.scan.triangulate = {.max_edge = 2.75,
                              .max_slope_cosine = 0.2588,
                              .min_component = coin(random, 0.7) ? std::size_t{40} : 3};
  command.stitch.method = coin(random, 0.5) ? StitchMethod::zipper : StitchMethod::clear_and_fill;
  command.stitch.withdrawal = coin(random, 0.7) ? 0 : 2;
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

}  // namespace rangezip::sessions

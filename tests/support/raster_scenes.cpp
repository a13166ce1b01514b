#include "tests/support/raster_scenes.h"

#include <algorithm>

#include "tests/support/lattice.h"
#include "tests/support/limit_scenes.h"
#include "tests/support/scene_builder.h"

namespace rangezip {

namespace {

using namespace scenes;

/// On a pixel's centre or border, or one unit beside it.
float on_lattice(Random& random, int size) {
  const int lattice = 128 * whole(random, -2, 2 * size + 2);
  return static_cast<float>(whole(random, 0, 2) == 0 ? lattice + whole(random, -1, 1) : lattice);
}

View central_view(Random& random, Extent extent) {
  const Vec3 eye{random.between(-1, 1), random.between(-1, 1), random.between(2, 4)};
  const double fov_y = random.between(0.3, 1.4);
  Camera camera = look_at(eye, {0, 0, 0}, {0, 1, 0}, Perspective{.fov_y = fov_y});
  camera.near_depth = random.between(0.5, 1.5);
  camera.far_depth = camera.near_depth + random.between(1.0, 5.0);
  return View(camera, extent);
}

std::vector<Vec3f> random_positions(Random& random, int count, double radius) {
  std::vector<Vec3f> positions;
  for (int i = 0; i < count; ++i) {
    positions.push_back(Vec3f{random.between(-radius, radius), random.between(-radius, radius),
                              random.between(-radius, radius)});
  }
  return positions;
}

RasterScene lattice_points(Random& random) {
  const Extent extent = random_extent(random);
  SceneBuilder builder = lattice_builder(extent);
  for (int item = 0; item < 2; ++item) {
    std::vector<Vec3f> positions;
    for (int i = 0; i < 120; ++i) {
      positions.push_back(Vec3f{on_lattice(random, extent.width), on_lattice(random, extent.height),
                                random_depth(random)});
    }
    builder.add_points(std::move(positions), whole(random, 1, 8));
  }
  return builder.take();
}

RasterScene scattered_points(Random& random) {
  const Extent extent = random_extent(random);
  SceneBuilder builder = lattice_builder(extent);
  for (int item = 0; item < 3; ++item) {
    std::vector<Vec3f> positions;
    for (int i = 0; i < 100; ++i) {
      // Halves of the grid's unit: rounding to even decides.
      positions.push_back(Vec3f{anywhere(random, extent.width, 20) * 0.5F,
                                anywhere(random, extent.height, 20) * 0.5F, random_depth(random)});
      if (whole(random, 0, 30) == 0) {
        positions.back()[whole(random, 0, 2)] =
            whole(random, 0, 1) == 0 ? not_finite(random) : 1e7F;
      }
    }
    auto votes = random_votes(random, positions.size());
    builder.add_points(std::move(positions), item == 0 ? 31 : whole(random, 1, 8),
                       std::move(votes));
  }
  return builder.take();
}

RasterScene central_points(Random& random) {
  const Extent extent = random_extent(random);
  SceneBuilder builder(central_view(random, extent), Mat4{1.0});
  for (const int size : {1, whole(random, 1, 5)}) {
    auto positions = random_positions(random, 150, 3.0);
    auto votes = random_votes(random, positions.size());
    builder.add_points(std::move(positions), size, std::move(votes));
  }
  return builder.take();
}

RasterScene lattice_triangles(Random& random) {
  const Extent extent = random_extent(random);
  SceneBuilder builder = lattice_builder(extent);
  std::vector<Vec3f> positions;
  for (int i = 0; i < 3 * 60; ++i) {
    positions.push_back(Vec3f{on_lattice(random, extent.width), on_lattice(random, extent.height),
                              random_depth(random)});
  }
  builder.add_soup(std::move(positions), random_facing(random));
  return builder.take();
}

RasterScene tiny_triangles(Random& random) {
  const Extent extent = random_extent(random);
  SceneBuilder builder = lattice_builder(extent);
  std::vector<Vec3f> positions;
  for (int i = 0; i < 150; ++i) {
    const float x = anywhere(random, extent.width, 1);
    const float y = anywhere(random, extent.height, 1);
    for (int corner = 0; corner < 3; ++corner) {
      positions.push_back(Vec3f{x + static_cast<float>(whole(random, -200, 200)),
                                y + static_cast<float>(whole(random, -200, 200)),
                                random_depth(random)});
    }
  }
  builder.add_soup(std::move(positions), random_facing(random));
  return builder.take();
}

RasterScene slivers(Random& random) {
  const Extent extent = random_extent(random);
  SceneBuilder builder = lattice_builder(extent);
  std::vector<Vec3f> positions;
  for (int i = 0; i < 80; ++i) {
    const Vec3f a{anywhere(random, extent.width, 10), anywhere(random, extent.height, 10),
                  random_depth(random)};
    const Vec3f b{anywhere(random, extent.width, 10), anywhere(random, extent.height, 10),
                  random_depth(random)};
    const Vec3f offset{whole(random, -3, 3), whole(random, -3, 3), whole(random, -50, 50)};
    positions.insert(positions.end(), {a, b, b + offset});
  }
  builder.add_soup(std::move(positions));
  return builder.take();
}

RasterScene wide_triangles(Random& random) {
  const Extent extent = random_extent(random);
  SceneBuilder builder = lattice_builder(extent);
  std::vector<Vec3f> positions;
  for (int i = 0; i < 3 * 40; ++i) {
    // The last is the whole guard range: areas up to 2^46, the longest numerators of R7.
    const int reach = std::array{50, 700, 7000, 16384}[static_cast<std::size_t>(i / 3 % 4)] * 256;
    positions.push_back(Vec3f{whole(random, -reach, reach), whole(random, -reach, reach),
                              whole(random, 0, 1) == 0
                                  ? random_depth(random)
                                  : static_cast<float>(whole(random, -(1 << 25), 1 << 25))});
  }
  builder.add_soup(std::move(positions), random_facing(random));
  return builder.take();
}

RasterScene plane_crossing(Random& random) {
  const Extent extent = random_extent(random);
  SceneBuilder builder = lattice_builder(extent);
  std::vector<Vec3f> positions;
  for (int i = 0; i < 3 * 40; ++i) {
    positions.push_back(Vec3f{anywhere(random, extent.width, 5), anywhere(random, extent.height, 5),
                              whole(random, -(1 << 24), 1 << 25)});
    if (whole(random, 0, 60) == 0) positions.back()[whole(random, 0, 2)] = not_finite(random);
    // Far outside of the guard range: cut before it is drawn.
    if (whole(random, 0, 20) == 0) positions.back()[whole(random, 0, 2)] *= 1e5F;
  }
  builder.add_soup(std::move(positions));
  return builder.take();
}

RasterScene duplicates(Random& random) {
  const Extent extent = random_extent(random);
  SceneBuilder builder = lattice_builder(extent);
  std::vector<Vec3f> positions;
  std::vector<Triangle> corners;
  for (std::uint32_t i = 0; i < 3 * 20; ++i) {
    positions.push_back(Vec3f{anywhere(random, extent.width, 3), anywhere(random, extent.height, 3),
                              random_depth(random)});
  }
  for (int i = 0; i < 100; ++i) {
    const auto first = static_cast<std::uint32_t>(3 * whole(random, 0, 19));
    Triangle triangle{first, first + 1, first + 2};
    std::rotate(triangle.begin(), triangle.begin() + whole(random, 0, 2), triangle.end());
    if (whole(random, 0, 1) == 0) std::swap(triangle[0], triangle[1]);
    corners.push_back(triangle);
  }
  builder.add_triangles(std::move(positions), std::move(corners), random_facing(random));
  return builder.take();
}

RasterScene shared_edges(Random& random) {
  const Extent extent = random_extent(random);
  SceneBuilder builder = lattice_builder(extent);
  constexpr std::uint32_t kSide = 9;
  std::vector<Vec3f> positions;
  std::vector<Triangle> corners;
  const int pitch = whole(random, 1, 6) * 128;
  const int jitter = whole(random, 0, 1) == 0 ? 0 : pitch / 3;
  for (int y = 0; y < static_cast<int>(kSide); ++y) {
    for (int x = 0; x < static_cast<int>(kSide); ++x) {
      positions.push_back(Vec3f{x * pitch + whole(random, -jitter, jitter),
                                y * pitch + whole(random, -jitter, jitter), random_depth(random)});
    }
  }
  for (std::uint32_t y = 0; y + 1 < kSide; ++y) {
    for (std::uint32_t x = 0; x + 1 < kSide; ++x) {
      const std::uint32_t a = y * kSide + x;
      corners.push_back({a, a + 1, a + kSide + 1});
      corners.push_back({a, a + kSide + 1, a + kSide});
    }
  }
  builder.add_triangles(std::move(positions), std::move(corners));
  return builder.take();
}

RasterScene central_triangles(Random& random) {
  const Extent extent = random_extent(random);
  SceneBuilder builder(central_view(random, extent), Mat4{1.0});
  // The larger ones reach behind the eye.
  const Facing facing = random_facing(random);
  builder.add_soup(random_positions(random, 3 * 30, 1.5), facing);
  builder.add_soup(random_positions(random, 3 * 30, 6.0));
  return builder.take();
}

RasterScene mixed_and_clipped(Random& random) {
  const Extent extent = random_extent(random);
  Camera camera = central_view(random, extent).camera();
  if (whole(random, 0, 1) == 0) camera.lens = Orthographic{.height = random.between(0.5, 4.0)};
  for (int i = whole(random, 1, 3); i > 0; --i) {
    camera.clip_planes.push_back({random.direction(), random.between(-0.2, 0.8)});
  }
  SceneBuilder builder(View(camera, extent), Mat4{1.0});
  const int size = whole(random, 1, 4);
  const Facing facing = random_facing(random);
  builder.add_points(random_positions(random, 100, 2.0), size);
  builder.add_soup(random_positions(random, 3 * 30, 2.0), facing);
  builder.add_points(random_positions(random, 100, 2.0), size);
  return builder.take();
}

RasterScene scene_of(SceneFamily family, Random& random) {
  switch (family) {
    case SceneFamily::lattice_points:
      return lattice_points(random);
    case SceneFamily::scattered_points:
      return scattered_points(random);
    case SceneFamily::central_points:
      return central_points(random);
    case SceneFamily::lattice_triangles:
      return lattice_triangles(random);
    case SceneFamily::tiny_triangles:
      return tiny_triangles(random);
    case SceneFamily::slivers:
      return slivers(random);
    case SceneFamily::wide_triangles:
      return wide_triangles(random);
    case SceneFamily::plane_crossing:
      return plane_crossing(random);
    case SceneFamily::duplicates:
      return duplicates(random);
    case SceneFamily::shared_edges:
      return shared_edges(random);
    case SceneFamily::central_triangles:
      return central_triangles(random);
    case SceneFamily::mixed_and_clipped:
      return mixed_and_clipped(random);
    case SceneFamily::point_sizes:
      return point_sizes(random);
    case SceneFamily::image_shapes:
      return image_shapes(random);
    case SceneFamily::guard_range:
      return guard_range(random);
    case SceneFamily::near_the_eye:
      return near_the_eye(random);
    case SceneFamily::denormals:
      return denormals(random);
    case SceneFamily::central_lattice:
      break;
  }
  return central_lattice(random);
}

/// The first twelve families keep the seeds under which their hashes were put on file.
std::uint64_t seed_of(SceneFamily family, std::uint64_t seed) {
  constexpr std::uint64_t kFirstFamilies = 12;
  const auto index = static_cast<std::uint64_t>(family);
  return index < kFirstFamilies ? seed * kFirstFamilies + index : (index << 32U) + seed;
}

}  // namespace

std::string name_of(SceneFamily family) {
  static const std::array<std::string, kSceneFamilies> names{
      "lattice_points", "scattered_points", "central_points",    "lattice_triangles",
      "tiny_triangles", "slivers",          "wide_triangles",    "plane_crossing",
      "duplicates",     "shared_edges",     "central_triangles", "mixed_and_clipped",
      "point_sizes",    "image_shapes",     "guard_range",       "near_the_eye",
      "denormals",      "central_lattice"};
  return names[static_cast<std::size_t>(family)];
}

RasterScene make_raster_scene(SceneFamily family, std::uint64_t seed) {
  Random random(seed_of(family, seed));
  return scene_of(family, random);
}

DepthBand random_band(const Framebuffer& image, std::uint64_t seed) {
  Random random(seed);
  DepthBand band = lattice::whole_band(image.depth.extent());
  for (std::size_t i = 0; i < image.depth.pixels().size(); ++i) {
    const std::uint32_t depth = image.depth.pixels()[i];
    if (depth == kNoDepth) continue;
    const auto d = static_cast<std::int32_t>(depth);
    // Just behind the nearest, up to it, or nothing.
    const int kind = whole(random, 0, 3);
    band.lower.pixels()[i] = kind == 0 ? d + 1 : 0;
    band.upper.pixels()[i] = kind == 1 ? d : (kind == 2 ? -1 : 1 << 25);
  }
  return band;
}

}  // namespace rangezip

#include "tests/support/large_scenes.h"

#include <algorithm>
#include <array>

#include "tests/support/lattice.h"
#include "tests/support/scene_builder.h"

namespace rangezip {

namespace {

using namespace scenes;

std::vector<Vec3f> scattered(Random& random, Extent extent, int count) {
  std::vector<Vec3f> positions;
  positions.reserve(static_cast<std::size_t>(count));
  for (int i = 0; i < count; ++i) {
    positions.push_back(Vec3f{anywhere(random, extent.width, 4), anywhere(random, extent.height, 4),
                              random_depth(random)});
  }
  return positions;
}

void add_voting_points(SceneBuilder& builder, Random& random, std::vector<Vec3f> positions,
                       int size) {
  auto votes = random_votes(random, positions.size());
  builder.add_points(std::move(positions), size, std::move(votes));
}

RasterScene cloud(Random& random, Extent extent, int primitives) {
  SceneBuilder builder = lattice_builder(extent);
  const int part = primitives / whole(random, 2, 9);
  for (const int count : {1, part, 0, 77, primitives - part})
    add_voting_points(builder, random, scattered(random, extent, count), 1);
  return builder.take();
}

RasterScene clustered(Random& random, Extent extent, int primitives) {
  SceneBuilder builder = lattice_builder(extent);
  const Extent corner{std::min(extent.width, 50), std::min(extent.height, 70)};
  add_voting_points(builder, random, scattered(random, corner, primitives - primitives / 20), 1);
  add_voting_points(builder, random, scattered(random, extent, primitives / 20), 2);
  return builder.take();
}

RasterScene splats(Random& random, Extent extent, int primitives) {
  SceneBuilder builder = lattice_builder(extent);
  for (int size = 2; size <= 8; ++size)
    add_voting_points(builder, random, scattered(random, extent, primitives / 7), size);
  add_voting_points(builder, random, scattered(random, extent, 100), 31);
  add_voting_points(builder, random, scattered(random, extent, 4), 255);
  return builder.take();
}

/// A grid of corners over the image and a little beyond, two triangles a cell.
RasterScene mesh(Random& random, Extent extent, int primitives) {
  SceneBuilder builder = lattice_builder(extent);
  // Half pixels at least, so that corners and edges meet pixel centres.
  int pitch = 128;
  const auto cells = [&](int size) { return size * 256 / pitch + 2; };
  while (2LL * cells(extent.width) * cells(extent.height) > primitives)
    pitch += 128;
  const int columns = cells(extent.width);
  const int rows = cells(extent.height);
  std::vector<Vec3f> positions;
  for (int y = 0; y <= rows; ++y) {
    for (int x = 0; x <= columns; ++x) {
      const int jitter = whole(random, 0, 3) == 0 ? pitch / 3 : 0;
      positions.push_back(Vec3f{(x - 1) * pitch + whole(random, -jitter, jitter),
                                (y - 1) * pitch + whole(random, -jitter, jitter),
                                random_depth(random)});
    }
  }
  std::vector<Triangle> corners;
  const auto row = static_cast<std::uint32_t>(columns + 1);
  for (std::uint32_t y = 0; y < static_cast<std::uint32_t>(rows); ++y) {
    for (std::uint32_t a = y * row; a + 1 < (y + 1) * row; ++a) {
      corners.push_back({a, a + 1, a + row + 1});
      corners.push_back({a, a + row + 1, a + row});
    }
  }
  builder.add_triangles(std::move(positions), std::move(corners));
  return builder.take();
}

/// Corners within `reach` pixels of their first one.
void append_triangles(Random& random, Extent extent, int count, double reach,
                      std::vector<Vec3f>& positions) {
  const int span = static_cast<int>(reach * 256.0);
  for (int i = 0; i < count; ++i) {
    const float x = anywhere(random, extent.width, 4);
    const float y = anywhere(random, extent.height, 4);
    for (int corner = 0; corner < 3; ++corner) {
      positions.push_back(Vec3f{x + static_cast<float>(whole(random, -span, span)),
                                y + static_cast<float>(whole(random, -span, span)),
                                random_depth(random)});
    }
  }
}

RasterScene soup(Random& random, Extent extent, int primitives) {
  SceneBuilder builder = lattice_builder(extent);
  std::vector<Vec3f> small;
  append_triangles(random, extent, primitives / 2, 0.7, small);
  builder.add_soup(std::move(small), random_facing(random));
  std::vector<Vec3f> medium;
  append_triangles(random, extent, primitives / 2, 3.0, medium);
  append_triangles(random, extent, primitives / 1000, 40.0, medium);
  builder.add_soup(std::move(medium));
  std::vector<Vec3f> wide;
  append_triangles(random, extent, 3, 500.0, wide);
  append_triangles(random, extent, 3, 7000.0, wide);
  builder.add_soup(std::move(wide));
  return builder.take();
}

std::vector<Vec3f> in_cube(Random& random, int count, double radius) {
  std::vector<Vec3f> positions;
  positions.reserve(static_cast<std::size_t>(count));
  for (int i = 0; i < count; ++i) {
    positions.push_back(Vec3f{random.between(-radius, radius), random.between(-radius, radius),
                              random.between(-radius, radius)});
  }
  return positions;
}

RasterScene central(Random& random, Extent extent, int primitives) {
  // The eye stands inside of the cube.
  Camera camera = look_at({0.1, -0.2, 1.5}, {0, 0, 0}, {0, 1, 0}, Perspective{.fov_y = 1.0});
  camera.near_depth = random.between(0.1, 0.5);
  camera.far_depth = camera.near_depth + random.between(1.0, 4.0);
  SceneBuilder builder(View(camera, extent), Mat4{1.0});
  add_voting_points(builder, random, in_cube(random, primitives / 4, 2.0), 1);
  const int size = whole(random, 2, 5);
  add_voting_points(builder, random, in_cube(random, primitives / 4, 2.0), size);
  const int triangles = primitives / 2;
  std::vector<Vec3f> corners;
  corners.reserve(3 * static_cast<std::size_t>(triangles));
  for (const Vec3f& center : in_cube(random, triangles, 2.0)) {
    for (int corner = 0; corner < 3; ++corner) {
      const Vec3f offset{random.between(-0.01, 0.01), random.between(-0.01, 0.01),
                         random.between(-0.01, 0.01)};
      corners.push_back(center + offset);
    }
  }
  builder.add_soup(std::move(corners), random_facing(random));
  builder.add_soup(in_cube(random, 3 * 4, 2.0));
  return builder.take();
}

RasterScene layers(Random& random, Extent extent, int primitives) {
  SceneBuilder builder = lattice_builder(extent);
  const int part = primitives / 5;
  std::vector<Vec3f> points;
  for (int i = 0; i < part; ++i) {
    const int x = whole(random, 0, extent.width - 1);
    const int y = whole(random, 0, extent.height - 1);
    points.push_back(Vec3f{lattice::px(x), lattice::px(y), 1000 * whole(random, 1, 3)});
  }
  std::vector<Vec3f> corners;
  append_triangles(random, extent, part, 2.0, corners);
  for (Vec3f& corner : corners)
    corner.z = 2000.0F;
  add_voting_points(builder, random, points, 1);
  builder.add_soup(corners);
  add_voting_points(builder, random, points, 2);
  builder.add_soup(corners);
  add_voting_points(builder, random, std::move(points), 1);
  return builder.take();
}

}  // namespace

std::string name_of(LargeScene kind) {
  static const std::array<std::string, kLargeScenes> names{"cloud", "clustered", "splats", "mesh",
                                                           "soup",  "central",   "layers"};
  return "large_" + names[static_cast<std::size_t>(kind)];
}

RasterScene make_large_scene(LargeScene kind, Extent extent, int primitives, std::uint64_t seed) {
  Random random(((1000 + static_cast<std::uint64_t>(kind)) << 32U) + seed);
  switch (kind) {
    case LargeScene::cloud:
      return cloud(random, extent, primitives);
    case LargeScene::clustered:
      return clustered(random, extent, primitives);
    case LargeScene::splats:
      return splats(random, extent, primitives);
    case LargeScene::mesh:
      return mesh(random, extent, primitives);
    case LargeScene::soup:
      return soup(random, extent, primitives);
    case LargeScene::central:
      return central(random, extent, primitives);
    case LargeScene::layers:
      break;
  }
  return layers(random, extent, primitives);
}

}  // namespace rangezip

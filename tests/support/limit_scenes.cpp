#include "tests/support/limit_scenes.h"

#include <array>
#include <cmath>
#include <limits>

#include "core/raster/row_transform.h"
#include "tests/support/lattice.h"

namespace rangezip::scenes {

namespace {

template <class T, std::size_t kCount>
T one_of(Random& random, const std::array<T, kCount>& values) {
  return values[static_cast<std::size_t>(whole(random, 0, static_cast<int>(kCount) - 1))];
}

int random_size(Random& random) {
  return one_of(random, std::array{1, 2, 3, 4, 5, 6, 7, 8, 31, 255});
}

std::vector<Vec3f> points_around(Random& random, Extent extent, int count, int margin) {
  std::vector<Vec3f> positions;
  for (int i = 0; i < count; ++i) {
    positions.push_back(Vec3f{anywhere(random, extent.width, margin),
                              anywhere(random, extent.height, margin), random_depth(random)});
  }
  return positions;
}

/// Wider or taller than a vector or a tile, and the smallest there are.
Extent random_shape(Random& random) {
  const int shorter = one_of(random, std::array{1, 1, 2, 3, 5});
  const int longer =
      one_of(random, std::array{1, 2, 7, 15, 17, 31, 33, 63, 65, 127, 129, 255, 257});
  return whole(random, 0, 1) == 0 ? Extent{shorter, longer} : Extent{longer, shorter};
}

/// A number at, just inside or just outside of +-limit, or +-7000 px, or on screen.
float near_limit(Random& random, float limit, float on_screen) {
  const float sign = whole(random, 0, 1) == 0 ? 1.0F : -1.0F;
  switch (whole(random, 0, 7)) {
    case 0:
      return sign * limit;
    case 1:
      return sign * std::nextafter(limit, 0.0F);
    case 2:
      return sign * std::nextafter(limit, 2.0F * limit);
    case 3:
      return sign * lattice::px(7000);
    default:
      return on_screen;
  }
}

Vec3f guarded_position(Random& random, Extent extent) {
  constexpr auto kXY = static_cast<float>(kGuardXY);
  constexpr auto kZ = static_cast<float>(kGuardZ);
  const float x = anywhere(random, extent.width, 1);
  const float y = anywhere(random, extent.height, 1);
  const float z = random_depth(random);
  // In braces: in this order.
  return Vec3f{near_limit(random, kXY, x), near_limit(random, kXY, y), near_limit(random, kZ, z)};
}

/// An eye depth of a scene in which 1 is an ordinary one: mostly that, else behind the eye, on it,
/// or at an end of the range of w.
double random_w(Random& random, double unit) {
  switch (whole(random, 0, 9)) {
    case 0:
      return 0.0;
    case 1:
      return -unit * random.between(0.0, 3.0);
    case 2: {
      const int exponent = whole(random, 0, 1) == 0 ? -64 : 64;
      return std::ldexp(random.between(0.5, 2.0), exponent);
    }
    case 3:
      return std::ldexp(1.0, whole(random, 0, 1) == 0 ? -64 : 64);
    default:
      return unit * random.between(0.3, 4.0);
  }
}

/// Seen `window` half images away from the axis: 1 is the upper border, large ones are at the ends
/// of the guard range.
Vec3f seen_position(Random& random, double unit, int height) {
  const double w = random_w(random, unit);
  const double guard = 2.0 * 16384.0 / height;
  std::array<double, 2> at{};
  for (double& coordinate : at) {
    coordinate = random.between(-1.5, 1.5);
    if (whole(random, 0, 6) == 0) coordinate = guard * (whole(random, 0, 1) == 0 ? 1.0 : -1.0);
    // Where w is not positive, the ray through a window position does not say where to be.
    coordinate *= w > 0.0 ? w : unit;
  }
  Vec3f position{at[0], at[1], -w};
  if (whole(random, 0, 40) == 0) position[whole(random, 0, 2)] = not_finite(random);
  return position;
}

std::vector<Vec3f> seen_positions(Random& random, int count, double unit, int height) {
  std::vector<Vec3f> positions;
  for (int i = 0; i < count; ++i)
    positions.push_back(seen_position(random, unit, height));
  return positions;
}

/// In 1/256 px: on a pixel's centre or border, or next to it, or half a unit before one of these.
double on_half(Random& random, int size) {
  const int unit = 128 * whole(random, -2, 2 * size + 2) + whole(random, -1, 1);
  return unit - 0.5 * whole(random, 0, 1);
}

/// Under a view of 90 degrees, whose rows are multiples of 128: nothing is rounded before R4, if
/// the height is a power of two.
std::vector<Vec3f> on_halves(Random& random, Extent extent, int count) {
  std::vector<Vec3f> positions;
  for (int i = 0; i < count; ++i) {
    const double w = one_of(random, std::array{0.75, 1.0, 1.25, 2.0, 3.0, 5.0});
    const double scale = w / (128.0 * extent.height);
    const double x = on_half(random, extent.width) - 128.0 * extent.width;
    const double y = on_half(random, extent.height) - 128.0 * extent.height;
    positions.push_back(Vec3f{x * scale, y * scale, -w});
  }
  return positions;
}

/// Below the least normal float, of either sign.
float denormal(Random& random) {
  const float size = std::ldexp(static_cast<float>(whole(random, 0, (1 << 23) - 1)), -149);
  return whole(random, 0, 1) == 0 ? size : -size;
}

}  // namespace

RasterScene point_sizes(Random& random) {
  const Extent extent = random_extent(random);
  SceneBuilder builder = lattice_builder(extent);
  for (int item = 0; item < 4; ++item) {
    const int size = random_size(random);
    auto positions = points_around(random, extent, 40, size / 2 + 2);
    auto votes = random_votes(random, positions.size());
    builder.add_points(std::move(positions), size, std::move(votes));
  }
  return builder.take();
}

RasterScene image_shapes(Random& random) {
  const Extent extent = random_shape(random);
  SceneBuilder builder = lattice_builder(extent);
  // Counts that leave a rest beside whole vectors.
  for (const int count : {1, whole(random, 0, 70)}) {
    const int size = whole(random, 1, 8);
    auto positions = points_around(random, extent, count, 2);
    auto votes = random_votes(random, positions.size());
    builder.add_points(std::move(positions), size, std::move(votes));
  }
  const int triangles = whole(random, 0, 40);
  auto corners = points_around(random, extent, 3 * triangles, 3);
  builder.add_soup(std::move(corners), random_facing(random));
  return builder.take();
}

RasterScene guard_range(Random& random) {
  const Extent extent = random_extent(random);
  SceneBuilder builder = lattice_builder(extent);
  for (const int size : {1, random_size(random)}) {
    std::vector<Vec3f> positions;
    for (int i = 0; i < 100; ++i)
      positions.push_back(guarded_position(random, extent));
    auto votes = random_votes(random, positions.size());
    builder.add_points(std::move(positions), size, std::move(votes));
  }
  std::vector<Vec3f> corners;
  for (int i = 0; i < 3 * 60; ++i)
    corners.push_back(guarded_position(random, extent));
  builder.add_soup(std::move(corners), random_facing(random));
  return builder.take();
}

RasterScene near_the_eye(Random& random) {
  const Extent extent = random_extent(random);
  // The whole scene is scaled so that the range of w ends between the planes, or far from them.
  const double unit = std::ldexp(1.0, one_of(random, std::array{-64, 0, 63}));
  const View view({.lens = Perspective{.fov_y = 2.0 * std::atan(1.0)},
                   .near_depth = 0.5 * unit,
                   .far_depth = 3.5 * unit},
                  extent);
  SceneBuilder builder(view, Mat4{1.0});
  for (const int size : {1, random_size(random)}) {
    auto positions = seen_positions(random, 100, unit, extent.height);
    auto votes = random_votes(random, positions.size());
    builder.add_points(std::move(positions), size, std::move(votes));
  }
  auto corners = seen_positions(random, 3 * 40, unit, extent.height);
  builder.add_soup(std::move(corners), random_facing(random));
  return builder.take();
}

RasterScene central_lattice(Random& random) {
  const int width = whole(random, 1, 40);
  const Extent extent{width, 1 << whole(random, 0, 5)};
  const View view(
      {.lens = Perspective{.fov_y = 2.0 * std::atan(1.0)}, .near_depth = 0.5, .far_depth = 8.0},
      extent);
  SceneBuilder builder(view, Mat4{1.0});
  for (const int size : {1, whole(random, 1, 5)}) {
    auto positions = on_halves(random, extent, 120);
    auto votes = random_votes(random, positions.size());
    builder.add_points(std::move(positions), size, std::move(votes));
  }
  auto corners = on_halves(random, extent, 3 * 30);
  builder.add_soup(std::move(corners), random_facing(random));
  return builder.take();
}

RasterScene denormals(Random& random) {
  const Extent extent = random_extent(random);
  // The clip plane is the front plane: a denormal of the wrong sign is outside of it.
  Camera camera = lattice::view(extent).camera();
  if (whole(random, 0, 1) == 0) camera.clip_planes.push_back({{0.0, 0.0, -1.0}, 0.0});
  SceneBuilder builder(View(camera, extent), lattice::placement(extent));

  std::vector<Vec3f> flat;  // of depth 0, or clipped
  for (int i = 0; i < 60; ++i) {
    flat.push_back(Vec3f{anywhere(random, extent.width, 1), anywhere(random, extent.height, 1),
                         denormal(random)});
  }
  auto votes = random_votes(random, flat.size());
  builder.add_points(flat, whole(random, 1, 3), std::move(votes));
  builder.add_soup(std::move(flat), random_facing(random));

  // Rows of 2^127: depths of a few units are denormal positions.
  Mat4 magnified = lattice::placement(extent);
  constexpr double kMagnified = 0x1p127;
  for (int axis = 0; axis < 3; ++axis)
    magnified[axis] *= kMagnified;
  builder.set_placement(magnified);
  std::vector<Vec3f> tiny;
  for (int i = 0; i < 150; ++i) {
    const double x = anywhere(random, extent.width, 1) / kMagnified;
    const double y = anywhere(random, extent.height, 1) / kMagnified;
    tiny.push_back(Vec3f{x, y, denormal(random)});
  }
  auto tiny_votes = random_votes(random, tiny.size());
  builder.add_points(tiny, whole(random, 1, 3), std::move(tiny_votes));
  builder.add_soup(std::move(tiny), random_facing(random));
  return builder.take();
}

}  // namespace rangezip::scenes

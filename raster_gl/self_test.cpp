#include "raster_gl/self_test.h"

#include <cstddef>
#include <cstdint>
#include <functional>
#include <limits>
#include <vector>

#include "raster_gl/plain_drawing.h"

namespace rangezip {

namespace {

constexpr Extent kExtent{64, 64};
constexpr int kSide = 64 * 256;  ///< of the image, in units of the grid

/// Positions of the scenes are integers of the window's grid, or near to them.
Camera lattice_camera() {
  return {.lens = Orthographic{.height = kExtent.height}, .near_depth = 0.0, .far_depth = 1.0};
}

Mat4 lattice_placement() {
  Mat4 m{1.0};
  m[0][0] = m[1][1] = 0x1p-8;
  m[2][2] = -0x1p-24;
  m[3] = {-0.5 * kExtent.width, -0.5 * kExtent.height, 0.0, 1.0};
  return m;
}

/// One item, and the rule that decides its pixels.
struct Trial {
  const char* rule;
  Extent extent = kExtent;
  Camera camera = lattice_camera();
  Mat4 placement = lattice_placement();
  std::vector<Vec3f> positions;
  int point_size = 0;  ///< 0: each three positions are a triangle
  Facing facing = Facing::both;
  bool has_band = false;
};

/// The same numbers everywhere.
class Random {
 public:
  int whole(int lower, int upper) {
    const auto count = static_cast<std::uint32_t>(upper - lower + 1);
    return lower + static_cast<int>(bits() % count);
  }
  /// whole(), as a coordinate.
  float number(int lower, int upper) { return static_cast<float>(whole(lower, upper)); }
  float between(float lower, float upper) {
    return lower + (upper - lower) * static_cast<float>(bits()) * 0x1p-32F;
  }

 private:
  /// [Steele, Lea, Flood 2014]
  std::uint32_t bits() {
    state_ += 0x9e37'79b9'7f4a'7c15U;
    std::uint64_t z = state_;
    z = (z ^ z >> 30U) * 0xbf58'476d'1ce4'e5b9U;
    z = (z ^ z >> 27U) * 0x94d0'49bb'1331'11ebU;
    return static_cast<std::uint32_t>((z ^ z >> 31U) >> 32U);
  }

  std::uint64_t state_ = 4;
};

void add(Trial& trial, int count, const std::function<Vec3f()>& next) {
  for (int i = 0; i < count; ++i)
    trial.positions.push_back(next());
}

Trial rows(Random& random) {
  Trial trial{.rule = "R2, rows without fused operations", .point_size = 1};
  // Rows with all four coefficients, none a power of two.
  trial.placement[0] = {0.317, -0.211, 0.0003, 0.0};
  trial.placement[1] = {0.173, 0.291, -0.0007, 0.0};
  trial.placement[2] = {-0.119, 0.237, -0.0111, 0.0};
  trial.placement[3] = {0.1, 0.2, -0.5, 1.0};
  add(trial, 3000, [&] {
    return Vec3f{random.between(-50, 50), random.between(-50, 50), random.between(-20, 20)};
  });
  return trial;
}

Trial denormals(Random& random) {
  Trial trial{.rule = "R2, numbers too small to be normal", .point_size = 1};
  constexpr double kMagnified = 0x1p127;
  for (int axis = 0; axis < 3; ++axis)
    trial.placement[axis] *= kMagnified;
  add(trial, 500, [&] {
    return Vec3f{random.number(0, kSide) / kMagnified, random.number(0, kSide) / kMagnified,
                 random.number(0, 40) / kMagnified};
  });
  return trial;
}

Trial clipped(Random& random) {
  Trial trial{.rule = "R11, clip planes and the sign of tiny numbers", .point_size = 2};
  trial.camera.clip_planes = {{{0.0, 0.0, -1.0}, 0.0}, {{1.0, 1.0, 0.0}, 5.0}};
  add(trial, 500, [&] {
    const float tiny = std::numeric_limits<float>::denorm_min();
    return Vec3f{random.number(0, kSide), random.number(0, kSide), random.number(-3, 3) * tiny};
  });
  return trial;
}

Trial halves(Random& random) {
  Trial trial{.rule = "R3, halves to even", .point_size = 1};
  add(trial, 1000, [&] {
    return Vec3f{0.5F * random.number(-10, 2 * kSide), 0.5F * random.number(-10, 2 * kSide),
                 0.5F * random.number(-4, 100)};
  });
  return trial;
}

Trial quotients(Random& random) {
  Trial trial{.rule = "R4, quotients and their halves", .point_size = 1};
  // Twice the arc tangent of 1/2: at eye depth w the image is w wide, so that odd multiples of
  // w / 2^15 lie half a unit beside the grid.
  trial.camera.lens = Perspective{.fov_y = 0.9272952180016122};
  trial.camera.near_depth = 1.0;
  trial.camera.far_depth = 64.0;
  trial.placement = Mat4{1.0};
  add(trial, 2000, [&] {
    const float w = random.number(1, 64);
    const float unit = 0x1p-15F * w;
    return Vec3f{unit * random.number(-kSide, kSide), unit * random.number(-kSide, kSide), -w};
  });
  add(trial, 2000, [&] {
    const float w = random.between(1.0F, 64.0F);
    return Vec3f{random.between(-0.5F, 0.5F) * w, random.between(-0.5F, 0.5F) * w, -w};
  });
  return trial;
}

Trial points(Random& random, int size) {
  Trial trial{.rule = "R5, the pixels of a point", .point_size = size};
  for (int i = 0; i < 60; ++i) {
    add(trial, 1, [&] {
      return Vec3f{128 * random.number(-40, 168) + random.number(-1, 1),
                   128 * random.number(-40, 168) + random.number(-1, 1), 55 - i};
    });
  }
  return trial;
}

Trial edges(Random& random, Facing facing) {
  Trial trial{.rule = "R6, edges through pixel centres", .facing = facing};
  for (int i = 0; i < 100; ++i) {
    add(trial, 3, [&] {
      return Vec3f{128 * random.number(-4, 132), 128 * random.number(-4, 132), 100 - i};
    });
  }
  return trial;
}

Trial slivers(Random& random) {
  Trial trial{.rule = "R6, triangles thinner than a pixel"};
  for (int i = 0; i < 100; ++i) {
    const Vec3f a{random.number(0, kSide), random.number(0, kSide), 100 - i};
    const Vec3f b{random.number(0, kSide), random.number(0, kSide), 100 - i};
    trial.positions.insert(trial.positions.end(),
                           {a, b, b + Vec3f{random.number(-9, 9), random.number(-9, 9), 0}});
  }
  return trial;
}

Trial slopes(Random& random, int reach) {
  Trial trial{.rule = "R7, depths rounded down"};
  add(trial, 90, [&] {
    return Vec3f{random.number(-reach, kSide + reach), random.number(-reach, kSide + reach),
                 random.number(-(1 << 22), (1 << 24) + (1 << 22))};
  });
  return trial;
}

Trial small_slopes(Random& random) {
  Trial trial{.rule = "R7, depths of small triangles"};
  for (int i = 0; i < 300; ++i) {
    const Vec3f at{random.number(0, kSide), random.number(0, kSide), 0};
    add(trial, 3, [&] {
      return at +
             Vec3f{random.number(-700, 700), random.number(-700, 700), random.number(0, 1 << 24)};
    });
  }
  return trial;
}

Trial cut(Random& random) {
  Trial trial{.rule = "R8, triangles that leave the guard range"};
  add(trial, 30, [&] {
    return Vec3f{random.number(-9, 9) * 1e6F, random.number(-9, 9) * 1e6F, random.number(0, 9)};
  });
  return trial;
}

Trial clipped_triangles(Random& random) {
  Trial trial{.rule = "R11, triangles cut by clip planes"};
  trial.camera.clip_planes = {{{1.0, 0.5, 0.0}, 9.0}, {{0.0, -1.0, 0.0}, 20.0}};
  for (int i = 0; i < 100; ++i) {
    add(trial, 3, [&] { return Vec3f{random.number(0, kSide), random.number(0, kSide), 100 - i}; });
  }
  return trial;
}

Trial ties(Random& random, int point_size) {
  Trial trial{.rule = "R9, equal depths", .point_size = point_size};
  add(trial, 300, [&] { return Vec3f{random.number(0, kSide), random.number(0, kSide), 5}; });
  return trial;
}

Trial banded(Random& random, int point_size) {
  Trial trial{.rule = "R12, bands of depths", .point_size = point_size, .has_band = true};
  add(trial, 600, [&] {
    return Vec3f{random.number(0, kSide), random.number(0, kSide), random.number(0, 40)};
  });
  return trial;
}

/// In an order in which a rule is tested before those that need it.
std::vector<Trial> all_trials() {
  Random random;
  std::vector<Trial> trials;
  for (const int size : {1, 2, 3, 8, 9, 31, 255})
    trials.push_back(points(random, size));
  for (const int size : {1, 5})
    trials.push_back(ties(random, size));
  for (const auto& make : {rows, denormals, halves, quotients, clipped})
    trials.push_back(make(random));
  for (const Facing facing : {Facing::both, Facing::front, Facing::back})
    trials.push_back(edges(random, facing));
  trials.push_back(slivers(random));
  trials.push_back(ties(random, 0));
  trials.push_back(small_slopes(random));
  for (const int reach : {0, 7000, 200'000})
    trials.push_back(slopes(random, reach));
  trials.push_back(cut(random));
  // Drivers compile a program anew for values of its uniforms, and may take those of before.
  for (int width = kExtent.width - 8; width < kExtent.width; ++width) {
    trials.push_back(cut(random));
    trials.back().extent.width = width;
  }
  trials.push_back(clipped_triangles(random));
  for (const int size : {0, 1, 5})
    trials.push_back(banded(random, size));
  return trials;
}

/// Even pixels take depths from 10 to 30, the others none or all.
DepthBand test_band() {
  DepthBand band{.lower = Grid<std::int32_t>(kExtent, 10),
                 .upper = Grid<std::int32_t>(kExtent, 30)};
  for (std::size_t i = 1; i < kExtent.count(); i += 2) {
    band.lower.pixels()[i] = i % 4 == 1 ? 20 : -5;
    band.upper.pixels()[i] = i % 4 == 1 ? 19 : 1 << 30;
  }
  return band;
}

std::string broken(const char* rule, std::size_t pixels, Extent extent) {
  return std::string(rule) + ": " + std::to_string(pixels) + " of " +
         std::to_string(extent.count()) + " pixels differ";
}

/// The item of a trial, with IDs that take all 32 bits.
DrawItem item_of(const Trial& trial, const std::vector<Triangle>& triangles) {
  const PrimitiveId first_id = kNoPrimitive - static_cast<PrimitiveId>(trial.positions.size());
  if (trial.point_size > 0) {
    return DrawPoints{.positions = trial.positions,
                      .world_from_item = trial.placement,
                      .first_id = first_id,
                      .point_size = trial.point_size};
  }
  return DrawTriangles{.positions = trial.positions,
                       .triangles = triangles,
                       .world_from_item = trial.placement,
                       .first_id = first_id,
                       .facing = trial.facing};
}

std::size_t differing_pixels(const Framebuffer& a, const Framebuffer& b) {
  std::size_t count = 0;
  for (std::size_t i = 0; i < a.id.pixels().size(); ++i) {
    const bool same =
        a.depth.pixels()[i] == b.depth.pixels()[i] && a.id.pixels()[i] == b.id.pixels()[i];
    count += same ? 0 : 1;
  }
  return count;
}

std::optional<std::string> find_broken_rule(Rasterizer& rasterizer, const Trial& trial) {
  const View view(trial.camera, trial.extent);
  std::vector<Triangle> triangles;
  for (std::uint32_t i = 0; i + 2 < trial.positions.size(); i += 3)
    triangles.push_back({i, i + 1, i + 2});
  const std::vector<DrawItem> items{item_of(trial, triangles)};
  const DepthBand band = test_band();
  Framebuffer image;
  if (trial.has_band) {
    rasterizer.render_in_band(view, items, band, image);
  } else {
    rasterizer.render(view, items, image);
  }
  const std::size_t differing =
      differing_pixels(image, plain::draw(view, items, trial.has_band ? &band : nullptr));
  if (differing > 0) return broken(trial.rule, differing, trial.extent);
  return std::nullopt;
}

/// Many points in one pixel and its neighbours: every sum passes 2^32, up and down.
std::optional<std::string> find_broken_sums(Rasterizer& rasterizer) {
  Random random;
  std::vector<Vec3f> positions;
  std::vector<std::int8_t> votes;
  for (int i = 0; i < 20'000; ++i) {
    positions.emplace_back(random.whole(0, 9 * 256), random.whole(0, 5 * 256),
                           random.whole(-9, 1 << 20));
    votes.push_back(static_cast<std::int8_t>(random.whole(-127, 127)));
  }
  const std::vector<DrawItem> items{
      DrawPoints{.positions = positions, .world_from_item = lattice_placement(), .votes = votes}};
  const View view(lattice_camera(), kExtent);
  const AccumulateWindow window{.band = {.lower = Grid<std::int32_t>(kExtent, 100),
                                         .upper = Grid<std::int32_t>(kExtent, 1'000'000)},
                                .reference = Grid<std::int32_t>(kExtent, 500'001),
                                .shift = 1};
  Grid<PixelMoments> sums;
  rasterizer.accumulate(view, items, window, sums);
  const Grid<PixelMoments> expected = plain::sum(view, items, window);
  std::size_t differing = 0;
  for (std::size_t i = 0; i < kExtent.count(); ++i)
    differing += sums.pixels()[i] == expected.pixels()[i] ? 0 : 1;
  if (differing > 0) return broken("R13, sums", differing, kExtent);
  return std::nullopt;
}

}  // namespace

std::optional<std::string> find_broken_rule(Rasterizer& rasterizer) {
  for (const Trial& trial : all_trials()) {
    if (auto rule = find_broken_rule(rasterizer, trial)) return rule;
  }
  return find_broken_sums(rasterizer);
}

}  // namespace rangezip

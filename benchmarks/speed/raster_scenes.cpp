#include "benchmarks/speed/raster_scenes.h"

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <random>

namespace rangezip::benchmark {

namespace {

/// Numbers in [0, 1) with the 24 bits that a float holds.
class Uniform {
 public:
  explicit Uniform(std::uint32_t seed) : engine_(seed) {}
  float operator()() { return static_cast<float>(engine_() >> 8U) * 0x1p-24F; }

 private:
  std::mt19937 engine_;
};

/// The even bits of `code`, moved together: x of a cell along the Z-shaped curve.
std::uint32_t even_bits(std::uint64_t code) {
  code &= 0x5555'5555'5555'5555U;
  code = (code | code >> 1U) & 0x3333'3333'3333'3333U;
  code = (code | code >> 2U) & 0x0f0f'0f0f'0f0f'0f0fU;
  code = (code | code >> 4U) & 0x00ff'00ff'00ff'00ffU;
  code = (code | code >> 8U) & 0x0000'ffff'0000'ffffU;
  return static_cast<std::uint32_t>(code | code >> 16U);
}

/// @param along place on the curve, in [0, 1)
Vec3f on_curve(double along, Uniform& uniform) {
  constexpr double kCells = 0x1p32;  // 2^16 by 2^16
  const auto cell = static_cast<std::uint64_t>(along * kCells);
  const auto place = [&](std::uint32_t index) {
    return static_cast<float>((static_cast<double>(index) + uniform()) * 0x1p-16);
  };
  const float x = place(even_bits(cell)), y = place(even_bits(cell >> 1U)), z = uniform();
  return {x, y, z};
}

/// @param along place on the way along all rows, in [0, 1)
Vec3f on_scan(double along, Uniform& uniform) {
  constexpr double kRows = 2048.0;
  const double row = std::floor(along * kRows);
  const auto y = static_cast<float>((row + uniform()) / kRows);
  return {static_cast<float>(along * kRows - row), y, uniform()};
}

}  // namespace

const char* name_of(Order order) {
  constexpr const char* kNames[]{"random", "scan", "curve"};
  return kNames[static_cast<int>(order)];
}

Cloud make_cloud(std::size_t count, Order order) {
  Uniform uniform(1);
  Cloud cloud{.order = order, .positions = std::vector<Vec3f>(count)};
  // Orders are made in order: to sort 10^8 points takes longer than to measure them.
  for (std::size_t i = 0; i < count; ++i) {
    const double along = (static_cast<double>(i) + uniform()) / static_cast<double>(count);
    if (order == Order::curve) {
      cloud.positions[i] = on_curve(along, uniform);
    } else if (order == Order::scan) {
      cloud.positions[i] = on_scan(along, uniform);
    } else {
      const float x = uniform(), y = uniform(), z = uniform();
      cloud.positions[i] = {x, y, z};
    }
  }
  return cloud;
}

Field make_field(double pixels, int size) {
  const int n = std::max(1, static_cast<int>(size / std::sqrt(2.0 * pixels)));
  Uniform uniform(2);
  Field field;
  for (int y = 0; y <= n; ++y) {
    for (int x = 0; x <= n; ++x) {
      field.positions.emplace_back(static_cast<float>(x) / static_cast<float>(n),
                                   static_cast<float>(y) / static_cast<float>(n), uniform());
    }
  }
  const auto row = static_cast<std::uint32_t>(n + 1);
  for (std::uint32_t y = 0; y + 1 < row; ++y) {
    for (std::uint32_t x = 0; x + 1 < row; ++x) {
      const std::uint32_t a = y * row + x;
      field.triangles.push_back({a, a + 1, a + row});
      field.triangles.push_back({a + 1, a + row + 1, a + row});
    }
  }
  return field;
}

View make_view(int size, bool is_central) {
  if (!is_central) {
    return View({.lens = Orthographic{.height = 1.0}, .near_depth = -0.1, .far_depth = 1.2},
                {size, size});
  }
  // The front of the cube at a distance of 1 fills the image.
  return View(
      {.lens = Perspective{.fov_y = 2.0 * std::atan(0.5)}, .near_depth = 0.9, .far_depth = 2.2},
      {size, size});
}

Mat4 placement(bool is_central) {
  Mat4 m{1.0};
  m[3] = {-0.5, -0.5, is_central ? -2.0 : -1.0, 1.0};
  return m;
}

DrawPoints draw(const Cloud& cloud, int point_size, bool is_central) {
  return {.positions = cloud.positions,
          .world_from_item = placement(is_central),
          .point_size = point_size};
}

DrawTriangles draw(const Field& field) {
  return {.positions = field.positions,
          .triangles = field.triangles,
          .world_from_item = placement(false)};
}

std::vector<Bytes> bytes_of(const Cloud& cloud) {
  return {std::as_bytes(std::span(cloud.positions))};
}

std::vector<Bytes> bytes_of(const Field& field) {
  return {std::as_bytes(std::span(field.positions)), std::as_bytes(std::span(field.triangles))};
}

AccumulateWindow make_open_window(int size) {
  const Extent extent{size, size};
  constexpr auto kLast = static_cast<std::int32_t>(kMaxDepth);
  return {
      .band = {.lower = Grid<std::int32_t>(extent, 0), .upper = Grid<std::int32_t>(extent, kLast)},
      .reference = Grid<std::int32_t>(extent, (kLast + 1) / 2),
      .shift = 4};
}

std::size_t covered_pixels(const Grid<PrimitiveId>& ids) {
  const auto pixels = ids.pixels();
  return pixels.size() -
         static_cast<std::size_t>(std::count(pixels.begin(), pixels.end(), kNoPrimitive));
}

}  // namespace rangezip::benchmark

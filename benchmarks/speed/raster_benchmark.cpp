// How fast the CPU rasterizer draws: items a second of processor time, the best of several runs.
//   raster_benchmark [quick|full] [--json FILE]
// Every row stands beside the limit of the same run: reading the bytes of its points once.
// quick: the scenes that have a target, 10 M points; full: the whole ladder.

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <cstdio>
#include <cstring>
#include <ctime>
#include <fstream>
#include <functional>
#include <nlohmann/json.hpp>
#include <random>
#include <string>
#include <vector>

#include "core/base/parallel.h"
#include "core/raster/draw_item.h"
#include "core/view/view.h"
#include "raster_cpu/cpu_rasterizer.h"

namespace {

using namespace rangezip;

enum class Order { random, scan, curve };
constexpr const char* kOrderNames[]{"random", "scan", "curve"};

double cpu_seconds() {
  timespec now{};
  clock_gettime(CLOCK_PROCESS_CPUTIME_ID, &now);
  return static_cast<double>(now.tv_sec) + 1e-9 * static_cast<double>(now.tv_nsec);
}

/// The best of several runs, for at least a second in all.
double best_seconds(const std::function<void()>& work) {
  constexpr int kLeastRuns = 3;
  constexpr double kEnough = 1.0;
  double best = 1e300, sum = 0.0;
  for (int run = 0; run < kLeastRuns || sum < kEnough; ++run) {
    const double begin = cpu_seconds();
    work();
    const double taken = cpu_seconds() - begin;
    best = std::min(best, taken);
    sum += taken;
  }
  return best;
}

/// The bits of x and y in turn: the order along a Z-shaped curve.
std::uint64_t curve_code(const Vec3f& p) {
  const auto spread = [](float v) {
    auto bits = static_cast<std::uint64_t>(v * 65536.0F);
    bits = (bits | bits << 16U) & 0x0000'ffff'0000'ffffU;
    bits = (bits | bits << 8U) & 0x00ff'00ff'00ff'00ffU;
    bits = (bits | bits << 4U) & 0x0f0f'0f0f'0f0f'0f0fU;
    bits = (bits | bits << 2U) & 0x3333'3333'3333'3333U;
    return (bits | bits << 1U) & 0x5555'5555'5555'5555U;
  };
  return spread(p.x) | spread(p.y) << 1U;
}

/// In the unit cube.
std::vector<Vec3f> make_points(std::size_t count, Order order) {
  std::mt19937 engine(1);
  const auto uniform = [&] { return static_cast<float>(engine() >> 8U) * 0x1p-24F; };
  std::vector<Vec3f> points(count);
  for (Vec3f& p : points) {
    const float x = uniform(), y = uniform(), z = uniform();
    p = {x, y, z};
  }
  if (order == Order::scan) {
    constexpr float kRows = 2048.0F;
    std::sort(points.begin(), points.end(), [](const Vec3f& p, const Vec3f& q) {
      const int row_p = static_cast<int>(p.y * kRows), row_q = static_cast<int>(q.y * kRows);
      return row_p != row_q ? row_p < row_q : p.x < q.x;
    });
  } else if (order == Order::curve) {
    std::sort(points.begin(), points.end(),
              [](const Vec3f& p, const Vec3f& q) { return curve_code(p) < curve_code(q); });
  }
  return points;
}

/// A height field over the unit square of triangles that cover about `pixels` each.
struct Field {
  std::vector<Vec3f> positions;
  std::vector<Triangle> triangles;
};

Field make_field(double pixels, int size) {
  const int n = std::max(1, static_cast<int>(size / std::sqrt(2.0 * pixels)));
  std::mt19937 engine(2);
  Field field;
  for (int y = 0; y <= n; ++y) {
    for (int x = 0; x <= n; ++x) {
      const float z = static_cast<float>(engine() >> 8U) * 0x1p-24F;
      field.positions.emplace_back(static_cast<float>(x) / static_cast<float>(n),
                                   static_cast<float>(y) / static_cast<float>(n), z);
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

/// Shows the unit cube in a square image, straight or in perspective.
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

class Runner {
 public:
  explicit Runner(nlohmann::ordered_json& rows) : rows_(rows) {}

  void points(const std::vector<Vec3f>& positions, Order order, const std::string& instructions,
              int size, int point_size, bool is_central) {
    CpuRasterizer rasterizer(instructions);
    const View view = make_view(size, is_central);
    const DrawItem item = DrawPoints{
        .positions = positions, .world_from_item = placement(is_central), .point_size = point_size};
    Framebuffer out;
    const double seconds = best_seconds([&] { rasterizer.render(view, {&item, 1}, out); });
    add({{"what", "points"},
         {"instructions", instructions},
         {"order", kOrderNames[static_cast<int>(order)]},
         {"size", size},
         {"point_size", point_size},
         {"projection", is_central ? "perspective" : "parallel"},
         {"count", positions.size()}},
        static_cast<double>(positions.size()) / seconds);
  }

  void triangles(double pixels, const std::string& instructions, int size) {
    const Field field = make_field(pixels, size);
    CpuRasterizer rasterizer(instructions);
    const View view = make_view(size, false);
    const DrawItem item = DrawTriangles{.positions = field.positions,
                                        .triangles = field.triangles,
                                        .world_from_item = placement(false)};
    Framebuffer out;
    const double seconds = best_seconds([&] { rasterizer.render(view, {&item, 1}, out); });
    add({{"what", "triangles"},
         {"instructions", instructions},
         {"pixels", pixels},
         {"size", size},
         {"count", field.triangles.size()}},
        static_cast<double>(field.triangles.size()) / seconds);
  }

  void accumulate(const std::vector<Vec3f>& positions, Order order, const std::string& instructions,
                  int size) {
    CpuRasterizer rasterizer(instructions);
    const View view = make_view(size, false);
    const DrawItem item = DrawPoints{.positions = positions, .world_from_item = placement(false)};
    const Extent extent{size, size};
    const AccumulateWindow window{
        .band = {.lower = Grid<std::int32_t>(extent, 0),
                 .upper = Grid<std::int32_t>(extent, static_cast<std::int32_t>(kMaxDepth))},
        .reference = Grid<std::int32_t>(extent, 1 << 23),
        .shift = 4};
    Grid<PixelMoments> out;
    const double seconds = best_seconds([&] {
      rasterizer.accumulate(view, {&item, 1}, window, out);
    });
    add({{"what", "accumulate"},
         {"instructions", instructions},
         {"order", kOrderNames[static_cast<int>(order)]},
         {"size", size},
         {"count", positions.size()}},
        static_cast<double>(positions.size()) / seconds);
  }

  /// The limit: every byte of the points read once.
  void reading(const std::vector<Vec3f>& positions) {
    volatile std::uint64_t sink = 0;
    const double seconds = best_seconds([&] {
      const auto* const bytes = reinterpret_cast<const unsigned char*>(positions.data());
      std::uint64_t sums[8]{};
      const std::size_t words = positions.size() * sizeof(Vec3f) / sizeof(sums);
      for (std::size_t i = 0; i < words; ++i) {
        std::uint64_t values[8];
        std::memcpy(values, bytes + i * sizeof(values), sizeof(values));
        for (std::size_t k = 0; k < 8; ++k)
          sums[k] += values[k];
      }
      for (const std::uint64_t sum : sums)
        sink = sink + sum;
    });
    add({{"what", "reading 12 bytes a point"}, {"count", positions.size()}},
        static_cast<double>(positions.size()) / seconds);
  }

 private:
  void add(nlohmann::ordered_json row, double rate) {
    row["million_per_second"] = std::round(rate / 1e5) / 10.0;
    std::string text;
    for (const auto& [key, value] : row.items())
      text += (value.is_string() ? value.get<std::string>() : key + " " + value.dump()) + "  ";
    std::printf("%s\n", text.c_str());
    std::fflush(stdout);
    rows_.push_back(std::move(row));
  }

  nlohmann::ordered_json& rows_;
};

void run_quick(Runner& runner) {
  constexpr std::size_t kPoints = 10'000'000;
  const auto random = make_points(kPoints, Order::random);
  const auto curve = make_points(kPoints, Order::curve);
  runner.reading(random);
  const std::vector<std::string> all = cpu_instructions();
  const std::string& best = all.front();
  for (const std::string& instructions : all)
    runner.points(random, Order::random, instructions, 1024, 1, false);
  runner.points(curve, Order::curve, best, 1024, 1, false);
  runner.points(random, Order::random, best, 1024, 1, true);
  runner.points(random, Order::random, best, 4096, 1, false);
  for (const int point_size : {2, 3, 5})
    runner.points(random, Order::random, best, 1024, point_size, false);
  for (const double pixels : {0.34, 1.4, 10.0, 400.0})
    runner.triangles(pixels, best, 1024);
  runner.accumulate(curve, Order::curve, best, 1024);
  runner.accumulate(random, Order::random, best, 1024);
  runner.accumulate(curve, Order::curve, "scalar", 1024);
  runner.accumulate(random, Order::random, "scalar", 1024);
}

void run_full(Runner& runner) {
  for (const Order order : {Order::random, Order::scan, Order::curve}) {
    for (const std::size_t count : {std::size_t{100'000}, std::size_t{1'000'000},
                                    std::size_t{10'000'000}, std::size_t{100'000'000}}) {
      const auto points = make_points(count, order);
      runner.reading(points);
      for (const std::string& instructions : cpu_instructions()) {
        for (const int size : {512, 1024, 2048, 4096}) {
          for (const bool is_central : {false, true})
            runner.points(points, order, instructions, size, 1, is_central);
        }
        for (const int point_size : {2, 3, 5})
          runner.points(points, order, instructions, 1024, point_size, false);
        if (count <= 10'000'000) runner.accumulate(points, order, instructions, 1024);
      }
    }
  }
  for (const std::string& instructions : cpu_instructions()) {
    for (const double pixels : {0.34, 1.4, 10.0, 400.0}) {
      for (const int size : {1024, 4096})
        runner.triangles(pixels, instructions, size);
    }
  }
}

}  // namespace

int main(int argc, char** argv) {
  std::string json;
  bool is_full = false;
  for (int i = 1; i < argc; ++i) {
    const std::string argument = argv[i];
    if (argument == "full") {
      is_full = true;
    } else if (argument == "--json" && i + 1 < argc) {
      json = argv[++i];
    } else if (argument != "quick") {
      std::fprintf(stderr, "usage: raster_benchmark [quick|full] [--json FILE]\n");
      return 1;
    }
  }
  nlohmann::ordered_json rows = nlohmann::ordered_json::array();
  Runner runner(rows);
  run_with_threads(1, [&] { is_full ? run_full(runner) : run_quick(runner); });
  if (!json.empty()) std::ofstream(json) << rows.dump(1) << '\n';
  return 0;
}

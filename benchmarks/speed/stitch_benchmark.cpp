// Is stitching local? The same patch is stitched into the same place of meshes of 50 thousand to a
// million faces, by both ways: processor time of stitch() alone, the best of several runs.
//   stitch_benchmark [--json FILE] [--revision TEXT]
// Exit code 1 if a million faces take more than five times as long as 50 thousand.

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <limits>
#include <nlohmann/json.hpp>
#include <string>
#include <utility>
#include <vector>

#include "benchmarks/report.h"
#include "benchmarks/speed/measure.h"
#include "core/stitch/stitch.h"
#include "tests/support/scans.h"

namespace {

using namespace rangezip;
using nlohmann::ordered_json;

constexpr double kPixel = 1.0;
constexpr int kPatchSide = 128;  ///< pixels
constexpr int kRuns = 9;
constexpr double kMostRatio = 5.0;

/// A sheet of squares of a pixel's side around the origin, not quite flat and not on the grid.
TriangleMesh sheet(int cells) {
  TriangleMesh mesh;
  for (int j = 0; j <= cells; ++j) {
    for (int i = 0; i <= cells; ++i) {
      const double x = (i - cells / 2 + 0.37) * kPixel;
      const double y = (j - cells / 2 + 0.21) * kPixel;
      mesh.positions.emplace_back(x, y, 0.1 * kPixel * ((i * 7 + j * 3) % 5));
    }
  }
  const auto row = static_cast<std::uint32_t>(cells + 1);
  for (std::uint32_t j = 0; j + 1 < row; ++j) {
    for (std::uint32_t i = 0; i + 1 < row; ++i) {
      const std::uint32_t a = j * row + i;
      mesh.triangles.push_back({a, a + 1, a + row + 1});
      mesh.triangles.push_back({a, a + row + 1, a + row});
    }
  }
  return mesh;
}

struct Figure {
  double seconds = std::numeric_limits<double>::infinity();
  StitchReport report;
};

Figure measure(const TriangleMesh& mesh, StitchMethod method) {
  const double half = 0.5 * kPatchSide * kPixel;
  const Scene scene = scans::scene_of(shapes::box({-half, -half, -1.0}, {half, half, 0.2}));
  const Scan scan = scans::run(scene, scans::plain_request(scene, {0, 0, 1}, kPixel), mesh);
  Figure figure;
  for (int run = 0; run < kRuns; ++run) {
    TriangleMesh copy = mesh;
    const auto begin = benchmark::seconds_since_start();
    const StitchResult result = stitch(std::move(copy), scan, {.method = method});
    const double seconds = (benchmark::seconds_since_start() - begin).cpu;
    figure.seconds = std::min(figure.seconds, seconds);
    figure.report = result.report;
  }
  return figure;
}

/// One row a size. @return the time of the last size by that of the first
double measure_all(StitchMethod method, ordered_json& rows) {
  const char* name = method == StitchMethod::zipper ? "zipper" : "clear_and_fill";
  std::vector<double> seconds;
  for (const int cells : {158, 354, 708}) {
    const TriangleMesh mesh = sheet(cells);
    const Figure figure = measure(mesh, method);
    seconds.push_back(figure.seconds);
    std::printf("%-16s %8zu faces: %6.1f ms   (%zu removed, %zu of the patch, %zu of the strip)\n",
                name, mesh.triangles.size(), 1e3 * figure.seconds, figure.report.removed_faces,
                figure.report.patch_faces, figure.report.strip_faces);
    rows.push_back({{"method", name},
                    {"faces", mesh.triangles.size()},
                    {"seconds", figure.seconds},
                    {"patch_faces", figure.report.patch_faces}});
  }
  return seconds.back() / seconds.front();
}

int run(const benchmark::ReportOptions& options) {
  ordered_json json = benchmark::describe_run("stitch_benchmark", options.revision);
  bool is_local = true;
  for (const StitchMethod method : {StitchMethod::clear_and_fill, StitchMethod::zipper}) {
    const double ratio = measure_all(method, json["rows"]);
    is_local = is_local && ratio <= kMostRatio;
    json["ratios"].push_back(ratio);
    std::printf("a million by 50 thousand: %.2f, at most %.1f demanded\n", ratio, kMostRatio);
  }
  benchmark::write_report(options, json);
  return is_local ? 0 : 1;
}

}  // namespace

int main(int argc, char** argv) {
  const auto no_others = [](const std::string&, const std::string&) { return false; };
  return rangezip::benchmark::run_program(
      "stitch_benchmark", argc, argv, [&](const std::vector<std::string>& arguments) {
        return run(rangezip::benchmark::read_options(arguments, no_others));
      });
}

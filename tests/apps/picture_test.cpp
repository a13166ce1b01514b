// rangezip render and info.

#include <catch2/catch.hpp>

#include "core/io/image_file.h"
#include "core/io/mesh_file.h"
#include "tests/apps/program.h"
#include "tests/core/io/temporary_folder.h"
#include "tests/support/shapes.h"

using namespace rangezip;
using namespace rangezip::test;
using Catch::Contains;

namespace {

/// Pixels that are not white, and the middle of them, in pixels from the lower left.
struct Covered {
  double count = 0.0;
  Vec2 center{0.0};
};

Covered covered(const Grid<Rgb>& picture, int first_column, int end_column) {
  Covered result;
  for (int y = 0; y < picture.extent().height; ++y) {
    for (int x = first_column; x < end_column; ++x) {
      if (picture[{x, y}] == Rgb{255, 255, 255}) continue;
      result.count += 1.0;
      result.center += Vec2{x + 0.5, y + 0.5};
    }
  }
  result.center /= std::max(1.0, result.count);
  return result;
}

}  // namespace

TEST_CASE("render draws meshes and clouds together, the same with any number of threads",
          "[apps]") {
  const TemporaryFolder folder;
  store_sphere(folder / "sphere.ply");
  write_mesh(folder / "bowl.off", shapes::to_mesh(shapes::bowl()));
  const std::vector<std::string> arguments{
      "render", folder / "sphere.ply", folder / "bowl.off", "--size", "300,200", "--boundary"};
  const auto draw = [&](const std::string& name, std::vector<std::string> more) {
    more.insert(more.begin(), arguments.begin(), arguments.end());
    more.insert(more.end(), {"-o", folder / name});
    const RunResult result = run(more);
    CAPTURE(result.err);
    REQUIRE(result.code == 0);
    return load(folder / name);
  };
  const std::string bytes = draw("a.png", {});
  CHECK(draw("b.png", {"--threads", "1"}) == bytes);
  CHECK(draw("c.png", {"--edges"}) != bytes);
  CHECK(draw("d.png", {"--points"}) != bytes);
  CHECK(draw("e.png", {"--direction", "0,-1,0", "--up", "0,0,1"}) != bytes);

  const auto picture = read_rgb_png(folder / "a.png");
  CHECK(picture.extent() == Extent{300, 200});
  const std::array<std::uint8_t, 3> white{255, 255, 255};
  CHECK(picture[{0, 0}] == white);
  CHECK(std::count(picture.pixels().begin(), picture.pixels().end(), white) < 300 * 200 * 3 / 4);
}

TEST_CASE("a list of one mesh is told and drawn as the mesh", "[apps]") {
  const TemporaryFolder folder;
  write_mesh(folder / "bowl.ply", shapes::to_mesh(shapes::bowl()));
  folder.store("list.conf", "bmesh bowl.ply 0 0 0 0 0 0 1\n");
  const RunResult told = run({"info", folder / "list.conf"});
  CAPTURE(told.err);
  CHECK(told.code == 0);
  CHECK_THAT(told.out, Contains("bowl.ply"));
  const auto draw = [&](const std::string& input) {
    const RunResult drawn = run({"render", folder / input, "--flat", "-o", folder / "a.png"});
    CAPTURE(drawn.err);
    REQUIRE(drawn.code == 0);
    return load(folder / "a.png");
  };
  CHECK(draw("list.conf") == draw("bowl.ply"));
}

TEST_CASE("render --zoom enlarges the surroundings of a place of the picture", "[apps]") {
  // Two plates far apart, one lower left, one upper right.
  TriangleMesh plates;
  for (const Vec3& corner : {Vec3{-5, -1, 0}, Vec3{4, 0, 0}}) {
    const auto first = static_cast<std::uint32_t>(plates.positions.size());
    for (const Vec3& step : {Vec3{0, 0, 0}, Vec3{1, 0, 0}, Vec3{1, 1, 0}, Vec3{0, 1, 0}})
      plates.positions.push_back(corner + step);
    plates.triangles.push_back({first, first + 1, first + 2});
    plates.triangles.push_back({first, first + 2, first + 3});
  }
  const TemporaryFolder folder;
  write_mesh(folder / "plates.off", plates);
  const auto draw = [&](const std::vector<std::string>& more) {
    std::vector<std::string> arguments{
        "render", folder / "plates.off", "-o", folder / "out.png", "--direction", "0,0,1", "--size",
        "600,200"};
    arguments.insert(arguments.end(), more.begin(), more.end());
    const RunResult result = run(arguments);
    CAPTURE(result.err);
    REQUIRE(result.code == 0);
    return read_rgb_png(folder / "out.png");
  };
  const auto whole = draw({});
  CHECK(draw({"--zoom", "0.5,0.5,1"}) == whole);
  const Covered left = covered(whole, 0, 300);
  const Covered right = covered(whole, 300, 600);
  REQUIRE(left.count > 1000);
  CHECK(right.count == Approx(left.count).epsilon(0.05));
  CHECK(right.center.y > left.center.y + 20);  // the bottom row comes first

  constexpr double kFactor = 3.0;
  for (const Covered& plate : {left, right}) {
    const Vec2 share{plate.center.x / 600, plate.center.y / 200};
    const auto picture = draw({"--zoom", std::to_string(share.x) + "," + std::to_string(share.y) +
                                             "," + std::to_string(kFactor)});
    const Covered enlarged = covered(picture, 0, 600);
    CHECK(enlarged.count == Approx(kFactor * kFactor * plate.count).epsilon(0.05));
    CHECK(enlarged.center.x == Approx(300).margin(2.0 * kFactor));
    CHECK(enlarged.center.y == Approx(100).margin(2.0 * kFactor));
  }
  const RunResult refused =
      run({"render", folder / "plates.off", "-o", folder / "out.png", "--zoom", "0.5,0.5,0.9"});
  CHECK(refused.code == 1);
  CHECK_THAT(refused.err, Contains("--zoom: the factor must be at least 1"));
}

TEST_CASE("info counts what is in a cloud and in a mesh", "[apps]") {
  const TemporaryFolder folder;
  store_sphere(folder / "sphere.ply", 1234);
  write_mesh(folder / "bowl.obj", shapes::to_mesh(shapes::bowl()));
  const RunResult result = run({"info", folder / "sphere.ply", folder / "bowl.obj", "--check"});
  CHECK(result.code == 0);
  CHECK_THAT(result.out, Contains("1,234") && Contains("binary_little_endian"));
  CHECK_THAT(result.out, Contains("boundary loops        1") &&
                             Contains("Euler number          1") &&
                             Contains("self-intersections    0"));
}

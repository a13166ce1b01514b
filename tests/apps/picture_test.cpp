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

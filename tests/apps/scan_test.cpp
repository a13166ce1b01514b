// rangezip scan: one virtual scan with its images, and a scan into an existing mesh.

#include <catch2/catch.hpp>

#include "core/image/range_image.h"
#include "core/io/image_file.h"
#include "core/io/mesh_file.h"
#include "core/mesh/mesh_report.h"
#include "tests/apps/program.h"
#include "tests/core/io/temporary_folder.h"
#include "tests/support/shapes.h"

using namespace rangezip;
using namespace rangezip::test;
using Catch::Contains;

namespace {

RunResult scan(const TemporaryFolder& folder, const std::vector<std::string>& more) {
  std::vector<std::string> arguments{"scan", folder / "sphere.ply"};
  arguments.insert(arguments.end(), more.begin(), more.end());
  return run(arguments);
}

std::size_t count_active(const Mask& mask) {
  return static_cast<std::size_t>(std::count(mask.pixels().begin(), mask.pixels().end(), 1));
}

}  // namespace

TEST_CASE("scan writes the front of a sphere and all its images", "[apps]") {
  const TemporaryFolder folder;
  store_sphere(folder / "sphere.ply");
  const RunResult result =
      scan(folder, {"-o", folder / "out.ply", "--size", "100,80", "--range-image",
                    folder / "range.pfm", "--depth", folder / "depth.pfm", "--mask",
                    folder / "mask.png", "--ids", folder / "ids.png"});
  CAPTURE(result.err);
  REQUIRE(result.code == 0);
  const TriangleMesh mesh = read_mesh(folder / "out.ply");
  CHECK_NOTHROW(check_mesh(mesh));
  CHECK(report_mesh(mesh).components == 1);
  // The sphere fills the height. A point of two pixels stands for a place up to 1.5 pixels beside
  // it, which on a slope of any angle is at most as far from the surface.
  const double tolerance = 1.5 * 2.0 / 70;
  for (const Vec3& position : mesh.positions) {
    CHECK(position.z > -0.1);  // the front half
    CHECK(std::abs(glm::length(position - Vec3{3, 0, 0}) - 1.0) < tolerance);
  }

  const Grid<double> range = read_pfm(folder / "range.pfm");
  const Grid<double> depth = read_pfm(folder / "depth.pfm");
  const Mask mask = read_mask_png(folder / "mask.png");
  const Grid<PrimitiveId> ids = read_id_png(folder / "ids.png");
  const Extent extent{100, 80};
  CHECK(range.extent() == extent);
  CHECK(depth.extent() == extent);
  CHECK(mask.extent() == extent);
  REQUIRE(ids.extent() == extent);
  // Every vertex is an active pixel; pixels on the rim may be in no triangle.
  CHECK(count_active(mask) >= mesh.positions.size());
  CHECK(0.95 * static_cast<double>(count_active(mask)) <
        static_cast<double>(mesh.positions.size()));
  for (std::size_t i = 0; i < extent.count(); ++i) {
    const bool is_drawn = ids.pixels()[i] != kNoPrimitive;
    CHECK((depth.pixels()[i] != kNoSample) == is_drawn);
    if (is_drawn) CHECK((ids.pixels()[i] < 20'000 && depth.pixels()[i] >= 0.0));
  }
  CHECK(range[{0, 0}] == kNoSample);
  CHECK(range[{50, 40}] < range[{60, 60}]);  // the middle is nearest
}

TEST_CASE("a region takes only what is inside, a clip plane opens the view behind", "[apps]") {
  const TemporaryFolder folder;
  store_sphere(folder / "sphere.ply");
  const std::vector<std::string> common{"--size", "100,100", "--mask", folder / "mask.png"};
  const auto with = [&](std::vector<std::string> more) {
    more.insert(more.end(), common.begin(), common.end());
    return scan(folder, more);
  };
  REQUIRE(with({"--region", "50,0 100,0 100,100 50,100"}).code == 0);
  const Mask half = read_mask_png(folder / "mask.png");
  CHECK(count_active(half) > 1000);
  for (int y = 0; y < 100; ++y) {
    for (int x = 0; x < 50; ++x)
      CHECK(half[{x, y}] == 0);
  }
  // What has z > 0 is cut away: the inside of the back half is seen, from which no vote keeps us.
  REQUIRE(with({"--clip", "0,0,-1,0", "--no-vote", "--range-image", folder / "r.pfm"}).code == 0);
  REQUIRE(with({"--range-image", folder / "s.pfm"}).code == 0);
  const double behind = read_pfm(folder / "r.pfm")[{50, 50}];
  const double front = read_pfm(folder / "s.pfm")[{50, 50}];
  CHECK(behind - front == Approx(2.0).margin(0.05));
}

TEST_CASE("each pass can be turned on and off", "[apps]") {
  const TemporaryFolder folder;
  store_sphere(folder / "sphere.ply");
  const auto bytes = [&](const std::vector<std::string>& passes) {
    std::vector<std::string> arguments{"--range-image", folder / "r.pfm"};
    arguments.insert(arguments.end(), passes.begin(), passes.end());
    const RunResult result = scan(folder, arguments);
    CAPTURE(passes, result.err);
    REQUIRE(result.code == 0);
    return load(folder / "r.pfm");
  };
  const std::vector<std::string> none{"--method", "paper", "--no-back-side", "--no-fill-holes"};
  const auto with = [&](const std::vector<std::string>& more) {
    std::vector<std::string> passes = none;
    passes.insert(passes.end(), more.begin(), more.end());
    return bytes(passes);
  };
  const std::string plain = with({"--no-median"});
  CHECK((with({"--median"}) != plain));
  CHECK((with({"--median", "--median-radius", "2"}) != with({"--median"})));
  CHECK((with({"--no-median", "--plane-fit"}) != plain));
  CHECK((with({"--no-median", "--point-size", "5"}) != plain));
  CHECK((with({"--no-median", "--erosions", "3"}) == plain));  // on the mask, not on the image
}

TEST_CASE("a central projection sees the sphere whole", "[apps]") {
  const TemporaryFolder folder;
  store_sphere(folder / "sphere.ply");
  REQUIRE(
      scan(folder, {"--perspective", "60", "--size", "120,90", "--ids", folder / "ids.png"}).code ==
      0);
  const Grid<PrimitiveId> ids = read_id_png(folder / "ids.png");
  int drawn = 0;
  for (int y = 0; y < 90; ++y) {
    for (int x = 0; x < 120; ++x) {
      if (ids[{x, y}] == kNoPrimitive) continue;
      ++drawn;
      CHECK((x > 0 && x < 119 && y > 0 && y < 89));
    }
  }
  CHECK(drawn > 1500);  // of a disc of 26 pixels: half the diagonal of the box fills the height
  CHECK(scan(folder, {"--perspective", "60", "--size", "9,9", "--pixel-size", "1", "--ids",
                      folder / "ids.png"})
            .code == 1);
}

TEST_CASE("a scan is stitched into an existing mesh, and plays back to the same bytes", "[apps]") {
  const TemporaryFolder folder;
  store_sphere(folder / "sphere.ply");
  // The model is the sphere with a hole; the scan closes it.
  TriangleMesh model =
      shapes::to_mesh(shapes::moved(shapes::sphere(1.0, 64), shapes::translation({3.0, 0.0, 0.0})));
  std::erase_if(model.triangles, [&](const Triangle& triangle) {
    const Vec3& p = model.positions[triangle[0]];
    return p.z > 0.8;
  });
  remove_unused_vertices(model);
  write_mesh(folder / "model.ply", model);
  REQUIRE(report_mesh(model).boundary_loops == 1);
  const RunResult result = scan(folder, {"--into", folder / "model.ply", "-o", folder / "out.ply",
                                         "--session", folder / "s.json"});
  CAPTURE(result.err);
  REQUIRE(result.code == 0);
  const TriangleMesh mesh = read_mesh(folder / "out.ply");
  CHECK_NOTHROW(check_mesh(mesh));
  CHECK(report_mesh(mesh).components == 1);
  CHECK(report_mesh(mesh).boundary_loops == 0);
  REQUIRE(run({"play", folder / "s.json", "-o", folder / "again.ply"}).code == 0);
  CHECK((load(folder / "out.ply") == load(folder / "again.ply")));
}

TEST_CASE("a mesh that is not manifold is refused with exit code 5", "[apps]") {
  const TemporaryFolder folder;
  store_sphere(folder / "sphere.ply", 1000);
  const auto fan = folder.store("fan.off",
                                "OFF\n5 3 0\n0 0 0\n0 0 1\n1 0 0\n0 1 0\n-1 0 0\n"
                                "3 0 1 2\n3 0 1 3\n3 0 1 4\n");
  const RunResult result = scan(folder, {"--into", fan, "-o", folder / "out.ply"});
  CHECK(result.code == 5);
  CHECK_THAT(result.err, Catch::Contains("fan.off: "));
  CHECK(folder.count() == 2);
}

TEST_CASE("an aligned and decimated scan has a sharp edge, and plays to the same bytes", "[apps]") {
  const TemporaryFolder folder;
  folder.store("roof.obj",
               "v -1 0 0\nv 1 0.3 0\nv -0.8 -1 -1\nv 1.2 -0.7 -1\nv -1.2 1 -1\nv 0.8 1.3 -1\n"
               "f 3 4 2 1\nf 1 2 6 5\n");
  const RunResult result =
      run({"scan", folder / "roof.obj", "-o", folder / "out.ply", "--pixel-size", "0.03", "--align",
           "--decimate", "0.01", "--session", folder / "s.json"});
  CAPTURE(result.err);
  REQUIRE(result.code == 0);
  const TriangleMesh mesh = read_mesh(folder / "out.ply");
  std::size_t on_ridge = 0;
  for (const Vec3& p : mesh.positions)
    on_ridge += p.z > -1e-4 ? 1 : 0;
  CHECK(on_ridge > 20);                 // of about 65 pixels, merged by twos
  CHECK(mesh.triangles.size() < 3000);  // of 6,000 and more without decimation
  REQUIRE(run({"play", folder / "s.json", "-o", folder / "again.ply"}).code == 0);
  CHECK((load(folder / "out.ply") == load(folder / "again.ply")));
}

TEST_CASE("alignment needs a feature, and an image whose size is its own", "[apps]") {
  const TemporaryFolder folder;
  store_sphere(folder / "sphere.ply");
  const RunResult smooth = scan(folder, {"--align", "-o", folder / "out.ply"});
  CHECK(smooth.code == 1);
  CHECK_THAT(smooth.err, Contains("--align: no sharp straight edge is seen"));
  const RunResult sized = scan(folder, {"--align", "--size", "90,90", "-o", folder / "out.ply"});
  CHECK(sized.code == 1);
  CHECK_THAT(sized.err, Contains("give neither --size nor --region"));
  CHECK(folder.count() == 1);
}

TEST_CASE("a scan that takes nothing writes no mesh", "[apps]") {
  const TemporaryFolder folder;
  store_sphere(folder / "sphere.ply", 1000);
  const RunResult result = scan(folder, {"--clip", "1,0,0,-100", "-o", folder / "out.ply"});
  CHECK(result.code == 5);
  CHECK_THAT(result.err, Catch::Contains("is not written: no face came out"));
  CHECK(folder.count() == 1);
}

#include "core/mask/correspondence.h"

#include <limits>

#include <catch2/catch.hpp>

#include "core/base/error.h"
#include "core/mask/nearest_faces.h"
#include "raster_cpu/cpu_rasterizer.h"
#include "tests/support/images.h"

namespace rangezip {
namespace {

/// Two squares of four triangles each, seen by the parallel view: the front one at depth `front`,
/// the other ten pixels behind. Faces 0..1 and 2..3; both face the viewer.
TriangleMesh two_sheets(double front) {
  TriangleMesh mesh;
  for (const double depth : {front, front + 10.0}) {
    const auto first = static_cast<std::uint32_t>(mesh.positions.size());
    mesh.positions.insert(mesh.positions.end(),
                          {{-9, -9, -depth}, {9, -9, -depth}, {9, 9, -depth}, {-9, 9, -depth}});
    mesh.triangles.push_back({first, first + 1, first + 2});
    mesh.triangles.push_back({first, first + 2, first + 3});
  }
  return mesh;
}

TriangleMesh turned_over(TriangleMesh mesh) {
  for (Triangle& t : mesh.triangles)
    std::swap(t[1], t[2]);
  return mesh;
}

const View kView = images::parallel_view({20, 20});

RangeImage level_image(double depth) {
  return images::image_of(kView, [=](Pixel) { return depth; });
}

Correspondence find(const RangeImage& image, const TriangleMesh& mesh,
                    const CorrespondenceOptions& options = {}) {
  CpuRasterizer rasterizer;
  return find_correspondence(rasterizer, image, estimate_slopes(image), mesh, options);
}

TEST_CASE("the depth band finds the sheet that a sample lies on, also behind another", "[mask]") {
  const TriangleMesh mesh = two_sheets(20.0);
  const auto sheet_of = [&](double depth) {
    const Correspondence found = find(level_image(depth), mesh);
    CHECK(images::count_of(found.from_behind) == 0);
    std::vector<PrimitiveId> faces;
    for (const PrimitiveId face : found.face.pixels()) {
      if (face != kNoPrimitive) faces.push_back(face);
    }
    if (faces.empty()) return -1;
    CHECK(faces.size() == 18 * 18);
    const auto [low, high] = std::minmax_element(faces.begin(), faces.end());
    CHECK(*high - *low == 1);
    return static_cast<int>(*low / 2);
  };
  CHECK(sheet_of(20.0) == 0);
  CHECK(sheet_of(21.4) == 0);  // within 1.5 pixel sides
  CHECK(sheet_of(18.6) == 0);
  CHECK(sheet_of(21.6) == -1);
  CHECK(sheet_of(30.0) == 1);  // hidden by the first sheet, found all the same
  CHECK(sheet_of(25.0) == -1);
}

TEST_CASE("the depth band is wider on slopes", "[mask]") {
  // Slope 2 stretches 1.5 pixel sides to 3.35.
  const TriangleMesh mesh = two_sheets(20.0);
  const auto matched = [&](double middle) {
    const RangeImage image =
        images::image_of(kView, [=](Pixel p) { return middle + 2.0 * (p.x - 9.5); });
    std::size_t count = 0;
    const Correspondence found = find(image, mesh);
    for (const PrimitiveId face : found.face.pixels()) {
      count += face == 0 || face == 1 ? 1 : 0;
    }
    return count;
  };
  // |2 (x - 9.5)| <= 3.354 holds for x = 8..11, 18 rows each.
  CHECK(matched(20.0) == 4 * 18);
}

TEST_CASE("a sample on the inside of a sheet is told apart", "[mask]") {
  const TriangleMesh mesh = turned_over(two_sheets(20.0));
  const Correspondence found = find(level_image(20.4), mesh);
  CHECK(images::count_of(found.from_behind) == 18 * 18);
  for (const PrimitiveId face : found.face.pixels())
    REQUIRE(face == kNoPrimitive);
  CHECK(images::count_of(find(level_image(20.7), mesh).from_behind) == 0);  // beyond 0.6
  CHECK(images::count_of(find(level_image(20.4), mesh, {.back_band = 0.0}).from_behind) == 0);
}

TEST_CASE("pixels without a sample correspond to nothing", "[mask]") {
  RangeImage image = level_image(20.0);
  image[{10, 10}] = kNoSample;
  for (const auto method : {CorrespondenceMethod::depth_band, CorrespondenceMethod::id_buffer}) {
    const Correspondence found = find(image, two_sheets(20.0), {.method = method});
    CHECK(found.face[{10, 10}] == kNoPrimitive);
    CHECK(found.face[{11, 10}] != kNoPrimitive);
    CHECK(found.face[{0, 0}] == kNoPrimitive);  // outside of the mesh
  }
  const Correspondence none = find(image, TriangleMesh{});
  CHECK(none.face[{11, 10}] == kNoPrimitive);
  CHECK(none.from_behind.extent() == image.extent());
}

TEST_CASE("both methods find the nearest face of a sphere at every sample", "[mask]") {
  const auto method = GENERATE(CorrespondenceMethod::depth_band, CorrespondenceMethod::id_buffer);
  TriangleMesh mesh = shapes::to_mesh(shapes::sphere(8.0, 24));
  for (Vec3& p : mesh.positions)
    p.z -= 30.0;
  // Samples of a slightly smaller, shifted sphere: the drawn face is often not the nearest one.
  const RangeImage image = images::image_of(kView, [](Pixel p) {
    const double x = p.x - 9.5 - 0.3;
    const double y = p.y - 9.5;
    const double squared = 7.6 * 7.6 - x * x - y * y;
    return squared > 0.0 ? 30.0 - std::sqrt(squared) : kNoSample;
  });
  const Correspondence found = find(image, mesh, {.method = method});
  int samples = 0;
  for (int y = 0; y < 20; ++y) {
    for (int x = 0; x < 20; ++x) {
      if (!image.has_sample({x, y})) continue;
      ++samples;
      const Vec3 point = image.position({x, y});
      const auto distance = [&](const Triangle& t) {
        return glm::length(closest_point_on_triangle(point, mesh.positions[t[0]],
                                                     mesh.positions[t[1]], mesh.positions[t[2]]) -
                           point);
      };
      double best = std::numeric_limits<double>::infinity();
      for (const Triangle& t : mesh.triangles)
        best = std::min(best, distance(t));
      const PrimitiveId face = found.face[{x, y}];
      REQUIRE(face != kNoPrimitive);
      // From inside of a sphere distance has a single minimum on the near side up to the facets'
      // own flatness, 8 (1 - cos(pi / 48)) = 0.017.
      REQUIRE(distance(mesh.triangles[face]) <= best + 0.017);
    }
  }
  CHECK(samples > 170);
}

TEST_CASE("what the ID buffer sees far behind a sample does not correspond to it", "[mask]") {
  // Where the old surface has a hole, its far side is seen through it.
  const TriangleMesh mesh = two_sheets(20.0);
  const auto matched = [&](double depth) {
    const Correspondence found =
        find(level_image(depth), mesh, {.method = CorrespondenceMethod::id_buffer});
    return std::count_if(found.face.pixels().begin(), found.face.pixels().end(),
                         [](PrimitiveId face) { return face != kNoPrimitive; });
  };
  CHECK(matched(18.6) == 18 * 18);  // within 1.5 pixel sides
  CHECK(matched(18.4) == 0);
  CHECK(matched(10.0) == 0);
}

TEST_CASE("the nearest face corresponds, also if it is seen in the next pixel only", "[mask]") {
  // A sheet at depth 20 left of x = 0, another at 21 right of it; samples at 21. From the sample at
  // x = -0.5 the second is half a pixel away, the one it is seen over a whole one.
  TriangleMesh mesh;
  mesh.positions = {{-9, -9, -20}, {0, -9, -20}, {0, 9, -20}, {-9, 9, -20},
                    {0, -9, -21},  {9, -9, -21}, {9, 9, -21}, {0, 9, -21}};
  mesh.triangles = {{0, 1, 2}, {0, 2, 3}, {4, 5, 6}, {4, 6, 7}};
  const RangeImage image = level_image(21.0);
  for (const auto method : {CorrespondenceMethod::depth_band, CorrespondenceMethod::id_buffer}) {
    const Correspondence found = find(image, mesh, {.method = method});
    CHECK(found.face[{9, 10}] / 2 == 1);
    CHECK(found.face[{8, 10}] / 2 == 0);
  }
  CpuRasterizer rasterizer;
  constexpr bool kAnyFace = true;
  const Correspondence seen =
      find_correspondence(rasterizer, image, estimate_slopes(image), mesh, {}, kAnyFace);
  CHECK(seen.face[{9, 10}] / 2 == 0);
}

TEST_CASE("a nearest face that is not seen and hangs together with nothing seen is found",
          "[mask]") {
  // A sheet at depth 20 up to x = 0, and a wall that goes down from (1, 21) away from the viewer,
  // over a gap: seen edge on, the wall is in no pixel. The samples lie at 21.2, so from x = -0.5
  // the sheet is 1.2 away; from x = 0.5 the wall is 0.5, the sheet 1.3.
  TriangleMesh mesh;
  mesh.positions = {{-9, -9, -20}, {0, -9, -20}, {0, 9, -20}, {-9, 9, -20}};
  mesh.triangles = {{0, 1, 2}, {0, 2, 3}};
  for (int k = 0; k <= 18; ++k) {
    mesh.positions.insert(mesh.positions.end(), {{1, k - 9, -21}, {1, k - 9, -24}});
    const auto v = static_cast<std::uint32_t>(mesh.positions.size());
    if (k == 0) continue;
    mesh.triangles.push_back({v - 4, v - 3, v - 1});
    mesh.triangles.push_back({v - 4, v - 1, v - 2});
  }
  const RangeImage image = level_image(21.2);
  Grid<PrimitiveId> seen(image.extent(), kNoPrimitive);
  for (int y = 1; y < 19; ++y) {
    for (int x = 1; x <= 10; ++x)
      seen[{x, y}] = 0;
  }
  const Grid<PrimitiveId> found = search_nearest_faces(seen, image, mesh, 1.5);
  for (int y = 2; y < 18; ++y) {
    CHECK(found[{9, y}] < 2);
    REQUIRE(found[{10, y}] != kNoPrimitive);
    CHECK(found[{10, y}] >= 2);
  }
}

TEST_CASE("find_correspondence refuses bands that are none", "[mask]") {
  const RangeImage image = level_image(20.0);
  const TriangleMesh mesh = two_sheets(20.0);
  CHECK_THROWS_AS(find(image, mesh, {.band = 0.0}), InvalidArgument);
  CHECK_THROWS_AS(find(image, mesh, {.back_band = -0.1}), InvalidArgument);
  CHECK_THROWS_AS(find(image, mesh, {.band = std::numeric_limits<double>::infinity()}),
                  InvalidArgument);
  CpuRasterizer rasterizer;
  CHECK_THROWS_AS(find_correspondence(rasterizer, image, SlopeImage(Extent{2, 2}), mesh),
                  InvalidArgument);
}

}  // namespace
}  // namespace rangezip

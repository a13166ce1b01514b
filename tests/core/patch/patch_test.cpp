#include "core/patch/patch.h"

#include <algorithm>
#include <set>

#include <catch2/catch.hpp>

#include "core/mesh/mesh_report.h"
#include "tests/support/shapes.h"

namespace rangezip {
namespace {

/// A view of `extent` pixels of side 1 that looks down -z.
View unit_view(Extent extent) {
  return View(Camera{.lens = Orthographic{.height = static_cast<double>(extent.height)},
                     .near_depth = 0.0,
                     .far_depth = 1000.0},
              extent);
}

RangeImage flat_image(Extent extent, double depth = 10.0) {
  return {unit_view(extent), Grid<double>(extent, depth)};
}

TEST_CASE("triangulate makes two triangles a cell of a full image", "[patch]") {
  const Extent extent{7, 5};
  const Patch patch = triangulate(flat_image(extent), full_mask(extent));
  CHECK(patch.mesh.positions.size() == 35);
  CHECK(patch.mesh.triangles.size() == 2 * 6 * 4);
  const MeshReport report = report_mesh(patch.mesh);
  CHECK(report.is_manifold());
  CHECK(report.euler == 1);
  CHECK(report.boundary_loops == 1);
  CHECK(report.longest_loop == Approx(2.0 * (6 + 4)).epsilon(1e-12));
  // Counter-clockwise for the viewer, who looks down -z; the areas add up to the rectangle.
  double area = 0.0;
  for (const Triangle& t : patch.mesh.triangles) {
    const Vec3 normal = area_vector(patch.mesh.positions[t[0]], patch.mesh.positions[t[1]],
                                    patch.mesh.positions[t[2]]);
    REQUIRE(normal.z > 0.0);
    area += 0.5 * glm::length(normal);
  }
  CHECK(area == Approx(24.0).epsilon(1e-12));
}

TEST_CASE("vertices of a patch are samples, numbered row by row", "[patch]") {
  const Extent extent{6, 6};
  RangeImage image = flat_image(extent);
  image[{2, 3}] = kNoSample;
  const Patch patch = triangulate(image, full_mask(extent));
  REQUIRE(patch.pixels.size() == patch.mesh.positions.size());
  for (std::size_t v = 0; v < patch.pixels.size(); ++v) {
    REQUIRE(patch.mesh.positions[v] == image.position(patch.pixels[v]));
    if (v > 0) REQUIRE(extent.index(patch.pixels[v - 1]) < extent.index(patch.pixels[v]));
  }
  CHECK(patch.pixels.size() == 35);
  // The four cells around the missing sample keep one triangle each.
  CHECK(patch.mesh.triangles.size() == 2 * 25 - 4);
  CHECK(report_mesh(patch.mesh).boundary_loops == 2);
}

TEST_CASE("the cells of a patch are those of its triangles, without dropped pieces", "[patch]") {
  RangeImage image = flat_image({8, 4}, 10.0);
  for (int y = 0; y < 4; ++y)
    image[{2, y}] = kNoSample;  // one column of cells on the left, four on the right
  const Patch patch = triangulate(image, full_mask({8, 4}), {.min_component = 7});
  std::size_t triangles = 0;
  for (int y = 0; y < 4; ++y) {
    for (int x = 0; x < 8; ++x) {
      const std::uint8_t bits = patch.cells[{x, y}];
      CHECK((x >= 3 || (bits & (kLowerTriangle | kUpperTriangle)) == 0));
      triangles += (bits & kLowerTriangle) != 0 ? 1 : 0;
      triangles += (bits & kUpperTriangle) != 0 ? 1 : 0;
    }
  }
  CHECK(patch.mesh.triangles.size() == 2 * 4 * 3);
  CHECK(triangles == patch.mesh.triangles.size());
}

TEST_CASE("vertices that no triangle uses go with their pixels", "[patch]") {
  const RangeImage image = flat_image({6, 4});
  Patch patch = triangulate(image, full_mask({6, 4}));
  std::erase_if(patch.mesh.triangles, [&](const Triangle& t) {
    return std::any_of(t.begin(), t.end(),
                       [&](std::uint32_t v) { return patch.pixels[v].x % 4 == 0; });
  });
  remove_unused_vertices(patch);
  CHECK(patch.pixels.size() == 3 * 4);
  REQUIRE(patch.pixels.size() == patch.mesh.positions.size());
  for (std::size_t v = 0; v < patch.pixels.size(); ++v)
    CHECK(patch.mesh.positions[v] == image.position(patch.pixels[v]));
}

TEST_CASE("pixel sides grow with the depth under a lens only", "[patch]") {
  const Extent extent{4, 4};
  RangeImage image(
      View(Camera{.lens = Perspective{}, .near_depth = 1.0, .far_depth = 1000.0}, extent),
      Grid<double>(extent, 10.0));
  image[{2, 1}] = 10.5;
  const PixelSides sides = pixel_sides_of(triangulate(image, full_mask(extent)), image);
  CHECK(sides.smallest == image.view().pixel_size(10.0));
  CHECK(sides.largest == image.view().pixel_size(10.5));
  CHECK(sides.largest > sides.smallest);
  const RangeImage parallel = flat_image(extent);
  const PixelSides equal = pixel_sides_of(triangulate(parallel, full_mask(extent)), parallel);
  CHECK((equal.smallest == 1.0 && equal.largest == 1.0));
}

TEST_CASE("triangulate cuts a cell along the smaller step of depth", "[patch]") {
  const Extent extent{2, 2};
  RangeImage image = flat_image(extent);
  image[{1, 1}] = 11.0;  // the other diagonal is level
  const Patch rising = triangulate(image, full_mask(extent));
  REQUIRE(rising.mesh.triangles.size() == 2);
  const std::set<Triangle> falling_cut{{0, 1, 2}, {1, 3, 2}};
  CHECK(std::set<Triangle>(rising.mesh.triangles.begin(), rising.mesh.triangles.end()) ==
        falling_cut);

  RangeImage turned = flat_image(extent);
  turned[{1, 0}] = 11.0;
  const Patch falling = triangulate(turned, full_mask(extent));
  const std::set<Triangle> rising_cut{{0, 1, 3}, {0, 3, 2}};
  CHECK(std::set<Triangle>(falling.mesh.triangles.begin(), falling.mesh.triangles.end()) ==
        rising_cut);
}

TEST_CASE("triangulate leaves a step of depth open", "[patch]") {
  const Extent extent{8, 4};
  RangeImage image = flat_image(extent, 10.0);
  for (int y = 0; y < 4; ++y) {
    for (int x = 4; x < 8; ++x)
      image[{x, y}] = 14.0;
  }
  CHECK(report_mesh(triangulate(image, full_mask(extent)).mesh).components == 1);
  const Patch open = triangulate(image, full_mask(extent), {.max_edge = 2.75});
  CHECK(report_mesh(open.mesh).components == 2);
  CHECK(open.mesh.triangles.size() == 2 * 2 * 3 * 3);
  // A step of 3.8 pixel sides is below 2.75 sqrt 2 = 3.889.
  for (int y = 0; y < 4; ++y) {
    for (int x = 4; x < 8; ++x)
      image[{x, y}] = 13.8;
  }
  CHECK(report_mesh(triangulate(image, full_mask(extent), {.max_edge = 2.75}).mesh).components ==
        1);
  // Seen at an angle whose tangent is 3.8, which is steeper than 75 degrees.
  CHECK(report_mesh(triangulate(image, full_mask(extent), {.max_slope_cosine = 0.2588}).mesh)
            .components == 2);
}

/// Two cells of a 3 x 3 image that meet in the middle sample only: the lower left one at depth 10,
/// the upper right one at 13, the middle between them; the other two cells have steps of 3.
RangeImage touching_cells() {
  RangeImage image = flat_image({3, 3}, 13.0);
  image[{0, 0}] = image[{1, 0}] = image[{0, 1}] = 10.0;
  image[{1, 1}] = 11.5;
  image[{2, 0}] = image[{0, 2}] = kNoSample;
  return image;
}
constexpr TriangulateOptions kTouchingCells{.max_edge = 1.5};  // steps up to 2.12

TEST_CASE("of two fans that touch in a vertex only the wider one stays there", "[patch]") {
  RangeImage image = touching_cells();
  image[{0, 1}] = kNoSample;  // the lower left cell now takes 45 degrees of the middle, not 90
  Patch patch = triangulate(image, full_mask({3, 3}), kTouchingCells);
  CHECK(patch.mesh.triangles.size() == 2);
  CHECK(patch.pixels == std::vector<Pixel>{{1, 1}, {2, 1}, {1, 2}, {2, 2}});

  image = touching_cells();
  image[{1, 2}] = kNoSample;
  patch = triangulate(image, full_mask({3, 3}), kTouchingCells);
  CHECK(patch.mesh.triangles.size() == 2);
  CHECK(patch.pixels == std::vector<Pixel>{{0, 0}, {1, 0}, {0, 1}, {1, 1}});
}

TEST_CASE("of two equal fans that touch in a vertex one loses its triangle there", "[patch]") {
  const Patch patch = triangulate(touching_cells(), full_mask({3, 3}), kTouchingCells);
  CHECK_NOTHROW(check_mesh(patch.mesh));
  CHECK(patch.mesh.triangles.size() == 3);
  CHECK(report_mesh(patch.mesh).components == 2);
}

TEST_CASE("triangulate is manifold for any mask and any depths", "[patch]") {
  for (std::uint64_t seed = 1; seed <= 300; ++seed) {
    CAPTURE(seed);
    shapes::Random random(seed);
    const Extent extent{2 + static_cast<int>(random.bits() % 30),
                        2 + static_cast<int>(random.bits() % 30)};
    const unsigned percent = 40 + static_cast<unsigned>(random.bits() % 60);
    Mask mask(extent, 0);
    for (std::uint8_t& pixel : mask.pixels())
      pixel = random.bits() % 100 < percent ? 1 : 0;
    RangeImage image = flat_image(extent);
    for (int y = 0; y < extent.height; ++y) {
      for (double& depth : image.row(y))
        depth = random.between(10.0, 16.0);
    }
    const Patch patch = triangulate(image, mask, {.max_edge = 3.0});
    REQUIRE_NOTHROW(check_mesh(patch.mesh));
    const MeshReport report = report_mesh(patch.mesh);
    REQUIRE(report.is_manifold());
    // A planar patch: each piece is a disc with holes, chi = 1 - holes, and one outer loop each.
    REQUIRE(report.euler == 2 * static_cast<std::ptrdiff_t>(report.components) -
                                static_cast<std::ptrdiff_t>(report.boundary_loops));
    REQUIRE(report.vertices == patch.pixels.size());
    for (const Pixel p : patch.pixels)
      REQUIRE(mask[p] == 1);

    const Patch large = triangulate(image, mask, {.max_edge = 3.0, .min_component = 5});
    REQUIRE(large.pixels.size() == large.mesh.positions.size());
    for (std::size_t v = 0; v < large.pixels.size(); ++v) {
      REQUIRE(large.mesh.positions[v] == image.position(large.pixels[v]));
    }
    REQUIRE(large.mesh.triangles.size() + 4 * report.components >= report.faces);
    REQUIRE(5 * report_mesh(large.mesh).components <= large.mesh.triangles.size());
  }
}

TEST_CASE("triangulate drops pieces with fewer triangles than asked", "[patch]") {
  const Extent extent{10, 4};
  Mask mask = full_mask(extent);
  for (int y = 0; y < 4; ++y)
    mask[{2, y}] = 0;  // leaves 2 x 4 and 7 x 4 pixels
  CHECK(triangulate(flat_image(extent), mask).mesh.triangles.size() == 6 + 36);
  CHECK(triangulate(flat_image(extent), mask, {.min_component = 6}).mesh.triangles.size() == 42);
  CHECK(triangulate(flat_image(extent), mask, {.min_component = 7}).mesh.triangles.size() == 36);
  CHECK(triangulate(flat_image(extent), mask, {.min_component = 37}).mesh.empty());
}

TEST_CASE("triangulate of nothing is empty", "[patch]") {
  const Extent extent{4, 4};
  CHECK(triangulate(RangeImage(unit_view(extent)), full_mask(extent)).mesh.empty());
  CHECK(triangulate(flat_image(extent), Mask(extent, 0)).mesh.empty());
  CHECK(triangulate(flat_image({1, 1}), full_mask({1, 1})).mesh.empty());
}

}  // namespace
}  // namespace rangezip

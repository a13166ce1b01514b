#include "core/patch/decimate.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <set>

#include <catch2/catch.hpp>

#include "core/base/error.h"
#include "core/base/parallel.h"
#include "core/mesh/mesh_report.h"
#include "tests/support/images.h"
#include "tests/support/shapes.h"

namespace rangezip {
namespace {

using images::central_view;
using images::image_of;
using images::parallel_view;

Patch whole_patch(const RangeImage& image) {
  return triangulate(image, full_mask(image.extent()));
}

int twice_area(Pixel a, Pixel b, Pixel c) {
  return (b.x - a.x) * (c.y - a.y) - (b.y - a.y) * (c.x - a.x);
}

/// The largest distance of a sample from the triangles that cover it, along the line of sight, in
/// pixel sides; every cell must be covered once.
double largest_error(const RangeImage& image, const Patch& patch) {
  double largest = 0.0;
  for (const Triangle& t : patch.mesh.triangles) {
    const std::array<Pixel, 3> p{patch.pixels[t[0]], patch.pixels[t[1]], patch.pixels[t[2]]};
    const Vec3& a = patch.mesh.positions[t[0]];
    const Vec3 normal = area_vector(a, patch.mesh.positions[t[1]], patch.mesh.positions[t[2]]);
    for (int y = std::min({p[0].y, p[1].y, p[2].y}); y <= std::max({p[0].y, p[1].y, p[2].y}); ++y) {
      for (int x = std::min({p[0].x, p[1].x, p[2].x}); x <= std::max({p[0].x, p[1].x, p[2].x});
           ++x) {
        const Pixel q{x, y};
        if (twice_area(p[0], p[1], q) < 0 || twice_area(p[1], p[2], q) < 0 ||
            twice_area(p[2], p[0], q) < 0) {
          continue;
        }
        // The ray through the pixel, met with the plane of the triangle.
        const Vec3 near = image.view().position(q, 1.0), far = image.view().position(q, 2.0);
        const double depth = 1.0 + glm::dot(normal, a - near) / glm::dot(normal, far - near);
        largest = std::max(largest, std::abs(depth - image[q]) / image.pixel_size(q));
      }
    }
  }
  return largest;
}

/// Directed edges without their opposite, by pixels.
std::set<std::array<Pixel, 2>> open_edges(const Patch& patch) {
  std::set<std::array<Pixel, 2>> edges;
  for (const Triangle& t : patch.mesh.triangles) {
    for (std::size_t k = 0; k < 3; ++k)
      edges.insert({patch.pixels[t[k]], patch.pixels[t[(k + 1) % 3]]});
  }
  std::set<std::array<Pixel, 2>> open;
  for (const auto& [from, to] : edges) {
    if (edges.count({to, from}) == 0) open.insert({from, to});
  }
  return open;
}

/// In square pixels; all triangles must run counter-clockwise.
double area_in_image(const Patch& patch) {
  double area = 0.0;
  for (const Triangle& t : patch.mesh.triangles) {
    const int twice = twice_area(patch.pixels[t[0]], patch.pixels[t[1]], patch.pixels[t[2]]);
    REQUIRE(twice > 0);
    area += 0.5 * twice;
  }
  return area;
}

TEST_CASE("decimate merges a flat patch to blocks but for the cells at its boundary", "[patch]") {
  const RangeImage image =
      image_of(parallel_view({67, 67}), [](Pixel p) { return 20.0 + 0.25 * p.x - 0.125 * p.y; });
  const Patch full = whole_patch(image);
  const Patch patch = decimate(image, full, {.tolerance = 1e-9});
  CHECK(patch.mesh.triangles.size() < full.mesh.triangles.size() / 5 + 1);
  CHECK(area_in_image(patch) == 66.0 * 66.0);
  CHECK(open_edges(patch) == open_edges(full));
  CHECK(report_mesh(patch.mesh).is_manifold());
  CHECK(report_mesh(patch.mesh).euler == 1);
  // Blocks of side 2, 4, 8, 16 begin at 2, 4, 8, 16 on the diagonal.
  const std::set<Pixel> pixels(patch.pixels.begin(), patch.pixels.end());
  for (int k = 1; k < 31; ++k)
    CHECK(pixels.count({k, k}) == (k <= 2 || k == 4 || k == 8 || k == 16 ? 1 : 0));
}

TEST_CASE("decimate leaves steep places as they are", "[patch]") {
  const auto faces_at = [](double slope) {
    const RangeImage image =
        image_of(parallel_view({40, 40}), [=](Pixel p) { return 5.0 + slope * p.x; });
    return decimate(image, whole_patch(image), {}).mesh.triangles.size();
  };
  CHECK(faces_at(1.49) < 2 * 39 * 39 / 2);
  CHECK(faces_at(1.51) == 2 * 39 * 39);
}

TEST_CASE("decimate knows a plane in a central projection", "[patch]") {
  // The plane z = 0.3 x - 10 of eye space: the depth on the ray (x, y, -1) t is t.
  const View view = central_view({40, 40});
  const RangeImage image = image_of(view, [&](Pixel p) {
    const Vec3 ray = view.position(p, 1.0);
    return 10.0 / (1.0 + 0.3 * ray.x);
  });
  const Patch full = whole_patch(image);
  const Patch patch = decimate(image, full, {.tolerance = 1e-9});
  CHECK(patch.mesh.triangles.size() < full.mesh.triangles.size() / 3);
  CHECK(largest_error(image, patch) < 2e-9);
}

TEST_CASE("decimate keeps what is smaller than a pixel at a crease and no more", "[patch]") {
  // A roof whose ridge runs along no axis.
  const RangeImage image = image_of(parallel_view({130, 130}), [](Pixel p) {
    return 30.0 + 0.5 * std::abs(p.x - 0.3 * p.y - 44.7);
  });
  const Patch patch = decimate(image, whole_patch(image), {.tolerance = 0.01});
  CHECK(largest_error(image, patch) <= 0.01 + 1e-9);
  CHECK(patch.mesh.triangles.size() < 2 * 129 * 129 / 5);
}

/// Bumps of many sizes: curved in some places, nearly flat in others.
RangeImage bumpy_image(shapes::Random& random, Extent extent) {
  const double a = random.between(0.02, 0.2), b = random.between(0.02, 0.2);
  const double height = random.between(0.1, 3.0);
  return image_of(parallel_view(extent), [=](Pixel p) {
    return 30.0 + height * std::sin(a * p.x) * std::sin(b * p.y) * p.x / extent.width;
  });
}

TEST_CASE("a decimated patch has the boundary, the topology and the tolerance", "[patch]") {
  for (std::uint64_t seed = 1; seed <= 60; ++seed) {
    CAPTURE(seed);
    shapes::Random random(seed);
    const Extent extent{10 + static_cast<int>(random.bits() % 90),
                        10 + static_cast<int>(random.bits() % 90)};
    const RangeImage image = bumpy_image(random, extent);
    Mask mask = full_mask(extent);
    for (int hole = 0; hole < 3; ++hole)
      mask[{static_cast<int>(random.bits() % static_cast<unsigned>(extent.width)),
            static_cast<int>(random.bits() % static_cast<unsigned>(extent.height))}] = 0;
    const Patch full = triangulate(image, mask);
    const double tolerance = random.between(0.0, 0.1);
    const Patch patch = decimate(image, full, {.tolerance = tolerance});
    CHECK_NOTHROW(check_mesh(patch.mesh));
    REQUIRE(report_mesh(patch.mesh).is_manifold());
    REQUIRE(report_mesh(patch.mesh).euler == report_mesh(full.mesh).euler);
    REQUIRE(open_edges(patch) == open_edges(full));
    REQUIRE(area_in_image(patch) == area_in_image(full));
    REQUIRE(largest_error(image, patch) <= tolerance + 1e-9);
    REQUIRE(patch.cells == full.cells);
    REQUIRE(std::is_sorted(patch.pixels.begin(), patch.pixels.end(),
                           [&](Pixel p, Pixel q) { return extent.index(p) < extent.index(q); }));
  }
}

TEST_CASE("triangles of a decimated patch grow gradually", "[patch]") {
  shapes::Random random(5);
  const RangeImage image = bumpy_image(random, {120, 100});
  const Patch patch = decimate(image, whole_patch(image), {.tolerance = 0.05});
  const std::size_t count = patch.pixels.size();
  std::vector<int> smallest(count, 1000), largest(count, 0);
  for (const Triangle& t : patch.mesh.triangles) {
    int side = 0;
    for (std::size_t k = 0; k < 3; ++k) {
      const Pixel p = patch.pixels[t[k]], q = patch.pixels[t[(k + 1) % 3]];
      side = std::max({side, std::abs(p.x - q.x), std::abs(p.y - q.y)});
    }
    for (const std::uint32_t v : t) {
      smallest[v] = std::min(smallest[v], side);
      largest[v] = std::max(largest[v], side);
    }
  }
  // Blocks at a vertex differ by a factor of 2, the triangles of a block by another.
  for (std::size_t v = 0; v < count; ++v)
    REQUIRE(largest[v] <= 4 * smallest[v]);
  CHECK(*std::max_element(largest.begin(), largest.end()) >= 8);
}

TEST_CASE("decimate gives the same patch for any number of threads", "[patch]") {
  shapes::Random random(6);
  const RangeImage image = bumpy_image(random, {200, 150});
  Patch one, two;
  run_with_threads(1, [&] { one = decimate(image, whole_patch(image), {}); });
  run_with_threads(2, [&] { two = decimate(image, whole_patch(image), {}); });
  CHECK(one.mesh == two.mesh);
  CHECK(one.pixels == two.pixels);
}

TEST_CASE("decimate refuses options out of range", "[patch]") {
  const RangeImage image = image_of(parallel_view({4, 4}), [](Pixel) { return 10.0; });
  CHECK_THROWS_AS(decimate(image, whole_patch(image), {.tolerance = -0.1}), InvalidArgument);
  CHECK_THROWS_AS(decimate(image, whole_patch(image), {.tolerance = kNoSample}), InvalidArgument);
  CHECK_THROWS_AS(decimate(image, whole_patch(image), {.max_block = 0}), InvalidArgument);
  CHECK_THROWS_AS(decimate(image, whole_patch(image), {.max_block = 1 << 30}), InvalidArgument);
}

}  // namespace
}  // namespace rangezip

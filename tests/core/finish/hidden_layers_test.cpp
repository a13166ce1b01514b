#include "core/finish/hidden_layers.h"

#include <algorithm>
#include <catch2/catch.hpp>
#include <cstddef>
#include <random>

#include "tests/core/finish/shapes.h"
#include "tests/support/shapes.h"

namespace rangezip {
namespace {

constexpr double kH = 0.1;

/// Layers of a sphere: points of so many radii each, and whether they are seen.
struct Layers {
  std::vector<Vec3> samples;
  std::vector<std::uint8_t> is_unseen;

  void add(double radius, bool is_seen, double lowest = -1.0) {
    std::mt19937_64 engine(samples.size() + 1);
    for (Vec3 p : testing::sphere_points(kH / 3.0, 0.0, engine)) {
      p = radius * glm::normalize(p);
      if (p.z < lowest * radius) continue;
      samples.push_back(p);
      is_unseen.push_back(is_seen ? 0 : 1);
    }
  }
};

TEST_CASE("layers behind the mesh that nothing shows are dropped, and nothing else") {
  const TriangleMesh mesh = testing::sphere(24);
  Layers layers;
  layers.add(1.0, true);               // the surface
  layers.add(1.0 + 1.5 * kH, false);   // before it
  layers.add(1.0 - 0.05 * kH, false);  // as good as on it
  layers.add(1.0 - 2.0 * kH, true);    // behind it, but seen
  std::vector<Vec3> expected = layers.samples;
  for (const double behind : {0.4, 1.0, 3.0})
    layers.add(1.0 - behind * kH, false);
  REQUIRE(layers.samples.size() > expected.size());
  drop_hidden_layers(layers.samples, layers.is_unseen, mesh, kH);
  CHECK(layers.samples == expected);
}

TEST_CASE("where two walls go through each other, what of each lies inside of the other goes") {
  TriangleMesh mesh = shapes::square_sheet(20);  // a floor for x > 0, and a wall that stands on it
  for (Vec3& p : mesh.positions)
    p = kH * (p.x < 0.0 ? Vec3{0.0, p.y, -p.x} : p);
  Layers layers;
  std::vector<Vec3> expected;
  const auto add = [&](const Vec3& sample, bool is_seen) {
    layers.samples.push_back(kH * sample);
    layers.is_unseen.push_back(is_seen ? 0 : 1);
    if (is_seen) expected.push_back(layers.samples.back());
  };
  for (double y = -7.0; y <= 7.0; y += 0.25) {
    for (double along = 0.125; along <= 8.0; along += 0.25) {
      add({along, y, 0.0}, true);
      add({0.0, y, along}, true);
      if (along < 0.3 || along > 3.0) continue;
      add({-along, y, 0.0}, false);  // behind the wall
      add({0.0, y, -along}, false);  // under the floor
    }
  }
  REQUIRE(layers.samples.size() > expected.size());
  drop_hidden_layers(layers.samples, layers.is_unseen, mesh, kH);
  CHECK(layers.samples == expected);
}

TEST_CASE("what lies behind faces in the air stays") {
  const TriangleMesh mesh = testing::sphere(24);
  Layers layers;
  layers.add(1.0, true, 0.0);  // half of the mesh has no samples
  const std::size_t surface = layers.samples.size();
  layers.add(1.0 - kH, false);
  const auto is_below = [](const Vec3& p) { return p.z < -kH; };
  const auto below = std::count_if(layers.samples.begin(), layers.samples.end(), is_below);
  drop_hidden_layers(layers.samples, layers.is_unseen, mesh, kH);
  CHECK(std::count_if(layers.samples.begin(), layers.samples.end(), is_below) == below);
  CHECK(std::none_of(layers.samples.begin() + static_cast<std::ptrdiff_t>(surface),
                     layers.samples.end(), [](const Vec3& p) { return p.z > kH; }));
}

TEST_CASE("flat faces support the mesh that ends just inside of them") {
  TriangleMesh mesh = testing::cube(20);
  for (Vec3& p : mesh.positions)
    p *= 1.0 - 1e-9;
  Layers layers;
  for (const double half_side : {1.0, 1.0 - 0.5 * kH}) {
    for (const Vec3& p : testing::cube(60).positions) {
      layers.samples.push_back(half_side * p);
      layers.is_unseen.push_back(half_side < 1.0 ? 1 : 0);
    }
  }
  drop_hidden_layers(layers.samples, layers.is_unseen, mesh, kH);
  CHECK(layers.samples == testing::cube(60).positions);
}

TEST_CASE("where all is seen, or there is no mesh, nothing is dropped") {
  Layers layers;
  layers.add(0.9, true);
  std::vector<Vec3> samples = layers.samples;
  drop_hidden_layers(samples, layers.is_unseen, testing::sphere(8), kH);
  CHECK(samples == layers.samples);
  drop_hidden_layers(samples, std::vector<std::uint8_t>(samples.size(), 1), {}, kH);
  CHECK(samples == layers.samples);
}

}  // namespace
}  // namespace rangezip

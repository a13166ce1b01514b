#include "core/plan/hidden_samples.h"

#include <algorithm>
#include <array>
#include <catch2/catch.hpp>
#include <cmath>
#include <cstdint>
#include <memory>
#include <utility>
#include <vector>

#include "core/plan/outer_samples.h"
#include "core/plan/spacing.h"
#include "raster_cpu/cpu_rasterizer.h"
#include "tests/support/shapes.h"

namespace rangezip {
namespace {

constexpr double kPixel = 0.05;

Scene scene_of(TriangleSoup soup) {
  Scene scene;
  scene.add(std::make_shared<const TriangleSoup>(std::move(soup)));
  return scene;
}

TriangleSoup turned_over(TriangleSoup soup) {
  for (Triangle& t : soup.triangles)
    std::swap(t[1], t[2]);
  return soup;
}

/// A ball with a round cavity whose mouth is so wide: no direction shows most of its walls.
TriangleSoup ball_with_cavity(double mouth) {
  constexpr double kPi = 3.14159265358979323846, kInner = 0.7;
  std::vector<Vec2> profile = shapes::arc(1.0, 0.0, kPi - std::asin(0.5 * mouth), 64);
  const std::vector<Vec2> inner =
      shapes::arc(kInner, kPi - std::asin(0.5 * mouth / kInner), 0.0, 64);
  profile.insert(profile.end(), inner.begin(), inner.end());
  return shapes::revolved(profile, false);
}

std::size_t count_of(const std::vector<std::uint8_t>& flags) {
  return static_cast<std::size_t>(std::count(flags.begin(), flags.end(), 1));
}

TEST_CASE("all of a body that stands alone is outer, whichever way its triangles look") {
  for (const TriangleSoup& soup : {shapes::cube(), shapes::washer(), ball_with_cavity(0.1),
                                   turned_over(ball_with_cavity(0.1))}) {
    const Scene scene = scene_of(soup);
    const std::vector<Vec3> samples = area_samples(scene, 20'000);
    CHECK(count_of(outer_samples(scene, samples)) == samples.size());
  }
}

TEST_CASE("what lies within a body, or is the wall of a closed void, is not outer") {
  const bool is_void = GENERATE(false, true);
  CAPTURE(is_void);
  Scene scene = scene_of(shapes::sphere(1.0));
  TriangleSoup inner = shapes::sphere(0.8);
  if (is_void) inner = turned_over(std::move(inner));
  scene.add(std::make_shared<const TriangleSoup>(std::move(inner)));
  const std::vector<Vec3> samples = area_samples(scene, 20'000);
  const std::vector<std::uint8_t> is_outer = outer_samples(scene, samples);
  for (std::size_t i = 0; i < samples.size(); ++i)
    CHECK(is_outer[i] == (glm::length(samples[i]) > 0.9 ? 1 : 0));
}

TEST_CASE("where two bodies overlap the part of each within the other is not outer") {
  Scene scene = scene_of(shapes::sphere(1.0));
  const Vec3 offset(0.9, 0.3, 0.2);
  Mat4 placement(1.0);
  placement[3] = Vec4(offset, 1.0);
  scene.add(std::make_shared<const TriangleSoup>(shapes::sphere(1.0)), placement);
  const std::vector<Vec3> samples = area_samples(scene, 20'000);
  const std::vector<std::uint8_t> is_outer = outer_samples(scene, samples);
  for (std::size_t i = 0; i < samples.size(); ++i) {
    const double least = std::min(glm::length(samples[i]), glm::length(samples[i] - offset));
    if (std::abs(least - 1.0) > 0.01) CHECK(is_outer[i] == 0);
    if (least > 0.9999) CHECK(is_outer[i] == 1);
  }
}

TEST_CASE("a single triangle has no outside that lines could tell") {
  TriangleSoup soup;
  soup.positions = {{0, 0, 0}, {1, 0, 0.3F}, {0, 1, 0.4F}};
  soup.triangles = {{0, 1, 2}};
  const Scene scene = scene_of(soup);
  CHECK(count_of(outer_samples(scene, area_samples(scene, 1000))) == 0);
  CHECK(outer_samples(scene, {}).empty());
}

TEST_CASE("slivers across the whole scene are told like any other triangles") {
  // The sides of a long thin drum along no axis.
  const std::array<Vec2, 4> profile{Vec2(0, -10), Vec2(0.1, -10), Vec2(0.1, 10), Vec2(0, 10)};
  const Scene scene =
      scene_of(shapes::moved(shapes::revolved(profile, false, 20'000), shapes::tilt()));
  CHECK(are_outer(outer_samples(scene, area_samples(scene, 5'000))));
}

TEST_CASE("the walls of a cavity are not hidden, those of a body within a body are") {
  CpuRasterizer rasterizer;
  const Scene cavity = scene_of(ball_with_cavity(0.1));
  CHECK(count_of(hidden_samples(rasterizer, cavity, area_samples(cavity, 20'000), kPixel)) == 0);
  Scene nested = scene_of(shapes::sphere(1.0));
  nested.add(std::make_shared<const TriangleSoup>(shapes::sphere(0.7)));
  const std::vector<Vec3> samples = area_samples(nested, 20'000);
  const std::vector<std::uint8_t> is_hidden = hidden_samples(rasterizer, nested, samples, kPixel);
  for (std::size_t i = 0; i < samples.size(); ++i)
    CHECK(is_hidden[i] == (glm::length(samples[i]) < 0.8 ? 1 : 0));
}

}  // namespace
}  // namespace rangezip

#include "core/scene/scene.h"

#include <catch2/catch.hpp>
#include <limits>
#include <variant>

#include "core/base/error.h"

namespace rangezip {
namespace {

std::shared_ptr<const PointCloud> three_points() {
  return std::make_shared<const PointCloud>(PointCloud{{{0, 0, 0}, {1, 0, 0}, {0, 2, 0}}});
}

std::shared_ptr<const TriangleSoup> two_triangles() {
  return std::make_shared<const TriangleSoup>(
      TriangleSoup{{{0, 0, 0}, {1, 0, 0}, {0, 1, 0}, {1, 1, 3}}, {{0, 1, 2}, {2, 1, 3}}});
}

Mat4 moved(const Vec3& offset) {
  Mat4 matrix{1.0};
  matrix[3] = Vec4(offset, 1.0);
  return matrix;
}

}  // namespace

TEST_CASE("A scene numbers points and triangles in order of addition") {
  Scene scene;
  CHECK(scene.empty());
  scene.add(three_points());
  scene.add(two_triangles());
  scene.add(three_points());
  CHECK(scene.point_count() == 6);
  CHECK(scene.triangle_count() == 2);
  const std::vector<DrawItem> items = scene.draw_items(5);
  REQUIRE(items.size() == 3);
  CHECK(first_id(items[0]) == 0);
  CHECK(first_id(items[1]) == 3);
  CHECK(first_id(items[2]) == 5);
  CHECK(std::get<DrawPoints>(items[2]).point_size == 5);
}

TEST_CASE("Bounds and points of a scene are in world space") {
  Scene scene;
  scene.add(three_points(), moved({1e6, 0, 0}));
  scene.add(two_triangles(), moved({1e6, -1, 0}));
  CHECK(scene.bounds() == Box{{1e6, -1, 0}, {1e6 + 1, 2, 3}});
  CHECK(scene.points() == std::vector<Vec3>{{1e6, 0, 0}, {1e6 + 1, 0, 0}, {1e6, 2, 0}});
}

TEST_CASE("Votes are shared out to the clouds of a scene in order") {
  Scene scene;
  scene.add(three_points());
  scene.add(two_triangles());
  scene.add(three_points());
  const std::vector<std::int8_t> votes{1, 2, 3, 4, 5, 6};
  const std::vector<DrawItem> items = scene.draw_items(1, votes);
  CHECK(std::get<DrawPoints>(items[0]).votes[2] == 3);
  CHECK(std::get<DrawPoints>(items[2]).votes[0] == 4);
  CHECK_THROWS_AS(scene.draw_items(1, std::span(votes).first(5)), InvalidArgument);
}

TEST_CASE("Copies of a scene share contents; other contents never share a key") {
  Scene scene;
  scene.add(three_points());
  scene.add(three_points());
  const Scene copy = scene;
  const auto key = [](const Scene& of, std::size_t i) {
    return std::get<DrawPoints>(of.draw_items()[i]).content_key;
  };
  CHECK(key(scene, 0) == key(copy, 0));
  CHECK(key(scene, 0) != key(scene, 1));
  CHECK(key(scene, 0) != 0);
}

TEST_CASE("A scene refuses null, wrong corners and placements that are not affine") {
  Scene scene;
  CHECK_THROWS_AS(scene.add(std::shared_ptr<const PointCloud>{}), InvalidArgument);
  CHECK_THROWS_AS(scene.add(std::shared_ptr<const TriangleSoup>{}), InvalidArgument);
  const auto wrong =
      std::make_shared<const TriangleSoup>(TriangleSoup{{{0, 0, 0}, {1, 0, 0}}, {{0, 1, 2}}});
  CHECK_THROWS_AS(scene.add(wrong), InvalidArgument);
  Mat4 projective{1.0};
  projective[0][3] = 1.0;
  CHECK_THROWS_AS(scene.add(three_points(), projective), InvalidArgument);
  Mat4 infinite{1.0};
  infinite[3][0] = std::numeric_limits<double>::infinity();
  CHECK_THROWS_AS(scene.add(three_points(), infinite), InvalidArgument);
  CHECK(scene.empty());
}

}  // namespace rangezip

// Pictures: what is shown where, in which hue, and what is not.

#include <catch2/catch.hpp>

#include "core/base/error.h"
#include "core/base/parallel.h"
#include "core/mesh/mesh_report.h"
#include "core/render/lines.h"
#include "core/render/picture.h"
#include "raster_cpu/cpu_rasterizer.h"
#include "tests/support/shapes.h"

using namespace rangezip;

namespace {

using Color = std::array<std::uint8_t, 3>;

constexpr Color kWhite{255, 255, 255};
const Vec3 kFromFront{0.0, 0.0, 1.0};

bool is_blue(const Color& color) {
  return color[2] > color[0] + 20;
}
bool is_orange(const Color& color) {
  return color[0] > color[2] + 60 && color[1] > 60;
}
bool is_red(const Color& color) {
  return color[0] > 150 && color[1] < 60 && color[2] < 90;
}

Picture draw(const PictureContent& content, const PictureOptions& options = {},
             const Vec3& toward_viewer = kFromFront) {
  CpuRasterizer rasterizer;
  return draw_picture(rasterizer, content, frame_picture(content, toward_viewer, options.extent),
                      options);
}

TriangleMesh turned_over(TriangleMesh mesh) {
  for (Triangle& triangle : mesh.triangles)
    std::swap(triangle[1], triangle[2]);
  return mesh;
}

template <class Predicate>
std::size_t count(const Picture& picture, const Predicate& predicate) {
  return static_cast<std::size_t>(
      std::count_if(picture.pixels().begin(), picture.pixels().end(), predicate));
}

constexpr PictureOptions kSmall{.extent = {120, 100}};

}  // namespace

TEST_CASE("outsides are blue, insides orange, the background white", "[picture]") {
  const TriangleMesh sphere = shapes::to_mesh(shapes::sphere());
  const Picture outside = draw({.mesh = sphere}, kSmall);
  CHECK(outside[{0, 0}] == kWhite);
  CHECK(outside[{119, 99}] == kWhite);
  CHECK(is_blue(outside[{60, 50}]));
  CHECK(count(outside, is_orange) == 0);
  const Picture inside = draw({.mesh = turned_over(sphere)}, kSmall);
  CHECK(is_orange(inside[{60, 50}]));
  CHECK(count(inside, is_blue) == 0);
}

TEST_CASE("the outline is smooth: its pixels mix object and background", "[picture]") {
  const TriangleMesh sphere = shapes::to_mesh(shapes::sphere());
  const auto mixed = [](const Color& c) { return c != kWhite && c[0] > 200; };
  PictureOptions coarse = kSmall;
  coarse.supersampling = 1;
  const std::size_t without = count(draw({.mesh = sphere}, coarse), mixed);
  const std::size_t with = count(draw({.mesh = sphere}, kSmall), mixed);
  CHECK(with > without + 50);
}

TEST_CASE("the boundary is marked where it can be seen", "[picture]") {
  PictureOptions options = kSmall;
  options.boundary = true;
  const TriangleMesh bowl = shapes::to_mesh(shapes::bowl());
  CHECK(count(draw({.mesh = bowl}, options), is_red) > 100);  // all around the rim
  CHECK(count(draw({.mesh = shapes::to_mesh(shapes::sphere())}, options), is_red) == 0);
  CHECK(count(draw({.mesh = bowl}, kSmall), is_red) == 0);

  // A small open square behind a closed box.
  PictureContent hidden{.mesh = shapes::to_mesh(shapes::cube())};
  const auto first = static_cast<std::uint32_t>(hidden.mesh.positions.size());
  for (const Vec3& p : {Vec3{-0.3, -0.3, -2.0}, Vec3{0.3, -0.3, -2.0}, Vec3{0.0, 0.3, -2.0}})
    hidden.mesh.positions.push_back(p);
  hidden.mesh.triangles.push_back({first, first + 1, first + 2});
  CHECK(count(draw(hidden, options), is_red) == 0);
  CHECK(count(draw(hidden, options, {0.0, 0.0, -1.0}), is_red) > 10);
}

TEST_CASE("edges darken the picture along them", "[picture]") {
  const TriangleMesh cube = shapes::to_mesh(shapes::cube());
  PictureOptions with_edges = kSmall;
  with_edges.edges = true;
  const Picture plain = draw({.mesh = cube}, kSmall);
  const Picture lined = draw({.mesh = cube}, with_edges);
  CHECK(plain != lined);
  int darker = 0;
  for (std::size_t i = 0; i < plain.pixels().size(); ++i) {
    CHECK(lined.pixels()[i][1] <= plain.pixels()[i][1]);
    darker += lined.pixels()[i][1] < plain.pixels()[i][1] ? 1 : 0;
  }
  CHECK(darker > 100);
}

TEST_CASE("every edge is listed once, the boundary apart", "[picture]") {
  const TriangleMesh cube = shapes::to_mesh(shapes::cube());
  CHECK(edges_of(cube, false).size() == 3 * cube.triangles.size() / 2);
  CHECK(edges_of(cube, true).empty());
  const TriangleMesh bowl = shapes::to_mesh(shapes::bowl());
  const auto rim = edges_of(bowl, true);
  CHECK(rim.size() == report_mesh(bowl).boundary_edges);
  for (const auto& [a, b] : rim) {
    CHECK(bowl.positions[a].z == Approx(0.0).margin(1e-6));
    CHECK(a < b);
  }
}

TEST_CASE("a point behind its neighbours is darker", "[picture]") {
  // A dense square with one point missing in its middle, through which one behind is seen.
  PictureContent content;
  for (int y = -20; y <= 20; ++y) {
    for (int x = -20; x <= 20; ++x) {
      if (x != 0 || y != 0) content.points.emplace_back(x, y, 0.0);
    }
  }
  content.points.emplace_back(0.0, 0.0, -3.0);
  PictureOptions options{.extent = {200, 200}};
  options.point_size = 5;
  const Picture picture = draw(content, options);
  CHECK(picture[{100, 100}][2] < picture[{30, 30}][2]);
  CHECK(is_blue(picture[{30, 30}]));
}

TEST_CASE("a frame shows all of the content, in the middle and large", "[picture]") {
  shapes::Random random(1);
  for (int seed = 1; seed <= 20; ++seed) {
    CAPTURE(seed);
    PictureContent content;
    const Vec3 stretch{random.between(0.01, 9.0), random.between(0.01, 9.0), random.unit()};
    const Vec3 center = 100.0 * random.direction();
    for (int i = 0; i < 50; ++i)
      content.points.push_back(center + stretch * random.direction());
    const Extent extent{300, 200};
    const View view(frame_picture(content, random.direction(), extent), extent);
    Box window;
    for (const Vec3& point : content.points)
      window.add(view.window_from_world(point));
    CHECK(window.center().x == Approx(150.0));
    CHECK(window.center().y == Approx(100.0));
    const double fill = std::max((window.upper.x - window.lower.x) / extent.width,
                                 (window.upper.y - window.lower.y) / extent.height);
    CHECK(fill == Approx(1.0 / 1.06));
    CHECK(window.lower.z >= 0.0);
    CHECK(window.upper.z <= 1.0);
  }
}

TEST_CASE("a picture is the same for any number of threads", "[picture]") {
  PictureContent content{.mesh = shapes::to_mesh(shapes::torus())};
  content.points = {{0, 0, 2}, {0, 1, 2}};
  PictureOptions options = kSmall;
  options.edges = true;
  options.boundary = true;
  Picture one;
  run_with_threads(1, [&] { one = draw(content, options); });
  for (const int threads : {2, 5}) {
    run_with_threads(threads, [&] { CHECK(draw(content, options) == one); });
  }
}

TEST_CASE("a picture of nothing, and options out of range, are refused", "[picture]") {
  CpuRasterizer rasterizer;
  const PictureContent empty;
  const PictureContent sphere{.mesh = shapes::to_mesh(shapes::sphere())};
  const Camera camera = frame_picture(sphere, kFromFront, {10, 10});
  CHECK_THROWS_AS(frame_picture(empty, kFromFront, {10, 10}), InvalidArgument);
  CHECK_THROWS_AS(frame_picture(sphere, kFromFront, {0, 10}), InvalidArgument);
  CHECK_THROWS_AS(frame_picture(sphere, {0, 0, 0}, {10, 10}), InvalidArgument);
  CHECK_THROWS_AS(draw_picture(rasterizer, empty, camera), InvalidArgument);
  for (const PictureOptions& options :
       {PictureOptions{.extent = {0, 5}}, PictureOptions{.supersampling = 0},
        PictureOptions{.supersampling = 5}, PictureOptions{.point_size = 0},
        PictureOptions{.point_size = 64}}) {
    CHECK_THROWS_AS(draw_picture(rasterizer, sphere, camera, options), InvalidArgument);
  }
}

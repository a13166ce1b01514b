#include "core/finish/small_pieces.h"

#include <algorithm>
#include <catch2/catch.hpp>

#include "core/finish/components.h"
#include "tests/core/finish/shapes.h"

namespace rangezip {
namespace {

constexpr double kFar = 10.0;  // of a pixel side with which nothing here stands apart

DroppedComponents drop_small(TriangleMesh& mesh, std::size_t min_faces, double pixel_size = kFar) {
  const CornerTable table(mesh.triangles, mesh.positions.size());
  return drop_small_components(mesh, table, components_of(table), {min_faces, pixel_size});
}

void add(TriangleMesh& mesh, TriangleMesh piece, const Vec3& offset) {
  for (Vec3& p : piece.positions)
    p += offset;
  testing::append(mesh, piece);
}

TEST_CASE("components with fewer faces go, but never the largest one") {
  TriangleMesh mesh = testing::cube(1);
  const TriangleMesh other = testing::sphere(3);
  add(mesh, other, {5, 0, 0});
  TriangleMesh kept = mesh;
  const DroppedComponents dropped = drop_small(kept, 13);
  REQUIRE(dropped.components == 1);
  REQUIRE(dropped.faces == 12);
  REQUIRE(kept.triangles.size() == other.triangles.size());
  kept = mesh;
  REQUIRE(drop_small(kept, 100000).components == 1);
  REQUIRE(kept.triangles.size() == other.triangles.size());
}

TEST_CASE("a small piece that stands apart from larger ones stays if it has 40 faces") {
  constexpr double kPixel = 0.1;
  const double gap = GENERATE(2.0, 4.0);  // pixel sides
  const int n = GENERATE(1, 2);
  CAPTURE(gap, n);
  TriangleMesh piece = testing::sphere(n);  // of 12 or 48 faces
  for (Vec3& p : piece.positions)
    p *= 0.1;
  double leftmost = 0.0;
  for (const Vec3& p : piece.positions)
    leftmost = std::min(leftmost, p.x);
  TriangleMesh mesh = testing::sphere(24);
  add(mesh, piece, {1.0 + gap * kPixel - leftmost, 0, 0});
  const bool stays = gap > 3.0 && n == 2;
  CHECK(drop_small(mesh, 100, kPixel).components == (stays ? 0U : 1U));
}

TEST_CASE("of two balls that are both too small the first stays, and the second if it is apart") {
  TriangleMesh mesh = testing::sphere(2);
  add(mesh, testing::sphere(2), {2.5, 0, 0});
  CHECK(drop_small(mesh, 100, 0.1).components == 0);
  CHECK(drop_small(mesh, 100, 1.0).components == 1);
}

TEST_CASE(
    "an open piece of less than a two-hundredth of the mesh is a shred, a closed one is not") {
  const TriangleMesh large = testing::sphere(24);  // 6912 faces: shreds have up to 34
  const bool is_open = GENERATE(false, true);
  CAPTURE(is_open);
  TriangleMesh mesh = large;
  TriangleMesh piece = testing::cube(1);
  if (is_open) piece.triangles.pop_back();
  add(mesh, piece, {5, 0, 0});
  TriangleMesh kept = mesh;
  REQUIRE(drop_small(kept, 0).components == 0);
  REQUIRE(kept == mesh);
  REQUIRE(drop_small(kept, 5).components == (is_open ? 1U : 0U));
  REQUIRE(kept.triangles == (is_open ? large : mesh).triangles);
}

TEST_CASE("an open piece is no shred if it has 40 faces and stands apart from all large components",
          "[finish]") {
  // As one side of a thin body; beside it another small body, which has no pockets.
  constexpr double kPixel = 0.1;
  const double gap = GENERATE(2.0, 4.0);  // pixel sides, to the large one
  const int n = GENERATE(2, 4);
  CAPTURE(gap, n);
  TriangleMesh side = testing::sphere(n);  // of half of it 24 or 96 faces
  testing::cut_where(side, [](const Vec3& p) { return p.z < 0.0; });
  TriangleMesh mesh = testing::sphere(48);  // 27,648 faces: shreds have up to 138
  add(mesh, side, {2.0 + gap * kPixel, 0, 0});
  add(mesh, testing::sphere(6), {2.0 + gap * kPixel, 2.0, 0});  // 432 faces
  const bool stays = gap > 3.0 && n == 4;
  CHECK(drop_small(mesh, 5, kPixel).components == (stays ? 0U : 1U));
}

TEST_CASE("close to a large component an open piece stays that is nearly closed around its inside",
          "[finish]") {
  // Turned inside out it is what scans have seen of a pocket.
  constexpr double kPixel = 0.1;
  const bool is_pocket = GENERATE(false, true);
  const double height = GENERATE(0.0, 0.7);  // up to where the ball is there
  const double gap = GENERATE(1.0, 2.0);     // pixel sides
  CAPTURE(is_pocket, height, gap);
  TriangleMesh ball = testing::sphere(4);  // with a vertex at (-1, 0, 0)
  testing::cut_where(ball, [&](const Vec3& p) { return p.z > height; });
  for (Triangle& t : ball.triangles) {
    if (is_pocket) std::swap(t[1], t[2]);
  }
  TriangleMesh mesh = testing::sphere(60);  // 43,200 faces: shreds have up to 215
  add(mesh, ball, {2.0 + gap * kPixel, 0, 0});
  const bool stays = !is_pocket && height > 0.5 && gap > 1.5;
  CHECK(drop_small(mesh, 12, kPixel).components == (stays ? 0U : 1U));
}

TEST_CASE("beside a sheet flatter than half a sphere an open piece is no shred") {
  // Caps of a sphere: area vector over area is (1 + height) / 2 with the height of the plane that
  // cuts them off, here for 6912 faces of the whole sphere.
  const double height = GENERATE(-0.2, 0.2);
  CAPTURE(height);
  TriangleMesh mesh = testing::sphere(24);
  testing::cut_where(mesh, [&](const Vec3& p) { return p.z < height; });
  const std::size_t of_cap = mesh.triangles.size();
  TriangleMesh piece = testing::cube(1);
  piece.triangles.pop_back();
  add(mesh, piece, {0, 0, 5});
  const bool stays = height > 0.0;
  CHECK(drop_small(mesh, 5).components == (stays ? 0U : 1U));
  CHECK(mesh.triangles.size() == of_cap + (stays ? piece.triangles.size() : 0U));
  CHECK(drop_small(mesh, 12).components == (stays ? 1U : 0U));  // small ones go beside any
}

}  // namespace
}  // namespace rangezip

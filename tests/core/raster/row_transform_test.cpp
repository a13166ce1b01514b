#include "core/raster/row_transform.h"

#include <catch2/catch.hpp>
#include <cmath>

#include "core/raster/split_triangle.h"
#include "tests/support/lattice.h"
#include "tests/support/shapes.h"

namespace rangezip {
namespace {

constexpr Extent kExtent{64, 48};

SnappedPosition snap(const RowTransform& rows, const Vec3f& position) {
  SnappedPosition snapped;
  snap_positions(rows, std::span(&position, 1), std::span(&snapped, 1));
  return snapped;
}

/// x, y and the divisor w are the position's own numbers.
RowTransform plain_central_rows() {
  return {.x = {1, 0, 0, 0},
          .y = {0, 1, 0, 0},
          .z = {0, 0, 0, 0},
          .w = {0, 0, 1, 0},
          .is_central = true};
}

TEST_CASE("the rows of a parallel view place its window corners (R1)") {
  const View view({.lens = Orthographic{.height = 4.8}, .near_depth = 2, .far_depth = 6}, kExtent);
  const RowTransform rows = make_row_transform(view, Mat4{1.0});
  CHECK_FALSE(rows.is_central);
  // One model unit is 10 pixels, the depth range 4 units, the window's middle at (32, 24).
  CHECK(rows.x == Row{2560, 0, 0, 32 * 256});
  CHECK(rows.y == Row{0, 2560, 0, 24 * 256});
  CHECK(rows.z == Row{0, 0, -0x1p22F, -0x1p23F});
  CHECK(snap(rows, {0.05F, -0.05F, -3}) ==
        SnappedPosition{32 * 256 + 128, 24 * 256 - 128, 1 << 22});
}

TEST_CASE("a placement is folded into the rows in double (R1)") {
  // Far from the origin floats would lose the position; the placement and the camera cancel.
  const Vec3 far_away{636763.25, 851298.5, 415.0};
  Camera camera =
      look_at(far_away + Vec3{0, 0, 4}, far_away, {0, 1, 0}, Orthographic{.height = 4.8});
  camera.near_depth = 2;
  camera.far_depth = 6;
  Mat4 placement{1.0};
  placement[3] = Vec4(far_away, 1.0);
  const RowTransform rows = make_row_transform(View(camera, kExtent), placement);
  CHECK(snap(rows, {0.0F, 0.0F, 0.0F}) == SnappedPosition{32 * 256, 24 * 256, 1 << 23});
  CHECK(snap(rows, {0.05F, -0.05F, 1}) == SnappedPosition{32 * 256 + 128, 24 * 256 - 128, 1 << 22});
}

TEST_CASE("the rows of a central view agree with the view's own window positions (R1, R4)") {
  Camera camera = look_at({1, 2, 5}, {0, 0, 0}, {0, 1, 0}, Perspective{.fov_y = 0.9});
  camera.near_depth = 2;
  camera.far_depth = 9;
  const View view(camera, kExtent);
  const RowTransform rows = make_row_transform(view, Mat4{1.0});
  CHECK(rows.is_central);
  shapes::Random random(1);
  for (int i = 0; i < 1000; ++i) {
    const Vec3f p{random.between(-1, 1), random.between(-1, 1), random.between(-1, 1)};
    const Vec3 window = view.window_from_world(Vec3(p));
    const SnappedPosition snapped = snap(rows, p);
    // Half a unit by the snap; the floats of R2 err by some 2^-22 of the largest term, which is
    // less than 2^15 units in x and y and 2^26 in z, divided by w > 2.
    CHECK(std::abs(snapped.x - 256.0 * window.x) < 0.5 + 0.01);
    CHECK(std::abs(snapped.y - 256.0 * window.y) < 0.5 + 0.01);
    CHECK(std::abs(snapped.z - 16777216.0 * window.z) < 0.5 + 16.0);
  }
}

TEST_CASE("a parallel view rounds halves to even (R3)") {
  const RowTransform rows{.x = {1, 0, 0, 0}, .y = {0, 1, 0, 0}, .z = {0, 0, 1, 0}};
  const std::array<std::pair<float, int>, 9> cases{{{0.5F, 0},
                                                    {1.5F, 2},
                                                    {2.5F, 2},
                                                    {-0.5F, 0},
                                                    {-1.5F, -2},
                                                    {0.49999997F, 0},
                                                    {0.50000006F, 1},
                                                    {4194303.5F, 4194304},
                                                    {-2097152.5F, -2097152}}};
  for (const auto& [value, expected] : cases) {
    CAPTURE(value);
    CHECK(snap(rows, {value, value, value}) == SnappedPosition{expected, expected, expected});
  }
}

TEST_CASE("the guard range is closed, and its outside rejected (R3, R4)") {
  const RowTransform parallel{.x = {1, 0, 0, 0}, .y = {0, 1, 0, 0}, .z = {0, 0, 1, 0}};
  const auto inside = static_cast<float>(kGuardXY);
  const float outside = std::nextafter(inside, 1e9F);
  const auto deep = static_cast<float>(kGuardZ);
  const float deeper = std::nextafter(deep, 1e9F);
  for (const float sign : {1.0F, -1.0F}) {
    CHECK_FALSE(is_rejected(snap(parallel, {sign * inside, sign * inside, sign * deep})));
    CHECK(is_rejected(snap(parallel, {sign * outside, 0, 0})));
    CHECK(is_rejected(snap(parallel, {0, sign * outside, 0})));
    CHECK(is_rejected(snap(parallel, {0, 0, sign * deeper})));
  }
  const RowTransform central = plain_central_rows();
  for (const float w : {0x1p-64F, 0.3F, 7.0F, 0x1p64F}) {
    CAPTURE(w);
    CHECK_FALSE(is_rejected(snap(central, {inside * w, -inside * w, w})));
    CHECK(is_rejected(snap(central, {std::nextafter(inside * w, 1e38F), 0, w})));
  }
  CHECK(is_rejected(snap(central, {0, 0, std::nextafter(0x1p-64F, 0.0F)})));
  CHECK(is_rejected(snap(central, {0, 0, std::nextafter(0x1p64F, 1e38F)})));
  CHECK(is_rejected(snap(central, {0, 0, 0})));
  CHECK(is_rejected(snap(central, {0, 0, -1})));
}

TEST_CASE("a central view rounds the exact quotient, halves up (R4)") {
  const RowTransform rows = plain_central_rows();
  CHECK(snap(rows, {1.5F, -1.5F, 3.0F}) == SnappedPosition{1, 0, 0});
  CHECK(snap(rows, {4.5F, -4.5F, 3.0F}) == SnappedPosition{2, -1, 0});
  shapes::Random random(2);
  for (int i = 0; i < 200'000; ++i) {
    // Integers are exact as floats, so the quotient's floor has a closed form in integers. Half of
    // the cases lie next to a half: numerators around (2 q + 1) w / 2.
    const auto w = static_cast<std::int64_t>(1 + random.bits() % 4000);
    auto x = static_cast<std::int64_t>(random.bits() % (1U << 24U)) - (1 << 23);
    if (i % 2 == 0) {
      const auto q = static_cast<std::int64_t>(random.bits() % 4000) - 2000;
      x = (2 * q + 1) * w / 2 + static_cast<std::int64_t>(random.bits() % 3) - 1;
    }
    if (std::abs(x) > kGuardXY * w) continue;
    const std::int64_t numerator = 2 * x + w;
    const std::int64_t quotient = numerator / (2 * w);
    const std::int64_t expected = quotient - (numerator % (2 * w) < 0 ? 1 : 0);
    CAPTURE(x, w);
    REQUIRE(snap(rows, {static_cast<float>(x), 0, static_cast<float>(w)}).x == expected);
  }
}

TEST_CASE("clip planes reject the positions on their outside (R11)") {
  RowTransform rows{.x = {1, 0, 0, 0}, .y = {0, 1, 0, 0}, .z = {0, 0, 1, 0}};
  rows.clip = {{1, 0, 0, -5}, {0, 1, 0, 0}};
  const float nan = std::nanf("");
  const std::vector<Vec3f> positions{{5, 0, 0}, {4, 0, 0}, {6, -1, 0}, {7, 3, 0}, {nan, 0, 0}};
  std::vector<SnappedPosition> snapped(positions.size());
  CHECK(snap_positions(rows, positions, snapped) == 1);
  reject_clipped(rows, positions, snapped);
  CHECK_FALSE(is_rejected(snapped[0]));
  CHECK(is_rejected(snapped[1]));
  CHECK(is_rejected(snapped[2]));
  CHECK_FALSE(is_rejected(snapped[3]));
  CHECK(is_rejected(snapped[4]));
}

/// Twice the signed area of all pieces, in 1/256 px squared.
std::int64_t area_of(const std::vector<SnappedTriangle>& pieces) {
  std::int64_t sum = 0;
  for (const auto& [a, b, c] : pieces) {
    sum += std::int64_t{b.x - a.x} * (c.y - a.y) - std::int64_t{c.x - a.x} * (b.y - a.y);
  }
  return sum;
}

TEST_CASE("a triangle inside of everything comes back whole (R8)") {
  const RowTransform rows{.x = {1, 0, 0, 0}, .y = {0, 1, 0, 0}, .z = {0, 0, 1, 0}};
  std::vector<SnappedTriangle> pieces;
  CHECK(split_triangle(rows, {Vec3f{1, 2, 3}, {40, 5, 6}, {7, 80, 9}}, pieces));
  REQUIRE(pieces.size() == 1);
  CHECK(pieces[0] == SnappedTriangle{{{1, 2, 3}, {40, 5, 6}, {7, 80, 9}}});
}

TEST_CASE("what lies outside of the guard range is cut off exactly there (R8)") {
  const RowTransform rows{.x = {1, 0, 0, 0}, .y = {0, 1, 0, 0}, .z = {0, 0, 1, 0}};
  constexpr float kReach = 4.0F * kGuardXY;
  std::vector<SnappedTriangle> pieces;
  // The half plane above the x axis, as far as a triangle reaches: the guard square's upper half.
  CHECK(split_triangle(rows, {Vec3f{-kReach, 0, 7}, {kReach, 0, 7}, {0, kReach, 7}}, pieces));
  CHECK(area_of(pieces) == 2 * std::int64_t{2 * kGuardXY} * kGuardXY);
  for (const SnappedTriangle& piece : pieces) {
    for (const SnappedPosition& corner : piece) {
      CHECK(corner.z == 7);
      CHECK(std::abs(corner.x) <= kGuardXY);
      CHECK((corner.y >= 0 && corner.y <= kGuardXY));
    }
  }
}

TEST_CASE("a triangle wholly outside leaves no piece, and is no error (R8)") {
  const RowTransform rows{.x = {1, 0, 0, 0}, .y = {0, 1, 0, 0}, .z = {0, 0, 1, 0}};
  std::vector<SnappedTriangle> pieces;
  CHECK(split_triangle(rows, {Vec3f{1e8F, 0, 0}, {2e8F, 0, 0}, {1e8F, 1e8F, 0}}, pieces));
  CHECK(pieces.empty());
  CHECK(split_triangle(plain_central_rows(), {Vec3f{0, 0, -1}, {5, 0, -2}, {0, 5, -1}}, pieces));
  CHECK(pieces.empty());
}

TEST_CASE("a clip plane halves a triangle, and what is cut lies on the plane (R11)") {
  RowTransform rows{.x = {1, 0, 0, 0}, .y = {0, 1, 0, 0}, .z = {0, 0, 1, 0}};
  rows.clip = {{1, 0, 0, -512}};
  std::vector<SnappedTriangle> pieces;
  CHECK(split_triangle(rows, {Vec3f{0, 0, 0}, {1024, 0, 1024}, {0, 1024, 0}}, pieces));
  REQUIRE(pieces.size() == 1);
  CHECK(area_of(pieces) == 512 * 512);
  for (const SnappedPosition& corner : pieces[0])
    CHECK((corner.x >= 512 && corner.z == corner.x));
  pieces.clear();
  CHECK(split_triangle(rows, {Vec3f{1024, 0, 0}, {0, 0, 0}, {1024, 1024, 0}}, pieces));
  CHECK(pieces.size() == 2);
  CHECK(area_of(pieces) == -(1024 * 1024 - 512 * 512));
}

TEST_CASE("a corner that is not finite leaves no piece and says so (R8)") {
  const RowTransform rows{.x = {1, 0, 0, 0}, .y = {0, 1, 0, 0}, .z = {0, 0, 1, 0}};
  std::vector<SnappedTriangle> pieces;
  for (const float bad : {std::nanf(""), HUGE_VALF, -HUGE_VALF}) {
    CHECK_FALSE(split_triangle(rows, {Vec3f{1, 2, 3}, {40, 5, bad}, {7, 80, 9}}, pieces));
    CHECK(pieces.empty());
  }
}

}  // namespace
}  // namespace rangezip

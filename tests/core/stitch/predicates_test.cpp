#include "core/stitch/predicates.h"

#include <catch2/catch.hpp>

using namespace rangezip;

TEST_CASE("orientation is exact at the limit of the grid", "[stitch]") {
  const GridPoint a{-kGridLimit, -kGridLimit};
  const GridPoint b{kGridLimit, kGridLimit};
  CHECK(orientation(a, b, {0, 0}) == 0);
  CHECK(orientation(a, b, {kGridLimit - 1, kGridLimit}) > 0);
  CHECK(orientation(a, b, {kGridLimit, kGridLimit - 1}) < 0);
  CHECK(orientation(a, {kGridLimit, -kGridLimit}, b) == 4 * kGridLimit * kGridLimit);
}

TEST_CASE("in_circle tells one grid step at the limit of the grid", "[stitch]") {
  const std::int64_t r = kGridLimit;
  const GridPoint east{r, 0}, north{0, r}, west{-r, 0};
  CHECK_FALSE(in_circle(east, north, west, {0, -r}));  // on it
  CHECK(in_circle(east, north, west, {0, -r + 1}));
  CHECK(in_circle({r, -r}, {r, r}, {-r, r}, {-r + 1, -r}));
  CHECK_FALSE(in_circle({r, -r}, {r, r}, {-r, r}, {-r, -r}));
}

TEST_CASE("in_circle takes the side of a degenerate circle", "[stitch]") {
  // A point between the ends of an edge bends the circle open towards the far side.
  CHECK(in_circle({0, 0}, {10, 0}, {5, 0}, {3, -7}));
}

TEST_CASE("segments_touch sees crossings, contacts and overlaps", "[stitch]") {
  const GridPoint a{0, 0}, b{10, 0};
  CHECK(segments_touch(a, b, {5, -5}, {5, 5}));
  CHECK(segments_touch(a, b, {5, 0}, {5, 5}));    // an end on the other
  CHECK(segments_touch(a, b, {10, 0}, {15, 3}));  // end to end
  CHECK(segments_touch(a, b, {3, 0}, {7, 0}));    // one within the other
  CHECK_FALSE(segments_touch(a, b, {11, 0}, {15, 0}));
  CHECK_FALSE(segments_touch(a, b, {5, 1}, {5, 5}));
  CHECK_FALSE(segments_touch(a, b, {11, -5}, {11, 5}));
}

TEST_CASE("segments from one tip overlap only in the same direction", "[stitch]") {
  CHECK(segments_overlap_at({0, 0}, {2, 1}, {4, 2}));
  CHECK_FALSE(segments_overlap_at({0, 0}, {2, 1}, {-4, -2}));
  CHECK_FALSE(segments_overlap_at({0, 0}, {2, 1}, {4, 3}));
}

#include "core/finish/box_tree.h"

#include <catch2/catch.hpp>
#include <cmath>
#include <cstdint>
#include <random>
#include <vector>

#include "tests/core/finish/shapes.h"

namespace rangezip {
namespace {

using testing::uniform;

Vec3 place_in(double side, std::mt19937_64& engine) {
  Vec3 place{0.0};
  for (int axis = 0; axis < 3; ++axis)
    place[axis] = uniform(engine, 0.0, side);
  return place;
}

/// From a millionth of the whole to all of it; on whole numbers, so that boxes touch.
Box random_box(double side, std::mt19937_64& engine) {
  const Vec3 lower = glm::floor(place_in(side, engine));
  const double size = side * std::pow(uniform(engine, 0.01, 1.0), 3.0);
  return {lower, lower + glm::floor(place_in(size, engine))};
}

std::vector<std::uint32_t> meeting_of_all(const std::vector<Box>& boxes, const Box& box) {
  std::vector<std::uint32_t> found;
  for (std::uint32_t i = 0; i < boxes.size(); ++i) {
    if (boxes_meet(boxes[i], box)) found.push_back(i);
  }
  return found;
}

}  // namespace

TEST_CASE("a tree finds the boxes that meet one, as looking at each of them does", "[finish]") {
  const auto seed = static_cast<std::uint64_t>(Catch::rngSeed());
  const std::size_t count = GENERATE(0U, 1U, 8U, 9U, 65U, 1000U);
  CAPTURE(seed, count);
  std::mt19937_64 engine(seed);
  constexpr double kSide = 100.0;
  std::vector<Box> boxes(count);
  for (Box& box : boxes)
    box = random_box(kSide, engine);
  const BoxTree tree(boxes);
  for (int i = 0; i < 200; ++i) {
    const Box box = random_box(kSide, engine);
    const std::vector<std::uint32_t> expected = meeting_of_all(boxes, box);
    CHECK(tree.meeting(box) == expected);
    CHECK(tree.meets(box) != expected.empty());
  }
}

TEST_CASE("a tree finds all of many boxes at one place", "[finish]") {
  const Box box{Vec3(1.0), Vec3(2.0)};
  const BoxTree tree(std::vector<Box>(100, box));
  CHECK(tree.meeting({Vec3(2.0), Vec3(3.0)}).size() == 100);
  CHECK(tree.meeting({Vec3(2.5), Vec3(3.0)}).empty());
}

}  // namespace rangezip

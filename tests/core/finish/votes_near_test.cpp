#include "core/finish/votes_near.h"

#include <array>
#include <catch2/catch.hpp>
#include <cstdint>
#include <random>
#include <vector>

#include "tests/core/finish/shapes.h"

namespace rangezip {
namespace {

using testing::uniform;

TEST_CASE("a grid sums the votes of the points within its radius, of polygons none", "[finish]") {
  const auto seed = static_cast<std::uint64_t>(Catch::rngSeed());
  CAPTURE(seed);
  std::mt19937_64 engine(seed);
  constexpr double kRadius = 0.8;
  constexpr std::size_t kWithVotes = 400;  // the others are of polygons
  const auto random = [&] {
    return Vec3(uniform(engine, -3.0, 3.0), uniform(engine, -3.0, 3.0), uniform(engine, -3.0, 3.0));
  };
  std::vector<Vec3> points(500);
  for (Vec3& p : points)
    p = random();
  std::vector<std::array<std::int8_t, 3>> votes(kWithVotes);
  for (auto& vote : votes) {
    for (std::int8_t& v : vote)
      v = static_cast<std::int8_t>(uniform(engine, -70.0, 70.0));
  }
  std::vector<Vec3> places(50);
  for (Vec3& p : places)
    p = random();
  const VoteGrid grid({points, votes}, places, kRadius);
  for (const Vec3& place : places) {
    Vec3 sum(0.0);
    std::size_t count = 0;
    for (std::size_t i = 0; i < kWithVotes; ++i) {
      if (glm::length(points[i] - place) > kRadius) continue;
      sum += Vec3(votes[i][0], votes[i][1], votes[i][2]);
      ++count;
    }
    const VotesNear near = grid.around(place);
    CHECK(near.count == count);
    CHECK(near.sum == sum);
  }
}

TEST_CASE("votes look to a side if they agree, and not across it or if few have any", "[finish]") {
  const VotesNear strong{Vec3(0.0, 0.0, 500.0), 10}, weak{Vec3(0.0, 0.0, 50.0), 10};
  CHECK(strong.look_toward(Vec3(0.0, 0.0, 1.0)));
  CHECK_FALSE(strong.look_toward(Vec3(0.0, 0.0, -1.0)));
  CHECK_FALSE(strong.look_toward(Vec3(1.0, 0.0, 0.0)));
  CHECK_FALSE(weak.look_toward(Vec3(0.0, 0.0, 1.0)));
  CHECK_FALSE(VotesNear{}.look_toward(Vec3(0.0, 0.0, 1.0)));
}

}  // namespace
}  // namespace rangezip

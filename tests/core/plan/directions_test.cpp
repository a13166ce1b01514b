#include "core/plan/directions.h"

#include <algorithm>
#include <catch2/catch.hpp>

#include "core/base/error.h"
#include "core/base/spread.h"
#include "tests/support/shapes.h"

namespace rangezip {

TEST_CASE("sphere_directions are of unit length and balance each other") {
  for (const int count : {1, 2, 7, 40, 150, 1000}) {
    CAPTURE(count);
    const std::vector<Vec3> directions = sphere_directions(count);
    REQUIRE(directions.size() == static_cast<std::size_t>(count));
    Vec3 sum{0.0};
    for (const Vec3& d : directions) {
      CHECK(glm::length(d) == Approx(1.0).margin(1e-14));
      sum += d;
    }
    // z is balanced exactly; the golden rotation balances x and y to within a direction or two.
    CHECK(sum.z == Approx(0.0).margin(1e-12 * count));
    CHECK(glm::length(sum) < 2.0);
  }
}

TEST_CASE("sphere_directions leave no gap and no cluster") {
  // A cap of angular radius r covers (1 - cos r) / 2 of the sphere. The lattice's covering radius
  // is at most that of caps of 3.5 times the share 1 / n, its packing radius at least that of
  // caps of a third of it.
  for (const int count : {40, 150, 200}) {
    CAPTURE(count);
    const std::vector<Vec3> directions = sphere_directions(count);
    const double covering_cosine = 1.0 - 2.0 * 3.5 / count;
    shapes::Random random(static_cast<std::uint64_t>(count));
    for (int i = 0; i < 20'000; ++i) {
      const Vec3 any = random.direction();
      double nearest = -1.0;
      for (const Vec3& d : directions)
        nearest = std::max(nearest, glm::dot(any, d));
      REQUIRE(nearest >= covering_cosine);
    }
    const double packing_cosine = 1.0 - 2.0 / 3.0 / count;
    for (std::size_t i = 0; i < directions.size(); ++i) {
      for (std::size_t j = 0; j < i; ++j) {
        REQUIRE(glm::dot(directions[i], directions[j]) <= packing_cosine);
      }
    }
  }
}

TEST_CASE("sphere_directions refuse a count below one") {
  CHECK_THROWS_AS(sphere_directions(0), InvalidArgument);
  CHECK_THROWS_AS(sphere_directions(-5), InvalidArgument);
}

TEST_CASE("spread_indices take one index from each equal slice") {
  for (const std::size_t count : {1U, 5U, 300U, 301U, 1000U, 1'000'003U}) {
    for (const std::size_t wanted : {1U, 3U, 300U, 2000U}) {
      CAPTURE(count, wanted);
      const std::vector<std::size_t> indices = spread_indices(count, wanted);
      REQUIRE(indices.size() == std::min(count, wanted));
      for (std::size_t i = 0; i < indices.size(); ++i) {
        const std::size_t begin = i * count / indices.size();
        const std::size_t end = (i + 1) * count / indices.size();
        REQUIRE(indices[i] >= begin);
        REQUIRE(indices[i] < end);
      }
    }
  }
  CHECK(spread_indices(0, 10).empty());
}

TEST_CASE("spread_indices fall in step with no row length") {
  // Taken every 100th, the columns of rows of 100 points would all be the same one.
  constexpr std::size_t kRow = 100;
  std::array<int, 4> quarters{};
  for (const std::size_t index : spread_indices(1000 * kRow, 1000)) {
    ++quarters[(index % kRow) / 25];
  }
  // Binomial with 1000 and 1/4: deviation 13.7; five of them.
  for (const int quarter : quarters)
    CHECK(std::abs(quarter - 250) < 69);
}

}  // namespace rangezip

#include "core/base/parallel.h"

#include <algorithm>
#include <atomic>
#include <cstdint>
#include <mutex>
#include <set>
#include <stdexcept>
#include <utility>
#include <vector>

#include <catch2/catch.hpp>

namespace rangezip {
namespace {

TEST_CASE("parallel_for visits every item once, in blocks that depend on count and grain only",
          "[base]") {
  for (const int threads : {1, 2, 7}) {
    for (const std::size_t count : {0U, 1U, 99U, 100U, 101U, 1000U}) {
      CAPTURE(threads, count);
      std::vector<std::uint8_t> visits(count, 0);
      std::set<std::pair<std::size_t, std::size_t>> blocks;
      std::mutex mutex;
      run_with_threads(threads, [&] {
        parallel_for(count, 100, [&](std::size_t begin, std::size_t end) {
          for (std::size_t i = begin; i < end; ++i)
            ++visits[i];
          const std::lock_guard lock(mutex);
          blocks.insert({begin, end});
        });
      });
      for (const std::uint8_t visit : visits)
        REQUIRE(visit == 1);
      std::set<std::pair<std::size_t, std::size_t>> expected;
      for (std::size_t begin = 0; begin < count; begin += 100) {
        expected.insert({begin, std::min(count, begin + 100)});
      }
      CHECK(blocks == expected);
    }
  }
}

TEST_CASE("for_each_row visits every row once", "[base]") {
  std::vector<std::atomic<int>> visits(123);
  for_each_row(123, [&](int y) { ++visits[static_cast<std::size_t>(y)]; });
  for (const auto& visit : visits)
    REQUIRE(visit == 1);
  for_each_row(0, [](int) { FAIL("there is no row"); });
  for_each_row(-1, [](int) { FAIL("there is no row"); });
}

TEST_CASE("exceptions of a parallel loop reach the caller", "[base]") {
  for (const int threads : {1, 4}) {
    CHECK_THROWS_AS(run_with_threads(threads,
                                     [] {
                                       parallel_for(1000, 1, [](std::size_t begin, std::size_t) {
                                         if (begin == 777) throw std::runtime_error("777");
                                       });
                                     }),
                    std::runtime_error);
  }
}

TEST_CASE("run_with_threads limits the loops inside it, and only those", "[base]") {
  const int before = thread_count();
  CHECK(before >= 1);
  run_with_threads(1, [] { CHECK(thread_count() == 1); });
  run_with_threads(3, [&] { CHECK(thread_count() == std::min(3, before)); });
  CHECK(thread_count() == before);
}

TEST_CASE("loops inside of loops finish", "[base]") {
  std::atomic<int> sum{0};
  for_each_row(40, [&](int) { for_each_row(40, [&](int y) { sum += y; }); });
  CHECK(sum == 40 * 780);
}

TEST_CASE("run_side_by_side calls both once and passes an exception on", "[base]") {
  for (const int threads : {1, 2}) {
    CAPTURE(threads);
    run_with_threads(threads, [] {
      int one = 0, other = 0;
      run_side_by_side([&] { ++one; }, [&] { ++other; });
      CHECK(one == 1);
      CHECK(other == 1);
      CHECK_THROWS_AS(run_side_by_side([] {}, [] { throw std::runtime_error("stop"); }),
                      std::runtime_error);
    });
  }
}

}  // namespace
}  // namespace rangezip

#include "core/io/lazy_memory.h"

#include <catch2/catch.hpp>

#include <limits>
#include <utility>

namespace rangezip {

TEST_CASE("Room for bytes can be written to from end to end and keeps them when it is moved") {
  constexpr std::size_t kSize = 10'000;
  LazyMemory first(kSize);
  REQUIRE(first.size() == kSize);
  first.data()[0] = 'a';
  first.data()[kSize - 1] = 'z';
  LazyMemory second(1);
  second = std::move(first);
  const LazyMemory third(std::move(second));
  REQUIRE(third.size() == kSize);
  CHECK(third.data()[0] == 'a');
  CHECK(third.data()[kSize - 1] == 'z');
  CHECK(LazyMemory().size() == 0);
}

TEST_CASE("Room for more than any machine has is room for what this one has") {
  const LazyMemory all(std::numeric_limits<std::size_t>::max());
  CHECK(all.size() > 0);
  CHECK(all.size() < std::numeric_limits<std::size_t>::max());
}

}  // namespace rangezip

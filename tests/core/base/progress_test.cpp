#include "core/base/progress.h"

#include <string>

#include <catch2/catch.hpp>

namespace rangezip {
namespace {

TEST_CASE("progress reports stages and does nothing by default", "[base]") {
  CHECK_NOTHROW(Progress{}.at("nobody listens", 0.5));
  std::string stage;
  double share = 0.0;
  const Progress progress{.report = [&](std::string_view s, double part) {
    stage = s;
    share = part;
  }};
  progress.at("scan", 0.25);
  CHECK(stage == "scan");
  CHECK(share == 0.25);
}

TEST_CASE("a stop request ends a long operation by Cancelled", "[base]") {
  std::stop_source source;
  const Progress progress{.stop = source.get_token()};
  CHECK_NOTHROW(progress.at("scan", 0.0));
  source.request_stop();
  CHECK_THROWS_AS(progress.at("scan", 0.1), Cancelled);
  CHECK_THROWS_AS(progress.check_stop(), Cancelled);
}

}  // namespace
}  // namespace rangezip

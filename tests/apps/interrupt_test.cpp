// Ctrl-C, and how progress is shown.

#include <catch2/catch.hpp>

#include <sys/stat.h>

#include <csignal>

#include "tests/apps/program.h"
#include "tests/core/io/temporary_folder.h"

using namespace rangezip::test;
using Catch::Contains;

TEST_CASE("an interrupted run ends with exit code 130 and leaves nothing", "[apps]") {
  const TemporaryFolder folder;
  store_sphere(folder / "sphere.ply", 300'000);
  for (const int signal : {SIGINT, SIGTERM}) {
    CAPTURE(signal);
    const RunResult result = run({"mesh", folder / "sphere.ply", "-o", folder / "out.ply",
                                  "--report", folder / "r.json", "--session", folder / "s.json"},
                                 {.signal = signal, .signal_after = "meshing: plan views"});
    CHECK(result.code == 130);
    CHECK_THAT(result.err, Contains("interrupted"));
    CHECK(folder.count() == 1);
  }
}

TEST_CASE("an interrupted run leaves the file that it would have overwritten", "[apps]") {
  const TemporaryFolder folder;
  store_sphere(folder / "sphere.ply", 300'000);
  const std::string before = load(folder / "sphere.ply");
  CHECK(run({"mesh", folder / "sphere.ply", "-o", folder / "sphere.ply"},
            {.signal = SIGINT, .signal_after = "meshing: plan views"})
            .code == 130);
  CHECK(load(folder / "sphere.ply") == before);
  CHECK(folder.count() == 1);
}

TEST_CASE("a run that waits for a pipe nobody writes into can be interrupted", "[apps]") {
  const TemporaryFolder folder;
  REQUIRE(mkfifo((folder / "p.xyz").c_str(), S_IRUSR | S_IWUSR) == 0);
  const RunResult result = run({"mesh", folder / "p.xyz", "-o", folder / "out.ply"},
                               {.signal = SIGTERM, .signal_after = "reading: read"});
  CHECK(result.code == 130);
  CHECK_THAT(result.err, Contains("interrupted"));
  CHECK(folder.count() == 1);
}

TEST_CASE("a run that waits for a pipe nobody reads ends with the second signal", "[apps]") {
  const TemporaryFolder folder;
  store_sphere(folder / "sphere.ply", 3000);
  REQUIRE(mkfifo((folder / "p.ply").c_str(), S_IRUSR | S_IWUSR) == 0);
  const RunResult result = run({"mesh", folder / "sphere.ply", "-o", folder / "p.ply"},
                               {.signal = SIGTERM, .signal_after = "meshing: done", .signals = 2});
  CHECK(result.code == 128 + SIGTERM);
  CHECK(folder.count() == 2);
}

TEST_CASE("progress is a bar with rate and time left on a terminal, and lines otherwise",
          "[apps]") {
  const TemporaryFolder folder;
  store_sphere(folder / "sphere.ply", 100'000);
  const std::vector<std::string> arguments{"mesh", folder / "sphere.ply", "-o", folder / "out.ply"};

  const RunResult on_terminal = run(arguments, {.terminal = true});
  REQUIRE(on_terminal.code == 0);
  CHECK_THAT(on_terminal.err,
             Contains("meshing: [") && Contains("points/s") && Contains(" left") && Contains("\r"));
  CHECK_THAT(on_terminal.err, Catch::EndsWith("\033[K"));  // the bar is gone at the end

  const RunResult in_file = run(arguments);
  REQUIRE(in_file.code == 0);
  CHECK_THAT(in_file.err, Contains("meshing: scan (") && !Contains("\r") && !Contains("\033"));
  CHECK_THAT(in_file.err, Catch::EndsWith("\n"));
}

TEST_CASE("--quiet says nothing but errors", "[apps]") {
  const TemporaryFolder folder;
  store_sphere(folder / "sphere.ply", 3000);
  for (const bool terminal : {false, true}) {
    const RunResult result = run({"mesh", folder / "sphere.ply", "-o", folder / "out.ply", "-q"},
                                 {.terminal = terminal});
    CHECK(result.code == 0);
    CHECK(result.out.empty());
    CHECK(result.err.empty());
  }
  CHECK_FALSE(run({"mesh", folder / "no.ply", "-o", folder / "out.ply", "-q"}).err.empty());
}

TEST_CASE("standard output that takes no more is an error", "[apps]") {
  const TemporaryFolder folder;
  store_sphere(folder / "sphere.ply", 3000);
  CHECK(run({"info", folder / "sphere.ply"}, {.out_path = "/dev/full"}).code == 3);
}

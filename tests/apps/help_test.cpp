// What the program says of itself, and how it refuses a wrong command line.

#include <catch2/catch.hpp>

#include "tests/apps/program.h"
#include "tests/core/io/temporary_folder.h"

using namespace rangezip::test;
using Catch::Contains;

TEST_CASE("--version names the program and its version", "[apps]") {
  const RunResult result = run({"--version"});
  CHECK(result.code == 0);
  CHECK(result.out == "rangezip " RANGEZIP_VERSION "\n");
}

TEST_CASE("--help lists every command and every exit code", "[apps]") {
  const RunResult result = run({"--help"});
  CHECK(result.code == 0);
  for (const char* command : {"mesh", "scan", "render", "play", "info", "backends"})
    CHECK_THAT(result.out, Contains(std::string("\n  ") + command + " "));
  for (const char* code :
       {"\n  0  ", "\n  1  ", "\n  2  ", "\n  3  ", "\n  4  ", "\n  5  ", "\n  6  ", "\n  130  "})
    CHECK_THAT(result.out, Contains(code));
}

TEST_CASE("the help of a command names its options", "[apps]") {
  const std::vector<std::pair<std::string, std::vector<std::string>>> commands{
      {"mesh",
       {"INPUT", "-o", "--backend", "--method", "--pixel-size", "--triangles", "--threads",
        "--views", "--finish", "--report", "--session", "--quiet", "--decimate", "--close-holes"}},
      {"scan",
       {"INPUT",        "--direction",   "--up",          "--size",           "--pixel-size",
        "--point-size", "--region",      "--clip",        "--perspective",    "--into",
        "-o",           "--range-image", "--depth",       "--mask",           "--ids",
        "--session",    "--back-side",   "--see-through", "--vote",           "--plane-fit",
        "--fill-holes", "--median",      "--steep-cells", "--correspondence", "--quality",
        "--erosions",   "--dilations",   "--stitch",      "--decimate",       "--align"}},
      {"render",
       {"FILE", "-o", "--direction", "--up", "--size", "--edges", "--boundary", "--points"}},
      {"play", {"SESSION", "-o"}},
      {"info", {"FILE", "--check"}},
      {"backends", {"--backend gl"}}};
  for (const auto& [command, options] : commands) {
    CAPTURE(command);
    const RunResult result = run({command, "--help"});
    CHECK(result.code == 0);
    CHECK(result.err.empty());
    for (const std::string& option : options)
      CHECK_THAT(result.out, Contains(option));
  }
}

TEST_CASE("a refused command line says whose help to ask for", "[apps]") {
  CHECK_THAT(run({"jump"}).err, Contains("See rangezip --help"));
  CHECK_THAT(run({"mesh", "--jump"}).err, Contains("See rangezip mesh --help"));
}

TEST_CASE("a wrong command line is refused with exit code 1 and the reason", "[apps]") {
  const TemporaryFolder folder;
  const std::string cloud = folder.store("cloud.xyz", "0 0 0\n1 0 0\n0 1 0\n").string();
  const std::string out = folder / "out.ply";
  const std::vector<std::pair<std::vector<std::string>, std::string>> lines{
      {{}, "A subcommand is required"},
      {{"jump"}, "rangezip: jump: is no command; there are mesh, scan, "},
      {{"mesh", cloud}, "--output is required"},
      {{"mesh", "-o", out}, "INPUT is required"},
      {{"mesh", cloud, "-o", out, "--no-such-option"}, "--no-such-option"},
      {{"mesh", cloud, "-o", out, "--pixel-size", "0"},
       "rangezip: --pixel-size: must be a number greater than 0, got '0'"},
      {{"mesh", cloud, "-o", out, "--pixel-size", "nan"}, "must be a number greater than 0"},
      {{"mesh", cloud, "-o", out, "--pixel-size", "1", "--triangles", "5"}, "--pixel-size"},
      {{"mesh", cloud, "-o", out, "--triangles", "0"},
       "--triangles: must be a whole number greater than 0, got '0'"},
      {{"mesh", cloud, "-o", out, "--views", "0"},
       "'auto' or a whole number in [1, 1000], got '0'"},
      {{"mesh", cloud, "-o", out, "--finish", "best"}, "one of fast, full, none, got 'best'"},
      {{"mesh", cloud, "-o", out, "--method", "old"}, "one of auto, paper, got 'old'"},
      {{"mesh", cloud, "-o", out, "--scanner", "1,2"},
       "--scanner: must be three numbers 'x,y,z', got '1,2'"},
      {{"mesh", cloud, "-o", out, "--threads", "-2"}, "--threads"},
      {{"mesh", cloud, "-o", out, "--report", folder / "r.json", "--session", folder / "r.json"},
       "is the same file as --report"},
      {{"scan", cloud}, "needs at least one of -o, --range-image"},
      {{"scan", cloud, "-o", out, "--direction", "0,0,0"},
       "--direction: must be three numbers 'x,y,z', not all 0"},
      {{"scan", cloud, "-o", out, "--direction", "1,2"}, "three numbers"},
      {{"scan", cloud, "-o", out, "--direction", "0,1,0", "--up", "0,2,0"}, "parallel"},
      {{"scan", cloud, "-o", out, "--size", "0,5"}, "two whole numbers"},
      {{"scan", cloud, "-o", out, "--size", "9000,5"}, "two whole numbers"},
      {{"scan", cloud, "-o", out, "--region", "1,1 2,2"}, "at least three corners"},
      {{"scan", cloud, "-o", out, "--clip", "1,0,0"}, "--clip: must be four numbers"},
      {{"scan", cloud, "-o", out, "--perspective", "180"}, "less than 180 degrees"},
      {{"scan", cloud, "-o", out, "--no-median", "--median-radius", "2"}, "needs --median"},
      {{"scan", cloud, "-o", out, "--vote", "--no-plane-fit"}, "--vote: needs --plane-fit"},
      {{"scan", cloud, "-o", out, "--median", "--no-median"}, "--median: given with its opposite"},
      {{"render", cloud, "-o", folder / "a.png", "--size", "1"}, "two whole numbers"},
  };
  for (const auto& [arguments, reason] : lines) {
    CAPTURE(arguments);
    const RunResult result = run(arguments);
    CHECK(result.code == 1);
    CHECK(result.out.empty());
    CHECK_THAT(result.err, Contains(reason));
  }
  CHECK(folder.count() == 1);
}

TEST_CASE("the CPU's rasterizer can be had with one set of vector instructions", "[apps]") {
  const TemporaryFolder folder;
  const std::string cloud = folder.store("cloud.xyz", "0 0 0\n1 0 0\n0 1 0\n").string();
  const auto scan = [&](const std::string& backend, const std::string& ids) {
    return run({"scan", cloud, "--ids", folder / ids, "--size", "16,16", "--backend", backend});
  };
  CHECK(scan("cpu", "widest.png").code == 0);
  CHECK(scan("cpu:scalar", "scalar.png").code == 0);
  CHECK(load(folder / "scalar.png") == load(folder / "widest.png"));
  const RunResult unknown = scan("cpu:abacus", "no.png");
  CHECK(unknown.code == 4);
  CHECK_THAT(unknown.err, Contains("there is no backend 'cpu:abacus'; known: cpu"));
}

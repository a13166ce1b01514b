// Choosing a rasterizer by option or environment; the result has the same bytes with each.

#include <catch2/catch.hpp>
#include <fstream>
#include <iterator>

#include "tests/apps/program.h"
#include "tests/core/io/temporary_folder.h"

using namespace rangezip::test;
using Catch::Contains;

TEST_CASE("an unknown backend is refused with exit code 4 and the known ones", "[apps]") {
  const TemporaryFolder folder;
  const std::string cloud = folder.store("cloud.xyz", "0 0 0\n1 0 0\n0 1 0\n").string();
  const RunResult by_option = run({"mesh", cloud, "-o", folder / "out.ply", "--backend", "abacus"});
  CHECK(by_option.code == 4);
  CHECK_THAT(by_option.err, Contains("there is no backend 'abacus'; known: cpu"));
  const RunResult by_environment = run({"mesh", cloud, "-o", folder / "out.ply"},
                                       {.environment = {{"RANGEZIP_BACKEND", "abacus"}}});
  CHECK(by_environment.code == 4);
  CHECK_THAT(by_environment.err, Contains("known: cpu"));
  CHECK(folder.count() == 1);
}

TEST_CASE("backends lists the CPU first, as working", "[apps]") {
  const RunResult result = run({"backends"});
  CHECK(result.code == 0);
  CHECK_THAT(result.out, Catch::StartsWith("cpu ") && Contains("works     cpu, "));
}

#ifdef RANGEZIP_WITH_GL

namespace {

std::string content_of(const std::string& path) {
  std::ifstream file(path, std::ios::binary);
  return {std::istreambuf_iterator<char>(file), {}};
}

}  // namespace

TEST_CASE("backends lists OSMesa and EGL, which work here", "[apps]") {
  const RunResult result = run({"backends"});
  for (const char* name : {"gl:osmesa", "gl:egl:0", "gl:egl:surfaceless"})
    CHECK_THAT(result.out, Contains(std::string("works     ") + name + ", "));
  CHECK_THAT(result.out, !Contains("does not"));
}

TEST_CASE("mesh, scan and render write the same bytes with every backend", "[apps]") {
  const TemporaryFolder folder;
  const std::string cloud = folder / "sphere.ply";
  store_sphere(cloud);
  const auto write_all = [&](const std::string& backend, const std::string& name) {
    const std::string start = folder / name;
    const RunOptions options{.environment = {{"RANGEZIP_BACKEND", backend}}};
    CHECK(run({"mesh", cloud, "-o", start + ".ply", "-q"}, options).code == 0);
    CHECK(run({"scan", cloud, "-o", start + ".off", "--ids", start + ".ids.png", "-q",
               "--perspective", "40", "--clip", "1,0,0,-2.5"},
              options)
              .code == 0);
    CHECK(run({"render", start + ".ply", "-o", start + ".png", "--edges", "-q"}, options).code ==
          0);
    return content_of(start + ".ply") + content_of(start + ".off") +
           content_of(start + ".ids.png") + content_of(start + ".png");
  };
  const std::string expected = write_all("cpu", "cpu");
  CHECK(expected.size() > 100'000);
  for (const char* backend : {"gl:osmesa", "gl:egl"}) {
    CAPTURE(backend);
    CHECK(write_all(backend, std::string(backend)) == expected);
  }
}

TEST_CASE("an OpenGL context that is not there is refused with exit code 4", "[apps]") {
  const TemporaryFolder folder;
  const std::string cloud = folder / "sphere.ply";
  store_sphere(cloud, 100);
  for (const auto& [backend, reason] :
       {std::pair{"gl:abacus", "there is no OpenGL context 'abacus'; known: osmesa"},
        {"gl:egl:999", "no device 999"},
        {"gl:", "there is no backend 'gl:'"}}) {
    CAPTURE(backend);
    const RunResult result = run({"mesh", cloud, "-o", folder / "out.ply", "--backend", backend});
    CHECK(result.code == 4);
    CHECK_THAT(result.err, Contains(reason));
  }
}

#else

TEST_CASE("a program without OpenGL says so", "[apps]") {
  const TemporaryFolder folder;
  const std::string cloud = folder / "sphere.ply";
  store_sphere(cloud, 100);
  for (const char* backend : {"gl", "gl:osmesa"}) {
    const RunResult result = run({"mesh", cloud, "-o", folder / "out.ply", "--backend", backend});
    CHECK(result.code == 4);
    CHECK_THAT(result.err, Contains("built without OpenGL"));
  }
  CHECK_THAT(run({"backends"}).out, Contains("gl   does not  this program was built without"));
}

#endif

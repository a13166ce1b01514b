// Inputs that can be read only once.

#include <catch2/catch.hpp>

#include <fcntl.h>
#include <sys/stat.h>
#include <unistd.h>

#include <fstream>
#include <thread>

#include "tests/apps/program.h"
#include "tests/core/io/temporary_folder.h"

using namespace rangezip::test;
using Catch::Contains;

namespace {

constexpr const char* kTetrahedron =
    "v 0 0 0\nv 1 0 0\nv 0 1 0\nv 0 0 1\nf 1 3 2\nf 1 2 4\nf 2 3 4\nf 3 1 4\n";

/// A pipe with a name, into which the bytes are written once somebody reads.
class NamedPipe {
 public:
  NamedPipe(const std::filesystem::path& path, std::string bytes) : path_(path) {
    if (mkfifo(path.c_str(), S_IRUSR | S_IWUSR) != 0) throw std::runtime_error("mkfifo failed");
    writer_ = std::thread(
        [path, bytes = std::move(bytes)] { std::ofstream(path, std::ios::binary) << bytes; });
  }
  ~NamedPipe() {
    const int reader = open(path_.c_str(), O_RDONLY | O_NONBLOCK);  // in case there was none
    writer_.join();
    close(reader);
  }
  NamedPipe(const NamedPipe&) = delete;
  NamedPipe& operator=(const NamedPipe&) = delete;

 private:
  std::filesystem::path path_;
  std::thread writer_;
};

}  // namespace

TEST_CASE("a mesh is read from a pipe as from a file", "[apps]") {
  const TemporaryFolder folder;
  const auto file = folder.store("file.obj", kTetrahedron);
  const RunResult expected = run({"info", "--check", file});
  REQUIRE(expected.code == 0);
  const std::string facts = expected.out.substr(expected.out.find('\n'));
  {
    const NamedPipe pipe(folder / "info.obj", kTetrahedron);
    const RunResult result = run({"info", "--check", folder / "info.obj"});
    CHECK(result.code == 0);
    CHECK_THAT(result.out, Catch::EndsWith(facts));
  }
  {
    const NamedPipe pipe(folder / "render.obj", kTetrahedron);
    CHECK(
        run({"render", folder / "render.obj", "-o", folder / "pipe.png", "--size", "64,48"}).code ==
        0);
    REQUIRE(run({"render", file, "-o", folder / "file.png", "--size", "64,48"}).code == 0);
    CHECK(load(folder / "pipe.png") == load(folder / "file.png"));
  }
  {
    const NamedPipe pipe(folder / "mesh.obj", kTetrahedron);
    CHECK(
        run({"mesh", folder / "mesh.obj", "-o", folder / "out.ply", "--pixel-size", "0.2"}).code ==
        0);
  }
}

TEST_CASE("a pipe is refused before it is opened where a session would read it again", "[apps]") {
  // Nobody writes into this pipe: a run that opens it waits without end.
  const TemporaryFolder folder;
  REQUIRE(mkfifo((folder / "p.xyz").c_str(), S_IRUSR | S_IWUSR) == 0);
  REQUIRE(mkfifo((folder / "p.obj").c_str(), S_IRUSR | S_IWUSR) == 0);
  const auto file = folder.store("file.obj", kTetrahedron);
  const auto rule = Contains("cannot be read again");
  const RunResult mesh =
      run({"mesh", folder / "p.xyz", "-o", folder / "out.ply", "--session", folder / "s.json"});
  CHECK(mesh.code == 1);
  CHECK_THAT(mesh.err, rule && Contains((folder / "p.xyz").string()));
  const RunResult scan = run({"scan", file, "--into", folder / "p.obj", "-o", folder / "out.ply",
                              "--session", folder / "s.json"});
  CHECK(scan.code == 1);
  CHECK_THAT(scan.err, rule && Contains((folder / "p.obj").string()));
  const auto session = folder.store(
      "play.json",
      R"({"version": 1, "inputs": [{"path": "p.xyz", "hash": "0000000000000000"}], "commands": []})");
  const RunResult play = run({"play", session, "-o", folder / "out.ply"});
  CHECK(play.code == 2);
  CHECK_THAT(play.err, Contains("p.xyz") && Contains("read again"));
  CHECK(folder.count() == 4);
}

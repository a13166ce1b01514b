#include <sys/resource.h>
#include <sys/stat.h>

#include <catch2/catch.hpp>
#include <climits>
#include <cmath>
#include <csignal>
#include <stop_token>
#include <string>

#include "core/base/error.h"
#include "core/io/atomic_file.h"
#include "core/io/input_file.h"
#include "core/io/mesh_file.h"
#include "tests/core/io/temporary_folder.h"
#include "tests/support/shapes.h"

namespace rangezip {
namespace {

using test::load;
using test::TemporaryFolder;

/// Any doubles from tiny to large, and triangles that use every position in the order of the file.
TriangleMesh random_mesh(std::uint64_t seed, std::uint32_t vertices) {
  shapes::Random random(seed);
  const auto any = [&random] {
    const double mantissa = random.between(-1, 1);
    return std::ldexp(mantissa, static_cast<int>(random.bits() % 120) - 60);
  };
  TriangleMesh mesh;
  for (std::uint32_t i = 0; i < vertices; ++i) {
    mesh.positions.push_back({any(), any(), any()});
    mesh.sources.push_back({.primitive = static_cast<PrimitiveId>(random.bits()), .view = i % 7});
  }
  for (std::uint32_t i = 0; i + 2 < vertices; ++i)
    mesh.triangles.push_back({i, i + 1, i + 2});
  return mesh;
}

/// Limits the size of files of this process for the length of the scope; exceeding it is an error
/// of write(), not a signal.
class FileSizeLimit {
 public:
  explicit FileSizeLimit(rlim_t bytes) : handler_before_(std::signal(SIGXFSZ, SIG_IGN)) {
    REQUIRE(::getrlimit(RLIMIT_FSIZE, &before_) == 0);
    const rlimit limited{.rlim_cur = bytes, .rlim_max = before_.rlim_max};
    REQUIRE(::setrlimit(RLIMIT_FSIZE, &limited) == 0);
  }
  ~FileSizeLimit() {
    ::setrlimit(RLIMIT_FSIZE, &before_);
    std::signal(SIGXFSZ, handler_before_);
  }
  FileSizeLimit(const FileSizeLimit&) = delete;
  FileSizeLimit& operator=(const FileSizeLimit&) = delete;

 private:
  void (*handler_before_)(int);
  rlimit before_{};
};

}  // namespace

TEST_CASE("Every mesh format but binary STL gives back the same doubles") {
  const TemporaryFolder folder;
  for (std::uint64_t seed = 0; seed < 5; ++seed) {
    CAPTURE(seed);
    TriangleMesh mesh = random_mesh(seed, 300);
    mesh.sources.clear();
    for (const auto& [name, ascii] : {std::pair{"a.ply", false},
                                      {"b.ply", true},
                                      {"a.obj", false},
                                      {"a.OFF", false},
                                      {"a.stl", true}}) {
      CAPTURE(name);
      write_mesh(folder / name, mesh, {.ascii = ascii});
      CHECK(read_mesh(folder / name) == mesh);
    }
  }
}

TEST_CASE("Binary STL holds the nearest floats") {
  const TemporaryFolder folder;
  const TriangleMesh mesh{.positions = {{0.1, 0, 0}, {1, 1.0 / 3.0, 0}, {0, 1, 12345678.9}},
                          .triangles = {{0, 1, 2}}};
  write_mesh(folder / "a.stl", mesh);
  const TriangleMesh back = read_mesh(folder / "a.stl");
  REQUIRE(back.positions.size() == 3);
  for (std::size_t i = 0; i < 3; ++i)
    for (int axis = 0; axis < 3; ++axis) {
      CAPTURE(i, axis);
      CHECK(back.positions[i][axis] ==
            static_cast<double>(static_cast<float>(mesh.positions[i][axis])));
    }
}

TEST_CASE("Binary STL is refused where floats would make one corner of two") {
  const TemporaryFolder folder;
  TriangleMesh mesh{.positions = {{0, 0, 0}, {0.01, 0, 0}, {0, 0.01, 0}}, .triangles = {{0, 1, 2}}};
  REQUIRE_NOTHROW(write_mesh(folder / "near.stl", mesh));
  for (Vec3& p : mesh.positions)
    p += Vec3(851298.0);  // floats are 1/16 apart there
  REQUIRE_THROWS_WITH(
      write_mesh(folder / "far.stl", mesh),
      Catch::Contains("far.stl: binary STL stores 32-bit floats") && Catch::Contains("face 0"));
  REQUIRE(folder.count() == 1);
  REQUIRE_NOTHROW(write_mesh(folder / "far.stl", mesh, {.ascii = true}));
  REQUIRE_NOTHROW(write_mesh(folder / "far.ply", mesh));
}

TEST_CASE("The sources of vertices are written as PLY properties on demand") {
  const TemporaryFolder folder;
  const TriangleMesh mesh = random_mesh(3, 4);
  write_mesh(folder / "a.ply", mesh, {.ascii = true, .with_sources = true});
  const std::string text = load(folder / "a.ply");
  CHECK(text.find("property uint source_primitive\nproperty uint source_view\n") !=
        std::string::npos);
  CHECK(text.find(" " + std::to_string(mesh.sources[2].primitive) + " 2\n") != std::string::npos);
  CHECK(read_mesh(folder / "a.ply").positions == mesh.positions);
  write_mesh(folder / "b.ply", mesh, {.with_sources = true});
  CHECK(read_mesh(folder / "b.ply").positions == mesh.positions);
  write_mesh(folder / "c.ply", mesh);
  CHECK(load(folder / "b.ply").size() ==
        load(folder / "c.ply").size() + 4 * 8 +
            std::string("property uint source_primitive\nproperty uint source_view\n").size());

  TriangleMesh without = mesh;
  without.sources.clear();
  CHECK_THROWS_AS(write_mesh(folder / "d.ply", without, {.with_sources = true}), InvalidArgument);
  CHECK_FALSE(std::filesystem::exists(folder / "d.ply"));
}

TEST_CASE("Unknown extensions, missing folders and folders are refused before any work") {
  const TemporaryFolder folder;
  const TriangleMesh mesh = random_mesh(1, 3);
  for (const char* name : {"a.txt", "a", "a.ply.gz", "none/a.ply"}) {
    CAPTURE(name);
    CHECK_THROWS_AS(check_mesh_path(folder / name), IoError);
    CHECK_THROWS_AS(write_mesh(folder / name, mesh), IoError);
  }
  std::filesystem::create_directory(folder / "folder.ply");
  CHECK_THROWS_AS(check_mesh_path(folder / "folder.ply"), IoError);
  CHECK_THROWS_AS(write_mesh(folder / "folder.ply", mesh), IoError);
  CHECK(folder.count() == 1);
  CHECK_NOTHROW(check_mesh_path(folder / "A.PLY"));
  CHECK_NOTHROW(check_mesh_path("a.stl"));
}

TEST_CASE(
    "A mesh that goes past the file-size limit leaves the target as it was and nothing else") {
  const TemporaryFolder folder;
  const TriangleMesh mesh = random_mesh(1, 20000);
  const std::string name = GENERATE("a.ply", "a.obj", "a.off", "a.stl");
  const bool is_there = GENERATE(false, true);
  CAPTURE(name, is_there);
  if (is_there) folder.store(name, "old");
  {
    // The last block is the first that does not fit: the failure comes as late as it can.
    write_mesh(folder / ("whole-" + name), mesh);
    const FileSizeLimit limit(std::filesystem::file_size(folder / ("whole-" + name)) - 1);
    std::filesystem::remove(folder / ("whole-" + name));
    CHECK_THROWS_WITH(write_mesh(folder / name, mesh),
                      Catch::Matchers::Contains(name + ": cannot be written in full: "));
  }
  CHECK(folder.count() == (is_there ? 1 : 0));
  if (is_there) CHECK(load(folder / name) == "old");
}

TEST_CASE("A stop ends the writing of a mesh: nothing new is there, and what was there stays") {
  const TemporaryFolder folder;
  const TriangleMesh mesh = random_mesh(1, 20000);
  const std::string name = GENERATE("a.ply", "a.obj", "a.off", "a.stl");
  const bool ascii = GENERATE(false, true);
  const bool is_there = GENERATE(false, true);
  CAPTURE(name, ascii, is_there);
  if (is_there) folder.store(name, "old");
  std::stop_source source;
  source.request_stop();
  CHECK_THROWS_AS(write_mesh(folder / name, mesh, {.ascii = ascii}, {.stop = source.get_token()}),
                  Cancelled);
  CHECK(folder.count() == (is_there ? 1 : 0));
  if (is_there) CHECK(load(folder / name) == "old");
}

TEST_CASE("A full device is an error, small and large output alike") {
  const TemporaryFolder folder;
  std::filesystem::create_symlink("/dev/full", folder / "full.ply");
  const std::uint32_t vertices = GENERATE(3U, 20000U);
  CHECK_THROWS_WITH(write_mesh(folder / "full.ply", random_mesh(1, vertices)),
                    Catch::Matchers::Contains("No space left"));
}

TEST_CASE("A file may be overwritten while it is still being read") {
  const TemporaryFolder folder;
  const TriangleMesh mesh = random_mesh(1, 1000);
  write_mesh(folder / "a.ply", mesh);
  const InputFile input = read_input(folder / "a.ply");
  write_mesh(folder / "a.ply", random_mesh(2, 10));
  CHECK(input.items.at(0).soup->triangles == mesh.triangles);
  CHECK(read_mesh(folder / "a.ply").positions == random_mesh(2, 10).positions);
  CHECK(folder.count() == 1);
}

TEST_CASE("AtomicFile keeps the target until commit and removes what is not committed") {
  const TemporaryFolder folder;
  const std::filesystem::path path = folder.store("a.txt", "old");
  {
    AtomicFile file(path);
    file.write("new");
    CHECK(load(path) == "old");
    CHECK(folder.count() == 2);
  }
  CHECK(load(path) == "old");
  CHECK(folder.count() == 1);
  AtomicFile file(path);
  file.write("new ");
  file.write(std::string(1000000, 'x'));
  file.commit();
  CHECK(load(path) == "new " + std::string(1000000, 'x'));
  CHECK(folder.count() == 1);
}

TEST_CASE("AtomicFile takes a target whose name is as long as names may be") {
  const TemporaryFolder folder;
  const std::string name(NAME_MAX, 'a');
  AtomicFile file(folder / name);
  file.write("new");
  file.commit();
  CHECK(load(folder / name) == "new");
  CHECK(folder.count() == 1);
}

TEST_CASE("AtomicFile follows links and keeps permissions") {
  const TemporaryFolder folder;
  const std::filesystem::path path = folder.store("real.txt", "old");
  REQUIRE(::chmod(path.c_str(), 0640) == 0);
  std::filesystem::create_symlink(path, folder / "link.txt");
  AtomicFile file(folder / "link.txt");
  file.write("new");
  file.commit();
  CHECK(std::filesystem::is_symlink(folder / "link.txt"));
  CHECK(load(path) == "new");
  CHECK((std::filesystem::status(path).permissions() & std::filesystem::perms::all) ==
        std::filesystem::perms{0640});
}

}  // namespace rangezip

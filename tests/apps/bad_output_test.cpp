// An output that cannot be written is refused with exit code 3, early where that can be known, and
// leaves nothing behind.

#include <catch2/catch.hpp>

#include <sys/stat.h>
#include <unistd.h>

#include "tests/apps/program.h"
#include "tests/core/io/temporary_folder.h"

using namespace rangezip::test;
using Catch::Contains;

TEST_CASE("an output without a place or a known type is refused before the input is read",
          "[apps]") {
  const TemporaryFolder folder;
  std::filesystem::create_directory(folder / "folder.ply");
  const std::string missing = folder / "missing.xyz";  // exit code 2 would show that it was opened
  const std::vector<std::pair<std::vector<std::string>, std::string>> lines{
      {{"mesh", missing, "-o", folder / "out.xml"}, "must end in .ply .obj .off .stl"},
      {{"mesh", missing, "-o", folder / "out"}, "must end in"},
      {{"mesh", missing, "-o", folder / "nowhere/out.ply"}, "there is no folder"},
      {{"mesh", missing, "-o", folder / "folder.ply"}, "is a folder"},
      {{"mesh", missing, "-o", folder / "out.ply", "--report", folder / "nowhere/r.json"},
       "--report"},
      {{"mesh", missing, "-o", folder / "out.ply", "--session", folder / "s.txt"}, "--session"},
      {{"scan", missing, "--mask", folder / "m.pfm"}, "must end in .png"},
      {{"scan", missing, "--range-image", folder / "m.png"}, "must end in .pfm"},
      {{"render", missing, "-o", folder / "out.jpg"}, "must end in .png"},
      {{"play", missing, "-o", folder / "out.txt"}, "must end in"},
  };
  for (const auto& [arguments, reason] : lines) {
    CAPTURE(arguments);
    const RunResult result = run(arguments);
    CHECK(result.code == 3);
    CHECK_THAT(result.err, Contains(reason));
  }
  CHECK(folder.count() == 1);
}

TEST_CASE("a folder without permission is refused before the input is read", "[apps]") {
  if (geteuid() == 0) {
    WARN("not checked: the super-user may write everywhere");
    return;
  }
  const TemporaryFolder folder;
  std::filesystem::create_directory(folder / "closed");
  chmod((folder / "closed").c_str(), 0500);
  const RunResult result = run({"mesh", folder / "missing.xyz", "-o", folder / "closed/out.ply"});
  CHECK(result.code == 3);
  CHECK_THAT(result.err, Contains("is not writable"));
}

TEST_CASE("a full disk is reported with exit code 3", "[apps]") {
  const TemporaryFolder folder;
  store_sphere(folder / "sphere.ply");
  std::filesystem::create_symlink("/dev/full", folder / "full.ply");
  std::filesystem::create_symlink("/dev/full", folder / "full.png");
  const RunResult mesh = run({"mesh", folder / "sphere.ply", "-o", folder / "full.ply"});
  CHECK(mesh.code == 3);
  CHECK_THAT(mesh.err, Contains("cannot be written in full"));
  CHECK(run({"render", folder / "sphere.ply", "-o", folder / "full.png"}).code == 3);
  CHECK(folder.count() == 3);
}

TEST_CASE("an output past the file-size limit leaves nothing, and what was there stays", "[apps]") {
  const TemporaryFolder folder;
  store_sphere(folder / "sphere.ply");
  const auto kept = folder.store("out.ply", "what was there");
  const RunResult result =
      run({"mesh", folder / "sphere.ply", "-o", kept}, {.file_size_limit = 50'000});
  CHECK(result.code == 3);
  CHECK_THAT(result.err, Contains("out.ply"));
  CHECK(load(kept) == "what was there");
  CHECK(folder.count() == 2);
}

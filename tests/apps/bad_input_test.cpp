// Each kind of bad input is refused with exit code 2, the file and a reason, and leaves no output.

#include <catch2/catch.hpp>

#include <sys/stat.h>
#include <unistd.h>
#include <zlib.h>

#include "tests/apps/program.h"
#include "tests/core/io/temporary_folder.h"

using namespace rangezip::test;
using Catch::Contains;

namespace {

std::string ascii_ply(const std::string& header, const std::string& body) {
  return "ply\nformat ascii 1.0\n" + header + "end_header\n" + body;
}

constexpr const char* kVertexProperties = "property float x\nproperty float y\nproperty float z\n";

std::string packed(std::string text) {
  std::string bytes(text.size() + 100, '\0');
  z_stream stream{};
  deflateInit2(&stream, Z_BEST_COMPRESSION, Z_DEFLATED, 15 + 16, 8, Z_DEFAULT_STRATEGY);
  stream.next_in = reinterpret_cast<Bytef*>(text.data());
  stream.avail_in = static_cast<uInt>(text.size());
  stream.next_out = reinterpret_cast<Bytef*>(bytes.data());
  stream.avail_out = static_cast<uInt>(bytes.size());
  deflate(&stream, Z_FINISH);
  bytes.resize(stream.total_out);
  deflateEnd(&stream);
  return bytes;
}

std::string cut_gzip() {
  std::string text;
  for (int i = 0; i < 1000; ++i)
    text += std::to_string(i * 37 % 101) + " 1 2\n";
  const std::string whole = packed(text);
  return whole.substr(0, whole.size() / 2);
}

}  // namespace

TEST_CASE("each kind of bad input is refused without an output", "[apps]") {
  const std::string vertex = std::string("element vertex 3\n") + kVertexProperties;
  const std::string triangle = vertex + "element face 1\nproperty list uchar int vertex_indices\n";
  const std::string corners = "0 0 0\n1 0 0\n0 1 0\n";
  const std::vector<std::pair<std::string, std::string>> files{
      {"empty.ply", ""},
      {"empty.xyz", ""},
      {"blank.xyz", "\n\n"},
      {"cut.ply", ascii_ply(vertex, "0 0 0\n1 0 0\n")},
      {"count.ply",
       ascii_ply("element vertex 4000000000\n" + std::string(kVertexProperties), corners)},
      {"negative.ply", ascii_ply("element vertex -3\n" + std::string(kVertexProperties), corners)},
      {"type.ply",
       ascii_ply("element vertex 3\nproperty quad x\nproperty float y\nproperty float z\n",
                 corners)},
      {"no_header_end.ply", "ply\nformat ascii 1.0\nelement vertex 3\n"},
      {"index.ply", ascii_ply(triangle, corners + "3 0 1 3\n")},
      {"index.obj", "v 0 0 0\nv 1 0 0\nv 0 1 0\nf 1 2 4\n"},
      {"index.off", "OFF\n3 1 0\n0 0 0\n1 0 0\n0 1 0\n3 0 1 -1\n"},
      {"nan.xyz", "nan nan nan\ninf 0 0\n0 -inf 0\nnan 1 2\n"},
      {"words.xyz", "once upon a time\nthere was a cloud\n"},
      {"binary.stl", std::string(84, '\xff')},
      {"cloud.docx", "0 0 0\n1 0 0\n0 1 0\n"},
      {"cloud", "0 0 0\n1 0 0\n0 1 0\n"},
      {"cut.xyz.gz", cut_gzip()},
      {"text.ply.gz", "this is no gzip"},
      {"one.xyz", "1 2 3\n"},
      {"two.xyz", "1 2 3\n2 3 4\n"},
      {"equal.xyz", "1 2 3\n1 2 3\n1 2 3\n1 2 3\n"},
      {"line.xyz", "0 0 0\n1 1 1\n2 2 2\n5 5 5\n"},
      {"scans.conf", "bmesh missing.ply 0 0 0 0 0 0 1\n"},
      {"no_scan.conf", "camera 0 0 0 0 0 0 1\n"},
  };
  for (const auto& [name, bytes] : files) {
    CAPTURE(name);
    const TemporaryFolder folder;
    const auto input = folder.store(name, bytes);
    const RunResult result =
        run({"mesh", input, "-o", folder / "out.ply", "--report", folder / "r.json"});
    CHECK(result.code == 2);
    CHECK_THAT(result.err, Contains("rangezip: ") && Contains(folder.path().string()));
    CHECK(result.out.empty());
    CHECK(folder.count() == 1);
  }
}

TEST_CASE("a missing file and a folder are refused as inputs", "[apps]") {
  const TemporaryFolder folder;
  std::filesystem::create_directory(folder / "folder.ply");
  for (const char* name : {"missing.ply", "folder.ply"}) {
    CAPTURE(name);
    for (const char* command : {"mesh", "scan"})
      CHECK(run({command, folder / name, "-o", folder / "out.ply"}).code == 2);
    CHECK(run({"render", folder / name, "-o", folder / "out.png"}).code == 2);
    CHECK(run({"info", folder / name}).code == 2);
  }
  CHECK(run({"play", folder / "missing.json", "-o", folder / "out.ply"}).code == 2);
  CHECK(folder.count() == 1);
}

TEST_CASE("an unreadable file is refused", "[apps]") {
  if (geteuid() == 0) {
    WARN("not checked: the super-user may read everything");
    return;
  }
  const TemporaryFolder folder;
  const auto cloud = folder.store("cloud.xyz", "0 0 0\n1 0 0\n0 1 0\n");
  chmod(cloud.c_str(), 0);
  CHECK(run({"mesh", cloud, "-o", folder / "out.ply"}).code == 2);
  CHECK(folder.count() == 1);
}

TEST_CASE("one bad input among good ones is refused", "[apps]") {
  const TemporaryFolder folder;
  store_sphere(folder / "good.ply", 1000);
  const auto bad = folder.store("bad.xyz", "1 2 three\n");
  const RunResult result = run({"mesh", folder / "good.ply", bad, "-o", folder / "out.ply"});
  CHECK(result.code == 2);
  CHECK_THAT(result.err, Contains(bad.string()) && Contains("line 1"));
  CHECK(folder.count() == 2);
}

TEST_CASE("a small file that unpacks to more than the memory is refused by its name", "[apps]") {
#if defined(__SANITIZE_ADDRESS__) || defined(__SANITIZE_THREAD__)
  WARN("not checked: sanitizers need more addresses than any limit leaves");
#else
  constexpr std::size_t kMegabyte = std::size_t{1} << 20U;
  const std::string member = packed(std::string(16 * kMegabyte, '\n'));
  std::string bomb = packed("0 0 0\n1 0 0\n0 1 0\n");
  for (int i = 0; i < 128; ++i)
    bomb += member;  // 2 GB in all
  const TemporaryFolder folder;
  const auto input = folder.store("bomb.xyz.gz", bomb);
  CHECK(std::filesystem::file_size(input) < 4 * kMegabyte);
  const RunResult result = run({"info", input}, {.address_limit = 1024 * kMegabyte});
  CHECK(result.code == 2);
  CHECK_THAT(result.err, Contains(input.string() + ": unpacks to more than the ") &&
                             Contains("bytes that there is memory for"));
#endif
}

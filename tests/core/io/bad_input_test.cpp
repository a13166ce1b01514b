#include <sys/stat.h>
#include <unistd.h>
#include <zlib.h>

#include <array>
#include <catch2/catch.hpp>
#include <string>
#include <vector>

#include "core/base/error.h"
#include "core/io/file_hash.h"
#include "core/io/input_file.h"
#include "core/io/input_with_mesh.h"
#include "core/io/mesh_file.h"
#include "tests/core/io/temporary_folder.h"

namespace rangezip {
namespace {

using test::TemporaryFolder;

/// The text of the IoError by which read_scene refuses a file; empty if it does not.
std::string refusal(const std::filesystem::path& path) {
  try {
    std::ignore = read_scene(std::array{path});
  } catch (const IoError& error) {
    return error.what();
  }
  return {};
}

struct BadFile {
  std::string name;
  std::string bytes;
  std::string place;  ///< as the message must name it
  std::string rule;   ///< a part of the message
};

const std::string kPlyHead = "ply\nformat ascii 1.0\n";
const std::string kXyz = "property float x\nproperty float y\nproperty float z\n";
const std::string kThreeVertices = "element vertex 3\n" + kXyz;
const std::string kPoints = "0 0 0\n1 0 0\n0 1 0\n";
const std::string kFaces = "element face 1\nproperty list uchar int vertex_indices\nend_header\n";

std::vector<BadFile> bad_files() {
  const std::string binary_head = "ply\nformat binary_little_endian 1.0\n";
  return {
      // empty and truncated
      {"a.ply", "", "byte 0", "empty"},
      {"a.xyz", "", "byte 0", "empty"},
      {"a.ply", "ply\nformat ascii 1.0\nelement vertex 3\n", "line 4", "ends within the header"},
      {"a.ply", kPlyHead + kThreeVertices + "end_header\n0.00 0 0\n1.00 0 0\n0 1", "line 10",
       "the line ends"},
      {"a.ply", kPlyHead + kThreeVertices + "end_header\n0.0 0.0 0.0\n1.0 0.0 0.0\n", "line 10",
       "ends after 2 of 3"},
      {"a.ply", binary_head + kThreeVertices + "end_header\n" + std::string(35, 'a'), "byte",
       "promises 3 of element 'vertex'"},
      {"a.ply",
       binary_head + kThreeVertices + kFaces + std::string(36, '\0') + '\x03' +
           std::string(4, '\0'),
       "byte", "does not fit"},
      {"a.obj", "v 0 0 0\nv 1 0 0\nv 0 1", "line 3", "ends before the third"},
      {"a.off", "OFF\n3 1 0\n0 0 0\n1 0 0\n0 1 0\n", "line 6", "ends after 0 of 1 faces"},
      {"a.off", "OFF\n3 1 0\n0 0 0\n1 0 0\n0 1 0\n3 0 1", "line 6", "2 were found"},
      {"a.stl", "solid a\nfacet normal 0 0 1\nouter loop\nvertex 0 0 0\n", "line 5", "cut"},
      {"a.stl", std::string(80, ' ') + std::string("\2\0\0\0", 4) + std::string(99, 'x'), "byte 80",
       "promises 2 triangles"},
      {"a.stl", std::string(20, 'x'), "byte 20", "within the header"},
      {"a.xyz", "0 0 0\n1 0 0\n0 1", "line 3", "ends before the third"},
      // headers that lie about counts or types
      {"a.ply", kPlyHead + "element vertex 99999999999999\n" + kXyz + "end_header\n" + kPoints,
       "byte", "promises 99999999999999"},
      {"a.ply", kPlyHead + "element vertex 2\n" + kXyz + "end_header\n" + kPoints, "line 10",
       "goes on after the last element"},
      {"a.ply",
       binary_head +
           "element vertex 3\nproperty float x\nproperty float y\nproperty short z\n"
           "end_header\n" +
           std::string(36, 'a'),
       "byte", "6 bytes are left"},
      {"a.ply", kPlyHead + "element vertex -3\n" + kXyz + "end_header\n", "line 3", "whole number"},
      {"a.ply", kPlyHead + "element vertex 3\nproperty real x\nend_header\n", "line 4",
       "unknown property type 'real'"},
      {"a.ply",
       kPlyHead +
           "element vertex 3\nproperty float x\nproperty float y\nend_header\n1 1\n2 2\n3 3\n",
       "line 6", "no number property 'z'"},
      {"a.ply",
       kPlyHead + "element vertex 3\nproperty list uchar float x\n" +
           "property float y\nproperty float z\nend_header\n" + kPoints,
       "line 7", "no number property 'x'"},
      {"a.ply", kPlyHead + kThreeVertices + "property float x\nend_header\n", "line 7", "twice"},
      {"a.ply", kPlyHead + kThreeVertices + kThreeVertices + "end_header\n", "line 7", "twice"},
      {"a.ply", kPlyHead + "property float x\nend_header\n", "line 3", "before the first element"},
      {"a.ply", kPlyHead + kThreeVertices + "property list float int a\nend_header\n", "line 7",
       "whole-number type"},
      {"a.ply", "ply\nformat ascii 2.0\nend_header\n", "line 2", "version"},
      {"a.ply", "ply\nformat text 1.0\nend_header\n", "line 2", "'text'"},
      {"a.ply", "ply\nend_header\n", "line 2", "no 'format' line"},
      {"a.ply", "plx\n", "line 1", "begins with the line 'ply'"},
      {"a.ply", kPlyHead + "colour red\nend_header\n", "line 3", "'colour'"},
      {"a.ply", kPlyHead + "element face 0\nproperty list uchar int vertex_indices\nend_header\n",
       "line 5", "no element 'vertex'"},
      {"a.ply",
       kPlyHead + kThreeVertices + "element face 1\nproperty int a\nend_header\n" + kPoints + "1\n",
       "line 9", "no list property"},
      {"a.ply", kPlyHead + kThreeVertices + "end_header\n0 0 0\n1 0 0 7\n0 1 0\n", "line 9",
       "more values"},
      {"a.off", "OFF\n99999999999999 1 0\n0 0 0\n", "line 2", "promised"},
      {"a.off", "OFF\n3 99999999999999 0\n" + kPoints, "line 2", "promised"},
      {"a.off", "OFF\n2 0 0\n" + kPoints, "line 5", "goes on"},
      {"a.off", "OFF\nthree 1 0\n" + kPoints, "line 2", "whole numbers"},
      {"a.off", "4OFF\n3 1 0\n" + kPoints, "line 1", "begins with OFF"},
      {"a.off", "OFF BINARY\n", "line 1", "binary OFF"},
      {"a.pts", "7\n0 0 0\n1 0 0\n0 1 0.00000000000000000000000\n", "line 1",
       "7 points are promised"},
      // indices out of range
      {"a.ply", kPlyHead + kThreeVertices + kFaces + kPoints + "3 0 1 3\n", "line 13",
       "vertex index 3 is out of range"},
      {"a.ply", kPlyHead + kThreeVertices + kFaces + kPoints + "3 0 1 -1\n", "line 13",
       "vertex index -1 is out of range"},
      {"a.ply",
       binary_head + kThreeVertices +
           "element face 1\nproperty list uchar uchar vertex_indices\nend_header\n" +
           std::string(36, '\0') + "\3" + std::string(1, '\0') + "\1\7",
       "byte", "vertex index 7 is out of range"},
      {"a.obj", "v 0 0 0\nv 1 0 0\nv 0 1 0\nf 1 2 4\n", "line 4", "vertex number 4"},
      {"a.obj", "v 0 0 0\nv 1 0 0\nv 0 1 0\nf 1 2 0\n", "line 4", "vertex number 0"},
      {"a.obj", "v 0 0 0\nv 1 0 0\nv 0 1 0\nf 1 2 -4\n", "line 4", "vertex number -4"},
      {"a.obj", "v 0 0 0\nv 1 0 0\nv 0 1 0\nf\n", "line 4", "no vertex numbers"},
      {"a.off", "OFF\n3 1 0\n" + kPoints + "3 0 1 3\n", "line 6", "vertex index 3"},
      // nothing but NaN and Inf
      {"a.xyz", "nan nan nan\ninf 0 0\n", "whole file", "none of its 2 points is finite"},
      {"a.off", "OFF\n3 1 0\nnan 0 0\n0 nan 0\n0 0 inf\n3 0 1 2\n", "whole file",
       "none of its 1 polygons"},
      {"a.ply", kPlyHead + "element vertex 0\n" + kXyz + "end_header\n", "whole file", "no point"},
      // text that is no number
      {"a.xyz", "once upon a time\nthere was a cloud\n", "line 1", "no line has three numbers"},
      {"a.xyz", "0 0 0\n1 one 0\n", "line 2", "'one 0'"},
      {"a.csv", "0,0,0\n1,,0\n", "line 2", "three numbers"},
      {"a.ply", kPlyHead + kThreeVertices + "end_header\n0 0 0\n1 x 0\n0 1 0\n", "line 9",
       "'y' needs a number"},
      {"a.ply", kPlyHead + kThreeVertices + kFaces + kPoints + "3 0 1 b\n", "line 13",
       "whole number"},
      {"a.obj", "v 0 0 0\nv 1 zero 0\n", "line 2", "'zero 0'"},
      {"a.obj", "v 0 0 0\nv 1 0 0\nv 0 1 0\nf 1 2 c\n", "line 4", "'c'"},
      {"a.obj", "this is a letter\n", "line 1", "no line 'v x y z'"},
      {"a.off", "OFF\n3 0 0\n0 0 0\n1 o 0\n0 1 0\n", "line 4", "three numbers"},
      {"a.off", "OFF\n3 1 0\n" + kPoints + "x 0 1 2\n", "line 6", "number of corners"},
      {"a.stl", "solid a\nfacet normal 0 0 1\nouter loop\nvertex 0 o 0\n", "line 4",
       "three numbers"},
      {"a.stl", "solid a\nfacet normal 0 0 1\nouter loop\nvertex 0 0 0\nendloop\n", "line 5",
       "at least three"},
      {"a.stl", "solid a\nfacet normal 0 0 1\nouter loop\nvertex 0 0 0\nendfacet\n", "line 5",
       "ends with 'endloop'"},
      {"a.stl", "solid a\nfacet normal 0 0 1\nouter hoop\nvortex 0 0 0\n", "line 4", "'vortex'"},
      // too few points
      {"a.xyz", "1 2 3\n", "whole input", "only 1"},
      {"a.xyz", "1 2 3\n4 5 6\n", "whole input", "only 2"},
      {"a.xyz", "1 2 3\n1 2 3\n1 2 3\n1 2 3\n", "whole input", "all are equal"},
      {"a.xyz", "1 2 3\n2 3 4\n3 4 5\n7 8 9\n", "whole input", "on one line"},
      {"a.obj", "v 0 0 0\nv 1 0 0\nv 3 0 0\nf 1 2 3\n", "whole input", "on one line"},
      // unknown types and lists of scans
      {"a.doc", kPoints, "", "unknown type 'doc'"},
      {"a", kPoints, "", "unknown type ''"},
      {"a.conf", "bmesh missing.ply 0 0 0 0 0 0 1\n", "line 1", "missing.ply is missing"},
      {"a.conf", "camera 0 0 0 0 0 0 1\n", "line 1", "'bmesh'"},
      {"a.conf", "bmesh a.conf 0 0 0 0 0 0\n", "line 1", "seven numbers"},
      {"a.conf", "bmesh a.conf 0 0 nan 0 0 0 1\n", "line 1", "seven numbers"},
      {"a.conf", "bmesh a.conf 0 0 0 0 0 0 1 5\n", "line 1", "more than seven"},
      {"a.conf", "bmesh a.conf 0 0 0 0 0 0 2\n", "line 1", "length 2"},
      {"a.conf", "bmesh missing.ply 0 0 -1.1e30 0 0 0 1\n", "line 1", "1e30"},
      {"a.conf", "bmesh missing.ply 1e30 0 0 0 0 0 1\n", "line 1", "missing.ply is missing"},
      {"a.conf", "bmesh a.conf 0 0 0 0 0 0 1\n", "", "another list"},
      {"a.conf", "scan a.ply\n", "line 1", "'scan'"},
      // packed files
      {"a.xyz.gz", kPoints, "byte", "corrupt gzip data"},
  };
}

std::string packed(const std::string& bytes, const TemporaryFolder& folder) {
  gzFile file = gzopen((folder / "packed.tmp").c_str(), "wb");
  gzwrite(file, bytes.data(), static_cast<unsigned>(bytes.size()));
  gzclose(file);
  return test::load(folder / "packed.tmp");
}

}  // namespace

TEST_CASE("Bad input is refused by name, place and rule") {
  const TemporaryFolder folder;
  for (const BadFile& bad : bad_files()) {
    CAPTURE(bad.name, bad.bytes, bad.rule);
    const std::filesystem::path path = folder.store(bad.name, bad.bytes);
    const std::string message = refusal(path);
    CAPTURE(message);
    CHECK(message.find(path.string() + ": " + bad.place) == 0);
    CHECK(message.find(bad.rule) != std::string::npos);
  }
}

TEST_CASE("What is too small for the doubles where it lies is refused, moved there or not") {
  const TemporaryFolder folder;
  folder.store("near.xyz", "0 0 0\n0 1 0\n0 0 1\n");
  const auto rule = Catch::Matchers::Contains("so far from (0, 0, 0)");
  CHECK_THAT(refusal(folder.store("a.xyz", "1e20 0 0\n1e20 1 0\n1e20 0 1\n")), rule);
  CHECK_THAT(refusal(folder.store("far.conf", "bmesh near.xyz 1e20 0 0 0 0 0 1\n")), rule);
  // Points on the grids of maps, a tenth of a millimetre apart, are well within.
  CHECK(refusal(folder.store("map.conf", "bmesh near.xyz 5e9 5e9 0 0 0 0 1\n")).empty());
}

TEST_CASE("Missing files and folders are refused") {
  const TemporaryFolder folder;
  CHECK(refusal(folder / "none.ply").find("none.ply: cannot be opened") != std::string::npos);
  std::filesystem::create_directory(folder / "folder.ply");
  CHECK(refusal(folder / "folder.ply").find("is a folder") != std::string::npos);
  CHECK_THROWS_AS(read_mesh(folder / "none.ply"), IoError);
  CHECK_THROWS_AS(hash_file(folder / "none.ply"), IoError);
  CHECK_THROWS_AS(read_scene({}), InvalidArgument);
}

TEST_CASE("A file without permission to read is refused") {
  const TemporaryFolder folder;
  const std::filesystem::path path = folder.store("a.xyz", kPoints);
  REQUIRE(::chmod(path.c_str(), 0) == 0);
  constexpr uid_t kNobody = 65534;
  const bool is_root = ::geteuid() == 0;  // who may read anything
  if (is_root) {
    REQUIRE(::chmod(folder.path().c_str(), 0755) == 0);
    REQUIRE(::seteuid(kNobody) == 0);
  }
  const std::string message = refusal(path);
  if (is_root) REQUIRE(::seteuid(0) == 0);
  CHECK(message.find("cannot be opened: Permission denied") != std::string::npos);
}

TEST_CASE("A cut or corrupt .gz is refused at every length") {
  const TemporaryFolder folder;
  const std::string whole = packed(kPoints + "2 2 2\n3 5 7\n", folder);
  REQUIRE(refusal(folder.store("a.xyz.gz", whole)).empty());
  for (std::size_t length = 0; length < whole.size(); ++length) {
    CAPTURE(length);
    const std::string message = refusal(folder.store("a.xyz.gz", whole.substr(0, length)));
    CHECK(message.find("a.xyz.gz: byte") != std::string::npos);
  }
  std::string corrupt = whole;
  corrupt[whole.size() - 6] ^= 1;  // in the checksum
  CHECK(refusal(folder.store("a.xyz.gz", corrupt)).find("corrupt") != std::string::npos);
  CHECK(refusal(folder.store("a.xyz.gz", whole + "rest")).find("corrupt") != std::string::npos);
  CHECK(refusal(folder.store("a.xyz.gz", packed("", folder))).find("empty") != std::string::npos);
}

TEST_CASE("A .gz cut where its content fills the memory for it exactly is refused") {
  // A byte of this file stands for up to a thousand bytes of text, so wherever the memory grows
  // there is a cut at which it is just full.
  std::string text = kPoints;
  for (int i = 0; i < 20000; ++i)
    text += "1.5 2 3\n";
  const TemporaryFolder folder;
  const std::string whole = packed(text, folder);
  REQUIRE(refusal(folder.store("a.xyz.gz", whole)).empty());
  for (std::size_t length = 1; length < whole.size(); ++length) {
    CAPTURE(length);
    const std::string message = refusal(folder.store("a.xyz.gz", whole.substr(0, length)));
    CHECK(message.find("the file is cut") != std::string::npos);
  }
}

TEST_CASE("A PLY list of negative length is refused in every encoding, also where it is skipped") {
  const TemporaryFolder folder;
  const std::string rule = "the list 'vertex_indices' of -1 items does not fit in the file";
  const std::string face = "element face 1\nproperty list char int vertex_indices\n";
  const std::string text = kPlyHead + kThreeVertices + face;
  CHECK(refusal(folder.store("a.ply", text + "end_header\n" + kPoints + "-1\n"))
            .find("line 13: " + rule) != std::string::npos);
  CHECK(refusal(folder.store("a.ply", text + "property list char int skipped\nend_header\n" +
                                          kPoints + "3 0 1 2 -7\n"))
            .find("line 14: the list 'skipped' of -7 items does not fit") != std::string::npos);
  const std::string binary = "ply\nformat binary_little_endian 1.0\n" + kThreeVertices + face;
  CHECK(refusal(folder.store("a.ply", binary + "end_header\n" + std::string(36, '\0') + '\xff'))
            .find(rule) != std::string::npos);
}

TEST_CASE("A file of unknown type is refused without being opened") {
  const TemporaryFolder folder;
  const auto rule = Catch::Matchers::Contains("unknown type");
  // Each of these would be refused for another reason, or read without end, if it were opened.
  for (const std::filesystem::path& path : {std::filesystem::path("/dev/zero"), folder / "none.doc",
                                            folder.store("a.zip.gz", "no gzip data")}) {
    CAPTURE(path);
    CHECK_THAT(refusal(path), rule);
    CHECK_THROWS_WITH(read_mesh(path), rule);
  }
}

TEST_CASE(
    "What is said of an unknown type names the types that are read there, lists of scans too") {
  const std::string all = "known are .ply .xyz .pts .asc .csv .txt .obj .off .stl";
  CHECK_THAT(refusal("a.doc"), Catch::Matchers::EndsWith(all + " .conf"));
  CHECK_THROWS_WITH(read_input_with_mesh("a.doc"), Catch::Matchers::EndsWith(all + " .conf"));
  CHECK_THROWS_WITH(read_mesh("a.doc"), Catch::Matchers::EndsWith(all));
}

TEST_CASE("A mesh without a face is refused as a mesh") {
  const TemporaryFolder folder;
  CHECK_THROWS_AS(read_mesh(folder.store("a.obj", "v 0 0 0\nv 1 0 0\nv 0 1 0\n")), IoError);
  CHECK_THROWS_AS(read_mesh(folder.store("a.xyz", kPoints)), IoError);
}

TEST_CASE("A file cut at any byte is read or refused, never worse") {
  const TemporaryFolder folder;
  const TriangleMesh mesh{.positions = {{0, 0, 0}, {1, 0, 0}, {0, 1, 0}, {0.25, 0.125, 1.5}},
                          .triangles = {{0, 2, 1}, {0, 1, 3}, {1, 2, 3}, {2, 0, 3}}};
  const std::string type = GENERATE("ply", "obj", "off", "stl");
  const bool ascii = GENERATE(false, true);
  CAPTURE(type, ascii);
  write_mesh(folder / ("whole." + type), mesh, {.ascii = ascii});
  const std::string whole = test::load(folder / ("whole." + type));
  std::size_t refused = 0;
  for (std::size_t length = 0; length < whole.size(); ++length) {
    const std::string message = refusal(folder.store("cut." + type, whole.substr(0, length)));
    if (!message.empty()) ++refused;
  }
  // All but the last line end (and, in OBJ and STL text, ends between two statements) is needed.
  CHECK(refused > whole.size() / 2);
}

TEST_CASE("A file with any byte changed is read or refused, never worse") {
  const TemporaryFolder folder;
  const TriangleMesh mesh{.positions = {{0, 0, 0}, {1, 0, 0}, {0, 1, 0}, {0.25, 0.125, 1.5}},
                          .triangles = {{0, 2, 1}, {0, 1, 3}, {1, 2, 3}, {2, 0, 3}}};
  const std::string type = GENERATE("ply", "obj", "off", "stl");
  const bool ascii = GENERATE(false, true);
  write_mesh(folder / ("whole." + type), mesh, {.ascii = ascii});
  const std::string whole = test::load(folder / ("whole." + type));
  for (std::size_t i = 0; i < whole.size(); ++i) {
    for (const char value : {'\0', '\xff', '-', '9', '\n'}) {
      CAPTURE(type, ascii, i, value);
      std::string changed = whole;
      changed[i] = value;
      CHECK_NOTHROW(refusal(folder.store("changed." + type, changed)));
    }
  }
}

}  // namespace rangezip

#include <sys/stat.h>
#include <zlib.h>

#include <array>
#include <bit>
#include <catch2/catch.hpp>
#include <string>
#include <vector>

#include "core/io/file_hash.h"
#include "core/io/input_with_mesh.h"
#include "core/io/mesh_file.h"
#include "core/io/split_polygon.h"
#include "tests/core/io/temporary_folder.h"
#include "tests/support/shapes.h"

namespace rangezip {
namespace {

using test::load;
using test::TemporaryFolder;

/// A tetrahedron whose coordinates are floats, so that every format holds it exactly.
TriangleMesh tetrahedron() {
  return {.positions = {{0, 0, 0}, {1, 0, 0}, {0, 1, 0}, {0.25, 0.125, 1.5}},
          .triangles = {{0, 2, 1}, {0, 1, 3}, {1, 2, 3}, {2, 0, 3}}};
}

/// The three corners of every triangle, in world space.
std::vector<std::array<Vec3, 3>> corners(const InputItem& item) {
  std::vector<std::array<Vec3, 3>> all;
  for (const Triangle& triangle : item.soup->triangles) {
    std::array<Vec3, 3> three;
    for (std::size_t i = 0; i < 3; ++i) {
      three[i] = Vec3(item.world_from_item * Vec4(Vec3(item.soup->positions[triangle[i]]), 1.0));
    }
    all.push_back(three);
  }
  return all;
}

std::vector<std::array<Vec3, 3>> corners(const TriangleMesh& mesh) {
  std::vector<std::array<Vec3, 3>> all;
  for (const Triangle& t : mesh.triangles) {
    all.push_back({mesh.positions[t[0]], mesh.positions[t[1]], mesh.positions[t[2]]});
  }
  return all;
}

std::vector<Vec3> points(const InputItem& item) {
  std::vector<Vec3> all;
  for (const Vec3f& p : item.cloud->positions) {
    all.emplace_back(item.world_from_item * Vec4(Vec3(p), 1.0));
  }
  return all;
}

std::string packed(const std::string& bytes, const TemporaryFolder& folder) {
  const std::filesystem::path path = folder / "packed.tmp";
  gzFile file = gzopen(path.c_str(), "wb");
  REQUIRE(gzwrite(file, bytes.data(), static_cast<unsigned>(bytes.size())) ==
          static_cast<int>(bytes.size()));
  REQUIRE(gzclose(file) == Z_OK);
  return load(path);
}

InputFile read_text(const std::string& name, const std::string& text) {
  const TemporaryFolder folder;
  return read_input(folder.store(name, text));
}

}  // namespace

TEST_CASE("Every mesh format, plain and packed, gives back the same triangles") {
  const TemporaryFolder folder;
  const TriangleMesh mesh = tetrahedron();
  const std::string type = GENERATE("ply", "obj", "off", "stl");
  const bool ascii = GENERATE(false, true);
  CAPTURE(type, ascii);
  const std::filesystem::path path = folder / ("mesh." + type);
  write_mesh(path, mesh, {.ascii = ascii});
  const std::filesystem::path packed_path =
      folder.store("mesh." + type + ".gz", packed(load(path), folder));
  for (const std::filesystem::path& each : {path, packed_path}) {
    const InputFile input = read_input(each);
    REQUIRE(input.items.size() == 1);
    REQUIRE(input.items[0].soup);
    CHECK(input.items[0].soup->positions.size() == 4);
    CHECK(corners(input.items[0]) == corners(mesh));
    CHECK(input.reports[0].triangles == 4);
    CHECK(input.reports[0].polygons == 4);
    CHECK(input.reports[0].bounds == bounds_of(mesh));
    CHECK(corners(read_mesh(each)) == corners(mesh));
  }
}

TEST_CASE("Text formats read the same with line ends of either kind") {
  const TemporaryFolder folder;
  const std::string type = GENERATE("ply", "obj", "off", "stl");
  write_mesh(folder / ("a." + type), tetrahedron(), {.ascii = true});
  std::string text = load(folder / ("a." + type));
  for (std::size_t i = 0; (i = text.find('\n', i)) != std::string::npos; i += 2)
    text.insert(i, "\r");
  CHECK(read_mesh(folder.store("b." + type, text)) == read_mesh(folder / ("a." + type)));
}

TEST_CASE("A .gz of several members is read to its end") {
  const TemporaryFolder folder;
  const std::string both = packed("0 0 0\n1 0 0\n", folder) + packed("0 1 0\n", folder);
  CHECK(read_input(folder.store("a.xyz.gz", both)).reports[0].points == 3);
}

TEST_CASE("PLY strips turn over every second triangle and start anew at -1") {
  const InputFile input = read_text("strip.ply",
                                    "ply\nformat ascii 1.0\nelement vertex 6\nproperty float x\n"
                                    "property float y\nproperty float z\nelement tristrips 1\n"
                                    "property list int int vertex_indices\nend_header\n"
                                    "0 0 0\n1 0 0\n0 1 0\n1 1 0\n0 2 0\n1 2 0\n"
                                    "9 0 1 2 3 -1 2 3 4 5\n");
  REQUIRE(input.items.size() == 1);
  CHECK(input.reports[0].polygons == 1);
  const std::vector<Triangle> expected{{0, 1, 2}, {2, 1, 3}, {2, 3, 4}, {4, 3, 5}};
  CHECK(input.items[0].soup->triangles == expected);
}

TEST_CASE("PLY strips of the binary encodings restart at -1 too, and repeated corners only link") {
  std::string bytes =
      "ply\nformat binary_little_endian 1.0\nelement vertex 5\nproperty float x\n"
      "property float y\nproperty float z\nelement tristrips 1\n"
      "property list uchar int vertex_indices\nend_header\n";
  const auto put = [&bytes](auto value) {
    const auto stored = std::bit_cast<std::array<char, sizeof(value)>>(value);
    bytes.append(stored.data(), stored.size());
  };
  for (int i = 0; i < 5; ++i) {
    put(static_cast<float>(i));
    put(static_cast<float>(i * i));
    put(0.0F);
  }
  bytes += '\x09';
  for (const int index : {0, 1, 2, 2, 3, -1, 2, 3, 4})
    put(std::int32_t{index});
  const InputFile input = read_text("strip.ply", bytes);
  const std::vector<Triangle> expected{{0, 1, 2}, {2, 3, 4}};
  CHECK(input.items[0].soup->triangles == expected);
  CHECK(input.reports[0].degenerate_polygons == 0);
}

TEST_CASE("A Stanford range image is a cloud; its grid is noted and left out") {
  const InputFile input = read_text("scan.ply",
                                    "ply\nformat ascii 1.0\nobj_info num_cols 2\ncomment scan\n"
                                    "element vertex 3\nproperty float x\nproperty float y\n"
                                    "property float z\nelement range_grid 4\n"
                                    "property list uchar int vertex_indices\nend_header\n"
                                    "0 0 0\n1 0 0\n0 1 0.5\n1 0\n0\n1 1\n1 2\n");
  REQUIRE(input.items.size() == 1);
  CHECK(points(input.items[0]) == std::vector<Vec3>{{0, 0, 0}, {1, 0, 0}, {0, 1, 0.5}});
  REQUIRE(input.reports[0].notes.size() == 1);
  CHECK(input.reports[0].notes[0].find("range_grid") != std::string::npos);
}

TEST_CASE("PLY elements may come in any order, with lists before and after the vertices") {
  const InputFile input = read_text("a.ply",
                                    "ply\nformat ascii 1.0\nelement face 1\n"
                                    "property uchar flags\nproperty list uchar int vertex_index\n"
                                    "property list uchar float texcoord\nelement vertex 4\n"
                                    "property float z\nproperty list uchar int ring\n"
                                    "property double x\nproperty double y\nend_header\n"
                                    "7 4 0 1 2 3 2 0.5 0.5\n"
                                    "0 0 0 0\n0 2 5 6 1 0\n0 0 1 1\n0 1 9 0 1\n");
  CHECK(input.reports[0].triangles == 2);
  CHECK(input.reports[0].bounds.upper == Vec3{1, 1, 0});
}

TEST_CASE("Polygons with a corner that is not finite, or with too few, are left out and counted") {
  const InputFile input = read_text("a.off",
                                    "OFF\n6 5 0\n0 0 0\n1 0 0\n0 1 0\nnan 0 0\n0 0 inf\n1 0 0\n"
                                    "3 0 1 2\n3 0 1 3\n4 0 1 2 4\n2 0 1\n3 0 1 5\n");
  CHECK(input.reports[0].triangles == 1);
  CHECK(input.reports[0].nonfinite_points == 2);
  CHECK(input.reports[0].nonfinite_polygons == 2);
  CHECK(input.reports[0].degenerate_polygons == 2);
  for (const Vec3f& p : input.items[0].soup->positions)
    CHECK(std::isfinite(p.x));
  CHECK(corners(input.items[0])[0] == std::array<Vec3, 3>{Vec3{0, 0, 0}, {1, 0, 0}, {0, 1, 0}});
}

TEST_CASE("Points that are not finite are left out and counted") {
  const InputFile input = read_text("a.xyz", "0 0 0\nnan 1 1\n1 0 0\n1 inf 0\n1 0 -1e999\n0 1 0\n");
  CHECK(input.reports[0].nonfinite_points == 3);
  CHECK(points(input.items[0]) == std::vector<Vec3>{{0, 0, 0}, {1, 0, 0}, {0, 1, 0}});
}

TEST_CASE("Points in one place are kept once where they are one in a hundred or more") {
  const std::size_t repeats = GENERATE(2U, 20U, 200U, 20'000U);
  std::string text, once;
  for (int i = 0; i < 4000; ++i) {
    const std::string line = std::to_string(i % 60) + " " + std::to_string(i) + " 7\n";
    text += line;
    once += line;
    if (i == 1000) once += "0 0 0\n";
    if (i != 1000) continue;
    for (std::size_t k = 0; k < repeats; ++k)
      text += "0 0 0\n";
  }
  const InputFile input = read_text("a.xyz", text);
  if (repeats < 40) {
    CHECK(input.reports[0].repeated_points == 0);
    CHECK(input.reports[0].points == 4000 + repeats);
  } else {
    CHECK(input.reports[0].repeated_points == repeats - 1);
    CHECK(points(input.items[0]) == points(read_text("a.xyz", once).items[0]));
  }
}

TEST_CASE("OBJ corners count from 1 or backwards and may carry textures and normals") {
  const InputFile input = read_text("a.obj",
                                    "mtllib x.mtl\no thing\nv 0 0 0\nv 1 0 0 1.0\n"
                                    "v 0 1 0 0.5 0.5 0.5\nvt 0 0\nvn 0 0 1\n"
                                    "f 1/1/1 2/1/1 3/1/1 # corner\nf -3//1 -2//1 \\\n -1//1\n"
                                    "f 3/1 2/1 1/1\nv 5 5 5\nl 1 2\n");
  const std::vector<Triangle> expected{{0, 1, 2}, {0, 1, 2}, {2, 1, 0}};
  REQUIRE(input.items.size() == 1);
  CHECK(input.items[0].soup->triangles == expected);
  CHECK(input.reports[0].notes.size() == 2);  // the unused vertex, the line element
}

TEST_CASE("A backslash at the end of an OBJ comment does not join the next line to it") {
  const InputFile input = read_text("a.obj",
                                    "# C:\\scans\\\nv 0 0 0\n \t# more\\\r\nv 1 0 0\n"
                                    "v 0 1 0 # here\\\nv 0 \\\n0 1 # there\\\nv 1 1 1\n");
  CHECK(points(input.items.at(0)) ==
        std::vector<Vec3>{{0, 0, 0}, {1, 0, 0}, {0, 1, 0}, {0, 0, 1}, {1, 1, 1}});
}

TEST_CASE("OBJ vertices are points without faces; with faces only point elements are") {
  const std::string vertices = "v 0 0 0\nv 1 0 0\nv 0 1 0\nv 0 0 1\n";
  const InputFile cloud = read_text("a.obj", vertices);
  REQUIRE(cloud.items.size() == 1);
  CHECK(cloud.items[0].cloud->positions.size() == 4);
  const InputFile mixed = read_text("a.obj", vertices + "f 1 2 3\np 4 -1 1\n");
  REQUIRE(mixed.items.size() == 2);
  CHECK(points(mixed.items[0]) == std::vector<Vec3>{{0, 0, 1}, {0, 0, 1}, {0, 0, 0}});
  CHECK(mixed.items[1].soup->triangles.size() == 1);
}

TEST_CASE("OFF headers with more columns, comments and counts behind the keyword are read") {
  const std::string body =
      "0 0 0 1 1 1 1\n1 0 0 1 1 1 1 # red\n\n# more\n0 1 0 1 1 1 1\n3 0 1 2 255 0 0\n";
  for (const std::string header :
       {"COFF\n3 1 0\n", "NOFF 3 1 0\n", "# by hand\nSTCNOFF\n# n\n3 1\n"}) {
    CAPTURE(header);
    CHECK(read_text("a.off", header + body).reports[0].triangles == 1);
  }
  CHECK(read_text("a.off", "OFF 3 0 0\n0 0 0\n1 0 0\n0 1 0\n").reports[0].points == 3);
}

TEST_CASE("A binary STL that begins with the word solid is read as binary") {
  const TemporaryFolder folder;
  write_mesh(folder / "a.stl", tetrahedron());
  std::string bytes = load(folder / "a.stl");
  bytes.replace(0, 6, "solid ");
  const InputFile input = read_input(folder.store("b.stl", bytes));
  CHECK(input.reports[0].format == "stl binary");
  CHECK(corners(input.items[0]) == corners(tetrahedron()));
}

TEST_CASE("An STL text of several solids in capital letters is read") {
  const std::string facet =
      "FACET NORMAL 0 0 1\n OUTER LOOP\n  VERTEX 0 0 0\n  VERTEX 1 0 0\n  VERTEX 0 1 0\n"
      " ENDLOOP\nENDFACET\n";
  const InputFile input =
      read_text("a.stl", "SOLID a b\n" + facet + "ENDSOLID\nsolid\n" + facet + "endsolid\n");
  CHECK(input.reports[0].triangles == 2);
  CHECK(input.items[0].soup->positions.size() == 3);
}

TEST_CASE("A .conf list places its scans by the inverse of the rotation") {
  const TemporaryFolder folder;
  folder.store("scan.xyz", "1 0 0\n0 1 0\n0 0 1\n");
  // A quarter turn about z: R maps x to y; its inverse maps x to -y.
  const std::filesystem::path path =
      folder.store("all.conf",
                   "camera 0 0 0 0 0 0 1\n# list\nmesh other.ply\n"
                   "bmesh scan.xyz 10 20 30 0 0 0.70710678118654752 0.70710678118654752\r\n"
                   "bmesh scan.xyz 0 0 0 0 0 0 1\n");
  const InputFile input = read_input(path);
  REQUIRE(input.items.size() == 2);
  CHECK(input.reports.size() == 2);
  const std::vector<Vec3> expected{{10, 19, 30}, {11, 20, 30}, {10, 20, 31}};
  for (std::size_t i = 0; i < 3; ++i) {
    // Entries of the matrix are off by a few units in the last place of 1.
    CHECK(glm::length(points(input.items[0])[i] - expected[i]) < 1e-14);
  }
  CHECK(points(input.items[1])[0] == Vec3{1, 0, 0});
}

TEST_CASE("read_scene puts points and polygons of several files together in order") {
  const TemporaryFolder folder;
  write_mesh(folder / "a.ply", tetrahedron());
  const std::array<std::filesystem::path, 2> paths{folder / "a.ply",
                                                   folder.store("b.xyz", "5 5 5\n6 6 6\n")};
  const SceneInput input = read_scene(paths);
  CHECK(input.scene.triangle_count() == 4);
  CHECK(input.scene.point_count() == 2);
  CHECK(input.reports.size() == 2);
  CHECK(input.scene.bounds().upper == Vec3{6, 6, 6});
}

TEST_CASE("A file read as input and as mesh gives what both readers give; no faces, no mesh") {
  const TemporaryFolder folder;
  const std::filesystem::path path = folder / "a.ply";
  write_mesh(path, tetrahedron());
  const InputWithMesh both = read_input_with_mesh(path);
  CHECK(both.input.reports.front().triangles == 4);
  CHECK(both.mesh.positions == read_mesh(path).positions);
  CHECK(both.mesh.triangles == read_mesh(path).triangles);
  CHECK(read_input_with_mesh(folder.store("a.xyz", "0 0 0\n1 0 0\n")).mesh.empty());
  const InputWithMesh list =
      read_input_with_mesh(folder.store("a.conf", "bmesh a.ply 0 0 0 0 0 0 1\n"));
  CHECK(list.input.items.size() == 1);
  CHECK(list.mesh.empty());
}

TEST_CASE("Reading stops when the caller asks for the end, whatever the reader and the file") {
  const TemporaryFolder folder;
  std::stop_source source;
  source.request_stop();
  const Progress progress{.stop = source.get_token()};
  const std::filesystem::path cloud = folder.store("a.xyz", "0 0 0\n1 0 0\n0 1 0\n");
  CHECK_THROWS_AS(read_input(cloud, progress), Cancelled);
  CHECK_THROWS_AS(hash_file(cloud, progress), Cancelled);
  for (const char* name : {"a.ply", "a.obj", "a.off", "a.stl"}) {
    CAPTURE(name);
    write_mesh(folder / name, tetrahedron());
    CHECK_THROWS_AS(read_mesh(folder / name, progress), Cancelled);
    CHECK_THROWS_AS(read_input_with_mesh(folder / name, progress), Cancelled);
  }
  // The reader of this type has no progress: what stops is the unpacking.
  const std::filesystem::path list = folder.store("a.conf.gz", packed("no list", folder));
  CHECK_THROWS_AS(read_input(list, progress), Cancelled);
  // Nobody writes into this pipe, so that reading it would wait without end.
  REQUIRE(mkfifo((folder / "p.xyz").c_str(), S_IRUSR | S_IWUSR) == 0);
  CHECK_THROWS_AS(read_input(folder / "p.xyz", progress), Cancelled);
}

TEST_CASE("Cutting a polygon ear by ear stops when the caller asks for the end") {
  std::stop_source source;
  source.request_stop();
  const std::array<std::uint32_t, 4> arrow{0, 1, 2, 3};
  const std::array<Vec3, 4> places{{{0, 0, 0}, {2, 1, 0}, {0, 2, 0}, {1, 1, 0}}};
  std::vector<Triangle> triangles;
  CHECK_THROWS_AS(split_polygon(arrow, places, triangles, {.stop = source.get_token()}), Cancelled);
}

}  // namespace rangezip

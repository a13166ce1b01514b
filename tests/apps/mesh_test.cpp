// rangezip mesh: one command from a cloud to a verified mesh, the same bytes however it is run.

#include <catch2/catch.hpp>
#include <fstream>
#include <sstream>

#include <nlohmann/json.hpp>

#include "core/io/input_file.h"
#include "core/io/mesh_file.h"
#include "core/mesh/mesh_report.h"
#include "tests/apps/program.h"
#include "tests/core/io/temporary_folder.h"
#include "tests/support/shapes.h"

using namespace rangezip;
using namespace rangezip::test;
using Catch::Contains;
using Json = nlohmann::json;

namespace {

RunResult mesh(const TemporaryFolder& folder, const std::string& output,
               const std::vector<std::string>& more = {}, const RunOptions& options = {}) {
  std::vector<std::string> arguments{"mesh", folder / "sphere.ply", "-o", folder / output};
  arguments.insert(arguments.end(), more.begin(), more.end());
  return run(arguments, options);
}

}  // namespace

TEST_CASE("mesh makes one closed sphere of a cloud, and says so", "[apps]") {
  const TemporaryFolder folder;
  store_sphere(folder / "sphere.ply");
  const RunResult result = mesh(folder, "out.ply", {"--report", folder / "r.json"});
  CAPTURE(result.err);
  REQUIRE(result.code == 0);
  CHECK_THAT(result.out, Contains("20,000 points") &&
                             Contains("1 component, 0 boundary loops, Euler number 2"));

  const TriangleMesh read = read_mesh(folder / "out.ply");
  CHECK_NOTHROW(check_mesh(read));
  const MeshReport report = report_mesh(read);
  CHECK(report.euler == 2);
  CHECK(report.boundary_loops == 0);

  const Json json = Json::parse(load(folder / "r.json"));
  REQUIRE(json["inputs"].size() == 1);
  CHECK(json["inputs"][0]["points"] == 20'000);
  CHECK(json["inputs"][0]["skipped"]["nonfinite_points"] == 0);
  CHECK(json["mesh"]["vertices"] == report.vertices);
  CHECK(json["mesh"]["faces"] == report.faces);
  CHECK(json["mesh"]["components"] == 1);
  CHECK(json["mesh"]["boundary_loops"] == 0);
  CHECK(json["mesh"]["euler_number"] == 2);
  CHECK(json["mesh"]["nonmanifold_edges"] == 0);
  CHECK(json["mesh"]["self_intersections"] == 0);
  CHECK(json["coverage"] > 0.99);
  CHECK(json["views"].size() >= 4);
  CHECK(json["views"][0]["kind"] == "planned");
  CHECK(json["dropped"].contains("components"));
  double seconds = 0.0;
  for (const Json& stage : json["stages"])
    seconds += stage["seconds"].get<double>();
  CHECK(json["stages"].size() >= 6);
  CHECK(seconds > 0.0);
}

TEST_CASE("mesh says which points it skipped", "[apps]") {
  const TemporaryFolder folder;
  store_sphere(folder / "sphere.ply");
  std::string unseen = "nan nan nan\n";
  for (int i = 0; i < 1500; ++i)
    unseen += "0 0 0\n";
  const auto more = folder.store("unseen.xyz", unseen);
  const RunResult result = mesh(folder, "out.ply", {more, "--report", folder / "r.json"});
  CAPTURE(result.err);
  REQUIRE(result.code == 0);
  CHECK_THAT(result.out,
             Contains("20,001 points") &&
                 Contains("skipped   points not finite: 1, points repeated in one place: 1,499"));
  const Json skipped = Json::parse(load(folder / "r.json"))["inputs"][1]["skipped"];
  CHECK(skipped["nonfinite_points"] == 1);
  CHECK(skipped["repeated_points"] == 1499);
}

TEST_CASE("mesh says which step made a handle", "[apps]") {
  const TemporaryFolder folder;
  std::ofstream cloud(folder / "torus.xyz");
  for (const Vec3f& p : shapes::sampled(shapes::torus(), 20'000).positions)
    cloud << p.x << ' ' << p.y << ' ' << p.z << '\n';
  cloud.close();
  const RunResult result =
      run({"mesh", folder / "torus.xyz", "-o", folder / "out.ply", "--report", folder / "r.json"});
  CAPTURE(result.err);
  REQUIRE(result.code == 0);
  const Json report = Json::parse(load(folder / "r.json"));
  CHECK(report["mesh"]["euler_number"] == 0);
  CHECK(report["handles"]["count"] == 1);
  int sum = 0;
  for (const Json& change : report["handles"]["changes"])
    sum += change["change"].get<int>();
  CHECK(sum == 1);
  const std::string first = report["handles"]["changes"][0]["by"];
  CHECK_THAT(first, Catch::StartsWith("view "));
  CHECK_THAT(result.out, Contains("handles   1: " + first + " +"));
}

/// 1,000 points about the centre of store_sphere(), where `place` puts those of a unit sphere, but
/// a fifth as far.
template <class Place>
void store_in_sphere(const std::string& file, const Place& place) {
  shapes::Random random(2);
  std::ofstream inside(file);
  for (int i = 0; i < 1000; ++i) {
    const Vec3 p = 0.2 * place(random.direction()) + Vec3{3.0, 0.0, 0.0};
    inside << p.x << ' ' << p.y << ' ' << p.z << '\n';
  }
}

TEST_CASE("mesh gives the wall of a closed cavity faces that no view reaches", "[apps]") {
  const TemporaryFolder folder;
  store_sphere(folder / "sphere.ply");
  store_in_sphere(folder / "inside.xyz", [](const Vec3& p) { return p; });
  const RunResult result =
      mesh(folder, "out.ply", {folder / "inside.xyz", "--report", folder / "r.json"});
  CAPTURE(result.err, result.out);
  REQUIRE(result.code == 0);
  const Json json = Json::parse(load(folder / "r.json"));
  CHECK(json["mesh"]["components"] == 2);
  CHECK(json["mesh"]["euler_number"] == 4);
  CHECK(json["finish"]["grown_bodies"] == 1);
  CHECK(json["coverage"] == 1.0);
}

TEST_CASE("mesh reports with its place what of the cloud no view reaches", "[apps]") {
  const TemporaryFolder folder;
  store_sphere(folder / "sphere.ply");
  // A disc inside of the sphere, whose centre is (3, 0, 0): a sheet, of which no side is outside.
  store_in_sphere(folder / "inside.xyz", [](const Vec3& p) { return Vec3{p.x, p.y, 0.0}; });
  const RunResult result =
      mesh(folder, "out.ply", {folder / "inside.xyz", "--report", folder / "r.json"});
  CAPTURE(result.err, result.out);
  REQUIRE(result.code == 0);
  CHECK_THAT(result.out, Contains("missing   1 place, area "));

  const Json json = Json::parse(load(folder / "r.json"));
  CHECK(json["coverage"] == Approx(20.0 / 21.0).margin(0.001));
  CHECK(json["uncovered"]["points"] == 1000);
  REQUIRE(json["uncovered"]["places"].size() == 1);
  const Json& place = json["uncovered"]["places"][0];
  CHECK(place["count"] == 1000);
  CHECK(place["center"][0] == Approx(3.0).margin(0.02));
  CHECK(place["radius"] == Approx(0.2).margin(0.02));
  CHECK(json["unsupported"]["places"].empty());
}

TEST_CASE("mesh gives the same bytes again, with one thread, and without AVX2 and FMA", "[apps]") {
  const TemporaryFolder folder;
  store_sphere(folder / "sphere.ply");
  REQUIRE(mesh(folder, "a.ply").code == 0);
  const std::string bytes = load(folder / "a.ply");
  REQUIRE(mesh(folder, "b.ply").code == 0);
  CHECK((load(folder / "b.ply") == bytes));
  REQUIRE(mesh(folder, "c.ply", {"--threads", "1"}).code == 0);
  CHECK((load(folder / "c.ply") == bytes));
  REQUIRE(mesh(folder, "d.ply", {"--threads", "2"}).code == 0);
  CHECK((load(folder / "d.ply") == bytes));
  // The names of glibc 2.33 and later; those before it end in "_Usable".
  const RunOptions plain_libm{
      .environment = {{"GLIBC_TUNABLES", "glibc.cpu.hwcaps=-AVX2,-FMA,-FMA4"}}};
  REQUIRE(mesh(folder, "e.ply", {}, plain_libm).code == 0);
  CHECK((load(folder / "e.ply") == bytes));
}

TEST_CASE("a recorded mesh run plays to the same bytes", "[apps]") {
  const TemporaryFolder folder;
  store_sphere(folder / "sphere.ply");
  for (const std::string method : {"auto", "paper"}) {
    CAPTURE(method);
    const RunResult recorded =
        mesh(folder, "a.ply", {"--method", method, "--session", folder / "s.json"});
    REQUIRE(std::filesystem::exists(folder / "s.json"));
    const RunResult played = run({"play", folder / "s.json", "-o", folder / "b.ply"});
    CAPTURE(recorded.err, played.err);
    REQUIRE(played.code == 0);
    CHECK((load(folder / "a.ply") == load(folder / "b.ply")));
  }
}

TEST_CASE("mesh writes every type, and more on demand", "[apps]") {
  const TemporaryFolder folder;
  store_sphere(folder / "sphere.ply", 5000);
  REQUIRE(mesh(folder, "a.ply").code == 0);
  const TriangleMesh reference = read_mesh(folder / "a.ply");
  for (const char* name : {"a.obj", "a.off"}) {
    CAPTURE(name);
    REQUIRE(mesh(folder, name).code == 0);
    CHECK(read_mesh(folder / name).positions == reference.positions);
  }
  REQUIRE(mesh(folder, "a.stl").code == 0);
  CHECK(read_mesh(folder / "a.stl").triangles.size() == reference.triangles.size());
  REQUIRE(mesh(folder, "b.ply", {"--ascii"}).code == 0);
  CHECK_THAT(load(folder / "b.ply"), Contains("format ascii"));
  CHECK_THAT(load(folder / "b.ply"), !Contains("source_primitive"));
  REQUIRE(mesh(folder, "c.ply", {"--sources"}).code == 0);
  CHECK_THAT(load(folder / "c.ply"), Contains("property uint source_primitive\n"
                                              "property uint source_view\n"));
  CHECK(read_mesh(folder / "c.ply").positions == reference.positions);
}

TEST_CASE("the sources of a mesh name the point behind a vertex and the view that saw it",
          "[apps]") {
  const TemporaryFolder folder;
  store_sphere(folder / "sphere.ply", 5000);
  const InputItem item = read_input(folder / "sphere.ply").items.at(0);
  const std::vector<Vec3f>& points = item.cloud->positions;
  REQUIRE(mesh(folder, "out.ply", {"--sources", "--ascii", "--report", folder / "r.json"}).code ==
          0);
  const Json report = Json::parse(load(folder / "r.json"));
  const std::size_t view_count = report["views"].size();
  const std::size_t vertex_count = report["mesh"]["vertices"];
  const double pixel_size = report["pixel_size"];

  std::istringstream file(load(folder / "out.ply"));
  for (std::string line; line != "end_header";)
    REQUIRE(std::getline(file, line));
  std::size_t with_point = 0;
  for (std::size_t i = 0; i < vertex_count; ++i) {
    Vec3 position;
    VertexSource source;
    REQUIRE(file >> position.x >> position.y >> position.z >> source.primitive >> source.view);
    CHECK((source.view < view_count || source.view == VertexSource::kNoView));
    if (source.primitive == kNoPrimitive) continue;
    REQUIRE(source.primitive < points.size());
    ++with_point;
    // Won in the vertex's own pixel; the finish then moves vertices by a few pixels, and those that
    // it makes have the point of a neighbour.
    const Vec3 point = item.world_from_item * Vec4(Vec3(points[source.primitive]), 1.0);
    CHECK(glm::distance(position, point) < 6.0 * pixel_size);
  }
  CHECK(with_point > vertex_count / 2);
}

TEST_CASE("the options of mesh do what they say", "[apps]") {
  const TemporaryFolder folder;
  store_sphere(folder / "sphere.ply");
  const auto faces = [&](const std::vector<std::string>& more) {
    const RunResult result = mesh(folder, "out.ply", more);
    CAPTURE(result.err);
    CHECK((result.code == 0 || result.code == 5));
    return static_cast<double>(read_mesh(folder / "out.ply").triangles.size());
  };
  // Half the pixel size, four times the faces; a target within 5 %.
  const double coarse = faces({"--pixel-size", "0.08"});
  const double fine = faces({"--pixel-size", "0.04"});
  CHECK(fine / coarse > 3.0);
  CHECK(fine / coarse < 5.0);
  const double wanted = faces({"--triangles", "4000"});
  CHECK(wanted > 3800);
  CHECK(wanted < 4200);
  // Where triangles may be off by a tenth of a pixel, they need not be as small as the pixels.
  CHECK(faces({"--pixel-size", "0.04", "--decimate", "0.1"}) < 0.5 * fine);

  mesh(folder, "out.ply", {"--views", "3", "--finish", "none", "--report", folder / "r.json"});
  const Json report = Json::parse(load(folder / "r.json"));
  std::size_t planned = 0;
  for (const Json& view : report["views"])
    planned += view["kind"] == "planned" ? 1 : 0;
  CHECK(planned <= 3);
  CHECK_FALSE(report.contains("finish"));
  REQUIRE(mesh(folder, "out.ply", {"--finish", "fast"}).code == 0);
}

TEST_CASE("a sphere that was scanned from within faces its middle, and plays to the same bytes",
          "[apps]") {
  const TemporaryFolder folder;
  store_sphere(folder / "sphere.ply");
  const RunResult result = mesh(folder, "in.ply",
                                {"--scanner", "3,0,0.5", "--scanner", "2.5,0,0", "--session",
                                 folder / "s.json", "--report", folder / "r.json"});
  CAPTURE(result.err);
  REQUIRE(result.code == 0);
  CHECK_THAT(result.out, Contains("turned    1 of them toward the scanners"));
  CHECK(Json::parse(load(folder / "r.json"))["turned_components"] == 1);
  const TriangleMesh inwards = read_mesh(folder / "in.ply");
  for (const Triangle& face : inwards.triangles) {
    const Vec3 toward_middle = Vec3{3.0, 0.0, 0.0} - centroid_of(inwards.positions, face);
    REQUIRE(glm::dot(unit_normal(inwards.positions, face), toward_middle) > 0.0);
  }
  REQUIRE(run({"play", folder / "s.json", "-o", folder / "again.ply"}).code == 0);
  CHECK(load(folder / "again.ply") == load(folder / "in.ply"));

  const RunResult outside = mesh(folder, "out.ply", {"--scanner=-3,0,0"});
  REQUIRE(outside.code == 0);
  CHECK_THAT(outside.out, !Contains("turned"));
}

TEST_CASE("a run that ends without a face writes nothing and says what may help", "[apps]") {
  const TemporaryFolder folder;
  const auto cloud = folder.store("cloud.xyz", "0 0 0\n1 0 0\n0 1 0\n0 0 1\n");
  const RunResult result = run({"mesh", cloud, "-o", folder / "out.ply"});
  CHECK(result.code == 5);
  CHECK_THAT(result.err, Contains("is not written: no face came out") && Contains("--pixel-size"));
  CHECK(folder.count() == 1);
}

TEST_CASE("an input may be overwritten by its mesh", "[apps]") {
  const TemporaryFolder folder;
  store_sphere(folder / "sphere.ply");
  REQUIRE(mesh(folder, "out.ply").code == 0);
  const std::string bytes = load(folder / "out.ply");
  REQUIRE(mesh(folder, "sphere.ply").code == 0);
  CHECK((load(folder / "sphere.ply") == bytes));
  CHECK(folder.count() == 2);
}

TEST_CASE("a session is not recorded over the input it needs", "[apps]") {
  const TemporaryFolder folder;
  store_sphere(folder / "sphere.ply");
  const std::string before = load(folder / "sphere.ply");
  const RunResult result = mesh(folder, "sphere.ply", {"--session", folder / "s.json"});
  CHECK(result.code == 1);
  CHECK_THAT(result.err, Contains("would overwrite an input"));
  CHECK((load(folder / "sphere.ply") == before));
}

TEST_CASE("nor over a scan that a list names", "[apps]") {
  const TemporaryFolder folder;
  store_sphere(folder / "a.ply");
  folder.store("scans.conf", "bmesh a.ply 0 0 0 0 0 0 1\n");
  const std::string before = load(folder / "a.ply");
  const RunResult result =
      run({"mesh", folder / "scans.conf", "-o", folder / "a.ply", "--session", folder / "s.json"});
  CHECK(result.code == 1);
  CHECK_THAT(result.err, Contains("would overwrite an input"));
  CHECK((load(folder / "a.ply") == before));
}

TEST_CASE("points and polygons of several files make one mesh", "[apps]") {
  const TemporaryFolder folder;
  store_sphere(folder / "sphere.ply");
  TriangleMesh box = shapes::to_mesh(shapes::cube(1.0));
  write_mesh(folder / "box.obj", box);
  const RunResult result = run({"mesh", folder / "sphere.ply", folder / "box.obj", "-o",
                                folder / "out.ply", "--report", folder / "r.json"});
  CAPTURE(result.err);
  REQUIRE(result.code == 0);
  const Json report = Json::parse(load(folder / "r.json"));
  CHECK(report["inputs"].size() == 2);
  CHECK(report["mesh"]["components"] == 2);
}

TEST_CASE("a .conf of scans is meshed, recorded with its scans and played back", "[apps]") {
  const TemporaryFolder folder;
  store_sphere(folder / "a.ply", 10'000);
  store_sphere(folder / "b.ply", 8'000);
  folder.store("scans.conf",
               "camera 0 0 0 0 0 0 1\nbmesh a.ply 0 0 0 0 0 0 1\nbmesh b.ply 0 0 0 0 0 0 1\n");
  const RunResult result = run(
      {"mesh", folder / "scans.conf", "-o", folder / "out.ply", "--session", folder / "s.json"});
  CAPTURE(result.err);
  REQUIRE(result.code == 0);
  CHECK_THAT(result.out, Contains("18,000 points"));
  const Json session = Json::parse(load(folder / "s.json"));
  CHECK(session["inputs"].size() == 1);
  CHECK(session["also_read"].size() == 2);
  REQUIRE(run({"play", folder / "s.json", "-o", folder / "b.out.ply"}).code == 0);
  CHECK((load(folder / "out.ply") == load(folder / "b.out.ply")));
  store_sphere(folder / "b.ply", 8'001);
  CHECK(run({"play", folder / "s.json", "-o", folder / "c.ply"}).code == 2);
}

// Session files: what is written comes back to the bit, what a person writes is understood or
// refused with its place.

#include <catch2/catch.hpp>

#include <bit>
#include <cmath>
#include <filesystem>
#include <fstream>

#include "core/base/error.h"
#include "core/io/file_hash.h"
#include "core/io/session_file.h"
#include "tests/core/io/temporary_folder.h"
#include "tests/core/session/sample_commands.h"

using namespace rangezip;
using test::TemporaryFolder;

namespace {

bool same_bits(double a, double b) {
  return std::bit_cast<std::uint64_t>(a) == std::bit_cast<std::uint64_t>(b);
}

bool same_bits(const Vec2& a, const Vec2& b) {
  return same_bits(a.x, b.x) && same_bits(a.y, b.y);
}

bool same_bits(const Camera& a, const Camera& b) {
  bool same = a.lens == b.lens && same_bits(a.near_depth, b.near_depth) &&
              same_bits(a.far_depth, b.far_depth) && a.clip_planes == b.clip_planes;
  for (int column = 0; column < 4; ++column) {
    for (int row = 0; row < 4; ++row) {
      same = same && same_bits(a.eye_from_world[column][row], b.eye_from_world[column][row]);
    }
  }
  return same;
}

/// The only command of a session with these members after "command".
Command read_command(const std::string& members) {
  const TemporaryFolder folder;
  return read_session(folder.store("s.json", R"({"version": 1, "inputs": [], "commands": [{)" +
                                                 members + "}]}"))
      .commands.at(0);
}

constexpr const char* kCamera =
    R"("camera": {"look_at": {"eye": [0,0,5], "target": [0,0,0], "up": [0,1,0]}})";

std::string message_of(const std::string& document) {
  const TemporaryFolder folder;
  const auto path = folder.store("s.json", document);
  try {
    static_cast<void>(read_session(path));
  } catch (const IoError& error) {
    const std::string text = error.what();
    CHECK(text.find(path.string() + ": ") == 0);
    return text.substr(path.string().size() + 2);
  }
  return "accepted";
}

std::string message_of_command(const std::string& members) {
  return message_of(R"({"version": 1, "inputs": [], "commands": [{"command": "undo"}, {)" +
                    members + "}]}");
}

}  // namespace

TEST_CASE("a session comes back to the bit, and is written the same again", "[session_file]") {
  const TemporaryFolder folder;
  for (std::uint64_t seed = 1; seed <= 20; ++seed) {
    CAPTURE(seed);
    shapes::Random random(seed);
    const SessionFile session{
        .points = 12, .triangles = 3, .commands = test::full_commands(random)};
    write_session(folder / "a.json", session);
    const SessionFile read = read_session(folder / "a.json");
    write_session(folder / "b.json", read);
    CHECK(test::load(folder / "a.json") == test::load(folder / "b.json"));
    CHECK(read.points == 12);
    CHECK(read.triangles == 3);
    REQUIRE(read.commands.size() == session.commands.size());

    const auto& scan = std::get<AddScan>(session.commands[0]);
    const auto& scan_read = std::get<AddScan>(read.commands[0]);
    CHECK(same_bits(scan.scan.camera, scan_read.scan.camera));
    CHECK(scan.scan.extent == scan_read.scan.extent);
    REQUIRE(scan_read.scan.region.size() == 3);
    CHECK(same_bits(scan.scan.region[2], scan_read.scan.region[2]));
    CHECK(same_bits(scan.scan.median->max_step, scan_read.scan.median->max_step));
    CHECK(scan.scan.clean_mask == scan_read.scan.clean_mask);
    CHECK(scan.stitch.view == scan_read.stitch.view);
    CHECK(scan.stitch.method == scan_read.stitch.method);
    CHECK(scan.vote == scan_read.vote);
    CHECK(same_bits(std::get<EraseRegion>(session.commands[1]).camera,
                    std::get<EraseRegion>(read.commands[1]).camera));
    const Sphere& place = std::get<ErasePlaces>(session.commands[2]).places.at(0);
    const Sphere& place_read = std::get<ErasePlaces>(read.commands[2]).places.at(0);
    CHECK((place.center == place_read.center));
    CHECK(same_bits(place.radius, place_read.radius));
    CHECK(std::get<FinishMesh>(session.commands.at(6)).vote ==
          std::get<FinishMesh>(read.commands.at(6)).vote);
    CHECK(same_bits(std::get<FillMeshHoles>(session.commands[4]).max_perimeter,
                    std::get<FillMeshHoles>(read.commands[4]).max_perimeter));
  }
}

TEST_CASE("passes that do not run and limits that do not exist stay so", "[session_file]") {
  const TemporaryFolder folder;
  AddScan scan;
  scan.scan.quality = QualityMaskOptions{};
  write_session(folder / "a.json", {.commands = {scan, FillMeshHoles{}}});
  const SessionFile read = read_session(folder / "a.json");
  const auto& scan_read = std::get<AddScan>(read.commands[0]);
  CHECK_FALSE(scan_read.scan.see_through);
  CHECK_FALSE(scan_read.scan.plane_fit);
  CHECK_FALSE(scan_read.vote);
  CHECK(scan_read.stitch.view == VertexSource::kNoView);
  CHECK(scan_read.scan.triangulate.max_edge == kNoSample);
  CHECK(scan_read.scan.quality->max_replacing_slope == kNoSample);
  CHECK(std::get<FillMeshHoles>(read.commands[1]).max_perimeter ==
        std::numeric_limits<double>::infinity());
}

TEST_CASE("numbers that are too large to tell from the next smaller one come back",
          "[session_file]") {
  const TemporaryFolder folder;
  for (const double huge : {0x1.0p53, -0x1.8p60, 1e300}) {
    CAPTURE(huge);
    AddScan scan;
    scan.scan.camera.eye_from_world[3][2] = huge;
    scan.stitch.band = std::abs(huge);
    write_session(folder / "a.json", {.commands = {scan}});
    const SessionFile read = read_session(folder / "a.json");
    CHECK(same_bits(std::get<AddScan>(read.commands[0]).scan.camera, scan.scan.camera));
    CHECK(same_bits(std::get<AddScan>(read.commands[0]).stitch.band, scan.stitch.band));
  }
}

TEST_CASE("what a hand-written session leaves out has its default", "[session_file]") {
  const auto scan = std::get<AddScan>(
      read_command(R"("command": "scan", "median": {}, )" + std::string(kCamera)));
  CHECK(scan.scan.extent == ScanRequest{}.extent);
  CHECK(scan.scan.point_size == 1);
  REQUIRE(scan.scan.median);
  CHECK(scan.scan.median->radius == MedianFilterOptions{}.radius);
  CHECK_FALSE(scan.scan.plane_fit);
  CHECK(scan.stitch.band == StitchOptions{}.band);
  CHECK(scan.scan.camera.eye_from_world == look_at({0, 0, 5}, {0, 0, 0}, {0, 1, 0}).eye_from_world);
  CHECK(scan.scan.camera.lens == Camera{}.lens);

  CHECK(std::get<SmoothMesh>(read_command(R"("command": "smooth")")).factor == 0.5);
  CHECK(std::get<FinishMesh>(read_command(R"("command": "finish")")).options.method ==
        FinishMethod::full);
  CHECK(std::get<UndoSteps>(read_command(R"("command": "undo")")).count == 1);
  CHECK(std::get<EraseRegion>(read_command(R"("command": "erase", )" + std::string(kCamera)))
            .visible_only);
}

TEST_CASE("whole numbers stand for real ones, whatever the locale", "[session_file]") {
  CHECK(std::get<SmoothMesh>(read_command(R"("command": "smooth", "factor": 1)")).factor == 1.0);
  CHECK(std::get<SmoothMesh>(read_command(R"("command": "smooth", "factor": 25e-2)")).factor ==
        0.25);
}

TEST_CASE("a wrong session is refused with file, place, rule and value", "[session_file]") {
  const std::string camera = kCamera;
  const std::vector<std::pair<std::string, std::string>> documents{
      {"[]", "/: must be an object, got []"},
      {"{", "parse error at line 1, column 2"},
      {R"({"version": 1, "version": 1})",
       "/: an object must not have a key twice, got \"version\""},
      {"{}", "/version: must be given"},
      {R"({"version": 2, "inputs": [], "commands": []})",
       "/version: this program reads version 1, got 2"},
      {R"({"version": 1, "commands": []})", "/inputs: must be given"},
      {R"({"version": 1, "inputs": []})", "/commands: must be given"},
      {R"({"version": 1, "inputs": {}, "commands": []})", "/inputs: must be an array, got {}"},
      {R"({"version": 1, "inputs": [], "commands": [], "extra": 3})", "/extra: unknown key, got 3"},
      {R"({"version": 1, "inputs": [{}], "commands": []})", "/inputs/0/path: must be given"},
      {R"({"version": 1, "inputs": [{"path": 5}], "commands": []})",
       "/inputs/0/path: must be a text, got 5"},
      {R"({"version": 1, "inputs": [{"path": ""}], "commands": []})",
       "/inputs/0/path: must not be empty"},
      {R"({"version": 1, "inputs": [{"path": "a", "hash": "xyz"}], "commands": []})",
       "/inputs/0/hash: must be 16 hexadecimal digits, got \"xyz\""},
      {R"({"version": 1, "inputs": [{"path": "a", "size": 3}], "commands": []})",
       "/inputs/0/size: unknown key, got 3"},
      {R"({"version": 1, "inputs": [], "points": -1, "commands": []})",
       "/points: must be an integer of at least 0, got -1"},
      {R"({"version": 1, "inputs": [], "commands": [{}]})", "/commands/0/command: must be given"},
  };
  for (const auto& [document, message] : documents) {
    CAPTURE(document);
    CHECK_THAT(message_of(document), Catch::StartsWith(message));
  }

  const std::vector<std::pair<std::string, std::string>> commands{
      {R"("command": "jump")",
       "/commands/1/command: must be one of \"scan\" \"erase\" \"erase_places\""},
      {R"("command": 3)", "/commands/1/command: must be one of"},
      {R"("command": "smooth", "factor": 0)",
       "/commands/1/factor: must be a number greater than 0.0 and of at most 1.0, got 0"},
      {R"("command": "smooth", "factor": 1.5)", "/commands/1/factor: must be a number"},
      {R"("command": "smooth", "factor": "big")", "/commands/1/factor: must be a number"},
      {R"("command": "smooth", "factor": 1e999)", "number overflow"},
      {R"("command": "smooth", "iterations": 0)",
       "/commands/1/iterations: must be an integer in [1, 10000], got 0"},
      {R"("command": "smooth", "iterations": 1.0)", "/commands/1/iterations: must be an integer"},
      {R"("command": "smooth", "iterations": 3000000000)",
       "/commands/1/iterations: must be an integer"},
      {R"("command": "smooth", "iterations": 18446744073709551615)",
       "/commands/1/iterations: must be an integer"},
      {R"("command": "smooth", "rounds": 1)",
       "/commands/1/rounds: unknown key; known here: command iterations factor, got 1"},
      {R"("command": "finish", "method": "slow")",
       "/commands/1/method: must be one of \"fast\" \"full\", got \"slow\""},
      {R"("command": "finish", "snap_features": 1)",
       "/commands/1/snap_features: must be true or false, got 1"},
      {R"("command": "fill", "max_perimeter": -1)", "/commands/1/max_perimeter: must be a number"},
      {R"("command": "scan")", "/commands/1/camera: must be given"},
      {R"("command": "scan", "camera": {})",
       "/commands/1/camera: must have one of eye_from_world and look_at, got {}"},
      {R"("command": "scan", "median": 3, )" + camera,
       "/commands/1/median: must be an object, got 3"},
      {R"("command": "scan", "median": {"radius": 0}, )" + camera,
       "/commands/1/median/radius: must be an integer"},
      {R"("command": "scan", "median": {"radius": 2147483647}, )" + camera,
       "/commands/1/median/radius: must be an integer in [1, 50]"},
      {R"("command": "scan", "decimate": {"max_block": 1073741824}, )" + camera,
       "/commands/1/decimate/max_block: must be an integer in [1, 8192]"},
      {R"("command": "scan", "stitch": {"max_gap": 65}, )" + camera,
       "/commands/1/stitch/max_gap: must be a number greater than 0.0 and of at most 64.0, got 65"},
      {R"("command": "scan", "vote": {}, )" + camera, "/commands/1/vote/pixel_size: must be given"},
      {R"("command": "scan", "extent": {"width": 9000}, )" + camera,
       "/commands/1/extent/width: must be an integer in [1, 8192], got 9000"},
      {R"("command": "scan", "stitch": {"view": 4294967295}, )" + camera,
       "/commands/1/stitch/view: must be an integer"},
      {R"("command": "erase", "region": [[0,0],[1,1]], )" + camera,
       "/commands/1/region: must be an array of no corner or at least three"},
      {R"("command": "erase", "region": [[0,0],[1,1],[2]], )" + camera,
       "/commands/1/region/2: must be an array of 2 numbers, got [2]"},
      {R"("command": "erase", "region": [[0,0],[1,1],[2,"a"]], )" + camera,
       "/commands/1/region/2/1: must be a number, got \"a\""},
      {R"("command": "erase", "camera": {"eye_from_world": [[1,0,0,0],[0,1,0,0],[0,0,1,0]]})",
       "/commands/1/camera/eye_from_world: must be an array of 4 rows"},
      {R"("command": "erase", "camera": {"look_at": {"eye": [0,0,0], "target": [0,0,0], "up": [0,1,0]}})",
       "/commands/1/camera/look_at: look_at: eye and target"},
      {R"("command": "erase", "camera": {"look_at": {"eye": [0,0,0], "target": [0,0,1]}})",
       "/commands/1/camera/look_at/up: must be given"},
      {R"("command": "erase", "camera": {"look_at": {"eye": [0,0,5], "target": [0,0,0], "up": [0,1,0]}, "height": 2, "fov_y": 1})",
       "/commands/1/camera: must have only one of height"},
      {R"("command": "erase", "camera": {"look_at": {"eye": [0,0,5], "target": [0,0,0], "up": [0,1,0]}, "fov_y": 4})",
       "/commands/1/camera/fov_y: must be less than pi (radians), got 4"},
      {R"("command": "erase", "camera": {"look_at": {"eye": [0,0,5], "target": [0,0,0], "up": [0,1,0]}, "clip_planes": [[1,0,0]]})",
       "/commands/1/camera/clip_planes/0: must be an array of 4 numbers"},
      {R"("command": "erase", "camera": {"look_at": {"eye": [0,0,5], "target": [0,0,0], "up": [0,1,0]}, "far": 4})",
       "/commands/1/camera/far: unknown key"},
  };
  for (const auto& [members, message] : commands) {
    CAPTURE(members);
    CHECK_THAT(message_of_command(members), Catch::StartsWith(message));
  }
}

TEST_CASE("a session nested deeper than 64 levels is refused, however deep", "[session_file]") {
  const std::string rule = "/: arrays and objects must be nested at most 64 deep";
  CHECK_THAT(message_of(std::string(64, '[') + std::string(64, ']')),
             Catch::StartsWith("/: must be an object"));
  CHECK_THAT(message_of(std::string(65, '[') + std::string(65, ']')), Catch::StartsWith(rule));
  constexpr std::size_t kDeep = 1'000'000;
  CHECK_THAT(message_of(std::string(kDeep, '[') + std::string(kDeep, ']')),
             Catch::StartsWith(rule));
  std::string objects;
  for (int i = 0; i < 65; ++i)
    objects += R"({"a":)";
  CHECK_THAT(message_of(objects), Catch::StartsWith(rule));
}

TEST_CASE("long values are cut in messages", "[session_file]") {
  const std::string text = message_of_command(R"("command": ")" + std::string(10000, 'x') + '"');
  CHECK(text.size() < 300);
}

TEST_CASE("inputs are found from the folder of the session", "[session_file]") {
  const TemporaryFolder folder;
  std::filesystem::create_directories(folder / "sessions");
  std::filesystem::create_directories(folder / "data");
  const auto cloud = folder.store("data/cloud.xyz", "0 0 0\n");
  const auto model = folder.store("model.off", "OFF\n");
  write_session(folder / "sessions/s.json", {.inputs = {{.path = cloud, .hash = hash_file(cloud)}},
                                             .initial_mesh = SessionInput{.path = model}});
  const std::string text = test::load(folder / "sessions/s.json");
  CHECK(text.find(R"("../data/cloud.xyz")") != std::string::npos);
  CHECK(text.find(folder.path().string()) == std::string::npos);

  std::filesystem::rename(folder / "sessions", folder / "renamed");
  const SessionFile read = read_session(folder / "renamed/s.json");
  REQUIRE(read.inputs.size() == 1);
  CHECK(std::filesystem::equivalent(read.inputs[0].path, cloud));
  CHECK(read.inputs[0].hash == hash_file(cloud));
  REQUIRE(read.initial_mesh);
  CHECK(std::filesystem::equivalent(read.initial_mesh->path, model));
  CHECK_FALSE(read.initial_mesh->hash);
  CHECK_NOTHROW(check_session_inputs(read));
}

TEST_CASE("a changed or missing input is noticed", "[session_file]") {
  const TemporaryFolder folder;
  const auto cloud = folder.store("cloud.xyz", "0 0 0\n");
  const SessionInput input{.path = cloud, .hash = hash_file(cloud)};
  const std::vector<SessionFile> sessions{
      {.inputs = {input}}, {.also_read = {input}}, {.initial_mesh = input}};
  for (const SessionFile& session : sessions)
    CHECK_NOTHROW(check_session_inputs(session));
  folder.store("cloud.xyz", "0 0 1\n");
  for (const SessionFile& session : sessions) {
    CHECK_THROWS_WITH(check_session_inputs(session),
                      Catch::Contains("has changed since the session was recorded"));
  }
  std::filesystem::remove(cloud);
  for (const SessionFile& session : sessions)
    CHECK_THROWS_AS(check_session_inputs(session), IoError);
}

TEST_CASE("a number that JSON cannot hold is not written", "[session_file]") {
  const TemporaryFolder folder;
  CHECK_THROWS_AS(
      write_session(folder / "s.json",
                    {.commands = {SmoothMesh{.factor = std::numeric_limits<double>::quiet_NaN()}}}),
      InvalidArgument);
  CHECK_THROWS_AS(write_session(folder / "s.json", {.inputs = {{.path = "\xff\xfe.ply"}}}),
                  IoError);
  CHECK_THROWS_AS(write_session(folder / "missing/s.json", {}), IoError);
  CHECK(folder.count() == 0);
}

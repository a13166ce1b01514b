// The schema in docs/ is the one of this program, and names exactly what the writer writes.

#include <catch2/catch.hpp>

#include <set>
#include <string>

#include <nlohmann/json.hpp>

#include "core/io/session_file.h"
#include "tests/core/io/temporary_folder.h"
#include "tests/core/session/sample_commands.h"

using namespace rangezip;
using Json = nlohmann::json;

namespace {

/// The names of all members below `json`, as pointers without list positions.
void collect_names(const Json& json, const std::string& at, std::set<std::string>& names) {
  if (json.is_array()) {
    for (const Json& element : json)
      collect_names(element, at, names);
  }
  if (!json.is_object()) return;
  // A command's members stand under its name.
  const std::string here =
      json.contains("command") ? at + '/' + json["command"].get<std::string>() : at;
  for (const auto& [key, value] : json.items()) {
    names.insert(here + '/' + key);
    collect_names(value, here + '/' + key, names);
  }
}

/// The names of all members that the schema allows, in the same form.
void collect_schema_names(const Json& root, const Json& schema, const std::string& at,
                          std::set<std::string>& names) {
  if (schema.contains("$ref")) {
    const auto pointer = schema["$ref"].get<std::string>().substr(1);
    collect_schema_names(root, root[Json::json_pointer(pointer)], at, names);
  }
  if (schema.contains("items")) collect_schema_names(root, schema["items"], at, names);
  if (schema.contains("oneOf")) {
    for (const Json& choice : schema["oneOf"])
      collect_schema_names(root, choice, at, names);
  }
  if (!schema.contains("properties")) return;
  const Json& members = schema["properties"];
  const std::string here =
      members.contains("command") ? at + '/' + members["command"]["const"].get<std::string>() : at;
  for (const auto& [key, value] : members.items()) {
    names.insert(here + '/' + key);
    collect_schema_names(root, value, here + '/' + key, names);
  }
}

}  // namespace

TEST_CASE("docs/session-schema.json is the schema of this program", "[session_schema]") {
  CHECK(test::load(RANGEZIP_SOURCE_DIR "/docs/session-schema.json") == session_schema());
}

TEST_CASE("the writer names exactly the members of the schema", "[session_schema]") {
  const test::TemporaryFolder folder;
  shapes::Random random(1);
  SessionFile session{.inputs = {{.path = "a.ply", .hash = 1}},
                      .also_read = {{.path = "b.ply", .hash = 2}},
                      .initial_mesh = SessionInput{.path = "c.ply", .hash = 3},
                      .points = 1,
                      .triangles = 1,
                      .commands = test::full_commands(random)};
  AddScan central = std::get<AddScan>(session.commands[0]);
  central.scan.camera = test::random_camera(random, true);
  EraseRegion parallel = std::get<EraseRegion>(session.commands[1]);
  parallel.camera = test::random_camera(random, false);
  session.commands.emplace_back(central);
  session.commands.emplace_back(parallel);
  write_session(folder / "s.json", session);

  std::set<std::string> written;
  collect_names(Json::parse(test::load(folder / "s.json")), "", written);
  std::set<std::string> allowed;
  const Json schema = Json::parse(session_schema());
  collect_schema_names(schema, schema, "", allowed);
  // What only a person writes: a pose in words.
  for (const std::string at : {"/commands/scan/camera/look_at", "/commands/erase/camera/look_at"}) {
    for (const std::string member : {"", "/eye", "/target", "/up"})
      CHECK(allowed.erase(at + member) == 1);
  }
  CHECK(written == allowed);
  CHECK(written.size() > 80);
}

TEST_CASE("every object of the schema refuses unknown members and says what each means",
          "[session_schema]") {
  const Json schema = Json::parse(session_schema());
  for (const auto& [name, definition] : schema["$defs"].items()) {
    CAPTURE(name);
    if (name == "command") continue;
    CHECK(definition["additionalProperties"] == false);
    for (const auto& [member, value] : definition["properties"].items()) {
      CAPTURE(member);
      if (member != "command") CHECK(value.contains("description"));
    }
  }
}

#include <numbers>
#include <string>

#include "core/io/session_file.h"
#include "core/io/session_file_fields.h"
#include "core/io/session_file_json.h"

namespace rangezip {

namespace session_file {

namespace {

Json number_schema(const NumberRule& rule) {
  Json schema{{"type", "number"}};
  if (rule.minimum) schema["minimum"] = *rule.minimum;
  if (rule.exclusive_minimum) schema["exclusiveMinimum"] = *rule.exclusive_minimum;
  if (rule.maximum) schema["maximum"] = *rule.maximum;
  return schema;
}

Json array_schema(Json items, std::optional<std::size_t> count = std::nullopt) {
  Json schema{{"type", "array"}, {"items", std::move(items)}};
  if (count) {
    schema["minItems"] = *count;
    schema["maxItems"] = *count;
  }
  return schema;
}

Json object_schema() {
  return {{"type", "object"}, {"additionalProperties", false}, {"properties", Json::object()}};
}

Json vector_schema() {
  return array_schema({{"type", "number"}}, 3);
}

Json camera_schema() {
  Json look_at = object_schema();
  look_at["description"] = "where the eye stands, a point it looks at, and what is up: world space";
  look_at["required"] = {"eye", "target", "up"};
  look_at["properties"] = {
      {"eye", vector_schema()}, {"target", vector_schema()}, {"up", vector_schema()}};

  Json matrix = array_schema(array_schema({{"type", "number"}}, 4), 4);
  matrix["description"] = "rows of a rigid motion; the eye looks down its own -z axis";
  Json height = number_schema(kPositive);
  height["description"] = "parallel projection: visible height, model units";
  height["default"] = Orthographic{}.height;
  Json fov_y = number_schema(kPositive);
  fov_y["exclusiveMaximum"] = std::numbers::pi;
  fov_y["description"] = "central projection: full vertical angle, radians";
  Json planes = array_schema(array_schema({{"type", "number"}}, 4));
  planes["description"] = "[nx, ny, nz, offset]: what has n p + offset < 0 is not seen";
  planes["default"] = Json::array();

  Json schema = object_schema();
  schema["properties"] = {{"eye_from_world", std::move(matrix)},
                          {"look_at", std::move(look_at)},
                          {"height", std::move(height)},
                          {"fov_y", std::move(fov_y)},
                          {"near_depth",
                           {{"type", "number"},
                            {"description", "eye depth of the front plane, model units"},
                            {"default", Camera{}.near_depth}}},
                          {"far_depth",
                           {{"type", "number"},
                            {"description", "eye depth of the back plane, model units"},
                            {"default", Camera{}.far_depth}}},
                          {"clip_planes", std::move(planes)}};
  schema["oneOf"] = {{{"required", {"eye_from_world"}}}, {{"required", {"look_at"}}}};
  schema["not"] = {{"required", {"height", "fov_y"}}};
  return schema;
}

/// Walks over a command's members with their defaults and describes each.
class SchemaBuilder {
 public:
  explicit SchemaBuilder(Json& schema) : schema_(schema) {}

  void number(const char* name, double value, const NumberRule& rule, const char* text) {
    add(name, number_schema(rule), text)["default"] = value;
  }
  void required_number(const char* name, double, const NumberRule& rule, const char* text) {
    add(name, number_schema(rule), text);
    schema_["required"].push_back(name);
  }
  void limit(const char* name, double value, const char* text) {
    Json schema{{"type", {"number", "null"}}, {"minimum", 0.0}};
    const bool is_limited = value < std::numeric_limits<double>::infinity();
    add(name, std::move(schema), text)["default"] = is_limited ? Json(value) : Json();
  }
  template <class Integer>
  void integer(const char* name, Integer value, const IntegerRule& rule, const char* text) {
    Json schema{{"type", "integer"}, {"minimum", rule.minimum}, {"maximum", rule.maximum}};
    add(name, std::move(schema), text)["default"] = value;
  }
  void optional_integer(const char* name, std::uint32_t, std::uint32_t none, const char* text) {
    Json schema{{"type", {"integer", "null"}}, {"minimum", 0}, {"maximum", none - 1}};
    add(name, std::move(schema), text)["default"] = nullptr;
  }
  void boolean(const char* name, bool value, const char* text) {
    add(name, {{"type", "boolean"}}, text)["default"] = value;
  }
  template <class Enum, std::size_t kCount>
  void choice(const char* name, Enum value, const std::array<Choice<Enum>, kCount>& choices,
              const char* text) {
    Json& schema = add(name, {{"enum", Json::array()}}, text);
    for (const auto& [word, choice] : choices) {
      schema["enum"].push_back(word);
      if (choice == value) schema["default"] = word;
    }
  }
  template <class Object>
  void object(const char* name, Object& value, const char* text) {
    Json members = object_schema();
    SchemaBuilder builder(members);
    describe(builder, value);
    add(name, std::move(members), text);
  }
  template <class Object>
  void optional(const char* name, std::optional<Object>& value, const char* text) {
    Object members = value.value_or(Object{});
    object(name, members, text);
    Json& schema = schema_["properties"][name];
    schema["type"] = {"object", "null"};
    schema["default"] = nullptr;
  }
  void polygon(const char* name, const std::vector<Vec2>&, const char* text) {
    Json schema = array_schema(array_schema({{"type", "number"}}, 2));
    schema["anyOf"] = {{{"maxItems", 0}}, {{"minItems", 3}}};
    add(name, std::move(schema), text)["default"] = Json::array();
  }
  void points(const char* name, const std::vector<Vec3>&, const char* text) {
    add(name, array_schema(array_schema({{"type", "number"}}, 3)), text)["default"] = Json::array();
  }
  void spheres(const char* name, const std::vector<Sphere>&, const char* text) {
    add(name, array_schema(array_schema({{"type", "number"}}, 4)), text)["default"] = Json::array();
  }
  void camera(const char* name, const Camera&, const char* text) {
    add(name, {{"$ref", "#/$defs/camera"}}, text);
    schema_["required"].push_back(name);
  }

 private:
  Json& add(const char* name, Json schema, const char* text) {
    schema["description"] = text;
    return schema_["properties"][name] = std::move(schema);
  }

  Json& schema_;
};

Json input_schema() {
  Json schema = object_schema();
  schema["required"] = {"path"};
  schema["properties"] = {
      {"path", {{"type", "string"}, {"description", "from the folder of the session file"}}},
      {"hash",
       {{"type", "string"},
        {"pattern", "^[0-9a-f]{16}$"},
        {"description",
         "64-bit FNV-1a of the content; left out: whatever the file holds is taken"}}}};
  return schema;
}

Json document_schema() {
  const auto count = [](const char* text) {
    return Json{{"type", "integer"}, {"minimum", 0}, {"description", text}};
  };
  const auto list = [](const char* definition, const char* text) {
    Json schema = array_schema({{"$ref", std::string("#/$defs/") + definition}});
    schema["description"] = text;
    return schema;
  };
  Json schema{{"$schema", "https://json-schema.org/draft/2020-12/schema"},
              {"title", "rangezip session"}};
  schema.update(object_schema());
  schema["required"] = {"version", "inputs", "commands"};
  schema["properties"] = {
      {"version", {{"const", kSessionFileVersion}}},
      {"inputs", list("input", "clouds and polygons that are scanned, in the order of the scene")},
      {"also_read", list("input", "files that the inputs name, such as the scans of a .conf")},
      {"initial_mesh", {{"$ref", "#/$defs/input"}}},
      {"points", count("of the scene; left out: not checked")},
      {"triangles", count("of the scene; left out: not checked")},
      {"commands", list("command", "in the order in which they are carried out")}};

  Json& definitions = schema["$defs"];
  definitions["input"] = input_schema();
  definitions["camera"] = camera_schema();
  definitions["command"] = {{"oneOf", Json::array()}};
  for_each_command_type([&](const char* name, const char* text, auto command) {
    Json members = object_schema();
    members["description"] = text;
    members["required"] = {"command"};
    members["properties"]["command"] = {{"const", name}};
    SchemaBuilder builder(members);
    describe(builder, command);
    definitions["command"]["oneOf"].push_back({{"$ref", std::string("#/$defs/") + name}});
    definitions[name] = std::move(members);
  });
  return schema;
}

}  // namespace

}  // namespace session_file

std::string session_schema() {
  return session_file::pretty(session_file::document_schema());
}

}  // namespace rangezip

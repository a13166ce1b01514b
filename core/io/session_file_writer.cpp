#include <cmath>
#include <string>
#include <type_traits>
#include <variant>

#include "core/base/error.h"
#include "core/io/session_file_fields.h"
#include "core/io/session_file_json.h"

namespace rangezip::session_file {

namespace {

/// Walks over a command's members and adds each to a JSON object.
class Writer {
 public:
  void number(const char* name, double value, const NumberRule&, const char*) {
    json_[name] = finite(name, value);
  }
  void required_number(const char* name, double value, const NumberRule&, const char*) {
    json_[name] = finite(name, value);
  }
  /// Infinity, which JSON does not know, is null.
  void limit(const char* name, double value, const char*) {
    json_[name] = std::isinf(value) && value > 0.0 ? Json() : Json(finite(name, value));
  }
  template <class Integer>
  void integer(const char* name, Integer value, const IntegerRule&, const char*) {
    json_[name] = value;
  }
  void optional_integer(const char* name, std::uint32_t value, std::uint32_t none, const char*) {
    json_[name] = value == none ? Json() : Json(value);
  }
  void boolean(const char* name, bool value, const char*) { json_[name] = value; }

  template <class Enum, std::size_t kCount>
  void choice(const char* name, Enum value, const std::array<Choice<Enum>, kCount>& choices,
              const char*) {
    for (const auto& [text, choice] : choices) {
      if (choice == value) json_[name] = text;
    }
  }
  template <class Object>
  void object(const char* name, Object& value, const char*) {
    Writer members;
    describe(members, value);
    json_[name] = members.take();
  }
  template <class Object>
  void optional(const char* name, std::optional<Object>& value, const char* text) {
    if (value) {
      object(name, *value, text);
    } else {
      json_[name] = nullptr;
    }
  }
  void polygon(const char* name, const std::vector<Vec2>& corners, const char*) {
    Json list = Json::array();
    for (const Vec2& corner : corners) {
      list.push_back({finite(name, corner.x), finite(name, corner.y)});
    }
    json_[name] = std::move(list);
  }
  void points(const char* name, const std::vector<Vec3>& points, const char*) {
    Json list = Json::array();
    for (const Vec3& p : points)
      list.push_back({finite(name, p.x), finite(name, p.y), finite(name, p.z)});
    json_[name] = std::move(list);
  }
  void spheres(const char* name, const std::vector<Sphere>& spheres, const char*) {
    Json list = Json::array();
    for (const auto& [center, radius] : spheres) {
      list.push_back({finite(name, center.x), finite(name, center.y), finite(name, center.z),
                      finite(name, radius)});
    }
    json_[name] = std::move(list);
  }
  void camera(const char* name, const Camera& camera, const char*) {
    Json rows = Json::array();
    for (int row = 0; row < 4; ++row) {
      Json numbers = Json::array();
      for (int column = 0; column < 4; ++column) {
        numbers.push_back(finite(name, camera.eye_from_world[column][row]));
      }
      rows.push_back(std::move(numbers));
    }
    Json planes = Json::array();
    for (const auto& [normal, offset] : camera.clip_planes) {
      planes.push_back({finite(name, normal.x), finite(name, normal.y), finite(name, normal.z),
                        finite(name, offset)});
    }
    Json json;
    json["eye_from_world"] = std::move(rows);
    if (const auto* lens = std::get_if<Orthographic>(&camera.lens)) {
      json["height"] = finite(name, lens->height);
    } else {
      json["fov_y"] = finite(name, std::get<Perspective>(camera.lens).fov_y);
    }
    json["near_depth"] = finite(name, camera.near_depth);
    json["far_depth"] = finite(name, camera.far_depth);
    json["clip_planes"] = std::move(planes);
    json_[name] = std::move(json);
  }

  void put(const char* name, Json value) { json_[name] = std::move(value); }
  Json take() { return std::move(json_); }

 private:
  static double finite(const char* name, double value) {
    if (!std::isfinite(value)) {
      throw InvalidArgument(std::string("write_session: ") + name + " must be finite, got " +
                            std::to_string(value));
    }
    return value;
  }

  Json json_ = Json::object();
};

constexpr std::size_t kLineWidth = 100;

/// The value on one line.
std::string one_line(const Json& json) {
  if (!json.is_structured()) return json.dump();
  const bool is_object = json.is_object();
  std::string text = is_object ? "{" : "[";
  const char* separator = "";
  for (const auto& [key, value] : json.items()) {
    text += separator;
    if (is_object) text += Json(key).dump() + ": ";
    text += one_line(value);
    separator = ", ";
  }
  return text + (is_object ? '}' : ']');
}

/// What fits stays on one line; the rest has a line for each member.
std::string pretty_at(const Json& json, const std::string& indent, std::size_t column) {
  std::string line = one_line(json);
  if (column + line.size() < kLineWidth || !json.is_structured() || json.empty()) return line;
  const std::string inner = indent + "  ";
  const bool is_object = json.is_object();
  std::string text = is_object ? "{" : "[";
  const char* separator = "\n";
  for (const auto& [key, value] : json.items()) {
    const std::string head = inner + (is_object ? Json(key).dump() + ": " : "");
    text += separator + head + pretty_at(value, inner, head.size());
    separator = ",\n";
  }
  return text + '\n' + indent + (is_object ? '}' : ']');
}

}  // namespace

Json json_of(const Command& command) {
  return std::visit(
      []<class Members>(Members members) {  // a copy: the walk takes what it could also fill
        Writer writer;
        for_each_command_type([&](const char* name, const char*, const auto& type) {
          if constexpr (std::is_same_v<std::decay_t<decltype(type)>, Members>) {
            writer.put("command", name);
          }
        });
        describe(writer, members);
        return writer.take();
      },
      command);
}

std::string pretty(const Json& json) {
  return pretty_at(json, "", 0) + '\n';
}

}  // namespace rangezip::session_file

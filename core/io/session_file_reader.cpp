#include <algorithm>
#include <cmath>
#include <numbers>
#include <string>
#include <vector>

#include "core/base/error.h"
#include "core/io/session_file_fields.h"
#include "core/io/session_file_json.h"

namespace rangezip::session_file {

namespace {

std::string shortest(double value) {
  return Json(value).dump();
}

std::string rule_text(const NumberRule& rule) {
  std::string text = "must be a number";
  const char* separator = " ";
  const auto add = [&](const char* relation, const std::optional<double>& bound) {
    if (!bound) return;
    text += separator + std::string(relation) + shortest(*bound);
    separator = " and ";
  };
  add("of at least ", rule.minimum);
  add("greater than ", rule.exclusive_minimum);
  add("of at most ", rule.maximum);
  return text;
}

double read_number(const Json& json, const std::string& pointer, const NumberRule& rule) {
  const double value = json.is_number() ? json.get<double>() : std::nan("");
  const bool is_in_range = std::isfinite(value) && value >= rule.minimum.value_or(value) &&
                           value <= rule.maximum.value_or(value) &&
                           !(rule.exclusive_minimum && value <= *rule.exclusive_minimum);
  if (!is_in_range) refuse(pointer, rule_text(rule), json);
  return value;
}

std::int64_t read_integer(const Json& json, const std::string& pointer, const IntegerRule& rule) {
  // A positive number that int64 cannot hold is read as unsigned, and would wrap around.
  const bool fits = json.is_number_integer() &&
                    !(json.is_number_unsigned() &&
                      json.get<std::uint64_t>() > static_cast<std::uint64_t>(rule.maximum));
  const std::int64_t value = fits ? json.get<std::int64_t>() : rule.minimum - 1;
  if (value < rule.minimum || value > rule.maximum) {
    refuse(pointer,
           "must be an integer in [" + std::to_string(rule.minimum) + ", " +
               std::to_string(rule.maximum) + "]",
           json);
  }
  return value;
}

/// An array of exactly `count` finite numbers.
std::vector<double> read_numbers(const Json& json, const std::string& pointer, std::size_t count) {
  if (!json.is_array() || json.size() != count) {
    refuse(pointer, "must be an array of " + std::to_string(count) + " numbers", json);
  }
  std::vector<double> numbers;
  for (std::size_t i = 0; i < count; ++i) {
    numbers.push_back(read_number(json[i], pointer + '/' + std::to_string(i), kAny));
  }
  return numbers;
}

Vec3 read_vector(const Json& json, const std::string& pointer) {
  const std::vector<double> numbers = read_numbers(json, pointer, 3);
  return {numbers[0], numbers[1], numbers[2]};
}

/// Walks over a command's members and takes each from a JSON object; what the object does not
/// have keeps its default.
class Reader {
 public:
  Reader(const Json& json, std::string pointer) : json_(json), pointer_(std::move(pointer)) {
    if (!json_.is_object()) refuse(pointer_, "must be an object", json_);
  }

  void number(const char* name, double& value, const NumberRule& rule, const char*) {
    if (const Json* member = find(name)) value = read_number(*member, at(name), rule);
  }
  void required_number(const char* name, double& value, const NumberRule& rule, const char* text) {
    require(name);
    number(name, value, rule, text);
  }
  void limit(const char* name, double& value, const char*) {
    const Json* member = find(name);
    if (member == nullptr) return;
    value = member->is_null() ? std::numeric_limits<double>::infinity()
                              : read_number(*member, at(name), kNotNegative);
  }
  template <class Integer>
  void integer(const char* name, Integer& value, const IntegerRule& rule, const char*) {
    if (const Json* member = find(name)) {
      value = static_cast<Integer>(read_integer(*member, at(name), rule));
    }
  }
  void optional_integer(const char* name, std::uint32_t& value, std::uint32_t none, const char*) {
    const Json* member = find(name);
    if (member == nullptr) return;
    const IntegerRule rule{.maximum = std::int64_t{none} - 1};
    value = member->is_null() ? none
                              : static_cast<std::uint32_t>(read_integer(*member, at(name), rule));
  }
  void boolean(const char* name, bool& value, const char*) {
    const Json* member = find(name);
    if (member == nullptr) return;
    if (!member->is_boolean()) refuse(at(name), "must be true or false", *member);
    value = member->get<bool>();
  }
  template <class Enum, std::size_t kCount>
  void choice(const char* name, Enum& value, const std::array<Choice<Enum>, kCount>& choices,
              const char*) {
    const Json* member = find(name);
    if (member == nullptr) return;
    std::string rule = "must be one of";
    for (const auto& [text, choice] : choices) {
      if (*member == text) {
        value = choice;
        return;
      }
      rule += " \"" + std::string(text) + '"';
    }
    refuse(at(name), rule, *member);
  }
  template <class Object>
  void object(const char* name, Object& value, const char*) {
    if (const Json* member = find(name)) read_members(*member, at(name), value);
  }
  template <class Object>
  void optional(const char* name, std::optional<Object>& value, const char*) {
    const Json* member = find(name);
    if (member == nullptr || member->is_null()) return;
    value.emplace();
    read_members(*member, at(name), *value);
  }
  void polygon(const char* name, std::vector<Vec2>& corners, const char*) {
    const Json* member = find(name);
    if (member == nullptr) return;
    if (!member->is_array() || member->size() == 1 || member->size() == 2) {
      refuse(at(name), "must be an array of no corner or at least three", *member);
    }
    corners.clear();
    for (std::size_t i = 0; i < member->size(); ++i) {
      const auto xy = read_numbers((*member)[i], at(name) + '/' + std::to_string(i), 2);
      corners.emplace_back(xy[0], xy[1]);
    }
  }
  void points(const char* name, std::vector<Vec3>& points, const char*) {
    const Json* member = find(name);
    if (member == nullptr) return;
    if (!member->is_array()) refuse(at(name), "must be an array of [x, y, z]", *member);
    points.clear();
    for (std::size_t i = 0; i < member->size(); ++i)
      points.push_back(read_vector((*member)[i], at(name) + '/' + std::to_string(i)));
  }
  void spheres(const char* name, std::vector<Sphere>& spheres, const char*) {
    const Json* member = find(name);
    if (member == nullptr) return;
    if (!member->is_array()) refuse(at(name), "must be an array of [x, y, z, radius]", *member);
    spheres.clear();
    for (std::size_t i = 0; i < member->size(); ++i) {
      const std::string pointer = at(name) + '/' + std::to_string(i);
      const auto numbers = read_numbers((*member)[i], pointer, 4);
      if (!(numbers[3] > 0.0)) refuse(pointer, "must have a positive radius", (*member)[i]);
      spheres.push_back({{numbers[0], numbers[1], numbers[2]}, numbers[3]});
    }
  }
  void camera(const char* name, Camera& camera, const char*) {
    require(name);
    if (const Json* member = find(name)) {
      Reader members(*member, at(name));
      members.camera_members(camera);
      members.refuse_unknown();
    }
  }

  /// Marks a member as known without reading it.
  void skip(const char* name) { static_cast<void>(find(name)); }

  /// @throws IoError for a member that no call has asked for.
  void refuse_unknown() const {
    for (const auto& [key, value] : json_.items()) {
      if (std::find(known_.begin(), known_.end(), key) != known_.end()) continue;
      std::string rule = "unknown key; known here:";
      for (const std::string& name : known_)
        rule += ' ' + name;
      refuse(at(key), rule, value);
    }
  }

 private:
  [[nodiscard]] std::string at(const std::string& name) const { return pointer_ + '/' + name; }

  const Json* find(const char* name) {
    known_.emplace_back(name);
    const auto member = json_.find(name);
    return member == json_.end() ? nullptr : &*member;
  }

  void require(const char* name) const {
    if (!json_.contains(name)) refuse(at(name), "must be given", Json());
  }

  template <class Object>
  static void read_members(const Json& json, const std::string& pointer, Object& value) {
    Reader members(json, pointer);
    describe(members, value);
    members.refuse_unknown();
  }

  void camera_members(Camera& camera) {
    const Json* matrix = find("eye_from_world");
    const Json* pose = find("look_at");
    if ((matrix != nullptr) == (pose != nullptr)) {
      refuse(pointer_, "must have one of eye_from_world and look_at", json_);
    }
    if (matrix != nullptr) {
      read_matrix(*matrix, at("eye_from_world"), camera.eye_from_world);
    } else {
      camera.eye_from_world = read_pose(*pose, at("look_at"));
    }
    read_lens(camera.lens);
    number("near_depth", camera.near_depth, kAny, "");
    number("far_depth", camera.far_depth, kAny, "");
    if (const Json* planes = find("clip_planes")) read_planes(*planes, camera.clip_planes);
  }

  static void read_matrix(const Json& json, const std::string& pointer, Mat4& matrix) {
    if (!json.is_array() || json.size() != 4) refuse(pointer, "must be an array of 4 rows", json);
    for (int row = 0; row < 4; ++row) {
      const auto i = static_cast<std::size_t>(row);
      const auto numbers = read_numbers(json[i], pointer + '/' + std::to_string(row), 4);
      for (int column = 0; column < 4; ++column) {
        matrix[column][row] = numbers[static_cast<std::size_t>(column)];
      }
    }
  }

  static Mat4 read_pose(const Json& json, const std::string& pointer) {
    Reader members(json, pointer);
    const auto vector = [&](const char* name) {
      members.require(name);
      return read_vector(*members.find(name), members.at(name));
    };
    const Vec3 eye = vector("eye");
    const Vec3 target = vector("target");
    const Vec3 up = vector("up");
    members.refuse_unknown();
    try {
      return look_at(eye, target, up).eye_from_world;
    } catch (const InvalidArgument& error) {
      refuse(pointer, error.what(), json);
    }
  }

  void read_lens(Lens& lens) {
    const Json* height = find("height");
    const Json* fov_y = find("fov_y");
    if (height != nullptr && fov_y != nullptr) {
      refuse(pointer_, "must have only one of height (parallel) and fov_y (central projection)",
             json_);
    }
    if (height != nullptr) {
      lens = Orthographic{.height = read_number(*height, at("height"), kPositive)};
    }
    if (fov_y == nullptr) return;
    const double angle = read_number(*fov_y, at("fov_y"), kPositive);
    if (angle >= std::numbers::pi) refuse(at("fov_y"), "must be less than pi (radians)", *fov_y);
    lens = Perspective{.fov_y = angle};
  }

  void read_planes(const Json& json, std::vector<Plane>& planes) const {
    const std::string pointer = at("clip_planes");
    if (!json.is_array()) refuse(pointer, "must be an array of planes [nx, ny, nz, offset]", json);
    for (std::size_t i = 0; i < json.size(); ++i) {
      const auto numbers = read_numbers(json[i], pointer + '/' + std::to_string(i), 4);
      planes.push_back({{numbers[0], numbers[1], numbers[2]}, numbers[3]});
    }
  }

  const Json& json_;
  std::string pointer_;
  std::vector<std::string> known_;
};

}  // namespace

void refuse(const std::string& pointer, const std::string& rule, const Json& value) {
  constexpr std::size_t kLongest = 80;  // of a value in a message
  std::string text = value.dump(-1, ' ', false, Json::error_handler_t::replace);
  if (text.size() > kLongest) text = text.substr(0, kLongest) + "...";
  throw IoError((pointer.empty() ? "/" : pointer) + ": " + rule +
                (value.is_null() ? "" : ", got " + text));
}

Command command_of(const Json& json, const std::string& pointer) {
  Reader reader(json, pointer);
  const std::string at = pointer + "/command";
  if (!json.contains("command")) refuse(at, "must be given", Json());
  reader.skip("command");
  std::optional<Command> command;
  std::string rule = "must be one of";
  for_each_command_type([&](const char* name, const char*, auto members) {
    rule += std::string(" \"") + name + '"';
    if (json["command"] != name) return;
    describe(reader, members);
    reader.refuse_unknown();
    command = std::move(members);
  });
  if (!command) refuse(at, rule, json["command"]);
  return std::move(*command);
}

}  // namespace rangezip::session_file

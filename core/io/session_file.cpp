#include "core/io/session_file.h"

#include <charconv>
#include <set>
#include <string>
#include <tuple>
#include <utility>

#include "core/base/error.h"
#include "core/io/atomic_file.h"
#include "core/io/file_bytes.h"
#include "core/io/file_hash.h"
#include "core/io/session_file_json.h"

namespace rangezip {

namespace {

namespace fs = std::filesystem;
using session_file::Json;
using session_file::refuse;

fs::path folder_of(const fs::path& file) {
  return file.has_parent_path() ? file.parent_path() : fs::path(".");
}

/// 16 hexadecimal digits: JSON numbers above 2^53 do not survive every program.
std::string hash_text(std::uint64_t hash) {
  constexpr const char* kDigits = "0123456789abcdef";
  std::string text(16, '0');
  for (std::size_t i = 16; i-- > 0; hash >>= 4U)
    text[i] = kDigits[hash & 15U];
  return text;
}

std::uint64_t hash_of(const Json& json, const std::string& pointer) {
  std::uint64_t hash = 0;
  const std::string text = json.is_string() ? json.get<std::string>() : "";
  const auto [end, error] = std::from_chars(text.data(), text.data() + text.size(), hash, 16);
  if (error != std::errc{} || hash_text(hash) != text) {
    refuse(pointer, "must be 16 hexadecimal digits", json);
  }
  return hash;
}

Json json_of_input(const SessionInput& input, const fs::path& folder) {
  const fs::path relative =
      fs::weakly_canonical(input.path).lexically_relative(fs::weakly_canonical(folder));
  Json json{{"path", relative.empty() ? input.path.generic_string() : relative.generic_string()}};
  if (input.hash) json["hash"] = hash_text(*input.hash);
  return json;
}

Json json_of_inputs(const std::vector<SessionInput>& inputs, const fs::path& folder) {
  Json list = Json::array();
  for (const SessionInput& input : inputs)
    list.push_back(json_of_input(input, folder));
  return list;
}

constexpr int kMostLevels = 64;  ///< far more than a session has; to go through it is recursive

/// Parses, and refuses what the parser would accept: a key that an object has twice, and a nesting
/// so deep that the stack could overflow.
Json parse(const FileBytes& file) {
  std::vector<std::set<std::string>> keys;
  const auto check = [&](int levels_above, Json::parse_event_t event, const Json& parsed) {
    const bool is_start =
        event == Json::parse_event_t::object_start || event == Json::parse_event_t::array_start;
    if (is_start && levels_above >= kMostLevels) {
      refuse("",
             "arrays and objects must be nested at most " + std::to_string(kMostLevels) + " deep",
             Json());
    }
    if (event == Json::parse_event_t::object_start) keys.emplace_back();
    if (event == Json::parse_event_t::object_end) keys.pop_back();
    if (event == Json::parse_event_t::key &&
        !keys.back().insert(parsed.get<std::string>()).second) {
      refuse("", "an object must not have a key twice", parsed);
    }
    return true;
  };
  try {
    return Json::parse(file.bytes(), check);
  } catch (const Json::exception& error) {
    const std::string text = error.what();  // "[json.exception.parse_error.101] parse error at ..."
    const std::size_t begin = text.find("] ");
    throw IoError(begin == std::string::npos ? text : text.substr(begin + 2));
  }
}

/// A walk over the members of the document that remembers which are known.
class Document {
 public:
  Document(const Json& json, std::string pointer) : json_(json), pointer_(std::move(pointer)) {
    if (!json_.is_object()) refuse(pointer_, "must be an object", json_);
  }

  const Json* find(const std::string& name) {
    known_.insert(name);
    const auto member = json_.find(name);
    return member == json_.end() ? nullptr : &*member;
  }

  const Json& required(const std::string& name) {
    const Json* member = find(name);
    if (member == nullptr) refuse(at(name), "must be given", Json());
    return *member;
  }

  [[nodiscard]] std::string text(const std::string& name, const Json& member) const {
    if (!member.is_string()) refuse(at(name), "must be a text", member);
    return member.get<std::string>();
  }

  [[nodiscard]] std::string at(const std::string& name) const { return pointer_ + '/' + name; }

  void refuse_unknown() const {
    for (const auto& [key, value] : json_.items()) {
      if (known_.count(key) == 0) refuse(at(key), "unknown key", value);
    }
  }

 private:
  const Json& json_;
  std::string pointer_;
  std::set<std::string> known_;
};

SessionInput input_of(const Json& json, const std::string& pointer, const fs::path& folder) {
  Document members(json, pointer);
  SessionInput input;
  const std::string path = members.text("path", members.required("path"));
  if (path.empty()) refuse(members.at("path"), "must not be empty", json["path"]);
  input.path = folder / fs::path(path);
  if (const Json* hash = members.find("hash")) input.hash = hash_of(*hash, members.at("hash"));
  members.refuse_unknown();
  return input;
}

const Json& check_list(const Json& json, const std::string& pointer) {
  if (!json.is_array()) refuse(pointer, "must be an array", json);
  return json;
}

std::vector<SessionInput> inputs_of(const Json& json, const std::string& pointer,
                                    const fs::path& folder) {
  std::vector<SessionInput> inputs;
  for (const Json& input : check_list(json, pointer)) {
    inputs.push_back(input_of(input, pointer + '/' + std::to_string(inputs.size()), folder));
  }
  return inputs;
}

std::optional<std::size_t> count_of(Document& members, const std::string& name) {
  const Json* member = members.find(name);
  if (member == nullptr) return std::nullopt;
  if (!member->is_number_unsigned()) {
    refuse(members.at(name), "must be an integer of at least 0", *member);
  }
  return member->get<std::size_t>();
}

SessionFile session_of(const Json& json, const fs::path& folder) {
  Document members(json, "");
  const Json& version = members.required("version");
  if (version != kSessionFileVersion) {
    refuse("/version", "this program reads version " + std::to_string(kSessionFileVersion),
           version);
  }
  SessionFile session;
  session.inputs = inputs_of(members.required("inputs"), "/inputs", folder);
  if (const Json* also = members.find("also_read")) {
    session.also_read = inputs_of(*also, "/also_read", folder);
  }
  if (const Json* mesh = members.find("initial_mesh")) {
    session.initial_mesh = input_of(*mesh, "/initial_mesh", folder);
  }
  session.points = count_of(members, "points");
  session.triangles = count_of(members, "triangles");
  for (const Json& command : check_list(members.required("commands"), "/commands")) {
    const std::string pointer = "/commands/" + std::to_string(session.commands.size());
    session.commands.push_back(session_file::command_of(command, pointer));
  }
  members.refuse_unknown();
  return session;
}

void check_input(const SessionInput& input, const Progress& progress) {
  if (!input.hash) return;
  const std::uint64_t hash = hash_file(input.path, progress);
  if (hash == *input.hash) return;
  throw IoError(input.path.string() +
                ": has changed since the session was recorded: the hash of its content must be " +
                hash_text(*input.hash) + ", got " + hash_text(hash));
}

}  // namespace

void check_session_paths(const fs::path& path, std::span<const fs::path> inputs) {
  for (const fs::path& input : inputs) {
    try {
      std::ignore = json_of_input({.path = input, .hash = {}}, folder_of(path)).dump();
    } catch (const Json::exception&) {
      throw IoError(path.string() + ": cannot name " + input.string() +
                    ": a session has only paths that are UTF-8");
    }
  }
}

void write_session(const fs::path& path, const SessionFile& session) {
  const fs::path folder = folder_of(path);
  Json json;
  json["version"] = kSessionFileVersion;
  std::string text;
  try {
    json["inputs"] = json_of_inputs(session.inputs, folder);
    json["also_read"] = json_of_inputs(session.also_read, folder);
    if (session.initial_mesh) json["initial_mesh"] = json_of_input(*session.initial_mesh, folder);
    if (session.points) json["points"] = *session.points;
    if (session.triangles) json["triangles"] = *session.triangles;
    json["commands"] = Json::array();
    for (const Command& command : session.commands) {
      json["commands"].push_back(session_file::json_of(command));
    }
    text = session_file::pretty(json);
  } catch (const Json::exception&) {
    throw IoError("write_session: " + path.string() + ": the path of an input is not UTF-8");
  }
  AtomicFile file(path);
  file.write(text);
  file.commit();
}

SessionFile read_session(const fs::path& path) {
  const FileBytes file(path);
  try {
    return session_of(parse(file), folder_of(path));
  } catch (const IoError& error) {
    file.fail(error.what());
  }
}

void check_session_inputs(const SessionFile& session, const Progress& progress) {
  for (const SessionInput& input : session.inputs)
    check_input(input, progress);
  for (const SessionInput& input : session.also_read)
    check_input(input, progress);
  if (session.initial_mesh) check_input(*session.initial_mesh, progress);
}

}  // namespace rangezip

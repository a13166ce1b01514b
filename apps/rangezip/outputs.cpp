#include "apps/rangezip/outputs.h"

#include <unistd.h>

#include <algorithm>
#include <cctype>

#include "apps/rangezip/exit_code.h"

namespace rangezip::app {

namespace {

namespace fs = std::filesystem;

std::string type_of(const fs::path& path) {
  std::string type = path.extension().string();
  std::transform(type.begin(), type.end(), type.begin(),
                 [](unsigned char c) { return static_cast<char>(std::tolower(c)); });
  return type.empty() ? type : type.substr(1);
}

void check_type(const std::string& name, const fs::path& path,
                std::initializer_list<std::string_view> types) {
  const std::string type = type_of(path);
  if (std::find(types.begin(), types.end(), type) != types.end()) return;
  std::string known;
  for (const std::string_view other : types)
    known += (known.empty() ? "." : " .") + std::string(other);
  throw OutputError(name + ": the name must end in " + known);
}

void check_place(const std::string& name, const fs::path& path) {
  std::error_code error;
  if (fs::is_directory(path, error)) throw OutputError(name + ": is a folder");
  const bool exists = fs::exists(path, error);
  if (exists && !fs::is_regular_file(path, error)) {  // a device or a pipe
    if (access(path.c_str(), W_OK) != 0) throw OutputError(name + ": is not writable");
    return;
  }
  const fs::path folder = path.has_parent_path() ? path.parent_path() : fs::path(".");
  if (!fs::is_directory(folder, error)) {
    throw OutputError(name + ": there is no folder " + folder.string());
  }
  if (access(folder.c_str(), W_OK | X_OK) != 0) {
    throw OutputError(name + ": the folder " + folder.string() + " is not writable");
  }
  if (exists && access(path.c_str(), W_OK) != 0) throw OutputError(name + ": is not writable");
}

bool is_same_file(const fs::path& a, const fs::path& b) {
  std::error_code error;
  if (fs::equivalent(a, b, error) && !error) return true;
  return fs::weakly_canonical(a, error) == fs::weakly_canonical(b, error) && !error;
}

}  // namespace

void Outputs::add(const std::string& option, const fs::path& path,
                  std::initializer_list<std::string_view> types) {
  const std::string name = option + " " + path.string();
  check_type(name, path, types);
  check_place(name, path);
  for (const Output& other : outputs_) {
    if (is_same_file(other.path, path)) {
      throw UsageError(name + ": is the same file as " + other.option + " " + other.path.string());
    }
  }
  outputs_.push_back({option, path});
}

void Outputs::refuse_overwriting(const std::vector<fs::path>& inputs) const {
  for (const Output& output : outputs_) {
    for (const fs::path& input : inputs) {
      if (!is_same_file(output.path, input)) continue;
      throw UsageError(output.option + " " + output.path.string() +
                       ": would overwrite an input, which the session needs to be replayed");
    }
  }
}

void write_output(const std::function<void()>& write) {
  try {
    write();
  } catch (const IoError& error) {
    throw OutputError(error.what());
  }
}

}  // namespace rangezip::app

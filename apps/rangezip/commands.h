#pragma once

#include <functional>
#include <map>
#include <string>

#include <CLI/CLI.hpp>

#include "apps/rangezip/console.h"
#include "core/io/mesh_file.h"

namespace rangezip::app {

/// What every command may use while it runs.
struct Context {
  std::stop_token stop;
};

/// The command that the command line names, ready to run; set while it is parsed.
using Action = std::function<void(const Context&)>;

/// Options that several commands share.
struct CommonOptions {
  std::string backend = "cpu";
  int threads = 0;
  bool quiet = false;
};
void add_common_options(CLI::App& command, CommonOptions& options);

/// How a mesh is written.
void add_mesh_file_options(CLI::App& command, MeshFileOptions& options);

/// --method and its like: one of a few words.
template <class Value>
auto one_of(std::map<std::string, Value> values) {
  return [values = std::move(values)](const std::string& text) {
    const auto found = values.find(text);
    if (found != values.end()) return found->second;
    std::string known;
    for (const auto& [name, value] : values)
      known += (known.empty() ? "" : ", ") + name;
    throw CLI::ValidationError("must be one of " + known + ", got '" + text + "'");
  };
}

/// Each adds one command with its options and help; when it is on the command line, `action`
/// becomes its run.
void add_mesh_command(CLI::App& app, Action& action);
void add_scan_command(CLI::App& app, Action& action);
void add_render_command(CLI::App& app, Action& action);
void add_play_command(CLI::App& app, Action& action);
void add_info_command(CLI::App& app, Action& action);
void add_backends_command(CLI::App& app, Action& action);

}  // namespace rangezip::app

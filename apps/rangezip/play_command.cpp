#include <algorithm>
#include <filesystem>
#include <utility>
#include <vector>

#include <fmt/format.h>

#include "apps/rangezip/backend.h"
#include "apps/rangezip/commands.h"
#include "apps/rangezip/inputs.h"
#include "apps/rangezip/outputs.h"
#include "apps/rangezip/session_start.h"
#include "apps/rangezip/verify.h"
#include "core/base/parallel.h"
#include "core/io/mesh_file.h"
#include "core/io/session_file.h"
#include "core/session/session.h"

namespace rangezip::app {

namespace {

struct PlayOptions {
  std::filesystem::path session;
  std::filesystem::path output;
  MeshFileOptions file;
  CommonOptions common;
};

/// The n-th of so many equal parts of the bar.
Progress part_of(const Progress& whole, std::size_t n, std::size_t count) {
  Progress part{.stop = whole.stop};
  part.report = [report = whole.report, n, count](std::string_view stage, double share) {
    report(stage, (static_cast<double>(n) + share) / static_cast<double>(count));
  };
  return part;
}

bool takes_back(const SessionFile& file) {
  return std::any_of(file.commands.begin(), file.commands.end(), [](const Command& command) {
    return std::holds_alternative<UndoSteps>(command);
  });
}

void play_commands(Session& session, const SessionFile& file, const PlayOptions& options,
                   Rasterizer& rasterizer, const Progress& progress) {
  for (std::size_t i = 0; i < file.commands.size(); ++i) {
    try {
      session.apply(file.commands[i], rasterizer, part_of(progress, i, file.commands.size()));
    } catch (const InvalidArgument& error) {
      throw IoError(options.session.string() + ": /commands/" + std::to_string(i) + ": " +
                    error.what());
    }
  }
}

void play(const PlayOptions& options, const Context& context) {
  const auto rasterizer = make_rasterizer(options.common.backend);
  Outputs outputs;
  outputs.add("-o", options.output, {"ply", "obj", "off", "stl"});
  Console console(options.common.quiet, context.stop);
  const SessionFile file = read_session(options.session);
  SessionStart start = read_session_start(
      options.session, file, [&](const auto& paths) { return read_inputs(paths, console).scene; },
      Progress{.stop = context.stop});

  SessionOptions session_options;
  if (!takes_back(file)) session_options.history_bytes = 0;
  Session session(std::move(start.scene), std::move(start.mesh), session_options);
  const Progress progress =
      console.start_task("playing", static_cast<double>(file.commands.size()), "commands");
  play_commands(session, file, options, *rasterizer, progress);
  console.end_task();
  progress.check_stop();

  require_faces(*session.mesh(), options.output, "the commands leave none");
  write_output([&] { write_mesh(options.output, *session.mesh(), options.file, progress); });
  console.print(fmt::format("session   {} commands", file.commands.size()));
  console.print(fmt::format("mesh      {}", topology_text(report_mesh(*session.mesh()))));
  console.print(fmt::format("written   {}", options.output.string()));
}

}  // namespace

void add_play_command(CLI::App& app, Action& action) {
  auto options = std::make_shared<PlayOptions>();
  CLI::App& command =
      *app.add_subcommand("play", "Carries out a session, recorded or written by hand");
  command
      .add_option("SESSION", options->session,
                  "From --session of 'mesh' or 'scan', or written after docs/session-schema.json")
      ->required()
      ->type_name("S.json");
  command.add_option("-o,--output", options->output, "The mesh to write, of the type of its name")
      ->required()
      ->type_name("OUT.{ply,obj,off,stl}");
  add_mesh_file_options(command, options->file);
  add_common_options(command, options->common);
  command.footer(
      "Inputs are found from the folder of the session and must be the same files as when it was "
      "recorded.\nA recorded session gives the same bytes as the run that recorded it.");
  command.callback([options, &action] {
    action = [options](const Context& context) {
      run_with_threads(options->common.threads, [&] { play(*options, context); });
    };
  });
}

}  // namespace rangezip::app

// rangezip: clean triangle meshes from raw 3D data by virtual range scanning.

#include <cstdio>
#include <exception>
#include <new>

#ifdef __GLIBC__
#include <malloc.h>
#endif

#include "apps/rangezip/commands.h"
#include "apps/rangezip/exit_code.h"
#include "apps/rangezip/interrupt.h"

namespace rangezip::app {

namespace {

constexpr const char* kExitCodes =
    "Exit codes:\n"
    "  0  done\n"
    "  1  wrong option or argument\n"
    "  2  an input is missing or not what it claims to be\n"
    "  3  an output cannot be written\n"
    "  4  the backend is unknown or failed\n"
    "  5  a mesh is not manifold or crosses itself\n"
    "  6  anything else, such as memory that ran out\n"
    "  130  interrupted (Ctrl-C); no file is left half written";

int fail(ExitCode code, const char* text) {
  std::fprintf(stderr, "rangezip: %s\n", text);
  return static_cast<int>(code);
}

int run(const Action& action) {
  const InterruptWatch interrupts;
  try {
    action({.stop = interrupts.token()});
    return static_cast<int>(ExitCode::ok);
  } catch (const UsageError& error) {
    return fail(ExitCode::usage, error.what());
  } catch (const InvalidArgument& error) {
    return fail(ExitCode::usage, error.what());
  } catch (const OutputError& error) {
    return fail(ExitCode::bad_output, error.what());
  } catch (const IoError& error) {
    return fail(ExitCode::bad_input, error.what());
  } catch (const BackendError& error) {
    return fail(ExitCode::backend, error.what());
  } catch (const NotVerified& error) {
    return fail(ExitCode::not_verified, error.what());
  } catch (const TopologyError& error) {
    return fail(ExitCode::not_verified, error.what());
  } catch (const Cancelled&) {
    return fail(ExitCode::cancelled, "interrupted");
  } catch (const std::bad_alloc&) {
    return fail(ExitCode::internal, "not enough memory");
  } catch (const std::exception& error) {
    return fail(ExitCode::internal, error.what());
  }
}

/// Without this an unknown command reads as none at all.
void check_command_name(const CLI::App& app, int argc, char** argv) {
  if (argc < 2 || argv[1][0] == '-') return;
  std::string known;
  for (const CLI::App* command : app.get_subcommands({})) {
    if (command->get_name() == argv[1]) return;
    known += (known.empty() ? "" : ", ") + command->get_name();
  }
  throw CLI::ValidationError(argv[1], "is no command; there are " + known);
}

/// How to ask for help about the command that was being read: "rangezip mesh --help".
std::string help_of(const CLI::App& app) {
  std::string line = app.get_name();
  for (const CLI::App* command : app.get_subcommands())
    line += " " + command->get_name();
  return line + " --help";
}

int parse_and_run(int argc, char** argv) {
  CLI::App app{"Clean triangle meshes from raw 3D data by virtual range scanning", "rangezip"};
  app.set_version_flag("--version", "rangezip " RANGEZIP_VERSION);
  app.require_subcommand(1);
  app.failure_message([](const CLI::App* failing, const CLI::Error& error) {
    return "rangezip: " + std::string(error.what()) + "\nSee " + help_of(*failing) + "\n";
  });
  app.footer(std::string("'rangezip COMMAND --help' lists the options of a command.\n\n") +
             kExitCodes);
  Action action;
  add_mesh_command(app, action);
  add_scan_command(app, action);
  add_render_command(app, action);
  add_play_command(app, action);
  add_info_command(app, action);
  add_backends_command(app, action);
  try {
    check_command_name(app, argc, argv);
    app.parse(argc, argv);
  } catch (const CLI::Success& success) {  // --help, --version
    return app.exit(success);
  } catch (const CLI::ParseError& error) {
    app.exit(error);
    return static_cast<int>(ExitCode::usage);
  }
  return run(action);
}

/// Every pass fills and frees tables of megabytes. Given back to the system they come back page by
/// page, zeroed, which costs one thread two percent of a run.
void keep_freed_memory() {
#ifdef __GLIBC__
  constexpr int kAnySize = 1 << 30;  // bytes
  mallopt(M_MMAP_THRESHOLD, kAnySize);
  mallopt(M_TRIM_THRESHOLD, kAnySize);
#endif
}

}  // namespace

}  // namespace rangezip::app

int main(int argc, char** argv) {
  rangezip::app::keep_freed_memory();
  try {
    return rangezip::app::parse_and_run(argc, argv);
  } catch (const std::exception& error) {
    std::fprintf(stderr, "rangezip: %s\n", error.what());
    return static_cast<int>(rangezip::app::ExitCode::internal);
  }
}

#include <algorithm>

#include <fmt/format.h>

#include "apps/rangezip/backend.h"
#include "apps/rangezip/commands.h"

namespace rangezip::app {

namespace {

void print_backends(const Context& context) {
  Console console(false, context.stop);
  const std::vector<BackendStatus> all = try_backends();
  std::size_t width = 0;
  for (const BackendStatus& backend : all)
    width = std::max(width, backend.name.size());
  for (const BackendStatus& backend : all) {
    console.print(fmt::format("{:<{}}  {}  {}", backend.name, width,
                              backend.works ? "works   " : "does not", backend.text));
  }
}

}  // namespace

void add_backends_command(CLI::App& app, Action& action) {
  CLI::App& command = *app.add_subcommand(
      "backends", "Says which rasterizers work here, and why the others do not");
  command.footer(
      "Each is started, and draws a test of the drawing rules first; those that work give the same "
      "bits. '--backend gl' takes the first of EGL's devices, or OSMesa.");
  command.callback([&action] { action = print_backends; });
}

}  // namespace rangezip::app

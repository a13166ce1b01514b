#include "apps/rangezip/handle_changes.h"

#include <algorithm>
#include <span>

#include <fmt/format.h>

namespace rangezip::app {
namespace {

constexpr std::size_t kShown = 8;  ///< of the changes, so that the text fits into two lines

std::string name_of(const ReconstructReport& report, std::size_t command) {
  if (command == report.finish_command) return "finish";
  const auto& scans = report.view_commands;
  const auto found = std::lower_bound(scans.begin(), scans.end(), command);
  if (found == scans.end() || *found != command) return "erasing faces";
  return fmt::format("view {}", found - scans.begin());
}

}  // namespace

std::vector<HandleChange> handle_changes(const ReconstructReport& report) {
  std::vector<HandleChange> changes;
  std::size_t before = 0;
  for (std::size_t i = 0; i < report.commands.size(); ++i) {
    const std::size_t after = report.commands[i].handles;
    if (after != before) {
      changes.push_back({name_of(report, i),
                         static_cast<std::ptrdiff_t>(after) - static_cast<std::ptrdiff_t>(before)});
    }
    before = after;
  }
  return changes;
}

std::string handles_text(const ReconstructReport& report) {
  const std::vector<HandleChange> changes = handle_changes(report);
  if (changes.empty()) return {};
  std::string text = std::to_string(report.commands.back().handles);
  const char* separator = ": ";
  for (const HandleChange& change : std::span(changes).first(std::min(kShown, changes.size()))) {
    text += fmt::format("{}{} {:+}", separator, change.by, change.handles);
    separator = ", ";
  }
  if (changes.size() > kShown) text += fmt::format(", and {} more", changes.size() - kShown);
  return text;
}

}  // namespace rangezip::app

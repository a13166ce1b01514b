#pragma once

#include <filesystem>
#include <map>
#include <optional>
#include <string>
#include <vector>

/// Runs the built program as a user would.
namespace rangezip::test {

struct RunOptions {
  std::map<std::string, std::string> environment;  ///< on top of this process's
  std::optional<std::size_t> file_size_limit;      ///< bytes (ulimit -f)
  std::optional<std::size_t> address_limit;        ///< bytes (ulimit -v)
  bool terminal = false;                           ///< standard error is a terminal
  std::string out_path;                            ///< standard output goes here instead
  /// Sends this signal as soon as standard error holds `signal_after`, and so many in all, one
  /// every 1.2 seconds.
  int signal = 0;
  std::string signal_after;
  int signals = 1;
};

struct RunResult {
  int code = -1;  ///< of the exit; 128 + signal if one killed it
  std::string out;
  std::string err;
};

/// @param arguments without the program's name
[[nodiscard]] RunResult run(const std::vector<std::string>& arguments,
                            const RunOptions& options = {});

/// A sphere of radius 1 about (3, 0, 0) as binary PLY, points spread evenly.
void store_sphere(const std::filesystem::path& path, std::size_t points = 20'000);

}  // namespace rangezip::test

#include "apps/rangezip/referee.h"

#include <fcntl.h>
#include <spawn.h>
#include <sys/wait.h>
#include <unistd.h>

#include <array>
#include <cerrno>
#include <chrono>
#include <csignal>
#include <cstdio>
#include <cstring>
#include <thread>
#include <tuple>
#include <vector>

#include "apps/rangezip/exit_code.h"
#include "apps/rangezip/outputs.h"
#include "core/base/error.h"
#include "core/base/progress.h"

namespace rangezip::app {

namespace {

namespace fs = std::filesystem;

constexpr const char* kName = "rangezip-compare";
constexpr int kNotGood = 1;  // exit codes of the referee (docs/command-line.md)
constexpr int kInterrupted = 130;
constexpr std::chrono::milliseconds kPause{20};  // between looks at the referee

/// A session on file for as long as this object lives.
class StoredSession {
 public:
  StoredSession(const SessionFile& session, const fs::path& output)
      : path_(session_for_referee(output)) {
    write_output([&] { write_session(path_, session); });
  }
  StoredSession(const StoredSession&) = delete;
  StoredSession& operator=(const StoredSession&) = delete;
  ~StoredSession() {
    std::error_code error;  // a file that is gone already is no matter
    fs::remove(path_, error);
  }

  [[nodiscard]] const fs::path& path() const noexcept { return path_; }

 private:
  fs::path path_;
};

/// Runs a program to its end, which a stop brings nearer. @return its exit code, 128 + the signal
/// that ended it
int run_program(std::vector<std::string> arguments, bool quiet, const std::stop_token& stop) {
  std::vector<char*> argv;
  argv.reserve(arguments.size() + 1);
  for (std::string& argument : arguments)
    argv.push_back(argument.data());
  argv.push_back(nullptr);
  posix_spawn_file_actions_t actions;
  posix_spawn_file_actions_init(&actions);
  if (quiet) {
    posix_spawn_file_actions_addopen(&actions, STDOUT_FILENO, "/dev/null", O_WRONLY, 0);
  }
  std::ignore =
      std::signal(SIGCHLD, SIG_DFL);  // where it is ignored, nobody learns how a program ended
  pid_t child = 0;
  static_cast<void>(std::fflush(stdout));  // what was printed comes first
  const int failed = posix_spawn(&child, argv[0], &actions, nullptr, argv.data(), environ);
  posix_spawn_file_actions_destroy(&actions);
  if (failed != 0) throw Error(arguments[0] + ": cannot be started: " + std::strerror(failed));
  int status = 0;
  bool is_asked_to_end = false;
  for (pid_t ended = 0; ended != child; ended = waitpid(child, &status, WNOHANG)) {
    if (ended < 0 && errno != EINTR)
      throw Error(arguments[0] + ": its verdict is not known: " + std::strerror(errno));
    if (stop.stop_requested() && !is_asked_to_end) {
      kill(child, SIGTERM);
      is_asked_to_end = true;
    }
    std::this_thread::sleep_for(kPause);
  }
  constexpr int kSignalled = 128;
  return WIFEXITED(status) ? WEXITSTATUS(status) : kSignalled + WTERMSIG(status);
}

}  // namespace

fs::path find_referee() {
  std::error_code error;
  const fs::path folder = fs::read_symlink("/proc/self/exe", error).parent_path();
  const std::array<fs::path, 2> places{folder / kName, folder.parent_path() / kName / kName};
  for (const fs::path& place : places) {
    if (fs::is_regular_file(place, error) && access(place.c_str(), X_OK) == 0) return place;
  }
  throw UsageError("--verify: needs the program " + places[0].string() +
                   ", which is not installed (build with RANGEZIP_BUILD_COMPARE=ON)");
}

fs::path session_for_referee(const fs::path& output) {
  return output.string() + ".verify-" + std::to_string(getpid()) + ".json";
}

void let_referee_judge(const fs::path& referee, const SessionFile& session, const fs::path& output,
                       const std::string& backend, bool quiet, const std::stop_token& stop) {
  const StoredSession stored(session, output);
  const int code = run_program(
      {referee.string(), "stitch", stored.path().string(), "--backend", backend}, quiet, stop);
  if (code == 0) return;
  if (code == kInterrupted) throw Cancelled("interrupted");
  if (code == kNotGood) {
    throw NotVerified(
        output.string() +
        ": the mesh is written, but rangezip-compare does not find all stitches good");
  }
  throw Error(referee.string() + ": failed with exit code " + std::to_string(code));
}

}  // namespace rangezip::app

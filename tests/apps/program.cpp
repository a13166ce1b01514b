#include "tests/apps/program.h"

#include <fcntl.h>
#include <pty.h>
#include <sys/resource.h>
#include <sys/wait.h>
#include <unistd.h>

#include <chrono>
#include <csignal>
#include <cstring>
#include <fstream>
#include <stdexcept>
#include <thread>

#include "tests/core/io/temporary_folder.h"
#include "tests/support/shapes.h"

namespace rangezip::test {

namespace {

constexpr std::chrono::milliseconds kBetweenSignals{1200};
constexpr std::chrono::seconds kLongestRun{900};  // with sanitizers on a busy machine

/// In the child: takes over the outputs and becomes the program.
[[noreturn]] void become_program(const std::vector<std::string>& arguments,
                                 const RunOptions& options, int out, int err) {
  const int in = open("/dev/null", O_RDONLY);
  dup2(in, STDIN_FILENO);
  dup2(options.out_path.empty() ? out : open(options.out_path.c_str(), O_WRONLY), STDOUT_FILENO);
  dup2(err, STDERR_FILENO);
  for (const int signal : {SIGINT, SIGTERM})
    std::signal(signal, SIG_DFL);
  unsetenv("RANGEZIP_BACKEND");
  for (const auto& [name, value] : options.environment)
    setenv(name.c_str(), value.c_str(), 1);
  if (options.file_size_limit) {
    const rlimit limit{*options.file_size_limit, *options.file_size_limit};
    setrlimit(RLIMIT_FSIZE, &limit);
  }
  if (options.address_limit) {
    const rlimit limit{*options.address_limit, *options.address_limit};
    setrlimit(RLIMIT_AS, &limit);
  }
  std::vector<char*> argv{const_cast<char*>(RANGEZIP_PROGRAM)};
  for (const std::string& argument : arguments)
    argv.push_back(const_cast<char*>(argument.c_str()));
  argv.push_back(nullptr);
  execv(RANGEZIP_PROGRAM, argv.data());
  _exit(127);
}

/// What has arrived at a descriptor, without waiting for more.
void drain(int descriptor, std::string& text) {
  char buffer[4096];
  for (ssize_t n = 0; (n = read(descriptor, buffer, sizeof buffer)) > 0;)
    text.append(buffer, static_cast<std::size_t>(n));
}

struct Channel {
  int ours = -1;
  int theirs = -1;
};

Channel open_channel(bool terminal) {
  Channel channel;
  int ends[2];
  if (terminal) {
    if (openpty(&ends[0], &ends[1], nullptr, nullptr, nullptr) != 0) {
      throw std::runtime_error("openpty failed");
    }
  } else if (pipe(ends) != 0) {
    throw std::runtime_error("pipe failed");
  }
  channel = {ends[0], ends[1]};
  fcntl(channel.ours, F_SETFL, O_NONBLOCK);
  fcntl(channel.ours, F_SETFD, FD_CLOEXEC);
  return channel;
}

}  // namespace

RunResult run(const std::vector<std::string>& arguments, const RunOptions& options) {
  const Channel out = open_channel(false);
  const Channel err = open_channel(options.terminal);
  const pid_t child = fork();
  if (child < 0) throw std::runtime_error("fork failed");
  if (child == 0) become_program(arguments, options, out.theirs, err.theirs);
  close(out.theirs);

  RunResult result;
  int signals = options.signal != 0 ? options.signals : 0;
  int status = 0;
  using Clock = std::chrono::steady_clock;
  const auto start = Clock::now();
  auto next_signal = start;
  while (waitpid(child, &status, WNOHANG) == 0) {
    drain(out.ours, result.out);
    drain(err.ours, result.err);
    if (signals > 0 && Clock::now() >= next_signal &&
        result.err.find(options.signal_after) != std::string::npos) {
      kill(child, options.signal);
      --signals;
      next_signal = Clock::now() + kBetweenSignals;
    }
    if (Clock::now() - start > kLongestRun) kill(child, SIGKILL);
    std::this_thread::sleep_for(std::chrono::milliseconds(2));
  }
  drain(out.ours, result.out);
  drain(err.ours, result.err);
  for (const int descriptor : {out.ours, err.ours, err.theirs})
    close(descriptor);
  result.code = WIFEXITED(status) ? WEXITSTATUS(status) : 128 + WTERMSIG(status);
  return result;
}

void store_sphere(const std::filesystem::path& path, std::size_t points) {
  shapes::Random random(1);
  std::ofstream file(path, std::ios::binary);
  file << "ply\nformat binary_little_endian 1.0\nelement vertex " << points
       << "\nproperty float x\nproperty float y\nproperty float z\nend_header\n";
  for (std::size_t i = 0; i < points; ++i) {
    const Vec3f position(random.direction() + Vec3{3.0, 0.0, 0.0});
    file.write(reinterpret_cast<const char*>(&position), sizeof position);
  }
  if (!file.flush()) throw std::runtime_error("cannot store " + path.string());
}

}  // namespace rangezip::test

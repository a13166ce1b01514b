#include "apps/rangezip/interrupt.h"

#include <array>
#include <chrono>
#include <tuple>

namespace rangezip::app {

namespace {

constexpr int kEndOfWatch = SIGUSR1;  ///< sent by the destructor to wake the watching thread

/// After the first signal: one that comes sooner is of the same impatient hand.
constexpr std::chrono::seconds kPatience{1};

bool is_ignored(int signal) {
  struct sigaction action {};
  return sigaction(signal, nullptr, &action) == 0 && action.sa_handler == SIG_IGN;
}

/// As if nobody had watched for it.
void end_by(int signal) {
  std::ignore = std::signal(signal, SIG_DFL);
  sigset_t only;
  sigemptyset(&only);
  sigaddset(&only, signal);
  pthread_sigmask(SIG_UNBLOCK, &only, nullptr);
  std::ignore = std::raise(signal);
}

}  // namespace

InterruptWatch::InterruptWatch() {
  std::ignore = std::signal(SIGXFSZ, SIG_IGN);
  sigemptyset(&signals_);
  sigaddset(&signals_, kEndOfWatch);
  for (const int signal : std::array{SIGINT, SIGTERM}) {
    if (!is_ignored(signal)) sigaddset(&signals_, signal);
  }
  pthread_sigmask(SIG_BLOCK, &signals_, nullptr);
  thread_ = std::thread([this] { watch(); });
}

InterruptWatch::~InterruptWatch() {
  pthread_kill(thread_.native_handle(), kEndOfWatch);
  thread_.join();
}

void InterruptWatch::watch() {
  using Clock = std::chrono::steady_clock;
  Clock::time_point first;
  int signal = 0;
  while (sigwait(&signals_, &signal) == 0 && signal != kEndOfWatch) {
    if (stop_.request_stop()) {
      first = Clock::now();
    } else if (Clock::now() - first >= kPatience) {
      end_by(signal);
    }
  }
}

}  // namespace rangezip::app

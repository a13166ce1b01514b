#include "apps/rangezip/interrupt.h"

#include <array>

namespace rangezip::app {

namespace {

constexpr int kEndOfWatch = SIGUSR1;  ///< sent by the destructor to wake the watching thread

bool is_ignored(int signal) {
  struct sigaction action {};
  return sigaction(signal, nullptr, &action) == 0 && action.sa_handler == SIG_IGN;
}

}  // namespace

InterruptWatch::InterruptWatch() {
  std::signal(SIGXFSZ, SIG_IGN);
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
  int signal = 0;
  while (sigwait(&signals_, &signal) == 0 && signal != kEndOfWatch)
    stop_.request_stop();
}

}  // namespace rangezip::app

#pragma once

#include <csignal>
#include <stop_token>
#include <thread>

namespace rangezip::app {

/// Turns Ctrl-C (SIGINT) and SIGTERM into a stop token, so that the library ends at its next
/// check and every unfinished file is removed. Another one, a second later or more, ends the
/// program at once, as where an output is a pipe that nobody reads. A signal that was ignored at
/// the start (nohup) stays ignored. Also lets writes past the file-size limit fail instead of
/// killing the program. Make it before any other thread, since threads inherit which signals they
/// take.
class InterruptWatch {
 public:
  InterruptWatch();
  ~InterruptWatch();
  InterruptWatch(const InterruptWatch&) = delete;
  InterruptWatch& operator=(const InterruptWatch&) = delete;

  [[nodiscard]] std::stop_token token() const { return stop_.get_token(); }

 private:
  void watch();

  std::stop_source stop_;
  sigset_t signals_{};
  std::thread thread_;
};

}  // namespace rangezip::app

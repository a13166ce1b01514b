#pragma once

#include <chrono>
#include <stop_token>
#include <string>
#include <string_view>

#include "core/base/progress.h"

namespace rangezip::app {

/// "1,234,567".
[[nodiscard]] std::string with_commas(std::size_t number);

/// How the program talks: results to standard output, progress to standard error. Progress is a bar
/// with rate and time left on a terminal, and a line for each stage otherwise. Quiet: neither.
class Console {
 public:
  Console(bool quiet, std::stop_token stop);
  ~Console();
  Console(const Console&) = delete;
  Console& operator=(const Console&) = delete;

  /// One line of result. @throws OutputError if standard output takes no more.
  void print(const std::string& line);

  /// Starts a task of `amount` units ("points") for the rate; ends the one before. The progress
  /// refers to this object.
  [[nodiscard]] Progress start_task(std::string name, double amount, std::string unit);

  /// Ends the task; the bar goes.
  void end_task();

 private:
  using Clock = std::chrono::steady_clock;

  void report(std::string_view stage, double share);
  void draw_bar(std::string_view stage, double share);
  [[nodiscard]] double seconds() const;

  bool quiet_;
  bool is_terminal_;
  std::stop_token stop_;
  std::string task_;
  std::string stage_;
  std::string unit_;
  double amount_ = 0.0;
  Clock::time_point start_;
  Clock::time_point last_drawn_;
  bool bar_is_shown_ = false;
};

}  // namespace rangezip::app

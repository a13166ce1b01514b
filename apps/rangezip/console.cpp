#include "apps/rangezip/console.h"

#include <unistd.h>

#include <algorithm>
#include <cmath>
#include <cstdio>

#include <fmt/format.h>

#include "apps/rangezip/exit_code.h"

namespace rangezip::app {

namespace {

constexpr std::size_t kBarWidth = 24;
constexpr std::chrono::milliseconds kRedraw{100};

/// "1.2 M points/s".
std::string rate_text(double rate, const std::string& unit) {
  const char* prefix = "";
  for (const char* larger : {"K ", "M ", "G "}) {
    if (rate < 1000.0) break;
    rate /= 1000.0;
    prefix = larger;
  }
  return fmt::format("{:.{}f} {}{}/s", rate, rate < 10.0 ? 1 : 0, prefix, unit);
}

std::string duration_text(double seconds) {
  const auto whole = static_cast<long>(std::ceil(seconds));
  return whole < 3600 ? fmt::format("{}:{:02}", whole / 60, whole % 60)
                      : fmt::format("{}:{:02}:{:02}", whole / 3600, whole / 60 % 60, whole % 60);
}

}  // namespace

std::string with_commas(std::size_t number) {
  std::string text = std::to_string(number);
  for (std::size_t i = text.size(); i > 3; i -= 3)
    text.insert(i - 3, ",");
  return text;
}

Console::Console(bool quiet, std::stop_token stop)
    : quiet_(quiet), is_terminal_(isatty(STDERR_FILENO) == 1), stop_(std::move(stop)) {}

Console::~Console() {
  end_task();
}

void Console::print(const std::string& line) {
  if (quiet_) return;
  end_task();
  if (std::fputs((line + '\n').c_str(), stdout) < 0 || std::fflush(stdout) != 0) {
    throw OutputError("standard output cannot be written");
  }
}

Progress Console::start_task(std::string name, double amount, std::string unit) {
  end_task();
  task_ = std::move(name);
  unit_ = std::move(unit);
  amount_ = amount;
  stage_.clear();
  start_ = Clock::now();
  last_drawn_ = start_ - kRedraw;
  return {.report = [this](std::string_view stage, double share) { report(stage, share); },
          .stop = stop_};
}

void Console::end_task() {
  if (bar_is_shown_) std::fputs("\r\033[K", stderr);
  bar_is_shown_ = false;
}

double Console::seconds() const {
  return std::chrono::duration<double>(Clock::now() - start_).count();
}

void Console::report(std::string_view stage, double share) {
  if (quiet_) return;
  if (is_terminal_) {
    const auto now = Clock::now();
    if (now - last_drawn_ < kRedraw) return;
    last_drawn_ = now;
    draw_bar(stage, std::clamp(share, 0.0, 1.0));
  } else if (stage != stage_) {
    stage_ = stage;
    fmt::print(stderr, "{}: {} ({:.1f} s)\n", task_, stage, seconds());
  }
}

void Console::draw_bar(std::string_view stage, double share) {
  constexpr double kFirstEstimate = 0.02;  // of the work, before rate and time left mean much
  const double elapsed = seconds();
  const auto filled = static_cast<std::size_t>(share * static_cast<double>(kBarWidth));
  std::string line = fmt::format("{}: [{}{}] {:3.0f} % {}", task_, std::string(filled, '#'),
                                 std::string(kBarWidth - filled, '-'), 100.0 * share, stage);
  if (share > kFirstEstimate && elapsed > 0.0) {
    line += ", " + rate_text(amount_ * share / elapsed, unit_) + ", " +
            duration_text(elapsed * (1.0 - share) / share) + " left";
  }
  fmt::print(stderr, "\r\033[K{}", line);
  std::fflush(stderr);
  bar_is_shown_ = true;
}

}  // namespace rangezip::app

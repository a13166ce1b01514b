#pragma once

#include <cstdint>
#include <cstring>
#include <string>
#include <string_view>

namespace rangezip {

/// The lines of a text, without their ends ("\n" or "\r\n").
class TextLines {
 public:
  explicit TextLines(std::string_view text) : next_(text.data()), end_(text.data() + text.size()) {}

  /// False at the end of the text.
  bool next(std::string_view& line) {
    if (next_ == end_) return false;
    const auto* stop =
        static_cast<const char*>(std::memchr(next_, '\n', static_cast<std::size_t>(end_ - next_)));
    const char* const after = stop == nullptr ? end_ : stop + 1;
    if (stop == nullptr) stop = end_;
    if (stop != next_ && stop[-1] == '\r') --stop;
    line = {next_, static_cast<std::size_t>(stop - next_)};
    next_ = after;
    return true;
  }
  /// The next line that holds more than blanks; empty at the end of the text.
  std::string_view next_filled();

  /// Where the next line begins.
  [[nodiscard]] const char* position() const noexcept { return next_; }
  [[nodiscard]] std::string_view rest() const noexcept {
    return {next_, static_cast<std::size_t>(end_ - next_)};
  }

 private:
  const char* next_;
  const char* end_;
};

/// Reads a number at `at` and moves `at` behind it. Decimal point and exponent as in C whatever the
/// locale; a leading '+', nan and inf are known; beyond the range of double gives infinity or zero.
/// False, and `at` stays, if there is no number or it runs into other text ("1.5abc").
/// @param separator ends a number besides blanks and `end`
bool parse_number(const char*& at, const char* end, double& value, char separator = ' ');

/// The same for whole numbers; false also beyond the range of int64.
bool parse_integer(const char*& at, const char* end, std::int64_t& value, char separator = ' ');

/// Reads one line field by field; fields are parted by blanks (space and tab).
class TextFields {
 public:
  explicit TextFields(std::string_view line) : at_(line.data()), end_(line.data() + line.size()) {
    skip_blanks();
  }

  [[nodiscard]] bool at_end() const noexcept { return at_ == end_; }
  [[nodiscard]] const char* position() const noexcept { return at_; }
  [[nodiscard]] std::string_view rest() const noexcept {
    return {at_, static_cast<std::size_t>(end_ - at_)};
  }

  /// False, and nothing is taken, if the next field is not a number.
  bool number(double& value) { return parse_number(at_, end_, value) && skip_blanks(); }
  bool integer(std::int64_t& value) { return parse_integer(at_, end_, value) && skip_blanks(); }
  /// The next field, empty at the end.
  std::string_view word();

 private:
  bool skip_blanks() {
    while (at_ != end_ && (*at_ == ' ' || *at_ == '\t'))
      ++at_;
    return true;
  }

  const char* at_;
  const char* end_;
};

/// `text` in lower case, for ASCII letters whatever the locale.
[[nodiscard]] std::string to_lower(std::string_view text);

/// `text` for an error message: cut to a short piece, unprintable bytes as '?', in quotes.
[[nodiscard]] std::string quote(std::string_view text);

}  // namespace rangezip

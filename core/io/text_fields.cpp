#include "core/io/text_fields.h"

#include <algorithm>
#include <array>
#include <charconv>
#include <limits>
#include <string>
#include <system_error>

namespace rangezip {

namespace {

bool is_blank(char c) {
  return c == ' ' || c == '\t';
}

constexpr double kInfinity = std::numeric_limits<double>::infinity();

/// The whole number behind the 'e' of a number; infinite if it does not fit 64 bits.
double exponent_of(std::string_view text) {
  const char* at = text.data();
  std::int64_t exponent = 0;
  if (parse_integer(at, text.data() + text.size(), exponent)) return static_cast<double>(exponent);
  return text.front() == '-' ? -kInfinity : kInfinity;
}

/// A number too large or too small for double, as infinity or zero: by the power of ten of its
/// first digit that is not zero. Such a power is far from 0, so it need not be exact.
double out_of_range_value(std::string_view number) {
  const std::size_t mantissa_end = std::min(number.find_first_of("eE"), number.size());
  const std::size_t point = std::min(number.find('.'), mantissa_end);
  const std::size_t first_digit = number.find_first_of("123456789");
  double power = static_cast<double>(point) - static_cast<double>(first_digit);
  if (mantissa_end != number.size()) power += exponent_of(number.substr(mantissa_end + 1));
  const double size = power < 0.0 ? 0.0 : kInfinity;
  return number.front() == '-' ? -size : size;
}

constexpr std::uint64_t kExactInteger = std::uint64_t{1} << 53U;  ///< doubles hold all up to here
constexpr std::array<double, 23> kExactPowersOfTen{1e0,  1e1,  1e2,  1e3,  1e4,  1e5,  1e6,  1e7,
                                                   1e8,  1e9,  1e10, 1e11, 1e12, 1e13, 1e14, 1e15,
                                                   1e16, 1e17, 1e18, 1e19, 1e20, 1e21, 1e22};

/// Plain decimals of few digits, the bulk of every file: one division of two exact doubles is
/// rounded correctly [Clinger 1990]. False if the number is of another kind; from_chars reads it.
bool parse_short_decimal(const char*& at, const char* end, double& value, char separator) {
  const char* p = at;
  const bool is_negative = p != end && *p == '-';
  if (is_negative) ++p;
  const char* const first_digit = p;
  constexpr std::ptrdiff_t kMostDigits = 18;  // no overflow of 64 bits
  std::uint64_t digits = 0;
  while (p != end && *p >= '0' && *p <= '9' && p - first_digit <= kMostDigits) {
    digits = 10 * digits + static_cast<std::uint64_t>(*p++ - '0');
  }
  if (p == first_digit) return false;
  std::ptrdiff_t decimals = 0;
  if (p != end && *p == '.') {
    const char* const first_decimal = ++p;
    while (p != end && *p >= '0' && *p <= '9' && p - first_digit <= kMostDigits) {
      digits = 10 * digits + static_cast<std::uint64_t>(*p++ - '0');
    }
    decimals = p - first_decimal;
  }
  const bool is_whole_field = p == end || is_blank(*p) || *p == separator;
  if (!is_whole_field || p - first_digit > kMostDigits || digits > kExactInteger) return false;
  const double size =
      static_cast<double>(digits) / kExactPowersOfTen[static_cast<std::size_t>(decimals)];
  value = is_negative ? -size : size;
  at = p;
  return true;
}

}  // namespace

std::string_view TextLines::next_filled() {
  std::string_view line;
  while (next(line)) {
    if (line.find_first_not_of(" \t\r") != std::string_view::npos) return line;
  }
  return rest();  // empty, at the end of the text
}

bool parse_number(const char*& at, const char* end, double& value, char separator) {
  if (parse_short_decimal(at, end, value, separator)) return true;
  const char* first = at;
  if (first != end && *first == '+' && first + 1 != end && first[1] != '-') ++first;
  const auto [last, error] = std::from_chars(first, end, value);
  if (error == std::errc::invalid_argument) return false;
  if (last != end && !is_blank(*last) && *last != separator) return false;
  if (error == std::errc::result_out_of_range) {
    value = out_of_range_value({first, static_cast<std::size_t>(last - first)});
  }
  at = last;
  return true;
}

bool parse_integer(const char*& at, const char* end, std::int64_t& value, char separator) {
  const char* first = at;
  if (first != end && *first == '+' && first + 1 != end && first[1] != '-') ++first;
  const auto [last, error] = std::from_chars(first, end, value);
  if (error != std::errc{}) return false;
  if (last != end && !is_blank(*last) && *last != separator) return false;
  at = last;
  return true;
}

std::string_view TextFields::word() {
  const char* const begin = at_;
  while (at_ != end_ && !is_blank(*at_))
    ++at_;
  const std::string_view field{begin, static_cast<std::size_t>(at_ - begin)};
  skip_blanks();
  return field;
}

std::string to_lower(std::string_view text) {
  std::string lower(text);
  for (char& c : lower) {
    if (c >= 'A' && c <= 'Z') c = static_cast<char>(c - 'A' + 'a');
  }
  return lower;
}

std::string quote(std::string_view text) {
  constexpr std::size_t kLongest = 40;
  std::string shown = "'";
  for (const char c : text.substr(0, kLongest))
    shown += (c >= ' ' && c <= '~') ? c : '?';
  return shown + (text.size() > kLongest ? "...'" : "'");
}

}  // namespace rangezip

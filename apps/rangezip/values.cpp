#include "apps/rangezip/values.h"

#include <charconv>
#include <cmath>
#include <string_view>

#include "core/raster/rasterizer.h"

namespace rangezip::app {

namespace {

[[noreturn]] void refuse(const std::string& rule, const std::string& text) {
  throw CLI::ValidationError("must be " + rule + ", got '" + text + "'");
}

std::optional<double> number_of(std::string_view text) {
  if (!text.empty() && text.front() == '+') text.remove_prefix(1);
  double value = 0.0;
  const auto [end, error] = std::from_chars(text.data(), text.data() + text.size(), value);
  if (error != std::errc{} || end != text.data() + text.size() || !std::isfinite(value)) {
    return std::nullopt;
  }
  return value;
}

/// Exactly `count` numbers between commas.
std::vector<double> numbers_of(const std::string& text, std::size_t count,
                               const std::string& rule) {
  std::vector<double> numbers;
  std::size_t begin = 0;
  while (begin <= text.size()) {
    const std::size_t end = std::min(text.find(',', begin), text.size());
    const auto number = number_of(std::string_view(text).substr(begin, end - begin));
    if (!number) refuse(rule, text);
    numbers.push_back(*number);
    begin = end + 1;
  }
  if (numbers.size() != count) refuse(rule, text);
  return numbers;
}

}  // namespace

double parse_number(const std::string& text) {
  const auto number = number_of(text);
  if (!number) refuse("a number", text);
  return *number;
}

double parse_positive(const std::string& text) {
  const auto number = number_of(text);
  if (!number || !(*number > 0.0)) refuse("a number greater than 0", text);
  return *number;
}

std::size_t parse_count(const std::string& text) {
  std::size_t count = 0;
  const auto [end, error] = std::from_chars(text.data(), text.data() + text.size(), count);
  if (error != std::errc{} || end != text.data() + text.size() || count == 0) {
    refuse("a whole number greater than 0", text);
  }
  return count;
}

double parse_not_negative(const std::string& text) {
  const auto number = number_of(text);
  if (!number || !(*number >= 0.0)) refuse("a number of at least 0", text);
  return *number;
}

Vec3 parse_vector(const std::string& text) {
  const std::string rule = "three numbers 'x,y,z', not all 0";
  const auto numbers = numbers_of(text, 3, rule);
  const Vec3 vector{numbers[0], numbers[1], numbers[2]};
  if (vector == Vec3{0.0}) refuse(rule, text);
  return vector;
}

Vec3 parse_position(const std::string& text) {
  const auto numbers = numbers_of(text, 3, "three numbers 'x,y,z'");
  return {numbers[0], numbers[1], numbers[2]};
}

Extent parse_extent(const std::string& text) {
  const std::string rule =
      "two whole numbers 'width,height' in [1, " + std::to_string(kMaxRasterExtent) + "]";
  const auto numbers = numbers_of(text, 2, rule);
  for (const double number : numbers) {
    if (!(number >= 1.0 && number <= kMaxRasterExtent && number == std::floor(number))) {
      refuse(rule, text);
    }
  }
  return {static_cast<int>(numbers[0]), static_cast<int>(numbers[1])};
}

std::vector<Vec2> parse_polygon(const std::string& text) {
  const std::string rule = "at least three corners 'x,y x,y x,y' (pixels, y up)";
  std::vector<Vec2> corners;
  std::size_t begin = text.find_first_not_of(' ');
  while (begin != std::string::npos) {
    const std::size_t end = std::min(text.find(' ', begin), text.size());
    const auto numbers = numbers_of(text.substr(begin, end - begin), 2, rule);
    corners.emplace_back(numbers[0], numbers[1]);
    begin = text.find_first_not_of(' ', end);
  }
  if (corners.size() < 3) refuse(rule, text);
  return corners;
}

Plane parse_plane(const std::string& text) {
  const std::string rule = "four numbers 'nx,ny,nz,d' with a normal that is not 0";
  const auto numbers = numbers_of(text, 4, rule);
  const Plane plane{{numbers[0], numbers[1], numbers[2]}, numbers[3]};
  if (plane.normal == Vec3{0.0}) refuse(rule, text);
  return plane;
}

}  // namespace rangezip::app

#include <catch2/catch.hpp>
#include <clocale>
#include <cmath>
#include <limits>
#include <locale>
#include <string>
#include <vector>

#include "core/base/error.h"
#include "core/io/input_file.h"
#include "core/io/mesh_file.h"
#include "core/io/text_fields.h"
#include "tests/core/io/temporary_folder.h"
#include "tests/support/shapes.h"

namespace rangezip {
namespace {

const std::vector<Vec3> kExpected{{1, 2.5, -3}, {0, 0.125, 400}, {-7, 8, 0.5}};

constexpr double kInfinity = std::numeric_limits<double>::infinity();

std::vector<Vec3> read_points(const std::string& name, const std::string& text) {
  const test::TemporaryFolder folder;
  const InputFile input = read_input(folder.store(name, text));
  std::vector<Vec3> points;
  for (const Vec3f& p : input.items.at(0).cloud->positions) {
    points.emplace_back(input.items[0].world_from_item * Vec4(Vec3(p), 1.0));
  }
  return points;
}

/// Writes numbers with a decimal comma and points between thousands.
class CommaPunctuation : public std::numpunct<char> {
  char do_decimal_point() const override { return ','; }
  char do_thousands_sep() const override { return '.'; }
  std::string do_grouping() const override { return "\3"; }
};

/// A locale with decimal commas, of C++ and, where the system has one, of C.
class CommaLocale {
 public:
  CommaLocale() : before_(std::locale::global(std::locale(std::locale(), new CommaPunctuation))) {
    for (const char* name : {"de_DE.UTF-8", "de_DE.utf8", "fr_FR.UTF-8"}) {
      if (std::setlocale(LC_NUMERIC, name) != nullptr) break;
    }
  }
  ~CommaLocale() {
    std::locale::global(before_);
    std::setlocale(LC_NUMERIC, "C");
  }

 private:
  std::locale before_;
};

double value_of(const std::string& text) {
  const char* at = text.data();
  double value = 0.0;
  REQUIRE(parse_number(at, text.data() + text.size(), value));
  return value;
}

}  // namespace

TEST_CASE("Text clouds are read whatever parts their columns") {
  const std::string text = GENERATE(as<std::string>{},
                                    "1 2.5 -3\n0 0.125 400\n-7 8 0.5\n",           //
                                    "1\t2.5\t-3\r\n0\t.125\t4e2\r\n-7\t8.\t+0.5",  //
                                    "1,2.5,-3\n0,0.125,400\n-7,8,0.5\n",           //
                                    "1 , 2.5, -3\n0 ,0.125 ,400\n-7,8,0.5\n",      //
                                    "1;2.5;-3\n0;0.125;400\n-7;8;0.5\n",           //
                                    "  1  2.5   -3  \n\n\n0 0.125 4.0E+02\n -7 8 0.5\n   \n");
  CAPTURE(text);
  for (const char* name : {"a.xyz", "a.asc", "a.csv", "a.txt", "a.PTS"}) {
    CHECK(read_points(name, text) == kExpected);
  }
}

TEST_CASE("Text clouds may have comments, header lines, more columns and a byte order mark") {
  const std::string text =
      GENERATE(as<std::string>{},
               "# made by hand\n// x y z\n; old style\n1 2.5 -3\n# between\n0 0.125 400 # "
               "behind\n-7 8 0.5\n",
               "X,Y,Z,R,G,B\n1,2.5,-3,255,0,0\n0,0.125,400,1,2,3\n-7,8,0.5,,,\n",
               "\xef\xbb\xbf"
               "1 2.5 -3 tree\n0 0.125 400 car 7\n-7 8 0.5\n",
               "a cloud\nof three points\n\n1 2.5 -3\n0 0.125 400\n-7 8 0.5\n");
  CAPTURE(text);
  CHECK(read_points("a.txt", text) == kExpected);
}

TEST_CASE("A header that names every column says which are x, y and z") {
  CHECK(read_points("a.csv", "id,z,\"X\",y\n1,-3,1,2.5\n2,400,0,0.125\n3,0.5,-7,8\n") == kExpected);
  CHECK(read_points("a.txt", "//id Z X Y\nn1 -3 1 2.5\nn2 400 0 0.125\nn3 0.5 -7 8\n") ==
        kExpected);
  // Four words for three columns name nothing.
  CHECK(read_points("a.txt", "# columns: x y z\n1 2.5 -3\n0 0.125 400\n-7 8 0.5\n") == kExpected);
}

TEST_CASE("The count line of a PTS file is checked and is no point") {
  CHECK(read_points("a.pts", "3\n1 2.5 -3 17 255 255 255\n0 0.125 400\n-7 8 0.5\n") == kExpected);
  CHECK(read_points("a.pts", "2\n1 2.5 -3\n0 0.125 400\n1\n-7 8 0.5\n") == kExpected);
  CHECK_THROWS_AS(read_points("a.pts", "4\n1 2.5 -3\n0 0.125 400\n-7 8 0.5 9 9 9 9\n"), IoError);
  CHECK_THROWS_AS(read_points("a.pts", "2\n1 2.5 -3\n0 0.125 400\n-7 8 0.5\n"), IoError);
  CHECK_THROWS_AS(read_points("a.pts", "999999999999\n1 2.5 -3\n"), IoError);
}

TEST_CASE("Decimal commas are refused, never taken for columns") {
  CHECK_THROWS_AS(read_points("a.csv", "1,5;2,5;3,5\n4,5;5,5;6,5\n"), IoError);
  CHECK_THROWS_AS(read_points("a.txt", "1,5 2,5 3,5\n4,5 5,5 6,5\n"), IoError);
}

TEST_CASE("Numbers are read and written the same under a locale with decimal commas") {
  const test::TemporaryFolder folder;
  const TriangleMesh mesh{.positions = {{0.5, 1234567.25, 0}, {1, 0, 0}, {0, 1e-7, 0}},
                          .triangles = {{0, 1, 2}}};
  for (const char* name : {"a.ply", "a.obj", "a.off", "a.stl"}) {
    write_mesh(folder / name, mesh, {.ascii = true});
    const std::string plain = test::load(folder / name);
    const CommaLocale locale;
    write_mesh(folder / name, mesh, {.ascii = true});
    CHECK(test::load(folder / name) == plain);
    CHECK(read_mesh(folder / name) == mesh);
    CHECK(read_points("a.xyz", "1 2.5 -3\n0 0.125 400\n-7 8 0.5\n") == kExpected);
  }
}

TEST_CASE("parse_number reads the same double as strtod") {
  shapes::Random random(7);
  for (int i = 0; i < 20000; ++i) {
    std::string digits = random.bits() % 2 == 0 ? "-" : "";
    const auto count = 1 + random.bits() % 22;
    for (std::uint64_t k = 0; k < count; ++k) {
      digits += static_cast<char>('0' + random.bits() % 10);
      if (k == count / 2 && random.bits() % 4 != 0) digits += '.';
    }
    if (random.bits() % 4 == 0) {
      digits += "e" + std::to_string(static_cast<int>(random.bits() % 40) - 20);
    }
    CAPTURE(digits);
    const char* at = digits.data();
    double value = 0.0;
    REQUIRE(parse_number(at, digits.data() + digits.size(), value));
    CHECK(at == digits.data() + digits.size());
    CHECK(value == std::strtod(digits.c_str(), nullptr));
  }
}

TEST_CASE("parse_number takes a number beyond double for zero or infinity by its size") {
  const std::string zeros(400, '0');
  CHECK(value_of("1" + zeros + "e-5") == kInfinity);
  CHECK(value_of("-1" + zeros + ".5e-5") == -kInfinity);
  CHECK(value_of("0." + zeros + "1e5") == 0.0);
  CHECK(std::signbit(value_of("-0." + zeros + "1e+5")));
  CHECK(value_of(zeros + "1e999") == kInfinity);
  CHECK(value_of("1" + zeros + "e-999") == 0.0);
  CHECK(value_of("0." + zeros + "1e999") == kInfinity);
  CHECK(value_of("1e99999999999999999999") == kInfinity);
  CHECK(value_of("1e-99999999999999999999") == 0.0);
  CHECK(value_of("100e9223372036854775807") == kInfinity);
  CHECK(value_of("0e99999999999999999999") == 0.0);
}

TEST_CASE("parse_number knows the edges of what a number is") {
  CHECK(value_of("+1.5") == 1.5);
  CHECK(std::signbit(value_of("-0")));
  CHECK(value_of(".5") == 0.5);
  CHECK(value_of("5.") == 5.0);
  CHECK(value_of("1e999") == kInfinity);
  CHECK(value_of("-1e999") == -kInfinity);
  CHECK(value_of("1e-999") == 0.0);
  CHECK(value_of("0." + std::string(400, '0') + "1") == 0.0);
  CHECK(value_of(std::string(400, '9')) == kInfinity);
  CHECK(value_of("-inf") == -kInfinity);
  CHECK(std::isnan(value_of("NaN")));
  CHECK(value_of("18446744073709551616") == 18446744073709551616.0);
  for (const std::string text :
       {"", "-", "+", ".", "abc", "1.5x", "--1", "+-1", "1,5", "0x10", "1e"}) {
    CAPTURE(text);
    const char* at = text.data();
    double value = 0.0;
    CHECK_FALSE(parse_number(at, text.data() + text.size(), value));
    CHECK(at == text.data());
  }
}

}  // namespace rangezip

#include <bit>
#include <catch2/catch.hpp>
#include <cmath>
#include <cstring>
#include <limits>
#include <random>
#include <string>
#include <vector>

#include "core/base/error.h"
#include "core/io/input_file.h"
#include "core/io/mesh_file.h"
#include "tests/core/io/temporary_folder.h"

namespace rangezip {
namespace {

using test::TemporaryFolder;

template <class T>
void append(std::string& bytes, T value, bool is_big) {
  auto stored = std::bit_cast<std::array<char, sizeof(T)>>(value);
  if (is_big != (std::endian::native == std::endian::big)) {
    std::reverse(stored.begin(), stored.end());
  }
  bytes.append(stored.data(), stored.size());
}

/// A number as text or as bytes of the named type.
void append_as(std::string& bytes, const std::string& type, double value,
               const std::string& format) {
  if (format == "ascii") {
    bytes += std::to_string(static_cast<int>(value)) + " ";
    return;
  }
  const bool is_big = format == "binary_big_endian";
  if (type == "char" || type == "int8") append(bytes, static_cast<std::int8_t>(value), is_big);
  if (type == "uchar" || type == "uint8") append(bytes, static_cast<std::uint8_t>(value), is_big);
  if (type == "short" || type == "int16") append(bytes, static_cast<std::int16_t>(value), is_big);
  if (type == "ushort" || type == "uint16") {
    append(bytes, static_cast<std::uint16_t>(value), is_big);
  }
  if (type == "int" || type == "int32") append(bytes, static_cast<std::int32_t>(value), is_big);
  if (type == "uint" || type == "uint32") append(bytes, static_cast<std::uint32_t>(value), is_big);
  if (type == "float" || type == "float32") append(bytes, static_cast<float>(value), is_big);
  if (type == "double" || type == "float64") append(bytes, value, is_big);
}

const std::vector<std::string> kTypes{"char",  "uchar",  "short",   "ushort", "int",   "uint",
                                      "float", "double", "int8",    "uint8",  "int16", "uint16",
                                      "int32", "uint32", "float32", "float64"};
const std::vector<std::string> kFormats{"ascii", "binary_little_endian", "binary_big_endian"};

const std::vector<Vec3> kPoints{{0, 1, 2}, {3, 0, 1}, {5, 7, 0}, {1, 6, 4}};

}  // namespace

TEST_CASE("read_input takes PLY coordinates of every type, in any order, in every encoding") {
  const TemporaryFolder folder;
  const std::string format = GENERATE(from_range(kFormats));
  CAPTURE(format);
  for (unsigned seed = 0; seed < 40; ++seed) {
    CAPTURE(seed);
    std::minstd_rand random(seed);
    const auto any_type = [&] { return kTypes[random() % kTypes.size()]; };
    struct Property {
      std::string name, type, count_type;
    };
    std::vector<Property> properties{{"x", any_type(), ""},
                                     {"y", any_type(), ""},
                                     {"z", any_type(), ""},
                                     {"red", any_type(), ""}};
    if (seed % 2 == 1) properties.push_back({"neighbours", any_type(), kTypes[random() % 6]});
    for (std::size_t i = properties.size() - 1; i > 0; --i) {
      std::swap(properties[i], properties[random() % (i + 1)]);
    }
    std::string bytes = "ply\nformat " + format + " 1.0\nelement vertex 4\n";
    for (const Property& p : properties) {
      bytes += "property " + (p.count_type.empty() ? "" : "list " + p.count_type + " ") + p.type +
               " " + p.name + "\n";
    }
    bytes += "end_header\n";
    for (std::size_t i = 0; i < kPoints.size(); ++i) {
      for (const Property& p : properties) {
        if (p.name.size() == 1) {
          append_as(bytes, p.type, kPoints[i][p.name[0] - 'x'], format);
        } else if (p.count_type.empty()) {
          append_as(bytes, p.type, 9, format);
        } else {
          append_as(bytes, p.count_type, static_cast<double>(i), format);
          for (std::size_t k = 0; k < i; ++k)
            append_as(bytes, p.type, 8, format);
        }
      }
      if (format == "ascii") bytes += "\n";
    }
    const InputFile input = read_input(folder.store("a.ply", bytes));
    REQUIRE(input.items.size() == 1);
    REQUIRE(input.items[0].cloud);
    CHECK(input.reports[0].points == 4);
    CHECK(input.reports[0].format == "ply " + format);
    for (std::size_t i = 0; i < kPoints.size(); ++i) {
      const Vec3 p(input.items[0].world_from_item *
                   Vec4(Vec3(input.items[0].cloud->positions[i]), 1.0));
      CHECK(p == kPoints[i]);
    }
  }
}

TEST_CASE("Binary points that are not finite are left out wherever they stand") {
  const TemporaryFolder folder;
  const std::string type = GENERATE("float", "double");
  constexpr int kCount = 2000;  // several blocks of the reader
  for (const int bad : {-1, 0, 511, 512, 1999}) {
    CAPTURE(type, bad);
    std::string bytes = "ply\nformat binary_little_endian 1.0\nelement vertex " +
                        std::to_string(kCount) + "\nproperty " + type + " x\nproperty " + type +
                        " y\nproperty uchar r\nproperty " + type + " z\nend_header\n";
    std::vector<Vec3> expected;
    for (int i = 0; i < kCount; ++i) {
      const Vec3 p{0.25 * (i % 7), 0.5 * (i % 11),
                   i == bad ? std::numeric_limits<double>::quiet_NaN() : 0.125 * (i % 5)};
      append_as(bytes, type, p.x, "binary_little_endian");
      append_as(bytes, type, p.y, "binary_little_endian");
      bytes += 'r';
      append_as(bytes, type, p.z, "binary_little_endian");
      if (i != bad) expected.push_back(p);
    }
    const InputFile input = read_input(folder.store("a.ply", bytes));
    CHECK(input.reports[0].nonfinite_points == (bad < 0 ? 0 : 1));
    const auto& positions = input.items.at(0).cloud->positions;
    REQUIRE(positions.size() == expected.size());
    const Vec3 origin = input.reports[0].origin;
    for (std::size_t i = 0; i < expected.size(); ++i) {
      REQUIRE(Vec3(positions[i]) + origin == expected[i]);
    }
  }
}

TEST_CASE("write_mesh and read_mesh give back every bit of a PLY mesh") {
  const TemporaryFolder folder;
  const bool ascii = GENERATE(false, true);
  std::minstd_rand random(1);
  TriangleMesh mesh;
  for (int i = 0; i < 1000; ++i) {
    const auto any = [&] {
      return std::ldexp(static_cast<double>(random()), static_cast<int>(random() % 100) - 80) / 3.0;
    };
    mesh.positions.push_back({any(), -any(), any()});
  }
  for (std::uint32_t i = 0; i + 2 < 1000; ++i)
    mesh.triangles.push_back({i, i + 1, i + 2});
  write_mesh(folder / "m.ply", mesh, {.ascii = ascii});
  CHECK(read_mesh(folder / "m.ply") == mesh);
  CHECK(folder.count() == 1);
}

}  // namespace rangezip

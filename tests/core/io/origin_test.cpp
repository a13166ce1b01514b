#include <catch2/catch.hpp>
#include <cmath>
#include <limits>
#include <string>
#include <vector>

#include "core/io/byte_order.h"
#include "core/io/input_file.h"
#include "core/io/local_origin.h"
#include "core/io/mesh_file.h"
#include "tests/core/io/temporary_folder.h"
#include "tests/support/shapes.h"

namespace rangezip {
namespace {

using test::TemporaryFolder;

const Vec3 kShift{636763, 851298, 415};  // of a map grid

/// A PLY cloud with doubles as text.
std::string ply_of(const std::vector<Vec3>& points) {
  std::string text = "ply\nformat ascii 1.0\nelement vertex " + std::to_string(points.size()) +
                     "\nproperty double x\nproperty double y\nproperty double z\nend_header\n";
  char line[100];
  for (const Vec3& p : points) {
    std::snprintf(line, sizeof line, "%.17g %.17g %.17g\n", p.x, p.y, p.z);
    text += line;
  }
  return text;
}

/// The same, little-endian.
std::string binary_ply_of(const std::vector<Vec3>& points) {
  std::string bytes = "ply\nformat binary_little_endian 1.0\nelement vertex " +
                      std::to_string(points.size()) +
                      "\nproperty double x\nproperty double y\nproperty double z\nend_header\n";
  for (const Vec3& p : points) {
    for (int axis = 0; axis < 3; ++axis) {
      const auto number = little_bytes(p[axis]);
      bytes.append(number.data(), number.size());
    }
  }
  return bytes;
}

/// Points of a box of the given size, all floats.
std::vector<Vec3> cloud(std::uint64_t seed, const Vec3& center, double size) {
  shapes::Random random(seed);
  std::vector<Vec3> points;
  for (int i = 0; i < 5000; ++i) {
    const Vec3 p{random.between(-0.5, 0.5), random.between(-0.5, 0.5), random.between(-0.5, 0.5)};
    points.emplace_back(Vec3f(center + size * p));
  }
  return points;
}

}  // namespace

TEST_CASE("A cloud moved by whole units gets the moved origin and the same local floats") {
  const TemporaryFolder folder;
  for (const double size : {0.2, 1.0, 7.5, 120.0}) {
    for (const Vec3& center : {Vec3{0.0}, Vec3{0.5}, Vec3{-0.1, 15.2, 3.5}}) {
      CAPTURE(size, center.x, center.y, center.z);
      const std::vector<Vec3> points = cloud(1, center, size);
      std::vector<Vec3> moved = points;
      for (Vec3& p : moved)
        p += kShift;
      const InputFile here = read_input(folder.store("a.ply", ply_of(points)));
      const InputFile there = read_input(folder.store("b.ply", ply_of(moved)));
      CHECK(there.reports[0].origin == here.reports[0].origin + kShift);
      const auto& local = here.items[0].cloud->positions;
      const auto& moved_local = there.items[0].cloud->positions;
      // The sum of point and shift is rounded to the double's step at 851298, 2^-33, half of which
      // is the most that it is off; that moves a float to its neighbour at most.
      std::size_t different = 0;
      for (std::size_t i = 0; i < points.size(); ++i) {
        for (int axis = 0; axis < 3; ++axis) {
          if (local[i][axis] == moved_local[i][axis]) continue;
          ++different;
          const double error = std::abs(Vec3(local[i])[axis] - Vec3(moved_local[i])[axis]);
          const double ulp = std::abs(std::nextafter(local[i][axis], 1e9F) - local[i][axis]);
          CHECK(error <= std::max(ulp, 0x1p-34));
        }
      }
      CHECK(different < points.size() / 20);
    }
  }
}

TEST_CASE("Large coordinates keep a millionth of the size of the data") {
  const TemporaryFolder folder;
  std::vector<Vec3> points = cloud(2, {0, 0, 0}, 0.1);
  for (Vec3& p : points)
    p += kShift;
  const InputFile input = read_input(folder.store("a.ply", ply_of(points)));
  const InputItem& item = input.items[0];
  for (std::size_t i = 0; i < points.size(); ++i) {
    const Vec3 p(item.world_from_item * Vec4(Vec3(item.cloud->positions[i]), 1.0));
    CHECK(glm::length(p - points[i]) < 1e-7 * 0.1 + 1e-9);  // and the step of doubles out there
  }
}

TEST_CASE("Data near zero keep the origin 0 and every bit of their floats") {
  const TemporaryFolder folder;
  const std::vector<Vec3> points = cloud(3, {0.02, 0.1, -0.01}, 0.25);
  const InputFile input = read_input(folder.store("a.ply", ply_of(points)));
  CHECK(input.reports[0].origin == Vec3{0.0});
  for (std::size_t i = 0; i < points.size(); ++i) {
    CHECK(Vec3(input.items[0].cloud->positions[i]) == points[i]);
  }
}

TEST_CASE("The positions at multiples of the stride decide the origin") {
  shapes::Random random(6);
  for (const std::size_t count : {1U, 7U, 4095U, 4096U, 4097U, 8192U, 8193U, 50000U}) {
    CAPTURE(count);
    LocalOrigin of_all;
    LocalOrigin of_some;
    const std::size_t stride = LocalOrigin::stride_of(count);
    for (std::size_t i = 0; i < count; ++i) {
      // Most others are far away: had they a say, the origin would be there.
      const Vec3 p = i % stride == 0 ? kShift + random.direction() : Vec3{-1e7};
      of_all.add(p);
      if (i % stride == 0) of_some.add(p);
    }
    CHECK(of_all.origin() == of_some.origin());
    CHECK(glm::length(of_all.origin() - kShift) < 2.0);
  }
}

TEST_CASE("Binary and text of the same points have the same origin and local floats") {
  const TemporaryFolder folder;
  for (const bool is_shifted : {false, true}) {
    CAPTURE(is_shifted);
    std::vector<Vec3> points = cloud(5, {0, 0, 0}, 0.7);
    // Every second position decides: those at kShift.
    for (std::size_t i = 0; i < points.size(); ++i)
      points[i] += i % 2 == 0 ? kShift : -kShift;
    // One that does not count, and the others decide, which cannot be foreseen.
    if (is_shifted) points[0].y = std::numeric_limits<double>::quiet_NaN();
    const InputFile text = read_input(folder.store("a.ply", ply_of(points)));
    const InputFile binary = read_input(folder.store("b.ply", binary_ply_of(points)));
    CHECK(binary.reports[0].origin == text.reports[0].origin);
    const Vec3 expected = is_shifted ? -kShift : kShift;
    CHECK(glm::length(binary.reports[0].origin - expected) < 1.0);
    CHECK(binary.items[0].cloud->positions == text.items[0].cloud->positions);
  }
}

TEST_CASE("A few strays, however far, do not pull the origin away") {
  LocalOrigin origin;
  shapes::Random random(4);
  for (int i = 0; i < 100000; ++i) {
    origin.add(i % 1000 == 7 ? Vec3{1e9} : Vec3{random.between(-1, 1), random.unit(), 0.0});
  }
  CHECK(glm::length(origin.origin()) <= 2.0);
}

TEST_CASE("The origin of a single place and of nothing is near it") {
  CHECK(LocalOrigin().origin() == Vec3{0.0});
  LocalOrigin one;
  for (int i = 0; i < 10; ++i)
    one.add({1e6 + 0.25, -3.0, 0.0});
  CHECK(glm::length(one.origin() - Vec3{1e6 + 0.25, -3.0, 0.0}) <= 1.0);
}

TEST_CASE("Meshes far away keep their doubles when read as meshes") {
  const TemporaryFolder folder;
  TriangleMesh mesh{.positions = {kShift, kShift + Vec3{1e-9, 0, 0}, kShift + Vec3{0, 1, 0}},
                    .triangles = {{0, 1, 2}}};
  write_mesh(folder / "a.ply", mesh);
  CHECK(read_mesh(folder / "a.ply") == mesh);
}

}  // namespace rangezip

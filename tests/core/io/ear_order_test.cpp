#include <algorithm>
#include <catch2/catch.hpp>
#include <cmath>
#include <numeric>
#include <optional>
#include <vector>

#include "core/io/corner_tree.h"
#include "core/io/split_polygon.h"
#include "tests/support/shapes.h"

namespace rangezip {
namespace {

std::vector<Triangle> split(const std::vector<Vec2>& outline) {
  std::vector<Vec3> positions;
  for (const Vec2& p : outline)
    positions.emplace_back(p, 0.0);
  std::vector<std::uint32_t> polygon(positions.size());
  std::iota(polygon.begin(), polygon.end(), 0U);
  std::vector<Triangle> triangles;
  split_polygon(polygon, positions, triangles);
  return triangles;
}

bool is_inside(const Vec2& a, const Vec2& b, const Vec2& c, const Vec2& p) {
  if (p == a || p == b || p == c) return false;
  return turn(a, b, p) >= 0.0 && turn(b, c, p) >= 0.0 && turn(c, a, p) >= 0.0;
}

/// Of a polygon that turns left and is not convex, by looking at all corners: the first ear from
/// the corner before the last one on or, if there is none, that corner itself.
std::vector<Triangle> split_by_looking_at_all(const std::vector<Vec2>& flat) {
  std::vector<std::uint32_t> outline(flat.size());
  std::iota(outline.begin(), outline.end(), 0U);
  std::vector<Triangle> triangles;
  const auto emit = [&](const Triangle& t) {
    if (flat[t[0]] != flat[t[1]] && flat[t[1]] != flat[t[2]] && flat[t[2]] != flat[t[0]])
      triangles.push_back(t);
  };
  const auto ear_at = [&](std::size_t i) {
    const std::size_t n = outline.size();
    return Triangle{outline[(i + n - 1) % n], outline[i], outline[(i + 1) % n]};
  };
  const auto is_ear = [&](const Triangle& t) {
    const Vec2 &a = flat[t[0]], &b = flat[t[1]], &c = flat[t[2]];
    return !(turn(a, b, c) <= 0.0) &&
           std::none_of(outline.begin(), outline.end(),
                        [&](std::uint32_t i) { return is_inside(a, b, c, flat[i]); });
  };
  std::size_t start = 0;
  while (outline.size() > 3) {
    std::size_t ear = start;
    for (std::size_t step = 0; step < outline.size(); ++step) {
      const std::size_t i = (start + step) % outline.size();
      if (!is_ear(ear_at(i))) continue;
      ear = i;
      break;
    }
    emit(ear_at(ear));
    outline.erase(outline.begin() + static_cast<std::ptrdiff_t>(ear));
    start = ear == 0 ? 0 : ear - 1;
  }
  emit({outline[0], outline[1], outline[2]});
  return triangles;
}

double area_of(const std::vector<Vec2>& outline) {
  double sum = 0.0;
  for (std::size_t i = 0; i < outline.size(); ++i)
    sum += turn({0, 0}, outline[i], outline[(i + 1) % outline.size()]);
  return sum;
}

/// Turned so that it is the counter-clockwise one that is cut.
std::vector<Vec2> leftward(std::vector<Vec2> outline) {
  if (area_of(outline) < 0.0) std::reverse(outline.begin(), outline.end());
  return outline;
}

std::vector<Vec2> star(std::uint64_t seed, int corners, double least_radius) {
  shapes::Random random(seed);
  std::vector<Vec2> outline;
  for (int i = 0; i < corners; ++i) {
    const double angle = 2.0 * std::numbers::pi * i / corners;
    const double radius = random.between(least_radius, 1.0);
    outline.emplace_back(radius * std::cos(angle), radius * std::sin(angle));
  }
  return outline;
}

/// Crosses itself very often; on a lattice many corners coincide or lie on one line.
std::vector<Vec2> tangle(std::uint64_t seed, int corners, double steps) {
  shapes::Random random(seed);
  std::vector<Vec2> outline;
  for (int i = 0; i < corners; ++i) {
    const double x = random.between(0.0, 1.0);
    outline.emplace_back(x, random.between(0.0, 1.0));
    if (steps > 0.0) outline.back() = glm::floor(outline.back() * steps);
  }
  return outline;
}

std::vector<Vec2> spiral(int corners) {
  std::vector<Vec2> outline;
  const int half = corners / 2;
  for (int i = 0; i < 2 * half; ++i) {
    const double angle = 0.05 * (i < half ? i : 2 * half - 1 - i);
    const double radius = angle + (i < half ? 3.0 : 1.0);
    outline.emplace_back(radius * std::cos(angle), radius * std::sin(angle));
  }
  return outline;
}

std::vector<Vec2> comb(int corners) {
  std::vector<Vec2> outline;
  const int half = corners / 2;
  for (int i = 0; i < half; ++i)
    outline.emplace_back(i, i % 2 == 1 ? -1.0 : 4.0);
  for (int i = half - 1; i >= 0; --i)
    outline.emplace_back(i, i % 2 == 1 ? 0.0 : 5.0);
  return outline;
}

/// Slanted sides with many corners on each, which are on one line but for rounding.
std::vector<Vec2> finely_cut(const std::vector<Vec2>& outline, int pieces) {
  std::vector<Vec2> fine;
  for (std::size_t i = 0; i < outline.size(); ++i) {
    for (int k = 0; k < pieces; ++k)
      fine.push_back(glm::mix(outline[i], outline[(i + 1) % outline.size()], double(k) / pieces));
  }
  return fine;
}

TEST_CASE("Ears are taken in the order in which looking at all corners takes them") {
  const auto check = [](const std::vector<Vec2>& outline) {
    const std::vector<Vec2> left = leftward(outline);
    CHECK(split(left) == split_by_looking_at_all(left));
  };
  for (std::uint64_t seed = 0; seed < 20; ++seed) {
    CAPTURE(seed);
    check(star(seed, 10 + 17 * static_cast<int>(seed), 0.1));
    check(star(seed, 300, 0.9));
    check(finely_cut(star(seed, 20, 0.2), 9));
    check(tangle(seed, 5 + 6 * static_cast<int>(seed), 0.0));
    check(tangle(seed, 60, 6.0));
    check(tangle(seed, 150, 20.0));
  }
  check(spiral(500));
  check(comb(500));
}

TEST_CASE("The corner tree finds a corner in a triangle exactly when there is one left") {
  const double steps = GENERATE(0.0, 5.0, 30.0);
  CAPTURE(steps);
  constexpr std::uint64_t kSeed = 3;
  const std::vector<Vec2> places = tangle(kSeed, 700, steps);
  CornerTree tree(places);
  std::vector<bool> is_left(places.size(), true);
  shapes::Random random(kSeed);
  int found = 0, none = 0;
  for (std::size_t removed = 0; removed < places.size(); ++removed) {
    const auto corner = [&] { return places[random.bits() % places.size()]; };
    const Vec2 a = corner(), c = corner();
    const Vec2 b = removed % 2 == 0 ? corner() : glm::mix(a, c, 0.3);
    const auto inside = tree.find_inside(a, b, c);
    bool expected = false;
    for (std::size_t i = 0; i < places.size(); ++i)
      expected = expected || (is_left[i] && is_inside(a, b, c, places[i]));
    CHECK(inside.has_value() == expected);
    if (inside) CHECK((is_left[*inside] && is_inside(a, b, c, places[*inside])));
    ++(inside ? found : none);
    tree.remove(removed);
    is_left[removed] = false;
  }
  CHECK(found > 50);
  CHECK(none > 50);
}

TEST_CASE("Outlines of very many corners are covered once by their ears") {
  for (const auto& outline : {star(1, 30000, 0.5), spiral(30000), comb(30000)}) {
    const std::vector<Vec2> left = leftward(outline);
    const std::vector<Triangle> triangles = split(left);
    CHECK(triangles.size() == outline.size() - 2);
    const double area = std::abs(area_of(outline));
    double sum = 0.0;
    std::size_t turned = 0;
    for (const Triangle& t : triangles) {
      const double size = turn(left[t[0]], left[t[1]], left[t[2]]);
      sum += size;
      if (size < 0.0) ++turned;
    }
    CHECK(turned == 0);
    CHECK(std::abs(sum - area) < 1e-9 * area);
  }
}

}  // namespace
}  // namespace rangezip

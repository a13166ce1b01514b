#pragma once

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <numbers>
#include <span>
#include <stdexcept>
#include <utility>
#include <vector>

#include "core/mesh/triangle_mesh.h"
#include "core/scene/scene.h"

/// Bodies whose right answer is known, as welded polygons (closed ones are closed, oriented
/// outward), and clouds drawn from them.
namespace rangezip::shapes {

/// A small generator with the same sequence everywhere (splitmix64).
class Random {
 public:
  explicit Random(std::uint64_t seed) : state_(seed) {}

  std::uint64_t bits() {
    std::uint64_t z = state_ += 0x9e37'79b9'7f4a'7c15U;
    z = (z ^ (z >> 30U)) * 0xbf58'476d'1ce4'e5b9U;
    z = (z ^ (z >> 27U)) * 0x94d0'49bb'1331'11ebU;
    return z ^ (z >> 31U);
  }
  /// In [0, 1).
  double unit() { return static_cast<double>(bits() >> 11U) / 9007199254740992.0; }
  double between(double lower, double upper) { return lower + (upper - lower) * unit(); }
  /// Mean 0, deviation 1, bell-shaped, within 6.
  double normal() {
    double sum = -6.0;
    for (int i = 0; i < 12; ++i)
      sum += unit();
    return sum;
  }
  /// Evenly on the unit sphere.
  Vec3 direction() {
    for (;;) {
      const Vec3 v{between(-1, 1), between(-1, 1), between(-1, 1)};
      const double squared = glm::dot(v, v);
      if (squared > 1e-6 && squared <= 1.0) return v / std::sqrt(squared);
    }
  }

 private:
  std::uint64_t state_;
};

inline void add_quad(TriangleSoup& soup, std::uint32_t a, std::uint32_t b, std::uint32_t c,
                     std::uint32_t d) {
  soup.triangles.push_back({a, b, c});
  soup.triangles.push_back({a, c, d});
}

/// A square sheet in z = 0 about the origin, of so many squares of side 1 along each side, looking
/// along z.
inline TriangleMesh square_sheet(std::uint32_t squares) {
  TriangleMesh mesh;
  const double half = 0.5 * squares;
  for (std::uint32_t i = 0; i <= squares; ++i) {
    for (std::uint32_t k = 0; k <= squares; ++k) {
      mesh.positions.emplace_back(i - half, k - half, 0.0);
      if (i == 0 || k == 0) continue;
      const std::uint32_t d = i * (squares + 1) + k, b = d - (squares + 1);
      mesh.triangles.push_back({b - 1, d - 1, d});
      mesh.triangles.push_back({b - 1, d, b});
    }
  }
  return mesh;
}

/// A surface of revolution about z. The profile (radius, z) has its outside to the right as one
/// walks along it with the radius to the right and z up; points of radius 0 become one vertex. A
/// `closed` profile returns to its start.
inline TriangleSoup revolved(std::span<const Vec2> profile, bool closed, int segments = 96) {
  TriangleSoup soup;
  std::vector<std::uint32_t> first;  // vertex of each profile point at angle 0
  const auto n = static_cast<std::uint32_t>(segments);
  for (const Vec2& p : profile) {
    first.push_back(static_cast<std::uint32_t>(soup.positions.size()));
    for (std::uint32_t s = 0; s < (p.x == 0.0 ? 1U : n); ++s) {
      const double angle = 2.0 * std::numbers::pi * s / segments;
      soup.positions.emplace_back(p.x * std::cos(angle), p.x * std::sin(angle), p.y);
    }
  }
  for (std::size_t i = 0; i + (closed ? 0U : 1U) < profile.size(); ++i) {
    const std::size_t j = (i + 1) % profile.size();
    const bool pole_i = profile[i].x == 0.0;
    const bool pole_j = profile[j].x == 0.0;
    for (std::uint32_t s = 0; s < n; ++s) {
      const std::uint32_t t = (s + 1) % n;
      const std::uint32_t a = first[i] + (pole_i ? 0 : s);
      const std::uint32_t b = first[i] + (pole_i ? 0 : t);
      const std::uint32_t c = first[j] + (pole_j ? 0 : t);
      const std::uint32_t d = first[j] + (pole_j ? 0 : s);
      if (pole_i && pole_j) continue;
      if (pole_i) soup.triangles.push_back({a, c, d});
      if (pole_j) soup.triangles.push_back({a, b, c});
      if (!pole_i && !pole_j) add_quad(soup, a, b, c, d);
    }
  }
  return soup;
}

/// Points of an arc about (0, 0) of the profile plane from polar angle `from` to `to`, measured
/// from the -z axis; exact on the axis.
inline std::vector<Vec2> arc(double radius, double from, double to, int steps) {
  std::vector<Vec2> points;
  for (int i = 0; i <= steps; ++i) {
    const double angle = from + (to - from) * i / steps;
    const bool on_axis = std::abs(std::sin(angle)) < 1e-12;
    points.emplace_back(on_axis ? 0.0 : radius * std::sin(angle), -radius * std::cos(angle));
  }
  return points;
}

inline TriangleSoup sphere(double radius = 1.0, int rings = 64) {
  return revolved(arc(radius, 0.0, std::numbers::pi, rings), false, 2 * rings);
}

/// The upper half of a sphere as an open sheet: one boundary loop.
inline TriangleSoup bowl(double radius = 1.0, int rings = 32) {
  return revolved(arc(radius, 0.5 * std::numbers::pi, std::numbers::pi, rings), false, 4 * rings);
}

/// A hemispherical shell of the given thickness with a flat rim; closed, genus 0.
inline TriangleSoup shell(double thickness, double radius = 1.0, int rings = 32) {
  std::vector<Vec2> profile = arc(radius, 0.5 * std::numbers::pi, std::numbers::pi, rings);
  const std::vector<Vec2> inner =
      arc(radius - thickness, std::numbers::pi, 0.5 * std::numbers::pi, rings);
  profile.insert(profile.end(), inner.begin(), inner.end());
  // From the inner rim back to the outer one.
  profile.push_back(profile.front());
  TriangleSoup soup = revolved(profile, false, 4 * rings);
  // The last ring repeats the first: join them.
  const auto n = static_cast<std::uint32_t>(4 * rings);
  const auto last = static_cast<std::uint32_t>(soup.positions.size()) - n;
  for (Triangle& triangle : soup.triangles) {
    for (std::uint32_t& corner : triangle) {
      if (corner >= last) corner -= last;
    }
  }
  soup.positions.resize(last);
  return soup;
}

/// Two flat cones on one another, whose rim is cut off so far inside; closed. The profile has
/// points 1 apart.
inline TriangleSoup double_cone(double radius, double slope, double cut_off, int segments) {
  std::vector<Vec2> profile;
  const double end = radius - cut_off;
  for (double r = 0.0; r < end; r += 1.0)
    profile.emplace_back(r, -slope * (radius - r));
  const std::size_t inner = profile.size();
  profile.emplace_back(end, -slope * cut_off);
  if (cut_off > 0.0) profile.emplace_back(end, slope * cut_off);
  for (std::size_t i = inner; i-- > 0;)
    profile.emplace_back(profile[i].x, -profile[i].y);
  return revolved(profile, false, segments);
}

inline TriangleSoup torus(double radius = 1.0, double tube = 0.4, int segments = 128) {
  std::vector<Vec2> profile;
  const int around = segments / 2;
  for (int i = 0; i < around; ++i) {
    const double angle = 2.0 * std::numbers::pi * i / around;
    profile.emplace_back(radius + tube * std::cos(angle), tube * std::sin(angle));
  }
  return revolved(profile, true, segments);
}

/// A disc of the given outer radius and height with a round hole through it: genus 1, sharp edges.
inline TriangleSoup washer(double radius = 1.0, double hole = 0.4, double height = 0.5) {
  const std::vector<Vec2> profile{{radius, 0.0}, {radius, height}, {hole, height}, {hole, 0.0}};
  return revolved(profile, true);
}

/// A cylinder of radius 1 and height 2 whose top (z = 0) has a round pocket; closed, genus 0.
inline TriangleSoup pocket(double depth, double radius = 0.3) {
  const std::vector<Vec2> profile{{0.0, -2.0},   {1.0, -2.0},      {1.0, 0.0},
                                  {radius, 0.0}, {radius, -depth}, {0.0, -depth}};
  return revolved(profile, false);
}

inline TriangleSoup box(const Vec3& lower, const Vec3& upper) {
  TriangleSoup soup;
  for (unsigned i = 0; i < 8; ++i) {
    soup.positions.emplace_back((i & 1U) != 0 ? upper.x : lower.x,
                                (i & 2U) != 0 ? upper.y : lower.y,
                                (i & 4U) != 0 ? upper.z : lower.z);
  }
  add_quad(soup, 0, 2, 3, 1);
  add_quad(soup, 4, 5, 7, 6);
  add_quad(soup, 0, 1, 5, 4);
  add_quad(soup, 2, 6, 7, 3);
  add_quad(soup, 0, 4, 6, 2);
  add_quad(soup, 1, 3, 7, 5);
  return soup;
}

inline TriangleSoup cube(double half_side = 1.0) {
  return box(Vec3(-half_side), Vec3(half_side));
}

/// 2 x 2 x `thickness`.
inline TriangleSoup plate(double thickness) {
  return box({-1.0, -1.0, -0.5 * thickness}, {1.0, 1.0, 0.5 * thickness});
}

/// A tube along the trefoil knot, which fits into a box of about 6 x 6 x 2.7; closed, genus 1.
inline TriangleSoup trefoil(double tube = 0.35, int along = 600, int around = 48) {
  const auto curve = [](double t) {
    return Vec3{std::sin(t) + 2.0 * std::sin(2.0 * t), std::cos(t) - 2.0 * std::cos(2.0 * t),
                -std::sin(3.0 * t)};
  };
  TriangleSoup soup;
  for (int i = 0; i < along; ++i) {
    const double t = 2.0 * std::numbers::pi * i / along;
    const Vec3 tangent = glm::normalize(curve(t + 1e-4) - curve(t - 1e-4));
    const Vec3 side = glm::normalize(glm::cross(tangent, Vec3{0.3, 0.2, 1.0}));
    const Vec3 up = glm::cross(tangent, side);
    for (int j = 0; j < around; ++j) {
      const double angle = 2.0 * std::numbers::pi * j / around;
      soup.positions.emplace_back(curve(t) +
                                  tube * (std::cos(angle) * side + std::sin(angle) * up));
    }
  }
  const auto at = [&](int i, int j) {
    return static_cast<std::uint32_t>((i % along) * around + j % around);
  };
  for (int i = 0; i < along; ++i) {
    for (int j = 0; j < around; ++j) {
      add_quad(soup, at(i, j), at(i, j + 1), at(i + 1, j + 1), at(i + 1, j));
    }
  }
  return soup;
}

inline TriangleSoup moved(TriangleSoup soup, const Mat4& placement) {
  for (Vec3f& p : soup.positions)
    p = Vec3f(Vec3(placement * Vec4(Vec3(p), 1.0)));
  return soup;
}

inline TriangleSoup merged(TriangleSoup a, const TriangleSoup& b) {
  const auto offset = static_cast<std::uint32_t>(a.positions.size());
  a.positions.insert(a.positions.end(), b.positions.begin(), b.positions.end());
  for (const Triangle& t : b.triangles) {
    a.triangles.push_back({t[0] + offset, t[1] + offset, t[2] + offset});
  }
  return a;
}

inline Mat4 translation(const Vec3& by) {
  Mat4 m{1.0};
  m[3] = Vec4(by, 1.0);
  return m;
}

/// Points on the slices z = (i + 0.5) step of that torus: circles, with a point in every `along`.
inline PointCloud sliced_torus(double radius, double tube, double step, double along,
                               std::uint64_t seed = 1) {
  PointCloud cloud;
  Random random(seed);
  for (double z = 0.5 * step - tube; z < tube; z += step) {
    for (const double side : {-1.0, 1.0}) {
      const double r = radius + side * std::sqrt(tube * tube - z * z);
      const int count = static_cast<int>(2.0 * std::numbers::pi * r / along);
      for (int i = 0; i < count; ++i) {
        const double angle = 2.0 * std::numbers::pi * (i + random.between(0.0, 1.0)) / count;
        cloud.positions.emplace_back(Vec3{r * std::cos(angle), r * std::sin(angle), z});
      }
    }
  }
  return cloud;
}

/// A rotation that leaves nothing parallel to an axis.
inline Mat4 tilt() {
  const double ca = std::cos(0.37);
  const double sa = std::sin(0.37);
  const double cb = std::cos(0.61);
  const double sb = std::sin(0.61);
  Mat4 about_z{1.0};
  about_z[0] = {ca, sa, 0.0, 0.0};
  about_z[1] = {-sa, ca, 0.0, 0.0};
  Mat4 about_x{1.0};
  about_x[1] = {0.0, cb, sb, 0.0};
  about_x[2] = {0.0, -sb, cb, 0.0};
  return about_x * about_z;
}

/// Two unit spheres side by side, `gap` apart.
inline TriangleSoup two_spheres(double gap, int rings = 64) {
  return merged(moved(sphere(1.0, rings), translation({-1.0 - 0.5 * gap, 0.0, 0.0})),
                moved(sphere(1.0, rings), translation({1.0 + 0.5 * gap, 0.0, 0.0})));
}

inline double area_of(const TriangleSoup& soup) {
  double area = 0.0;
  for (const Triangle& t : soup.triangles) {
    area += 0.5 * glm::length(area_vector(Vec3(soup.positions[t[0]]), Vec3(soup.positions[t[1]]),
                                          Vec3(soup.positions[t[2]])));
  }
  return area;
}

/// Points drawn at random, evenly by area, moved along the normal by bell-shaped noise.
inline PointCloud sampled(const TriangleSoup& soup, std::size_t count, std::uint64_t seed = 1,
                          double noise = 0.0) {
  std::vector<double> ends;  // of the triangles' areas laid end to end
  double area = 0.0;
  for (const Triangle& t : soup.triangles) {
    area += glm::length(area_vector(Vec3(soup.positions[t[0]]), Vec3(soup.positions[t[1]]),
                                    Vec3(soup.positions[t[2]])));
    ends.push_back(area);
  }
  if (!(area > 0.0)) throw std::logic_error("sampled: the shape has no area");
  Random random(seed);
  PointCloud cloud;
  cloud.positions.reserve(count);
  for (std::size_t i = 0; i < count; ++i) {
    const auto end = std::upper_bound(ends.begin(), ends.end() - 1, area * random.unit());
    const Triangle& t = soup.triangles[static_cast<std::size_t>(end - ends.begin())];
    const Vec3 a(soup.positions[t[0]]);
    const Vec3 b(soup.positions[t[1]]);
    const Vec3 c(soup.positions[t[2]]);
    double u = random.unit();
    double v = random.unit();
    if (u + v > 1.0) {
      u = 1.0 - u;
      v = 1.0 - v;
    }
    Vec3 p = a + u * (b - a) + v * (c - a);
    if (noise > 0.0) p += noise * random.normal() * glm::normalize(area_vector(a, b, c));
    cloud.positions.emplace_back(p);
  }
  return cloud;
}

inline std::vector<Vec3> to_points(const PointCloud& cloud) {
  return {cloud.positions.begin(), cloud.positions.end()};
}

inline TriangleMesh to_mesh(const TriangleSoup& soup) {
  return {.positions = {soup.positions.begin(), soup.positions.end()},
          .triangles = soup.triangles,
          .sources = {}};
}

}  // namespace rangezip::shapes

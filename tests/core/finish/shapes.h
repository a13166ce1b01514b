#pragma once

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <random>
#include <vector>

#include "core/mesh/triangle_mesh.h"

namespace rangezip::testing {

/// A uniform number in [lower, upper); the same on every machine.
inline double uniform(std::mt19937_64& engine, double lower, double upper) {
  constexpr double kUnit = 1.0 / 9007199254740992.0;  // 2^-53
  return lower + (upper - lower) * (static_cast<double>(engine() >> 11U) * kUnit);
}

/// The cube [-1, 1]^3 cut into n x n x 2 triangles a side, closed and oriented; corners of the
/// lattice are shared.
inline TriangleMesh cube(int n) {
  TriangleMesh mesh;
  std::vector<std::uint32_t> index(static_cast<std::size_t>((n + 1) * (n + 1) * (n + 1)),
                                   0xffff'ffffU);
  const auto vertex = [&](int x, int y, int z) {
    std::uint32_t& i = index[static_cast<std::size_t>((z * (n + 1) + y) * (n + 1) + x)];
    if (i == 0xffff'ffffU) {
      i = static_cast<std::uint32_t>(mesh.positions.size());
      mesh.positions.emplace_back(-1.0 + 2.0 * x / n, -1.0 + 2.0 * y / n, -1.0 + 2.0 * z / n);
    }
    return i;
  };
  for (int axis = 0; axis < 3; ++axis) {
    for (const int level : {0, n}) {
      for (int v = 0; v < n; ++v) {
        for (int u = 0; u < n; ++u) {
          const auto corner = [&](int i, int j) {
            int p[3];
            p[axis] = level;
            p[(axis + 1) % 3] = u + i;
            p[(axis + 2) % 3] = v + j;
            return vertex(p[0], p[1], p[2]);
          };
          std::uint32_t a = corner(0, 0), b = corner(1, 0), c = corner(1, 1), d = corner(0, 1);
          if (level == 0) std::swap(b, d);
          mesh.triangles.push_back({a, b, c});
          mesh.triangles.push_back({a, c, d});
        }
      }
    }
  }
  return mesh;
}

/// The unit sphere: the cube's lattice, evened out and pushed onto the sphere.
inline TriangleMesh sphere(int n) {
  TriangleMesh mesh = cube(n);
  for (Vec3& p : mesh.positions) {
    constexpr double kQuarterPi = 0.78539816339744830962;
    p = glm::normalize(
        Vec3(std::tan(kQuarterPi * p.x), std::tan(kQuarterPi * p.y), std::tan(kQuarterPi * p.z)));
  }
  return mesh;
}

/// Drops the triangles that have a corner where `inside` holds, and the corners nobody needs then.
template <class Inside>
void cut_where(TriangleMesh& mesh, Inside inside) {
  std::erase_if(mesh.triangles, [&](const Triangle& t) {
    return std::any_of(t.begin(), t.end(),
                       [&](std::uint32_t v) { return inside(mesh.positions[v]); });
  });
  remove_unused_vertices(mesh);
}

/// Adds another mesh, not joined.
inline void append(TriangleMesh& mesh, const TriangleMesh& other) {
  const auto first = static_cast<std::uint32_t>(mesh.positions.size());
  mesh.positions.insert(mesh.positions.end(), other.positions.begin(), other.positions.end());
  for (const auto& [a, b, c] : other.triangles)
    mesh.triangles.push_back({first + a, first + b, first + c});
}

/// The volume that a closed mesh encloses.
inline double volume_of(const TriangleMesh& mesh) {
  double six = 0.0;
  for (const Triangle& t : mesh.triangles) {
    six += glm::dot(mesh.positions[t[0]], glm::cross(mesh.positions[t[1]], mesh.positions[t[2]]));
  }
  return six / 6.0;
}

/// The smallest angle of all triangles, radians.
inline double smallest_angle(const TriangleMesh& mesh) {
  double smallest = 4.0;
  for (const Triangle& t : mesh.triangles) {
    for (std::size_t i = 0; i < 3; ++i) {
      const Vec3 a = glm::normalize(mesh.positions[t[(i + 1) % 3]] - mesh.positions[t[i]]);
      const Vec3 b = glm::normalize(mesh.positions[t[(i + 2) % 3]] - mesh.positions[t[i]]);
      smallest = std::min(smallest, std::acos(std::clamp(glm::dot(a, b), -1.0, 1.0)));
    }
  }
  return smallest;
}

/// A direction, uniform over the sphere.
inline Vec3 direction(std::mt19937_64& engine) {
  for (;;) {
    const Vec3 p{uniform(engine, -1, 1), uniform(engine, -1, 1), uniform(engine, -1, 1)};
    const double length = glm::length(p);
    if (length > 0.1 && length < 1.0) return p / length;
  }
}

/// A standard normal deviate, by the sum of twelve uniform ones.
inline double gaussian(std::mt19937_64& engine) {
  double sum = -6.0;
  for (int i = 0; i < 12; ++i)
    sum += uniform(engine, 0.0, 1.0);
  return sum;
}

/// Points of the unit sphere, `spacing` apart on average, moved by Gaussian noise.
inline std::vector<Vec3> sphere_points(double spacing, double noise, std::mt19937_64& engine) {
  constexpr double kArea = 12.566370614359172;
  std::vector<Vec3> points(static_cast<std::size_t>(kArea / (spacing * spacing)));
  for (Vec3& p : points) {
    p = direction(engine);
    p += noise * Vec3{gaussian(engine), gaussian(engine), gaussian(engine)};
  }
  return points;
}

}  // namespace rangezip::testing

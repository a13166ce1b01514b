#pragma once

#include <array>
#include <cstddef>
#include <fstream>
#include <stdexcept>
#include <string>
#include <vector>

/// Writes a mesh as OFF.
inline void write_off(const std::string& path, const std::vector<std::array<double, 3>>& points,
                      const std::vector<std::array<std::size_t, 3>>& faces) {
  std::ofstream out(path);
  out.precision(9);
  out << "OFF\n" << points.size() << ' ' << faces.size() << " 0\n";
  for (const auto& p : points)
    out << p[0] << ' ' << p[1] << ' ' << p[2] << '\n';
  for (const auto& f : faces)
    out << "3 " << f[0] << ' ' << f[1] << ' ' << f[2] << '\n';
  out.close();
  if (!out) throw std::runtime_error("cannot write " + path);
}

/// Reads lines of x y z.
inline std::vector<std::array<double, 3>> read_xyz(const std::string& path) {
  std::ifstream in(path);
  std::vector<std::array<double, 3>> points;
  for (std::array<double, 3> p{}; in >> p[0] >> p[1] >> p[2];)
    points.push_back(p);
  if (points.empty()) throw std::runtime_error("no points in " + path);
  return points;
}

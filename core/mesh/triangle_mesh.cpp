#include "core/mesh/triangle_mesh.h"

#include <algorithm>
#include <cmath>
#include <utility>

#include "core/base/curve_order.h"

namespace rangezip {
namespace {

template <class Value>
std::vector<Value> in_order(const std::vector<Value>& values,
                            const std::vector<std::uint32_t>& order) {
  std::vector<Value> ordered;
  ordered.reserve(values.size());
  if (values.empty()) return ordered;
  for (const std::uint32_t i : order)
    ordered.push_back(values[i]);
  return ordered;
}

void sort_by_first_vertex(std::vector<Triangle>& triangles) {
  std::vector<std::pair<std::uint32_t, std::uint32_t>> keys;
  keys.reserve(triangles.size());
  for (const auto& [a, b, c] : triangles)
    keys.emplace_back(std::min({a, b, c}), static_cast<std::uint32_t>(keys.size()));
  std::sort(keys.begin(), keys.end());
  std::vector<Triangle> sorted;
  sorted.reserve(triangles.size());
  for (const auto& [first, face] : keys)
    sorted.push_back(triangles[face]);
  triangles = std::move(sorted);
}

}  // namespace

Box bounds_of(const TriangleMesh& mesh) {
  Box bounds;
  for (const Vec3& p : mesh.positions)
    bounds.add(p);
  return bounds;
}

double longest_side(const TriangleMesh& mesh, const Triangle& triangle) {
  const Vec3& a = mesh.positions[triangle[0]];
  const Vec3& b = mesh.positions[triangle[1]];
  const Vec3& c = mesh.positions[triangle[2]];
  return std::sqrt(
      std::max({glm::dot(b - a, b - a), glm::dot(c - b, c - b), glm::dot(a - c, a - c)}));
}

double sampling_of(const TriangleMesh& mesh, const Triangle& triangle) {
  const double longest = longest_side(mesh, triangle);
  if (mesh.sources.empty()) return longest;
  double coarsest = 0.0;
  for (const std::uint32_t v : triangle) {
    const double sampling = mesh.sources[v].sampling;
    if (sampling == 0.0) return longest;
    coarsest = std::max(coarsest, sampling);
  }
  return std::min(longest, coarsest);
}

void remove_triangles(std::vector<Triangle>& triangles, const std::vector<std::uint8_t>& marked) {
  std::size_t kept = 0;
  for (std::size_t f = 0; f < triangles.size(); ++f) {
    if (marked[f] == 0) triangles[kept++] = triangles[f];
  }
  triangles.resize(kept);
}

void remove_vertices(TriangleMesh& mesh, const std::vector<std::uint8_t>& marked) {
  std::vector<std::uint32_t> new_index(mesh.positions.size());
  std::uint32_t next = 0;
  for (std::size_t i = 0; i < new_index.size(); ++i) {
    new_index[i] = next;
    if (marked[i] != 0) continue;
    mesh.positions[next] = mesh.positions[i];
    if (!mesh.sources.empty()) mesh.sources[next] = mesh.sources[i];
    ++next;
  }
  if (next == mesh.positions.size()) return;
  mesh.positions.resize(next);
  if (!mesh.sources.empty()) mesh.sources.resize(next);
  for (Triangle& triangle : mesh.triangles) {
    for (std::uint32_t& corner : triangle)
      corner = new_index[corner];
  }
}

void sort_along_curve(TriangleMesh& mesh) {
  const std::vector<std::uint32_t> order = order_along_curve(mesh.positions);
  mesh.positions = in_order(mesh.positions, order);
  mesh.sources = in_order(mesh.sources, order);
  std::vector<std::uint32_t> place(order.size());
  for (std::uint32_t i = 0; i < order.size(); ++i)
    place[order[i]] = i;
  for (Triangle& triangle : mesh.triangles) {
    for (std::uint32_t& corner : triangle)
      corner = place[corner];
  }
  sort_by_first_vertex(mesh.triangles);
}

void remove_unused_vertices(TriangleMesh& mesh) {
  std::vector<std::uint8_t> is_unused(mesh.positions.size(), 1);
  for (const Triangle& triangle : mesh.triangles) {
    for (const std::uint32_t corner : triangle)
      is_unused[corner] = 0;
  }
  remove_vertices(mesh, is_unused);
}

}  // namespace rangezip

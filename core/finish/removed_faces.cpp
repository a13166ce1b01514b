#include "core/finish/removed_faces.h"

#include <algorithm>
#include <numeric>
#include <unordered_set>

#include "core/mesh/coverage.h"
#include "core/mesh/self_intersection.h"

namespace rangezip {
namespace {

/// In h: less than what a fill closes over where it gives up a part of the surface, more than what
/// it cuts off the ragged rim of a hole.
constexpr double kStandsFor = 1.5;
/// Of the places: those of a corner, once rounds of widening have taken rings around it.
constexpr double kMayLose = 0.05;

EdgeMap edges_of(const std::vector<Triangle>& triangles) {
  EdgeMap edges(3 * triangles.size());
  for (std::uint32_t f = 0; f < triangles.size(); ++f) {
    for (std::size_t k = 0; k < 3; ++k)
      edges.insert(triangles[f][k], triangles[f][(k + 1) % 3], f);
  }
  return edges;
}

/// Whether a mesh has this face.
bool has_face(const CornerTable& table, const Triangle& face) {
  bool found = false;
  table.for_each_corner(face[0], [&](std::uint32_t c) {
    found = found || (table.vertex(CornerTable::next(c)) == face[1] &&
                      table.vertex(CornerTable::previous(c)) == face[2]);
  });
  return found;
}

}  // namespace

RemovedFaces::RemovedFaces(const TriangleMesh& start)
    : start_(start.triangles), edges_(edges_of(start_)) {}

std::vector<Triangle> RemovedFaces::behind(const CornerTable& table,
                                           const BoundaryLoop& loop) const {
  std::vector<std::uint32_t> open;
  std::unordered_set<std::uint32_t> found;
  const auto visit = [&](std::uint32_t from, std::uint32_t to) {
    const std::uint32_t f = edges_.find(from, to);
    if (f == EdgeMap::kNone || has_face(table, start_[f])) return;
    if (found.insert(f).second) open.push_back(f);
  };
  for (const std::uint32_t c : loop.corners)
    visit(table.head(c), table.vertex(c));
  std::vector<Triangle> faces;
  while (!open.empty()) {
    const Triangle face = start_[open.back()];
    open.pop_back();
    faces.push_back(face);
    for (std::size_t k = 0; k < 3; ++k)
      visit(face[(k + 1) % 3], face[k]);
  }
  return faces;
}

std::size_t RemovedFaces::put_back(TriangleMesh& mesh) const {
  const std::size_t before = mesh.triangles.size();
  EdgeMap used = edges_of(mesh.triangles);
  std::vector<std::uint8_t> is_back(start_.size(), 0);
  std::vector<std::uint32_t> open;
  const auto is_free = [&](const Triangle& face) {
    for (std::size_t k = 0; k < 3; ++k) {
      if (used.find(face[k], face[(k + 1) % 3]) != EdgeMap::kNone) return false;
    }
    return true;
  };
  const auto visit = [&](std::uint32_t from, std::uint32_t to) {
    const std::uint32_t f = edges_.find(from, to);
    if (f == EdgeMap::kNone || is_back[f] != 0 || !is_free(start_[f])) return;
    is_back[f] = 1;
    for (std::size_t k = 0; k < 3; ++k)
      used.insert(start_[f][k], start_[f][(k + 1) % 3],
                  static_cast<std::uint32_t>(mesh.triangles.size()));
    mesh.triangles.push_back(start_[f]);
    open.push_back(f);
  };
  for (std::size_t f = 0; f < before; ++f) {
    const Triangle face = mesh.triangles[f];
    for (std::size_t k = 0; k < 3; ++k)
      visit(face[(k + 1) % 3], face[k]);
  }
  while (!open.empty()) {
    const Triangle face = start_[open.back()];
    open.pop_back();
    for (std::size_t k = 0; k < 3; ++k)
      visit(face[(k + 1) % 3], face[k]);
  }
  std::vector<std::uint32_t> added(mesh.triangles.size() - before);
  std::iota(added.begin(), added.end(), static_cast<std::uint32_t>(before));
  std::vector<std::uint8_t> crosses(mesh.triangles.size(), 0);
  for (const auto& [i, j] : self_intersections(mesh, added))
    crosses[std::max(i, j)] = 1;
  remove_triangles(mesh.triangles, crosses);
  return mesh.triangles.size() - before;
}

bool stands_for(const TriangleMesh& fill, std::span<const Vec3> places, double pixel_size) {
  const std::vector<std::uint8_t> covered = covered_points(places, fill, kStandsFor * pixel_size);
  const auto lost = static_cast<double>(std::count(covered.begin(), covered.end(), 0));
  return lost <= kMayLose * static_cast<double>(places.size());
}

}  // namespace rangezip

#include "core/finish/unfold.h"

#include <algorithm>
#include <array>
#include <cstdint>
#include <map>
#include <numeric>
#include <utility>
#include <vector>

#include "core/base/disjoint_sets.h"
#include "core/finish/boundary_loops.h"
#include "core/finish/corner_table.h"
#include "core/finish/edge_changes.h"
#include "core/finish/verified_fills.h"
#include "core/finish/vertex_geometry.h"
#include "core/mesh/self_intersection.h"

namespace rangezip {
namespace {

constexpr double kFolded = -0.5;       ///< cosine of the turn over an edge
constexpr std::size_t kMostEdges = 8;  ///< of a fold
constexpr double kReach = 0.75;        ///< in h: farther points count as if they were so far
/// In h, of each point that is near: a fold has two more faces for points to be near to than what
/// takes its place.
constexpr double kFartherBy = 0.1;
constexpr int kRounds = 2;  ///< a fold beside another waits for the next one

/// The faces around a fold.
struct Region {
  std::vector<std::uint32_t> faces;     ///< in order
  std::vector<std::uint32_t> vertices;  ///< of these, in order
};

bool is_folded(const Vec3& unit_a, const Vec3& unit_b) {
  return glm::dot(unit_a, unit_b) < kFolded;
}

void sort_and_unite(std::vector<std::uint32_t>& numbers) {
  std::sort(numbers.begin(), numbers.end());
  numbers.erase(std::unique(numbers.begin(), numbers.end()), numbers.end());
}

/// The vertices of each fold: ends of its edges and third corners of their faces.
std::vector<std::vector<std::uint32_t>> find_folds(const TriangleMesh& mesh,
                                                   const CornerTable& table) {
  std::vector<std::uint32_t> folded;
  for (std::uint32_t c = 0; c < table.corner_count(); ++c) {
    if (!table.names_inner_edge(c)) continue;
    const Vec3 here = unit_normal(mesh.positions, table.triangle(c / 3));
    const Vec3 there = unit_normal(mesh.positions, table.triangle(table.across(c) / 3));
    if (is_folded(here, there)) folded.push_back(c);
  }
  DisjointSets joined(mesh.positions.size());
  for (const std::uint32_t c : folded)
    joined.join(table.vertex(c), table.head(c));
  std::map<std::size_t, std::vector<std::uint32_t>> edges_of;
  for (const std::uint32_t c : folded)
    edges_of[joined.find(table.vertex(c))].push_back(c);
  std::vector<std::vector<std::uint32_t>> folds;
  for (const auto& [root, edges] : edges_of) {
    if (edges.size() > kMostEdges) continue;
    std::vector<std::uint32_t>& fold = folds.emplace_back();
    for (const std::uint32_t c : edges) {
      const Diamond d(table, c);
      fold.insert(fold.end(), {d.a, d.b, d.x, d.y});
    }
    sort_and_unite(fold);
  }
  return folds;
}

Region region_around(const std::vector<std::uint32_t>& fold, const CornerTable& table) {
  Region region;
  for (const std::uint32_t v : fold)
    table.for_each_corner(v, [&](std::uint32_t c) { region.faces.push_back(c / 3); });
  sort_and_unite(region.faces);
  for (const std::uint32_t f : region.faces) {
    const Triangle t = table.triangle(f);
    region.vertices.insert(region.vertices.end(), t.begin(), t.end());
  }
  sort_and_unite(region.vertices);
  return region;
}

/// Whether a region of inner vertices has one border that meets itself nowhere: its border passes
/// each vertex once, and it has no handle.
bool is_disc(const Region& region, const CornerTable& table) {
  std::vector<std::uint32_t> starts;
  for (const std::uint32_t f : region.faces) {
    for (std::uint32_t c = 3 * f; c < 3 * f + 3; ++c) {
      if (table.is_boundary(table.vertex(c))) return false;
      const std::uint32_t beside = table.across(c) / 3;
      if (!std::binary_search(region.faces.begin(), region.faces.end(), beside))
        starts.push_back(table.vertex(c));
    }
  }
  const std::size_t border = starts.size();
  sort_and_unite(starts);
  const std::size_t edges = (3 * region.faces.size() + border) / 2;
  return starts.size() == border && region.vertices.size() + region.faces.size() == edges + 1;
}

/// Regions around folds that share no vertex.
std::vector<Region> find_regions(const TriangleMesh& mesh, const CornerTable& table) {
  std::vector<Region> regions;
  std::vector<std::uint8_t> is_taken(mesh.positions.size(), 0);
  for (const std::vector<std::uint32_t>& fold : find_folds(mesh, table)) {
    Region region = region_around(fold, table);
    const bool is_free = std::none_of(region.vertices.begin(), region.vertices.end(),
                                      [&](std::uint32_t v) { return is_taken[v] != 0; });
    if (!is_free || !is_disc(region, table)) continue;
    for (const std::uint32_t v : region.vertices)
      is_taken[v] = 1;
    regions.push_back(std::move(region));
  }
  return regions;
}

void drop(std::vector<Triangle>& triangles, const std::vector<Region>& regions) {
  std::vector<std::uint8_t> marked(triangles.size(), 0);
  for (const Region& region : regions) {
    for (const std::uint32_t f : region.faces)
      marked[f] = 1;
  }
  remove_triangles(triangles, marked);
}

using Corners = std::array<Vec3, 3>;

std::vector<Corners> corners_of(const HoleFill& fill, const std::vector<Vec3>& positions) {
  std::vector<Corners> corners;
  for (const auto& [a, b, c] : fill.triangles)
    corners.push_back({corner_of(fill, positions, a), corner_of(fill, positions, b),
                       corner_of(fill, positions, c)});
  return corners;
}

/// Whether a fill is folded, in itself or to the faces beyond its loop.
bool has_fold(const HoleFill& fill, const std::vector<Corners>& corners,
              const std::vector<Vec3>& positions, const CornerTable& table,
              const BoundaryLoop& loop) {
  std::map<std::pair<std::uint32_t, std::uint32_t>, Vec3> normal_at;  // of directed edges
  for (const std::uint32_t c : loop.corners)
    normal_at[{table.vertex(c), table.head(c)}] = unit_normal(positions, table.triangle(c / 3));
  const auto unit_of = [&](std::size_t i) {
    return unit_normal(corners[i][0], corners[i][1], corners[i][2]);
  };
  for (std::size_t i = 0; i < corners.size(); ++i) {
    for (std::size_t k = 0; k < 3; ++k)
      normal_at[{fill.triangles[i][k], fill.triangles[i][(k + 1) % 3]}] = unit_of(i);
  }
  for (std::size_t i = 0; i < corners.size(); ++i) {
    for (std::size_t k = 0; k < 3; ++k) {
      const auto beside = normal_at.find({fill.triangles[i][(k + 1) % 3], fill.triangles[i][k]});
      if (beside == normal_at.end() || is_folded(unit_of(i), beside->second)) return true;
    }
  }
  return false;
}

/// What points tell of faces.
struct Distances {
  double sum = 0.0;      ///< of the squares
  std::size_t near = 0;  ///< points within reach
};

Distances distances_to(const std::vector<Vec3>& points, const std::vector<Corners>& faces,
                       double reach) {
  Distances distances;
  for (const Vec3& p : points) {
    double least = reach * reach;
    for (const auto& [a, b, c] : faces)
      least = std::min(least, squared_distance_to_triangle(p, a, b, c));
    distances.sum += least;
    distances.near += least < reach * reach ? 1 : 0;
  }
  return distances;
}

/// All points that may be within reach of a region's faces.
std::vector<Vec3> points_near(const Region& region, const std::vector<Vec3>& positions,
                              const PointGrid& cloud, double reach) {
  Box box;
  for (const std::uint32_t v : region.vertices)
    box.add(positions[v]);
  const Vec3 center = box.center();
  std::vector<Vec3> points;
  cloud.for_each_near(center, 0.5 * box.diagonal() + reach,
                      [&](const Vec3& offset) { points.push_back(center + offset); });
  return points;
}

/// Whether a fill is better than the faces that it is to replace.
bool is_better(const HoleFill& fill, const Region& region, const BoundaryLoop& loop,
               const TriangleMesh& mesh, const CornerTable& without, const PointGrid& cloud,
               const UnfoldOptions& options) {
  if (fill.triangles.empty()) return false;
  const std::vector<Corners> after = corners_of(fill, mesh.positions);
  if (has_fold(fill, after, mesh.positions, without, loop)) return false;
  std::vector<Corners> before;
  for (const std::uint32_t f : region.faces) {
    const auto& [a, b, c] = mesh.triangles[f];
    before.push_back({mesh.positions[a], mesh.positions[b], mesh.positions[c]});
  }
  const double h = options.pixel_size;
  const double reach = kReach * h;
  const std::vector<Vec3> points = points_near(region, mesh.positions, cloud, reach);
  const Distances folded = distances_to(points, before, reach);
  const double slack = kFartherBy * kFartherBy * h * h + options.noise * options.noise;
  return distances_to(points, after, reach).sum <=
         folded.sum + static_cast<double>(folded.near) * slack;
}

/// The loop around each region once all are gone.
std::vector<BoundaryLoop> loops_around(const std::vector<Region>& regions,
                                       const CornerTable& without) {
  constexpr std::size_t kNoRegion = ~std::size_t{0};
  std::vector<std::size_t> region_of(without.vertex_count(), kNoRegion);
  for (std::size_t i = 0; i < regions.size(); ++i) {
    for (const std::uint32_t v : regions[i].vertices)
      region_of[v] = i;
  }
  std::vector<BoundaryLoop> loops(regions.size());
  for (BoundaryLoop& loop : boundary_loops(without)) {
    const std::size_t region = region_of[without.vertex(loop.corners[0])];
    if (region != kNoRegion) loops[region] = std::move(loop);
  }
  return loops;
}

/// Puts fills in the place of regions. @return how many; 0, and nothing changes, if what stays of
/// the others would cross them
std::size_t replace(TriangleMesh& mesh, const std::vector<Region>& regions,
                    const std::vector<HoleFill>& fills, const Progress& progress) {
  const TriangleMesh before = mesh;
  drop(mesh.triangles, regions);
  const std::vector<std::size_t> left = append_verified(mesh, fills, progress);
  const std::size_t kept = mesh.triangles.size();
  for (const std::size_t i : left) {
    for (const std::uint32_t f : regions[i].faces)
      mesh.triangles.push_back(before.triangles[f]);
  }
  std::vector<std::uint32_t> restored(mesh.triangles.size() - kept);
  std::iota(restored.begin(), restored.end(), static_cast<std::uint32_t>(kept));
  if (self_intersections(mesh, restored, {}, progress).empty()) return fills.size() - left.size();
  mesh = before;
  return 0;
}

std::size_t unfold_once(TriangleMesh& mesh, const PointGrid& cloud, const UnfoldOptions& options,
                        const Progress& progress) {
  const CornerTable table(mesh.triangles, mesh.positions.size());
  const std::vector<Region> regions = find_regions(mesh, table);
  if (regions.empty()) return 0;
  std::vector<Triangle> rest = mesh.triangles;
  drop(rest, regions);
  const CornerTable without(rest, mesh.positions.size());
  const std::vector<BoundaryLoop> loops = loops_around(regions, without);
  std::vector<Region> replaced;
  std::vector<HoleFill> fills;
  for (std::size_t i = 0; i < regions.size(); ++i) {
    progress.check_stop();
    if (loops[i].corners.empty()) continue;  // the region was all of a component
    HoleFill fill = fill_loop(mesh.positions, without, loops[i], FillShape::smooth, 0.0);
    if (!is_better(fill, regions[i], loops[i], mesh, without, cloud, options)) continue;
    replaced.push_back(regions[i]);
    fills.push_back(std::move(fill));
  }
  return fills.empty() ? 0 : replace(mesh, replaced, fills, progress);
}

}  // namespace

std::size_t unfold(TriangleMesh& mesh, const PointGrid& cloud, const UnfoldOptions& options,
                   const Progress& progress) {
  std::size_t count = 0;
  for (int round = 0; round < kRounds; ++round) {
    const std::size_t gone = unfold_once(mesh, cloud, options, progress);
    if (gone == 0) break;
    count += gone;
  }
  return count;
}

}  // namespace rangezip

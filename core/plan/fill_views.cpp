#include <cstdint>
#include <utility>

#include "core/mesh/edge_map.h"
#include "core/plan/directions.h"
#include "core/plan/view_planner.h"

namespace rangezip {

namespace {

/// A wish of some boundary to be looked at along `normal`.
struct Wish {
  Vec3 normal;
  double weight = 0.0;  ///< length of the boundary that has it, model units
};

/// An edge without a face on its other side.
struct BoundaryEdge {
  std::uint32_t from = 0;
  std::uint32_t to = 0;
  std::uint32_t face = 0;
};

std::vector<BoundaryEdge> boundary_edges(const TriangleMesh& mesh) {
  EdgeMap faces(3 * mesh.triangles.size());
  for (std::uint32_t f = 0; f < mesh.triangles.size(); ++f) {
    const Triangle& t = mesh.triangles[f];
    for (std::size_t i = 0; i < 3; ++i)
      faces.insert(t[i], t[(i + 1) % 3], f);
  }
  std::vector<BoundaryEdge> boundary;
  for (std::uint32_t f = 0; f < mesh.triangles.size(); ++f) {
    const Triangle& t = mesh.triangles[f];
    for (std::size_t i = 0; i < 3; ++i) {
      const std::uint32_t from = t[i];
      const std::uint32_t to = t[(i + 1) % 3];
      if (faces.find(to, from) == EdgeMap::kNone) boundary.push_back({from, to, f});
    }
  }
  return boundary;
}

/// The wishes of one loop's edges. A loop in one plane asks for one view into its middle; a loop
/// that winds, such as a slit around an edge, asks per edge.
void add_wishes(std::span<const Wish> edges, double min_loop, std::vector<Wish>& wishes) {
  constexpr double kFlat = 0.75;  // length of the mean normal from which a loop counts as flat
  Vec3 sum{0.0};
  double length = 0.0;
  for (const Wish& edge : edges) {
    sum += edge.weight * edge.normal;
    length += edge.weight;
  }
  if (length < min_loop) return;
  if (glm::length(sum) > kFlat * length) {
    wishes.push_back({unit_or_z(sum), length});
  } else {
    wishes.insert(wishes.end(), edges.begin(), edges.end());
  }
}

/// Follows each boundary loop and collects its wishes.
std::vector<Wish> boundary_wishes(const TriangleMesh& mesh, double min_loop) {
  constexpr std::uint32_t kNone = EdgeMap::kNone;
  const std::vector<BoundaryEdge> boundary = boundary_edges(mesh);
  std::vector<std::uint32_t> edge_from(mesh.positions.size(), kNone);
  for (std::uint32_t e = 0; e < boundary.size(); ++e)
    edge_from[boundary[e].from] = e;

  std::vector<Wish> wishes;
  std::vector<Wish> loop;
  std::vector<std::uint8_t> followed(boundary.size(), 0);
  for (std::uint32_t start = 0; start < boundary.size(); ++start) {
    loop.clear();
    for (std::uint32_t e = start; e != kNone && followed[e] == 0; e = edge_from[boundary[e].to]) {
      followed[e] = 1;
      const Triangle& t = mesh.triangles[boundary[e].face];
      const Vec3& from = mesh.positions[boundary[e].from];
      const Vec3& to = mesh.positions[boundary[e].to];
      const Vec3 normal =
          area_vector(mesh.positions[t[0]], mesh.positions[t[1]], mesh.positions[t[2]]);
      loop.push_back({unit_or_z(normal), glm::length(to - from)});
    }
    if (!loop.empty()) add_wishes(loop, min_loop, wishes);
  }
  return wishes;
}

/// How much of the wishes a view grants. Within 53 degrees of its wish a boundary is seen well.
double granted(std::span<const Wish> wishes, const Vec3& direction) {
  constexpr double kSeenCosine = 0.6;
  constexpr double kWorthlessCosine = 0.4;
  double sum = 0.0;
  for (const Wish& wish : wishes) {
    const double cosine = glm::dot(wish.normal, direction);
    if (cosine > kSeenCosine) sum += wish.weight * (cosine - kWorthlessCosine);
  }
  return sum;
}

/// Drops the candidates within 13 degrees of a direction: they would see what it sees.
void drop_near(const Vec3& direction, std::vector<Vec3>& candidates) {
  constexpr double kSameCosine = 0.975;
  std::erase_if(candidates, [&](const Vec3& candidate) {
    return glm::dot(candidate, direction) > kSameCosine * glm::length(direction);
  });
}

}  // namespace

std::vector<Vec3> plan_fill_views(const TriangleMesh& mesh, double min_loop, int max_views) {
  constexpr int kCandidates = 200;
  constexpr double kMinGrantedLoops = 0.5;  // a shortest loop, seen straight on, grants 0.6
  constexpr double kServedCosine = 0.75;    // wishes within 41 degrees of a view are served,
  constexpr double kLeftWhenServed = 0.15;  // and this share of them is left
  std::vector<Wish> wishes = boundary_wishes(mesh, min_loop);
  std::vector<Vec3> candidates = sphere_directions(kCandidates);

  std::vector<Vec3> views;
  while (static_cast<int>(views.size()) < max_views && !wishes.empty()) {
    double best = 0.0;
    Vec3 view{0.0};
    for (const Vec3& candidate : candidates) {
      const double sum = granted(wishes, candidate);
      if (sum > best) {
        best = sum;
        view = candidate;
      }
    }
    if (!(best > 0.0) || best < kMinGrantedLoops * min_loop) break;
    views.push_back(view);
    drop_near(view, candidates);
    for (Wish& wish : wishes) {
      if (glm::dot(wish.normal, view) > kServedCosine) wish.weight *= kLeftWhenServed;
    }
  }
  return views;
}

}  // namespace rangezip

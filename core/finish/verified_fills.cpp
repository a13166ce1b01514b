#include "core/finish/verified_fills.h"

#include <algorithm>
#include <cstdint>
#include <numeric>
#include <span>

#include "core/base/parallel.h"
#include "core/finish/self_intersection.h"

namespace rangezip {
namespace {

/// The mesh with fills appended, and which fill each new face belongs to.
struct Trial {
  TriangleMesh mesh;
  std::vector<std::size_t> fill_of;  ///< per face from `old_faces` on
  std::size_t old_faces = 0;
};

/// Only positions and faces: a verdict needs no sources.
Trial make_trial(const TriangleMesh& mesh, const std::vector<HoleFill>& fills) {
  Trial trial{{mesh.positions, mesh.triangles, {}}, {}, mesh.triangles.size()};
  for (std::size_t i = 0; i < fills.size(); ++i) {
    append_fill(trial.mesh, fills[i], mesh.positions.size());
    trial.fill_of.resize(trial.mesh.triangles.size() - trial.old_faces, i);
  }
  return trial;
}

/// Flags the fills that must go.
std::vector<std::uint8_t> failing_fills(const TriangleMesh& mesh,
                                        const std::vector<HoleFill>& fills) {
  const Trial trial = make_trial(mesh, fills);
  std::vector<std::uint32_t> added(trial.fill_of.size());
  std::iota(added.begin(), added.end(), static_cast<std::uint32_t>(trial.old_faces));
  const auto pairs = self_intersections(trial.mesh, added);
  std::vector<std::uint8_t> fails(fills.size(), 0);
  const auto fill_of = [&](std::uint32_t face) { return trial.fill_of[face - trial.old_faces]; };
  for (const auto& [i, j] : pairs) {  // j > i is always a new face
    if (i < trial.old_faces || fill_of(i) == fill_of(j)) fails[fill_of(j)] = 1;
  }
  for (const auto& [i, j] : pairs) {
    if (i < trial.old_faces || fails[fill_of(i)] != 0 || fails[fill_of(j)] != 0) continue;
    fails[std::max(fill_of(i), fill_of(j))] = 1;
  }
  return fails;
}

/// Fills the requests with the given numbers, appends what passes, and returns the others.
std::vector<std::size_t> fill_once(TriangleMesh& mesh, const CornerTable& table,
                                   const std::vector<FillRequest>& requests,
                                   std::span<const std::size_t> chosen, bool coarse,
                                   double edge_length, VerifiedFills& result) {
  std::vector<HoleFill> fills(chosen.size());
  parallel_for(chosen.size(), 1, [&](std::size_t begin, std::size_t end) {
    for (std::size_t k = begin; k < end; ++k) {
      const FillRequest& request = requests[chosen[k]];
      fills[k] = fill_loop(mesh.positions, table, request.loop,
                           coarse ? FillShape::coarse : request.shape, edge_length);
    }
  });
  const std::vector<std::uint8_t> fails = failing_fills(mesh, fills);
  std::vector<std::size_t> rejected;
  const std::size_t base = mesh.positions.size();
  for (std::size_t k = 0; k < fills.size(); ++k) {
    if (fails[k] != 0 || fills[k].triangles.empty()) {
      rejected.push_back(chosen[k]);
      continue;
    }
    append_fill(mesh, fills[k], base);
    ++result.filled_holes;
    result.filled_faces += fills[k].triangles.size();
  }
  return rejected;
}

}  // namespace

VerifiedFills fill_verified(TriangleMesh& mesh, const CornerTable& table,
                            const std::vector<FillRequest>& requests, double edge_length) {
  VerifiedFills result;
  if (requests.empty()) return result;
  std::vector<std::size_t> all(requests.size());
  std::iota(all.begin(), all.end(), std::size_t{0});
  result.rejected = fill_once(mesh, table, requests, all, false, edge_length, result);
  if (!result.rejected.empty()) {
    const std::vector<std::size_t> again = result.rejected;
    result.rejected = fill_once(mesh, table, requests, again, true, edge_length, result);
  }
  return result;
}

}  // namespace rangezip

#include "core/finish/verified_fills.h"

#include <algorithm>
#include <cstdint>
#include <numeric>
#include <optional>
#include <utility>

#include "core/base/parallel.h"
#include "core/finish/faces_around.h"
#include "core/mesh/self_intersection.h"

namespace rangezip {
namespace {

/// Of free fills: their cost grows with the third power of the edges, and with the length of sides.
constexpr std::size_t kMostFreeEdges = 100;
constexpr double kLongestFreeSide = 8.0;  ///< in lengths of new edges
/// Of their area: what leads so far through air may close the mouth of a hole.
constexpr double kMostFreeInAir = 0.1;

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

/// Those with a new face, which is the second one (or both are).
std::vector<std::pair<std::uint32_t, std::uint32_t>> crossing_pairs(const Trial& trial,
                                                                    const Progress& progress) {
  std::vector<std::uint32_t> added(trial.fill_of.size());
  std::iota(added.begin(), added.end(), static_cast<std::uint32_t>(trial.old_faces));
  return self_intersections(trial.mesh, added, {}, progress);
}

struct FillVerdict {
  std::vector<std::uint8_t> fails;        ///< flags of the fills that must go
  std::vector<std::uint32_t> obstructed;  ///< VerifiedFills::obstructed
};

FillVerdict judge_fills(const TriangleMesh& mesh, const std::vector<HoleFill>& fills,
                        const Progress& progress) {
  const Trial trial = make_trial(mesh, fills);
  const auto pairs = crossing_pairs(trial, progress);
  FillVerdict verdict;
  for (const auto& pair : pairs) {
    for (const std::uint32_t face : {pair.first, pair.second}) {
      if (face < trial.old_faces) continue;
      for (const std::uint32_t v : trial.mesh.triangles[face]) {
        if (v < mesh.positions.size()) verdict.obstructed.push_back(v);
      }
    }
  }
  std::vector<std::uint8_t>& fails = verdict.fails;
  fails.assign(fills.size(), 0);
  const auto fill_of = [&](std::uint32_t face) { return trial.fill_of[face - trial.old_faces]; };
  for (const auto& [i, j] : pairs) {
    if (i < trial.old_faces || fill_of(i) == fill_of(j)) fails[fill_of(j)] = 1;
  }
  for (const auto& [i, j] : pairs) {
    if (i < trial.old_faces || fails[fill_of(i)] != 0 || fails[fill_of(j)] != 0) continue;
    fails[std::max(fill_of(i), fill_of(j))] = 1;
  }
  return verdict;
}

/// The least sharp of the fills whose faces cross nothing that is there; empty if there is none.
HoleFill free_fill(const TriangleMesh& mesh, const CornerTable& table, const BoundaryLoop& loop,
                   const FacesAround& around, double longest_side, const CloudEvidence& evidence) {
  if (loop.corners.size() > kMostFreeEdges) return {};
  const std::vector<std::uint32_t> vertices = vertices_of(loop, table);
  const auto in_mesh = [&](const Triangle& t) {
    return Triangle{vertices[t[0]], vertices[t[1]], vertices[t[2]]};
  };
  LoopShape shape = shape_of(loop, table, mesh.positions, evidence);
  shape.longest_edge = longest_side;
  shape.can_take = [&](const Triangle& t) { return around.can_take(in_mesh(t)); };
  const std::vector<Triangle> triangles = triangulate_loop(shape);
  if (share_in_air(shape, triangles) > kMostFreeInAir) return {};
  HoleFill fill;
  for (const Triangle& t : triangles)
    fill.triangles.push_back(in_mesh(t));
  return fill;
}

/// Fills made for a request: one, or the pieces of a zipped loop.
std::vector<HoleFill> fills_for(const TriangleMesh& mesh, const CornerTable& table,
                                const FillRequest& request, FillShape shape,
                                const VerifiedFillOptions& options) {
  if (shape == request.shape && !request.fill.triangles.empty()) return {request.fill};
  if (shape == FillShape::zipped) {
    return zip_loop(mesh.positions, table, request.loop, options.zip_width, options.evidence,
                    options.memo);
  }
  return {fill_loop(mesh.positions, table, request.loop, shape, options.edge_length,
                    options.evidence, options.memo)};
}

class Filler {
 public:
  Filler(TriangleMesh& mesh, const CornerTable& table, const std::vector<FillRequest>& requests,
         const VerifiedFillOptions& options, const Progress& progress)
      : mesh_(mesh), table_(table), requests_(requests), options_(options), progress_(progress) {}

  VerifiedFills run() {
    std::vector<std::size_t> all(requests_.size());
    std::iota(all.begin(), all.end(), std::size_t{0});
    fill(all, std::nullopt);
    fill(std::exchange(result_.rejected, {}), FillShape::coarse);
    fill_freely(std::exchange(result_.rejected, {}));
    const auto is_short = [&](std::size_t request) {
      return perimeter_of(requests_[request].loop, table_, mesh_.positions) <= options_.zipped_from;
    };
    std::vector<std::size_t> again = std::exchange(result_.rejected, {});
    const auto first_short = std::stable_partition(
        again.begin(), again.end(), [&](std::size_t request) { return !is_short(request); });
    result_.rejected.assign(first_short, again.end());
    again.erase(first_short, again.end());
    fill(again, FillShape::zipped);
    return std::move(result_);
  }

 private:
  /// Fills the chosen requests, appends what passes, and notes the others.
  /// @param instead of the shape asked for
  void fill(const std::vector<std::size_t>& chosen, std::optional<FillShape> instead) {
    if (chosen.empty()) return;
    const auto shape_of = [&](std::size_t request) {
      return instead.value_or(requests_[request].shape);
    };
    std::vector<std::vector<HoleFill>> made(chosen.size());
    parallel_for(chosen.size(), 1, [&](std::size_t begin, std::size_t end) {
      progress_.check_stop();
      for (std::size_t k = begin; k < end; ++k)
        made[k] = fills_for(mesh_, table_, requests_[chosen[k]], shape_of(chosen[k]), options_);
    });
    std::vector<HoleFill> fills;
    std::vector<std::size_t> request_of;
    for (std::size_t k = 0; k < made.size(); ++k) {
      for (HoleFill& fill : made[k])
        fills.push_back(std::move(fill));
      request_of.resize(fills.size(), chosen[k]);
    }
    const std::vector<std::uint32_t> obstructed = append(fills, request_of, chosen, instead);
    if (instead == FillShape::coarse) result_.obstructed = obstructed;
  }

  /// The same, with free fills.
  void fill_freely(const std::vector<std::size_t>& chosen) {
    if (chosen.empty()) return;
    std::vector<std::vector<std::uint32_t>> loops;
    loops.reserve(chosen.size());
    for (const std::size_t request : chosen)
      loops.push_back(vertices_of(requests_[request].loop, table_));
    const double edge = usual_edge(chosen);
    const FacesAround around(mesh_, loops, edge);
    std::vector<HoleFill> fills(chosen.size());
    parallel_for(chosen.size(), 1, [&](std::size_t begin, std::size_t end) {
      progress_.check_stop();
      for (std::size_t k = begin; k < end; ++k)
        fills[k] = free_fill(mesh_, table_, requests_[chosen[k]].loop, around,
                             kLongestFreeSide * edge, options_.evidence);
    });
    append(fills, chosen, chosen, FillShape::coarse);
  }

  /// The length of new edges, or the mean one of the loops.
  [[nodiscard]] double usual_edge(const std::vector<std::size_t>& chosen) const {
    if (options_.edge_length > 0.0) return options_.edge_length;
    double length = 0.0;
    std::size_t count = 0;
    for (const std::size_t request : chosen) {
      const BoundaryLoop& loop = requests_[request].loop;
      length += perimeter_of(loop, table_, mesh_.positions);
      count += loop.corners.size();
    }
    return length / static_cast<double>(count);
  }

  /// @return FillVerdict::obstructed
  std::vector<std::uint32_t> append(const std::vector<HoleFill>& fills,
                                    const std::vector<std::size_t>& request_of,
                                    const std::vector<std::size_t>& chosen,
                                    std::optional<FillShape> instead) {
    const auto shape_of = [&](std::size_t request) {
      return instead.value_or(requests_[request].shape);
    };
    auto [fails, obstructed] = judge_fills(mesh_, fills, progress_);
    const std::size_t base = mesh_.positions.size();
    std::vector<std::uint8_t> is_served(requests_.size(), 0);
    for (std::size_t i = 0; i < fills.size(); ++i) {
      if (fails[i] != 0 || fills[i].triangles.empty()) continue;
      append_fill(mesh_, fills[i], base);
      result_.filled_faces += fills[i].triangles.size();
      const bool is_piece = shape_of(request_of[i]) == FillShape::zipped;
      ++(is_piece ? result_.zipped_pieces : result_.filled_holes);
      is_served[request_of[i]] = 1;
    }
    for (const std::size_t request : chosen) {
      if (is_served[request] == 0 && requests_[request].shape != FillShape::zipped)
        result_.rejected.push_back(request);
    }
    return std::move(obstructed);
  }

  TriangleMesh& mesh_;
  const CornerTable& table_;
  const std::vector<FillRequest>& requests_;
  const VerifiedFillOptions& options_;
  const Progress& progress_;
  VerifiedFills result_;
};

}  // namespace

VerifiedFills fill_verified(TriangleMesh& mesh, const CornerTable& table,
                            const std::vector<FillRequest>& requests,
                            const VerifiedFillOptions& options, const Progress& progress) {
  if (requests.empty()) return {};
  return Filler(mesh, table, requests, options, progress).run();
}

std::vector<HoleFill> without_crossing_faces(const TriangleMesh& mesh, std::vector<HoleFill> fills,
                                             const Progress& progress) {
  if (fills.empty()) return fills;
  const Trial trial = make_trial(mesh, fills);
  const auto pairs = crossing_pairs(trial, progress);
  std::vector<std::uint8_t> goes(trial.mesh.triangles.size(), 0);
  for (const auto& [i, j] : pairs) {  // first, since what goes is in no other's way
    if (i < trial.old_faces) goes[j] = 1;
  }
  for (const auto& [i, j] : pairs) {
    if (goes[i] == 0) goes[j] = 1;
  }
  std::size_t face = trial.old_faces;
  for (HoleFill& fill : fills)
    std::erase_if(fill.triangles, [&](const Triangle&) { return goes[face++] != 0; });
  return fills;
}

std::vector<std::size_t> append_verified(TriangleMesh& mesh, const std::vector<HoleFill>& fills,
                                         const Progress& progress) {
  if (fills.empty()) return {};
  const std::vector<std::uint8_t> fails = judge_fills(mesh, fills, progress).fails;
  const std::size_t base = mesh.positions.size();
  std::vector<std::size_t> left_out;
  for (std::size_t i = 0; i < fills.size(); ++i) {
    if (fails[i] != 0) {
      left_out.push_back(i);
    } else {
      append_fill(mesh, fills[i], base);
    }
  }
  return left_out;
}

}  // namespace rangezip

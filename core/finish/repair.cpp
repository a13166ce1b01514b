#include "core/finish/repair.h"

#include <algorithm>
#include <cstdint>
#include <iterator>
#include <numeric>
#include <optional>
#include <utility>
#include <vector>

#include "core/base/parallel.h"
#include "core/finish/boundary_loops.h"
#include "core/finish/bridge_loops.h"
#include "core/finish/clean_topology.h"
#include "core/finish/corner_table.h"
#include "core/finish/ear_fill.h"
#include "core/finish/hole_choice.h"
#include "core/finish/join_loops.h"
#include "core/finish/local_plane.h"
#include "core/finish/mesh_pieces.h"
#include "core/finish/verified_fills.h"
#include "core/mesh/self_intersection.h"

namespace rangezip {
namespace {

/// Rounds in which loops that are to be joined, but are hindered, are kept open for the next one.
constexpr int kRoundsToJoin = 3;
/// Of loops over points with more edges than that, in so many rounds only what is in the way is
/// cleared, with so many vertices on both sides: along the edge of a blade every ring of faces is a
/// part of it lost.
constexpr std::size_t kLongLoop = 40;
constexpr int kGentleRounds = 4;
constexpr std::size_t kAroundObstacle = 2;
/// In h: loops up to this that cannot be closed otherwise are zipped.
constexpr double kLongestZipped = 60.0;

constexpr int kZipPasses = 2;               ///< of {zip what stays, close what that parts from it}
constexpr int kLastRounds = 6;              ///< of {ears, widen what is left}
constexpr std::size_t kNoisePoints = 2000;  ///< that tell it

using Pairs = std::vector<std::pair<std::uint32_t, std::uint32_t>>;

/// Drops every face that a pair names.
void cut_pairs(TriangleMesh& mesh, const Pairs& pairs, FinishReport& report) {
  std::vector<std::uint8_t> marked(mesh.triangles.size(), 0);
  for (const auto& [i, j] : pairs)
    marked[i] = marked[j] = 1;
  const std::size_t before = mesh.triangles.size();
  remove_triangles(mesh.triangles, marked);
  report.self_intersections_cut += before - mesh.triangles.size();
}

/// With the loops that are not settled.
MeshPieces pieces_to_repair(const TriangleMesh& mesh, const SettledLoops& settled) {
  MeshPieces pieces = pieces_of(mesh);
  std::erase_if(pieces.loops,
                [&](const BoundaryLoop& loop) { return settled.contain(loop, pieces.table); });
  return pieces;
}

void drop_small(TriangleMesh& mesh, MeshPieces& pieces, const SettledLoops& settled,
                const FinishOptions& options, FinishReport& report) {
  const DroppedComponents dropped =
      drop_small_components(mesh, pieces.table, pieces.component, options.min_component);
  if (dropped.faces > 0) pieces = pieces_to_repair(mesh, settled);
  report.dropped_components += dropped.components;
  report.dropped_faces += dropped.faces;
}

/// Bridges whose faces cross anything are taken back.
void bridge(TriangleMesh& mesh, MeshPieces& pieces, const SettledLoops& settled,
            const PointGrid& cloud, const FinishOptions& options, FinishReport& report) {
  const std::size_t before = mesh.triangles.size();
  std::size_t bridges = bridge_loops(mesh, pieces, cloud, options.pixel_size);
  if (bridges == 0) return;
  std::vector<std::uint32_t> added(mesh.triangles.size() - before);
  std::iota(added.begin(), added.end(), static_cast<std::uint32_t>(before));
  std::vector<std::uint8_t> marked(mesh.triangles.size(), 0);
  for (const auto& [i, j] : self_intersections(mesh, added)) {
    const std::size_t first = before + (j - before) / 2 * 2;  // a bridge has two faces
    if (marked[first] == 0) --bridges;
    marked[first] = marked[first + 1] = 1;
  }
  remove_triangles(mesh.triangles, marked);
  if (bridges > 0) pieces = pieces_to_repair(mesh, settled);
  report.bridged_loops += bridges;
}

struct FillOutcome {
  bool is_done = true;                 ///< nothing to do in another round
  std::vector<std::uint8_t> unfilled;  ///< flags of vertices of loops that could not be filled
};

/// Parts the loops that hindered vertices are in from the others.
/// @param is_hindered of vertices; empty: none
std::vector<BoundaryLoop> hindered_among(std::vector<BoundaryLoop>& loops, const CornerTable& table,
                                         const std::vector<std::uint8_t>& is_hindered) {
  if (is_hindered.empty()) return {};
  const auto first = std::stable_partition(loops.begin(), loops.end(), [&](const auto& loop) {
    return is_hindered[table.vertex(loop.corners[0])] == 0;
  });
  std::vector<BoundaryLoop> hindered(std::make_move_iterator(first),
                                     std::make_move_iterator(loops.end()));
  loops.erase(first, loops.end());
  return hindered;
}

/// Flags the vertices of a loop next to those that are obstructed; all if none is.
void mark_obstructed(const std::vector<std::uint32_t>& loop,
                     const std::vector<std::uint8_t>& is_obstructed,
                     std::vector<std::uint8_t>& marked) {
  const std::size_t n = loop.size();
  bool any = false;
  for (std::size_t k = 0; k < n; ++k) {
    if (is_obstructed[loop[k]] == 0) continue;
    any = true;
    for (std::size_t i = n - kAroundObstacle; i <= n + kAroundObstacle; ++i)
      marked[loop[(k + i) % n]] = 1;
  }
  if (any) return;
  for (const std::uint32_t v : loop)
    marked[v] = 1;
}

/// The loops that are to be closed.
struct ChosenFills {
  std::vector<FillRequest> requests;
  std::vector<std::uint8_t> is_wall;  ///< of each: FillChoice::is_wall
  bool leave_gaps = false;            ///< any of them
};

/// Flags the vertices of loops around which faces are to go before the next round: of lost walls,
/// and in the first rounds of long loops over points, only next to what is in the way.
std::vector<std::uint8_t> unfilled_vertices(const TriangleMesh& mesh, const CornerTable& table,
                                            const ChosenFills& chosen, const VerifiedFills& fills,
                                            bool is_gentle) {
  std::vector<std::uint8_t> unfilled(mesh.positions.size(), 0);
  std::vector<std::uint8_t> is_obstructed(mesh.positions.size(), 0);
  for (const std::uint32_t v : fills.obstructed)
    is_obstructed[v] = 1;
  const std::vector<std::uint8_t> none(mesh.positions.size(), 0);
  for (const std::size_t i : fills.rejected) {
    const FillRequest& request = chosen.requests[i];
    const std::vector<std::uint32_t> loop = vertices_of(request.loop, table);
    const bool is_shown = request.shape == FillShape::smooth;  // by points, if it is long
    const bool is_spared = is_gentle && is_shown && loop.size() > kLongLoop;
    mark_obstructed(loop, is_spared || chosen.is_wall[i] != 0 ? is_obstructed : none, unfilled);
  }
  return unfilled;
}

HoleChoiceOptions choice_options(const PointGrid& cloud, const FinishOptions& options) {
  const double h = options.pixel_size;
  HoleChoiceOptions choice{.pixel_size = h,
                           .max_hole_perimeter = options.max_hole_perimeter,
                           .narrow_width = options.narrow_width,
                           .is_sampled = !cloud.empty() && options.gap == 0.0};
  if (choice.is_sampled) choice.noise = noise_of(cloud.points(kNoisePoints), cloud, h);
  return choice;
}

VerifiedFillOptions fill_options(const PointGrid& cloud, const HoleChoiceOptions& choice) {
  const double h = choice.pixel_size;
  return {h, choice.narrow_width * h, kLongestZipped * h,
          choice.is_sampled ? CloudEvidence{&cloud, h} : CloudEvidence{}};
}

/// Which loops are to be closed, and how.
ChosenFills choose_fills(const TriangleMesh& mesh, const CornerTable& table,
                         std::vector<BoundaryLoop> loops, bool is_zipped, const PointGrid& cloud,
                         const HoleChoiceOptions& choice) {
  std::vector<std::optional<FillChoice>> choices(loops.size());
  parallel_for(loops.size(), 1, [&](std::size_t begin, std::size_t end) {
    for (std::size_t i = begin; i < end; ++i)
      choices[i] = choose_fill(mesh.positions, table, loops[i], is_zipped, cloud, choice);
  });
  ChosenFills chosen;
  for (std::size_t i = 0; i < loops.size(); ++i) {
    if (!choices[i]) continue;
    chosen.leave_gaps = chosen.leave_gaps || choices[i]->leaves_gaps;
    chosen.requests.push_back(
        {std::move(loops[i]), choices[i]->shape, std::move(choices[i]->fill)});
    chosen.is_wall.push_back(choices[i]->is_wall ? 1 : 0);
  }
  return chosen;
}

/// Joins loops around gaps in the walls of holes. @return of vertices: their loops are not to be
/// filled in this round; empty: none
std::vector<std::uint8_t> join(TriangleMesh& mesh, MeshPieces& pieces, int round,
                               const SettledLoops& settled, const PointGrid& cloud,
                               const FinishOptions& options, FinishReport& report) {
  JoinedLoops joined = join_loops(mesh, pieces, cloud, options.pixel_size);
  if (joined.pairs > 0) pieces = pieces_to_repair(mesh, settled);
  report.joined_loops += joined.pairs;
  if (round >= kRoundsToJoin) return {};
  return std::move(joined.is_hindered);
}

/// @param pieces of the mesh, as it is before
/// @param round the first is 0
/// @param is_hindered of vertices: their loops are not filled in this round; empty: none
FillOutcome fill(TriangleMesh& mesh, MeshPieces pieces, int round,
                 const std::vector<std::uint8_t>& is_hindered, const PointGrid& cloud,
                 const HoleChoiceOptions& choice, FinishReport& report) {
  const bool is_zipped = round > 0;
  const CornerTable& table = pieces.table;
  std::vector<BoundaryLoop> loops = std::move(pieces.loops);
  const std::vector<BoundaryLoop> hindered = hindered_among(loops, table, is_hindered);
  const ChosenFills chosen = choose_fills(mesh, table, std::move(loops), is_zipped, cloud, choice);
  const VerifiedFills fills =
      fill_verified(mesh, table, chosen.requests, fill_options(cloud, choice));
  report.filled_holes += fills.filled_holes;
  report.filled_faces += fills.filled_faces;
  FillOutcome outcome;
  outcome.unfilled = unfilled_vertices(mesh, table, chosen, fills, round < kGentleRounds);
  for (const BoundaryLoop& loop : hindered) {
    for (const std::uint32_t v : vertices_of(loop, table))
      outcome.unfilled[v] = 1;
  }
  const bool any_zipped =
      std::any_of(chosen.requests.begin(), chosen.requests.end(),
                  [](const FillRequest& r) { return r.shape == FillShape::zipped; });
  outcome.is_done = hindered.empty() && fills.rejected.empty() && fills.zipped_pieces == 0 &&
                    !any_zipped && !chosen.leave_gaps;
  return outcome;
}

/// Drops the faces around marked vertices.
void widen(TriangleMesh& mesh, const std::vector<std::uint8_t>& vertices) {
  std::erase_if(mesh.triangles, [&](const Triangle& t) {
    return std::any_of(t.begin(), t.end(), [&](std::uint32_t v) { return vertices[v] != 0; });
  });
}

/// The loops that are to be closed, of those that have been zipped before.
std::vector<BoundaryLoop> loops_left(const TriangleMesh& mesh, MeshPieces& pieces,
                                     const PointGrid& cloud, const HoleChoiceOptions& choice) {
  std::vector<BoundaryLoop> loops;
  ChosenFills chosen =
      choose_fills(mesh, pieces.table, std::move(pieces.loops), true, cloud, choice);
  for (FillRequest& request : chosen.requests)
    loops.push_back(std::move(request.loop));
  return loops;
}

/// Zips what has stayed open as if it never had been, and closes what that parts from it: what was
/// cut away around a loop, or is left of a fill, may be cracks that lead into a hole. No more faces
/// go: what crosses something stays open.
void zip_again(TriangleMesh& mesh, const SettledLoops& settled, const PointGrid& cloud,
               const HoleChoiceOptions& choice, FinishReport& report) {
  const VerifiedFillOptions options = fill_options(cloud, choice);
  const auto close = [&](bool is_zipped) {
    MeshPieces pieces = pieces_to_repair(mesh, settled);
    ChosenFills chosen =
        choose_fills(mesh, pieces.table, std::move(pieces.loops), is_zipped, cloud, choice);
    if (!is_zipped) {
      std::erase_if(chosen.requests,
                    [](const FillRequest& r) { return r.shape != FillShape::zipped; });
    }
    const VerifiedFills fills = fill_verified(mesh, pieces.table, chosen.requests, options);
    report.filled_holes += fills.filled_holes;
    report.filled_faces += fills.filled_faces;
    clean_topology(mesh);
    return fills.zipped_pieces > 0;
  };
  for (int pass = 0; pass < kZipPasses && close(false); ++pass)
    close(true);
}

/// Closes ear by ear what all rounds have left, if that closes all of it: around what is left of a
/// loop a ring of faces goes, which is a loss where a loop stays open.
void fill_the_last(TriangleMesh& mesh, const SettledLoops& settled, const PointGrid& cloud,
                   const HoleChoiceOptions& choice, FinishReport& report) {
  const std::vector<Triangle> before = mesh.triangles;
  std::size_t faces = 0;
  for (int round = 0; round < kLastRounds; ++round) {
    MeshPieces pieces = pieces_to_repair(mesh, settled);
    const std::vector<BoundaryLoop> loops = loops_left(mesh, pieces, cloud, choice);
    const EarFills fills = fill_by_ears(mesh, pieces.table, loops, choice.pixel_size);
    faces += fills.faces;
    if (fills.left.empty()) {
      report.filled_faces += faces;
      return;
    }
    std::vector<std::uint8_t> unfilled(mesh.positions.size(), 0);
    for (const std::uint32_t v : fills.left)
      unfilled[v] = 1;
    widen(mesh, unfilled);
    clean_topology(mesh);
  }
  mesh.triangles = before;
}

void close_in_rounds(TriangleMesh& mesh, const SettledLoops& settled, const PointGrid& cloud,
                     HoleChoiceOptions choice, const FinishOptions& options, FinishReport& report,
                     const Progress& progress) {
  for (int round = 0; round < options.rounds; ++round) {
    progress.check_stop();
    clean_topology(mesh);
    MeshPieces pieces = pieces_to_repair(mesh, settled);
    bridge(mesh, pieces, settled, cloud, options, report);
    drop_small(mesh, pieces, settled, options, report);
    choice.leaves_gaps = round + 1 < options.rounds;  // which the next one chooses for
    const std::vector<std::uint8_t> is_hindered =
        join(mesh, pieces, round, settled, cloud, options, report);
    const FillOutcome outcome =
        fill(mesh, std::move(pieces), round, is_hindered, cloud, choice, report);
    if (outcome.is_done) return;
    if (round + 1 < options.rounds) {
      widen(mesh, outcome.unfilled);
    } else {
      fill_the_last(mesh, settled, cloud, choice, report);
    }
  }
}

}  // namespace

void repair(TriangleMesh& mesh, const Pairs& crossing, const SettledLoops& settled,
            const PointGrid& cloud, const FinishOptions& options, FinishReport& report,
            const Progress& progress) {
  cut_pairs(mesh, crossing, report);
  const HoleChoiceOptions choice = choice_options(cloud, options);
  // From here on nothing crosses: faces only go, and what comes is checked.
  close_in_rounds(mesh, settled, cloud, choice, options, report, progress);
  zip_again(mesh, settled, cloud, choice, report);
  remove_unused_vertices(mesh);
}

}  // namespace rangezip

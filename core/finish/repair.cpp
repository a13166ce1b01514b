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
#include "core/finish/face_tree.h"
#include "core/finish/hole_choice.h"
#include "core/finish/join_loops.h"
#include "core/finish/local_plane.h"
#include "core/finish/mesh_pieces.h"
#include "core/finish/small_pieces.h"
#include "core/finish/take_back_losses.h"
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

constexpr int kJointPasses = 3;             ///< of bridges: a loop gets one in each
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

HoleChoiceOptions choice_options(const PointGrid& cloud, const FinishOptions& options,
                                 TriangulationMemo& memo) {
  const double h = options.pixel_size;
  HoleChoiceOptions choice{.pixel_size = h,
                           .max_hole_perimeter = options.max_hole_perimeter,
                           .narrow_width = options.narrow_width,
                           .is_sampled = !cloud.empty() && options.gap == 0.0,
                           .has_narrow_gaps = options.narrow_gaps,
                           .open_sheet = options.open_sheet,
                           .memo = &memo};
  if (choice.is_sampled) choice.noise = noise_of(cloud.points(kNoisePoints), cloud, h);
  return choice;
}

VerifiedFillOptions fill_options(const PointGrid& cloud, const HoleChoiceOptions& choice) {
  const double h = choice.pixel_size;
  return {h, choice.narrow_width * h, kLongestZipped * h,
          choice.is_sampled ? CloudEvidence{&cloud, h} : CloudEvidence{}, choice.memo};
}

std::vector<double> areas_of_components(const TriangleMesh& mesh,
                                        const std::vector<std::uint32_t>& component) {
  std::vector<double> areas(component.size(), 0.0);
  for (std::size_t f = 0; f < component.size(); ++f)
    areas[component[f]] += area_of_face(mesh.positions, mesh.triangles[f]);
  return areas;
}

/// Which loops are to be closed, and how.
/// @param pieces of the mesh, with or without these loops
ChosenFills choose_fills(const TriangleMesh& mesh, const MeshPieces& pieces,
                         std::vector<BoundaryLoop> loops, bool is_zipped, const PointGrid& cloud,
                         const HoleChoiceOptions& choice, const Progress& progress) {
  const std::vector<double> areas = areas_of_components(mesh, pieces.component);
  const FaceTree faces(mesh.positions, pieces.table);
  std::vector<std::optional<FillChoice>> choices(loops.size());
  parallel_for(loops.size(), 1, [&](std::size_t begin, std::size_t end) {
    progress.check_stop();
    for (std::size_t i = begin; i < end; ++i)
      choices[i] =
          choose_fill(mesh.positions, pieces.table, loops[i], faces,
                      areas[pieces.component[loops[i].corners[0] / 3]], is_zipped, cloud, choice);
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

/// Drops the faces around marked vertices.
void widen(TriangleMesh& mesh, const std::vector<std::uint8_t>& vertices) {
  std::erase_if(mesh.triangles, [&](const Triangle& t) {
    return std::any_of(t.begin(), t.end(), [&](std::uint32_t v) { return vertices[v] != 0; });
  });
}

/// What the steps of a repair share.
class Repairer {
 public:
  Repairer(TriangleMesh& mesh, const SettledLoops& settled, const PointGrid& cloud,
           const FinishOptions& options, FinishReport& report, const Progress& progress)
      : mesh_(mesh),
        settled_(settled),
        cloud_(cloud),
        options_(options),
        choice_(choice_options(cloud, options, memo_)),
        fill_options_(fill_options(cloud, choice_)),
        report_(report),
        progress_(progress) {}

  /// What repair() does once nothing crosses.
  void close_in_rounds() {
    for (int round = 0; round < options_.rounds; ++round) {
      progress_.check_stop();
      clean_topology(mesh_);
      MeshPieces pieces = look_at_pieces();
      bridge(pieces, bridge_loops);
      drop_small(pieces);
      const bool is_last = round + 1 == options_.rounds;
      choice_.leaves_gaps = !is_last;  // which the next one chooses for
      const std::vector<std::uint8_t> is_hindered = join(pieces, round);
      const FillOutcome outcome = fill(std::move(pieces), round, is_hindered);
      if (outcome.is_done) return;
      if (is_last) {
        fill_the_last();
      } else {
        widen(mesh_, outcome.unfilled);
      }
    }
  }

  /// The same; what is cleared around loops that stay open after all comes back.
  void close_without_losses() {
    clean_topology(mesh_);
    const TriangleMesh before = mesh_;
    close_in_rounds();
    if (take_back_losses(mesh_, before, &cloud_, options_.pixel_size, progress_) == 0) return;
    MeshPieces pieces = look_at_pieces();
    drop_small(pieces);
  }

  /// Bridges the joints of turned pieces. @return all loops that no bridge has to do with
  [[nodiscard]] SettledLoops bridge_joints() {
    const std::size_t before = mesh_.triangles.size();
    MeshPieces pieces = look_at_pieces();
    for (int pass = 0; pass < kJointPasses; ++pass) {
      const std::size_t bridged = mesh_.triangles.size();
      bridge(pieces, bridge_runs);
      bridge(pieces, bridge_loops);
      if (mesh_.triangles.size() == bridged) break;
    }
    std::erase_if(pieces.loops, [&](const BoundaryLoop& loop) {
      return std::any_of(loop.corners.begin(), loop.corners.end(),
                         [&](std::uint32_t c) { return c / 3 >= before; });
    });
    return SettledLoops(pieces.loops, pieces.table);
  }

  /// What zip_open_loops() does.
  void zip_again() {
    for (int pass = 0; pass < kZipPasses && close_loops(false); ++pass)
      close_loops(true);
    MeshPieces pieces = look_at_pieces();
    drop_small(pieces);  // a crumb beside a crack, once it is closed
  }

 private:
  /// With the loops that are not settled.
  [[nodiscard]] MeshPieces look_at_pieces() const {
    MeshPieces pieces = pieces_of(mesh_);
    std::erase_if(pieces.loops,
                  [&](const BoundaryLoop& loop) { return settled_.contain(loop, pieces.table); });
    return pieces;
  }

  /// Bridges whose faces cross anything are taken back.
  template <class Bridge>
  void bridge(MeshPieces& pieces, const Bridge& bridge) {
    const std::size_t before = mesh_.triangles.size();
    std::size_t bridges = bridge(mesh_, pieces, cloud_, options_.pixel_size, options_.narrow_gaps);
    if (bridges == 0) return;
    std::vector<std::uint32_t> added(mesh_.triangles.size() - before);
    std::iota(added.begin(), added.end(), static_cast<std::uint32_t>(before));
    std::vector<std::uint8_t> marked(mesh_.triangles.size(), 0);
    for (const auto& [i, j] : self_intersections(mesh_, added, {}, progress_)) {
      const std::size_t first = before + (j - before) / 2 * 2;  // a bridge has two faces
      if (marked[first] == 0) --bridges;
      marked[first] = marked[first + 1] = 1;
    }
    remove_triangles(mesh_.triangles, marked);
    if (bridges > 0) pieces = look_at_pieces();
    report_.bridged_loops += bridges;
  }

  void drop_small(MeshPieces& pieces) {
    const DroppedComponents dropped = drop_small_components(
        mesh_, pieces.table, pieces.component, {options_.min_component, options_.pixel_size});
    if (dropped.faces > 0) pieces = look_at_pieces();
    report_.dropped_components += dropped.components;
    report_.dropped_faces += dropped.faces;
  }

  /// Joins loops around gaps in the walls of holes. @return of vertices: their loops are not to be
  /// filled in this round; empty: none
  std::vector<std::uint8_t> join(MeshPieces& pieces, int round) {
    JoinedLoops joined =
        join_loops(mesh_, pieces, cloud_, options_.pixel_size, options_.narrow_gaps, progress_);
    if (joined.pairs > 0) pieces = look_at_pieces();
    report_.joined_loops += joined.pairs;
    if (round >= kRoundsToJoin) return {};
    return std::move(joined.is_hindered);
  }

  /// @param is_hindered of vertices: their loops are not filled in this round; empty: none
  FillOutcome fill(MeshPieces pieces, int round, const std::vector<std::uint8_t>& is_hindered) {
    const CornerTable& table = pieces.table;
    std::vector<BoundaryLoop> loops = std::move(pieces.loops);
    const std::vector<BoundaryLoop> hindered = hindered_among(loops, table, is_hindered);
    const ChosenFills chosen =
        choose_fills(mesh_, pieces, std::move(loops), round > 0, cloud_, choice_, progress_);
    const VerifiedFills fills = make(chosen.requests, table);
    FillOutcome outcome;
    outcome.unfilled = unfilled_vertices(mesh_, table, chosen, fills, round < kGentleRounds);
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

  VerifiedFills make(const std::vector<FillRequest>& requests, const CornerTable& table) {
    VerifiedFills fills = fill_verified(mesh_, table, requests, fill_options_, progress_);
    report_.filled_holes += fills.filled_holes;
    report_.filled_faces += fills.filled_faces;
    return fills;
  }

  /// Closes ear by ear what all rounds have left, if that closes all of it: around what is left of
  /// a loop a ring of faces goes, which is a loss where a loop stays open.
  void fill_the_last() {
    const std::vector<Triangle> before = mesh_.triangles;
    std::size_t faces = 0;
    for (int round = 0; round < kLastRounds; ++round) {
      progress_.check_stop();
      MeshPieces pieces = look_at_pieces();
      const std::vector<BoundaryLoop> loops = loops_to_close(pieces);
      const EarFills fills = fill_by_ears(mesh_, pieces.table, loops, options_.pixel_size);
      faces += fills.faces;
      if (fills.left.empty()) {
        report_.filled_faces += faces;
        return;
      }
      std::vector<std::uint8_t> unfilled(mesh_.positions.size(), 0);
      for (const std::uint32_t v : fills.left)
        unfilled[v] = 1;
      widen(mesh_, unfilled);
      clean_topology(mesh_);
    }
    mesh_.triangles = before;
  }

  /// Of those that have been zipped before.
  [[nodiscard]] std::vector<BoundaryLoop> loops_to_close(MeshPieces& pieces) const {
    std::vector<BoundaryLoop> loops;
    ChosenFills chosen =
        choose_fills(mesh_, pieces, std::move(pieces.loops), true, cloud_, choice_, progress_);
    for (FillRequest& request : chosen.requests)
      loops.push_back(std::move(request.loop));
    return loops;
  }

  /// @param are_zipped whether all loops are to be closed; else they are only zipped
  /// @return whether any was zipped
  bool close_loops(bool are_zipped) {
    MeshPieces pieces = look_at_pieces();
    if (pieces.loops.empty()) return false;
    std::vector<FillRequest> requests =
        choose_fills(mesh_, pieces, std::move(pieces.loops), are_zipped, cloud_, choice_, progress_)
            .requests;
    if (!are_zipped)
      std::erase_if(requests, [](const FillRequest& r) { return r.shape != FillShape::zipped; });
    const VerifiedFills fills = make(requests, pieces.table);
    clean_topology(mesh_);
    return fills.zipped_pieces > 0;
  }

  TriangleMesh& mesh_;
  const SettledLoops& settled_;
  const PointGrid& cloud_;
  const FinishOptions& options_;
  TriangulationMemo memo_;
  HoleChoiceOptions choice_;
  VerifiedFillOptions fill_options_;
  FinishReport& report_;
  const Progress& progress_;
};

}  // namespace

void repair(TriangleMesh& mesh, const Pairs& crossing, const SettledLoops& settled,
            const PointGrid& cloud, const FinishOptions& options, FinishReport& report,
            const Progress& progress) {
  cut_pairs(mesh, crossing, report);
  // From here on nothing crosses: faces only go, and what comes is checked.
  Repairer repairer(mesh, settled, cloud, options, report, progress);
  if (options.open_sheet) {
    repairer.close_without_losses();
  } else {
    repairer.close_in_rounds();
  }
  remove_unused_vertices(mesh);
}

void close_joints(TriangleMesh& mesh, const PointGrid& cloud, const FinishOptions& options,
                  FinishReport& report, const Progress& progress) {
  const SettledLoops none;
  const SettledLoops others =
      Repairer(mesh, none, cloud, options, report, progress).bridge_joints();
  Repairer(mesh, others, cloud, options, report, progress).close_in_rounds();
}

void zip_open_loops(TriangleMesh& mesh, const PointGrid& cloud, const FinishOptions& options,
                    FinishReport& report, const Progress& progress) {
  const SettledLoops none;
  const TriangleMesh before = mesh;
  Repairer(mesh, none, cloud, options, report, progress).zip_again();
  if (options.open_sheet) take_back_losses(mesh, before, &cloud, options.pixel_size, progress);
  remove_unused_vertices(mesh);
}

}  // namespace rangezip

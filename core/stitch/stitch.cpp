#include "core/stitch/stitch.h"

#include <algorithm>
#include <optional>
#include <string>
#include <utility>

#include "core/base/check_number.h"
#include "core/base/error.h"
#include "core/base/parallel.h"
#include "core/mesh/edge_map.h"
#include "core/mesh/face_changes.h"
#include "core/mesh/self_intersection.h"
#include "core/patch/decimate.h"
#include "core/stitch/clean_up.h"
#include "core/stitch/clear_and_fill.h"
#include "core/stitch/collapse_seam.h"
#include "core/stitch/crossing_faces.h"
#include "core/stitch/lost_pixels.h"
#include "core/stitch/lost_places.h"
#include "core/stitch/mesh_part.h"
#include "core/stitch/withdraw.h"
#include "core/stitch/zipper.h"

namespace rangezip {

namespace {

/// Where the old surface was a face must be within this many pixel sides.
constexpr double kLostDistance = 1.0;

/// From a hole the patch is withdrawn by as many pixels each time, from the seventh time on by
/// twice as many as before; after the last one altogether.
constexpr int kEqualWithdrawals = 6;
constexpr int kWithdrawals = 10;

/// A patch of which less than one in so many faces is left counts as given up.
constexpr std::size_t kGivenUp = 10;

/// The part is cut out this much wider than the seam can be, pixels.
constexpr int kPartMargin = 2;

void check(const StitchOptions& options) {
  constexpr double kMost = StitchOptions::kMostPixels;
  check_positive("stitch: band", options.band);
  check_range("stitch: clearance", options.clearance, 0.0, kMost);
  check_positive("stitch: max_gap", options.max_gap);
  check_range("stitch: max_gap", options.max_gap, 0.0, kMost);
  check_range("stitch: min_strip_cosine", options.min_strip_cosine, 0.0, 1.0);
  check_not_negative("stitch: collapse_ratio", options.collapse_ratio);
  check_range("stitch: withdrawal", options.withdrawal, 0.0, kMost);
}

void check_indices(const TriangleMesh& mesh) {
  for (std::size_t f = 0; f < mesh.triangles.size(); ++f) {
    const Triangle& t = mesh.triangles[f];
    const auto count = mesh.positions.size();
    const bool is_in_range = t[0] < count && t[1] < count && t[2] < count;
    if (!is_in_range || t[0] == t[1] || t[1] == t[2] || t[2] == t[0]) {
      throw TopologyError("stitch: face " + std::to_string(f) +
                          " of the mesh must have three different existing corners");
    }
  }
}

/// A patch that is joined to a part of the mesh.
struct Joined {
  TriangleMesh mesh;  ///< the part
  FaceChanges changes;
  StitchReport report;
  StitchRecord record;  ///< by the part's faces
};

/// One way of joining a patch to the part of the mesh around it.
class Attempt {
 public:
  /// @param keeps_old whether pieces of the mesh so far stay, however small the patch leaves them
  Attempt(const MeshPart& part, const ImagePlane& image, const PatchScan& scan,
          const StitchOptions& options, bool keeps_old)
      : part_(part),
        image_(image),
        scan_(scan),
        options_(options),
        kept_(keeps_old ? part.mesh.positions.size() : 0) {}

  void join();
  void roll_back_crossings();
  [[nodiscard]] std::vector<std::uint8_t> changed_vertices() const;
  [[nodiscard]] std::vector<Pixel> lost_pixels();

  [[nodiscard]] const TriangleMesh& mesh() const { return joint_.mesh; }
  [[nodiscard]] const StitchReport& report() const { return report_; }
  [[nodiscard]] Joined result() && {
    return {std::move(joint_.mesh), std::move(changes_), report_, std::move(record_)};
  }

 private:
  void clean();
  [[nodiscard]] std::vector<FaceOrigin> origins_of(std::span<const std::uint32_t> made) const;
  [[nodiscard]] std::vector<std::uint32_t> faces_as_sampled(
      std::span<const FaceOrigin> origins) const;
  void remove(std::span<const std::uint32_t> faces, std::span<const FaceOrigin> origins);

  const MeshPart& part_;
  const ImagePlane& image_;  ///< of the part
  PatchScan scan_;
  const StitchOptions& options_;
  std::size_t kept_;  ///< vertices whose pieces stay
  Joint joint_;
  FaceChanges changes_;
  StitchReport report_;
  StitchRecord record_;
};

void Attempt::clean() {
  const CleanUpReport cleaned = clean_up(joint_.mesh, joint_.touched, joint_.seam,
                                         options_.min_component, part_.is_rim, kept_);
  report_.opened_fans += cleaned.opened_fans;
  report_.split_vertices += cleaned.split_vertices;
  report_.dropped_components += cleaned.dropped_components;
  report_.dropped_faces += cleaned.dropped_faces;
}

void Attempt::join() {
  const bool is_zipper = options_.method == StitchMethod::zipper;
  joint_ = is_zipper ? zipper(part_.mesh, scan_, options_, report_, record_)
                     : clear_and_fill(part_.mesh, scan_, options_, report_);
  clean();
  if (is_zipper && options_.collapse_ratio > 0.0) {
    report_.collapsed_edges = collapse_short_seam_edges(
        joint_.mesh, joint_.seam,
        options_.collapse_ratio * pixel_sides_of(scan_.patch, scan_.image).smallest);
  }
}

/// Faces of the patch are known by the directed edge from their lowest corner on.
std::vector<FaceOrigin> Attempt::origins_of(std::span<const std::uint32_t> made) const {
  EdgeMap of_patch(3 * scan_.patch.mesh.triangles.size());
  for (const Triangle& t : scan_.patch.mesh.triangles) {
    for (std::size_t k = 0; k < 3; ++k) {
      of_patch.insert(joint_.vertex_of_patch[t[k]], joint_.vertex_of_patch[t[(k + 1) % 3]],
                      joint_.vertex_of_patch[t[(k + 2) % 3]]);
    }
  }
  std::vector<FaceOrigin> origins(joint_.mesh.triangles.size(), FaceOrigin::old);
  for (const std::uint32_t f : made) {
    const Triangle& face = joint_.mesh.triangles[f];
    origins[f] = of_patch.find(face[0], face[1]) == face[2] ? FaceOrigin::patch : FaceOrigin::seam;
  }
  return origins;
}

/// The faces of the patch that are as its scan saw them: so they lie side by side in the image.
std::vector<std::uint32_t> Attempt::faces_as_sampled(std::span<const FaceOrigin> origins) const {
  std::vector<std::uint8_t> is_sample(joint_.mesh.positions.size(), 0);
  for (std::size_t v = 0; v < joint_.vertex_of_patch.size(); ++v) {
    const std::uint32_t in_joint = joint_.vertex_of_patch[v];
    if (joint_.mesh.positions[in_joint] == scan_.patch.mesh.positions[v]) is_sample[in_joint] = 1;
  }
  std::vector<std::uint32_t> faces;
  for (const std::uint32_t f : changes_.made) {
    const Triangle& face = joint_.mesh.triangles[f];
    if (origins[f] == FaceOrigin::patch &&
        (is_sample[face[0]] & is_sample[face[1]] & is_sample[face[2]]) != 0)
      faces.push_back(f);
  }
  return faces;
}

void Attempt::remove(std::span<const std::uint32_t> faces, std::span<const FaceOrigin> origins) {
  joint_.touched.assign(joint_.mesh.positions.size(), 0);
  std::vector<std::uint8_t> is_removed(joint_.mesh.triangles.size(), 0);
  for (const std::uint32_t f : faces) {
    is_removed[f] = 1;
    ++(origins[f] == FaceOrigin::patch ? report_.crossing_patch_faces
                                       : report_.crossing_seam_faces);
    for (const std::uint32_t v : joint_.mesh.triangles[f])
      joint_.touched[v] = 1;
  }
  remove_triangles(joint_.mesh.triangles, is_removed);
}

/// Every round removes a face at least, so there is a last one. What is left of faces that did not
/// cross does not either, unless vertices were split, and so moved.
void Attempt::roll_back_crossings() {
  for (bool has_moved = true; has_moved;) {
    changes_ = find_face_changes(part_.mesh, joint_.mesh);
    const std::vector<FaceOrigin> origins = origins_of(changes_.made);
    const std::vector<FacePair> pairs =
        self_intersections(joint_.mesh, changes_.made, faces_as_sampled(origins));
    if (pairs.empty()) return;
    remove(choose_crossing_faces(pairs, origins), origins);
    const std::size_t split = report_.split_vertices;
    clean();
    has_moved = report_.split_vertices > split;
  }
  changes_ = find_face_changes(part_.mesh, joint_.mesh);
}

/// Flags of those where faces came or went; elsewhere nothing has changed.
std::vector<std::uint8_t> Attempt::changed_vertices() const {
  std::vector<std::uint8_t> changed(joint_.mesh.positions.size(), 0);
  for (const std::uint32_t f : changes_.made) {
    for (const std::uint32_t v : joint_.mesh.triangles[f])
      changed[v] = 1;
  }
  for (const std::uint32_t f : changes_.gone) {
    for (const std::uint32_t v : part_.mesh.triangles[f])
      changed[v] = 1;
  }
  return changed;
}

std::vector<Pixel> Attempt::lost_pixels() {
  const View& view = scan_.image.view();
  const std::size_t known = joint_.image.points.size();  // vertices split since have no image yet
  const ImagePlane rest = project_to_image(std::span(joint_.mesh.positions).subspan(known), view);
  joint_.image.points.insert(joint_.image.points.end(), rest.points.begin(), rest.points.end());
  joint_.image.depths.insert(joint_.image.depths.end(), rest.depths.begin(), rest.depths.end());
  const SeenMesh before{part_.mesh, image_};
  const SeenMesh after{joint_.mesh, joint_.image};
  const double distance = kLostDistance * pixel_sides_of(scan_.patch, scan_.image).largest;
  std::vector<Pixel> lost, places;
  run_side_by_side([&] { lost = find_lost_pixels(before, after, changes_, view); },
                   [&] { places = find_lost_places(before, after, changes_, distance); });
  lost.insert(lost.end(), places.begin(), places.end());
  return lost;
}

/// The record by the faces of the whole mesh and the vertices of the whole patch.
/// @param pixels of the vertices that are left of the patch. Those that a decimated patch did not
///     have, and segments from or to them, are left out
StitchRecord record_of_whole(const StitchRecord& record, const MeshPart& part,
                             std::span<const Pixel> pixels, const Patch& whole_patch) {
  const std::vector<std::uint32_t> vertex_in_whole = numbers_in(whole_patch, pixels);
  StitchRecord of_whole;
  for (const auto& [vertex, face] : record.vertices) {
    if (vertex_in_whole[vertex] == kNotInPatch) continue;
    of_whole.vertices.push_back({vertex_in_whole[vertex], part.face_in_whole[face]});
  }
  for (const auto& [from, to] : record.segments) {
    const std::uint32_t a = vertex_in_whole[from], b = vertex_in_whole[to];
    if (a != kNotInPatch && b != kNotInPatch) of_whole.segments.push_back({a, b});
  }
  return of_whole;
}

/// Triangles that are left of the grid, whatever size those of the patch have.
std::size_t grid_triangle_count(const Patch& patch) {
  std::size_t count = 0;
  for (const std::uint8_t bits : patch.cells.pixels())
    count += ((bits & kLowerTriangle) != 0 ? 1U : 0U) + ((bits & kUpperTriangle) != 0 ? 1U : 0U);
  return count;
}

/// Whether faces around what has changed are outside of the part.
bool reaches_rim(const MeshPart& part, const std::vector<std::uint8_t>& is_changed) {
  for (std::size_t v = 0; v < part.is_rim.size(); ++v) {
    if ((part.is_rim[v] & is_changed[v]) != 0) return true;
  }
  return false;
}

/// One attempt, and whether it can stay.
struct Tried {
  Attempt attempt;
  bool reaches_rim = false;
  bool is_manifold = false;
  std::vector<Pixel> lost;
};

Tried try_to_join(const MeshPart& part, const ImagePlane& image, const PatchScan& scan,
                  const StitchOptions& options, bool keeps_old) {
  Tried tried{Attempt(part, image, scan, options, keeps_old)};
  tried.attempt.join();
  tried.attempt.roll_back_crossings();
  const std::vector<std::uint8_t> is_changed = tried.attempt.changed_vertices();
  tried.reaches_rim = reaches_rim(part, is_changed);
  if (tried.reaches_rim) return tried;
  run_side_by_side([&] { tried.is_manifold = is_manifold_at(tried.attempt.mesh(), is_changed); },
                   [&] { tried.lost = tried.attempt.lost_pixels(); });
  return tried;
}

/// What was done to the mesh.
struct Stitched {
  StitchReport report;
  StitchRecord record;
};

/// What is left of a patch once no pixel loses its surface.
struct Settled {
  std::optional<Joined> joined;  ///< none: nothing is left of it
  Patch patch;
  bool reaches_rim = false;     ///< the part is too small to tell
  bool dropped_crumbs = false;  ///< in any attempt

  [[nodiscard]] std::size_t faces() const { return joined ? grid_triangle_count(patch) : 0; }
};

/// Withdraws the patch until it can stay.
Settled settle(const MeshPart& part, const ImagePlane& image, const Scan& scan,
               const StitchOptions& options, bool keeps_old, const Progress& progress) {
  Settled settled{.patch = scan.patch};
  Patch whole = scan.decimate ? scan.whole_patch : scan.patch;
  int radius = options.withdrawal;
  for (int round = 1; !settled.patch.mesh.empty(); ++round) {
    progress.check_stop();
    Tried tried = try_to_join(part, image, PatchScan(scan, settled.patch, part.face_in_whole),
                              options, keeps_old);
    settled.reaches_rim = tried.reaches_rim;
    settled.dropped_crumbs |= tried.attempt.report().dropped_faces > 0;
    if (tried.reaches_rim || !tried.is_manifold) break;
    if (tried.lost.empty()) {
      settled.joined = std::move(tried.attempt).result();
      break;
    }
    if (round > kWithdrawals) break;
    whole = withdraw_locally(scan.image, whole, tried.lost, radius);
    settled.patch = scan.decimate ? decimate(scan.image, whole, *scan.decimate) : whole;
    if (round >= kEqualWithdrawals) radius = wider(radius);
  }
  return settled;
}

/// The same. Where a crumb of the mesh so far went nothing may lie any more, wherever the patch
/// ends: before the patch is given up for that, crumbs stay.
Settled settle_or_keep_crumbs(const MeshPart& part, const ImagePlane& image, const Scan& scan,
                              const StitchOptions& options, const Progress& progress) {
  Settled settled = settle(part, image, scan, options, false, progress);
  const bool is_given_up = kGivenUp * settled.faces() < grid_triangle_count(scan.patch);
  if (settled.reaches_rim || !is_given_up || !settled.dropped_crumbs) return settled;
  Settled with_crumbs = settle(part, image, scan, options, true, progress);
  const bool is_more = with_crumbs.reaches_rim || with_crumbs.faces() > settled.faces();
  return is_more ? std::move(with_crumbs) : std::move(settled);
}

/// Stitches into a part of the mesh; nothing is done, and nothing returned, if the part is too
/// small for that.
std::optional<Stitched> stitch_into(TriangleMesh& mesh, const MeshPart& part, const Scan& scan,
                                    const StitchOptions& options, const Progress& progress) {
  const ImagePlane image = project_to_image(part.mesh.positions, scan.image.view());
  const Settled settled = settle_or_keep_crumbs(part, image, scan, options, progress);
  if (settled.reaches_rim) return std::nullopt;
  Stitched stitched;
  if (settled.joined) {
    const Joined& joined = *settled.joined;
    put_back(mesh, part, joined.mesh, joined.changes);
    stitched = {joined.report,
                record_of_whole(joined.record, part, settled.patch.pixels, scan.patch)};
  }
  stitched.report.withdrawn_faces = grid_triangle_count(scan.patch) - settled.faces();
  return stitched;
}

}  // namespace

StitchResult stitch(TriangleMesh mesh, const Scan& scan, const StitchOptions& options,
                    const Progress& progress) {
  check(options);
  check_indices(mesh);
  if (scan.patch.mesh.empty()) return {.mesh = std::move(mesh)};
  const MeshPart near =
      cut_out_part(mesh, scan.image.view(), scan.patch.pixels, sheet_radius(options) + kPartMargin);
  std::optional<Stitched> stitched = stitch_into(mesh, near, scan, options, progress);
  // Faces of any length may reach farther than any margin: in one of 50,000 random stitches.
  if (!stitched) stitched = stitch_into(mesh, whole_as_part(mesh), scan, options, progress);
  return {std::move(mesh), stitched->report, std::move(stitched->record)};
}

}  // namespace rangezip

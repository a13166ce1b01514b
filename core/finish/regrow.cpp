#include "core/finish/regrow.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <numeric>
#include <optional>
#include <utility>
#include <vector>

#include "core/base/parallel.h"
#include "core/finish/clean_topology.h"
#include "core/finish/components.h"
#include "core/finish/corner_table.h"
#include "core/finish/facing_inwards.h"
#include "core/finish/flagged_pieces.h"
#include "core/finish/grow_over.h"
#include "core/finish/inside_out.h"
#include "core/finish/left_out_points.h"
#include "core/finish/local_plane.h"
#include "core/finish/places_near.h"
#include "core/finish/restart_fronts.h"
#include "core/finish/unsupported_faces.h"
#include "core/finish/votes_near.h"
#include "core/mesh/coverage.h"

namespace rangezip {
namespace {

constexpr double kLeftOutPerNoise = 3.0;
constexpr double kMostNoise = 0.3;  ///< in h: more would bend the front
/// In h, around points that are left out: faces that are doubted; points that the front may reach;
/// and faces that it might meet.
constexpr double kDoubted = 3.0;
constexpr double kPlace = 4.0;
constexpr double kPart = 8.0;
constexpr double kOwnPoints = 0.75;  ///< in h: those of a face, also beside a gap of 2 h
/// In h: points farther from the mesh than this are not in it.
constexpr double kOffMesh = 0.42;
constexpr double kOffMeshPerNoise = 2.0;
/// In h: of circles without points where the front has stopped. A wider one leads across a gap of
/// 2 h.
constexpr double kVoidRadius = 1.0;
constexpr double kVoidRadiusInVerySparse = 1.15;
/// In square h: of faces that have grown and that hang together, around a rim, where points of both
/// sides look the way of one.
constexpr double kByChance = 10.0;
constexpr double kAroundWrong = 4.0;  ///< in h: of more, where no face is to grow inside out
constexpr double kFullVote = 127.0;
constexpr std::size_t kSpacingPlaces = 200;  ///< that tell whether points are sparse
constexpr int kSmoothRounds = 3;
constexpr double kHardlyNoise = 0.08;  ///< in h: less is left in
constexpr std::size_t kGrain = 256;
/// Faces: less is a shred in the air; and less may have been seen through a wall, from behind, but
/// not where all is seen from one side.
constexpr std::size_t kMinPiece = 12;
constexpr std::size_t kMinPieceOfBodies = 40;

/// How far from the mesh points are left out.
double left_out_by(double noise, double h) {
  return std::max(kLeftOut * h, kLeftOutPerNoise * noise);
}

/// The centroid, the middles of the sides, and the corners.
std::array<Vec3, 7> places_on(const TriangleMesh& mesh, const Triangle& face) {
  const Vec3 &a = mesh.positions[face[0]], &b = mesh.positions[face[1]],
             &c = mesh.positions[face[2]];
  return {(a + b + c) / 3.0, 0.5 * (a + b), 0.5 * (b + c), 0.5 * (c + a), a, b, c};
}

void drop_shreds(TriangleMesh& mesh, std::size_t min_faces) {
  const CornerTable table(mesh.triangles, mesh.positions.size());
  const std::vector<std::uint32_t> component = components_of(table);
  const std::vector<std::size_t> sizes = component_sizes(component);
  std::vector<std::uint8_t> goes(component.size(), 0);
  for (std::size_t f = 0; f < component.size(); ++f)
    goes[f] = sizes[component[f]] < min_faces ? 1 : 0;
  remove_triangles(mesh.triangles, goes);
}

/// Drops the faces near points that are left out whose own points look the other way.
void drop_inside_out(TriangleMesh& mesh, const SeenPoints& seen, const PointGrid& left_out,
                     double h) {
  std::vector<std::uint32_t> faces;
  for (std::uint32_t f = 0; f < mesh.triangles.size(); ++f) {
    const Vec3 center = centroid_of(mesh.positions, mesh.triangles[f]);
    if (left_out.has_point_within(center, kDoubted * h)) faces.push_back(f);
  }
  remove_triangles(mesh.triangles, inside_out_faces(mesh, faces, seen, kOwnPoints * h));
}

/// Where faces have grown inside out that hang together, and from where the points there are seen.
struct WrongPlaces {
  std::vector<Vec3> places;  ///< centroids
  std::vector<std::array<std::int8_t, 3>> votes;

  [[nodiscard]] SeenPoints seen() const { return {places, votes}; }
};

/// @param flags of faces that are inside out; those of small pieces are cleared
WrongPlaces wrong_places(const TriangleMesh& mesh, std::vector<std::uint8_t> flags, double h) {
  keep_pieces(mesh, flags,
              [&](const FlaggedPiece& piece) { return piece.area > kByChance * h * h; });
  WrongPlaces wrong;
  for (std::size_t f = 0; f < flags.size(); ++f) {
    if (flags[f] == 0) continue;
    const Vec3 vote = -kFullVote * unit_normal(mesh.positions, mesh.triangles[f]);
    wrong.places.push_back(centroid_of(mesh.positions, mesh.triangles[f]));
    wrong.votes.push_back({static_cast<std::int8_t>(vote.x), static_cast<std::int8_t>(vote.y),
                           static_cast<std::int8_t>(vote.z)});
  }
  return wrong;
}

/// Drops faces that lead through the air, and those that hide the way to points.
/// @param off points near those that the mesh does not show
void clear_way(TriangleMesh& mesh, std::span<const Vec3> off, const PointGrid& left_out,
               const PointGrid& cloud, const RegrowOptions& options) {
  const double h = options.pixel_size;
  const double in_the_way = options.in_the_way * h;  // faces there are quickly made again
  const PointGrid off_mesh(off, widened(bounds_of(mesh), kPart * h), 0.5 * in_the_way);
  remove_triangles(mesh.triangles, flags_of(mesh.triangles.size(), [&](std::size_t f) {
                     const std::array<Vec3, 7> places = places_on(mesh, mesh.triangles[f]);
                     return left_out.has_point_within(places[0], kDoubted * h) &&
                            std::any_of(places.begin(), places.end(), [&](const Vec3& place) {
                              return off_mesh.has_point_within(place, in_the_way) ||
                                     !is_supported(cloud, place, h, kCloseSupport);
                            });
                   }));
  clean_topology(mesh);
}

/// Moves each onto the plane through the points around it, more than once: the points around its
/// foot are not those around it.
void smooth(std::vector<Vec3>& points, const PointGrid& cloud, double h) {
  parallel_for(points.size(), kGrain, [&](std::size_t begin, std::size_t end) {
    for (std::size_t i = begin; i < end; ++i) {
      for (int round = 0; round < kSmoothRounds; ++round) {
        if (const auto plane = plane_at(points[i], cloud, kPlaneRadius * h))
          points[i] = plane->foot;
      }
    }
  });
}

/// The median of the spacing at some of the places.
double spacing_of(const std::vector<Vec3>& places, const PointGrid& cloud, double h) {
  std::vector<double> spacings;
  const std::size_t step = 1 + places.size() / kSpacingPlaces;
  for (std::size_t i = 0; i < places.size(); i += step)
    spacings.push_back(spacing_near(cloud, places[i], h).value_or(0.0));
  const auto middle = spacings.begin() + static_cast<std::ptrdiff_t>(spacings.size() / 2);
  std::nth_element(spacings.begin(), middle, spacings.end());
  return *middle;
}

/// Grows over points, and once more from the start where that goes on inside out: not with faces
/// there of which the points look out of the back.
class OutwardGrowth {
 public:
  /// @param whole that the part is taken from
  /// @param options get the votes that the last growth has kept to
  OutwardGrowth(const TriangleMesh& whole, FacePart& part, std::span<const Vec3> near,
                const SeenPoints& seen, GrowOverOptions& options, const Progress& progress)
      : whole_(whole),
        part_(part),
        start_(part.mesh),
        near_(near),
        seen_(seen),
        options_(options),
        progress_(progress) {}

  /// @param is_body whether it closes around what the faces look away from
  /// @return faces that came
  std::size_t run(bool is_body) {
    const std::size_t count = grow_over(part_.mesh, near_, options_, progress_);
    progress_.check_stop();
    const std::vector<std::uint32_t> grown = last_faces(part_.mesh, grown_count());
    const double h = options_.pixel_size;
    const WrongPlaces by_votes =
        wrong_places(part_.mesh, inside_out_faces(part_.mesh, grown, seen_, kOwnPoints * h), h);
    if (!by_votes.places.empty()) {
      const double around = kAroundWrong * h;
      return grow_again(seen_, points_near(near_, grid_of(by_votes.places, around), around));
    }
    if (!is_body) return count;
    wrong_ = facing_inwards();
    return wrong_.places.empty() ? count : grow_other_way_round(count);
  }

 private:
  [[nodiscard]] std::size_t grown_count() const {
    return part_.mesh.triangles.size() - start_.triangles.size();
  }

  static std::vector<std::uint32_t> last_faces(const TriangleMesh& mesh, std::size_t count) {
    std::vector<std::uint32_t> faces(count);
    std::iota(faces.begin(), faces.end(),
              static_cast<std::uint32_t>(mesh.triangles.size() - count));
    return faces;
  }

  /// Of what has grown, where no votes tell.
  [[nodiscard]] WrongPlaces facing_inwards() const {
    TriangleMesh all = whole_;
    put_back(part_, all);
    return wrong_places(all, faces_facing_inwards(all, last_faces(all, grown_count())),
                        options_.pixel_size);
  }

  /// @param votes known for longer than this
  std::size_t grow_again(const SeenPoints& votes, std::span<const Vec3> places) {
    votes_.emplace(votes, places, kOwnPoints * options_.pixel_size);
    options_.votes = &*votes_;
    part_.mesh = start_;
    return grow_over(part_.mesh, near_, options_, progress_);
  }

  /// Unless less is reached that way.
  std::size_t grow_other_way_round(std::size_t count) {
    TriangleMesh first = part_.mesh;
    const std::size_t second = grow_again(wrong_.seen(), wrong_.places);
    if (missing_in(part_.mesh) <= missing_in(first) + kFewLeftOut) return second;
    part_.mesh = std::move(first);
    options_.votes = nullptr;
    return count;
  }

  [[nodiscard]] std::size_t missing_in(const TriangleMesh& mesh) const {
    return points_off(near_, mesh, options_.off_mesh).size();
  }

  const TriangleMesh& whole_;
  FacePart& part_;
  TriangleMesh start_;
  std::span<const Vec3> near_;
  const SeenPoints& seen_;
  GrowOverOptions& options_;
  const Progress& progress_;
  WrongPlaces wrong_;  ///< that no votes tell
  std::optional<VoteGrid> votes_;
};

/// In h, of circles without points that are closed where fronts have stopped; 0: of none.
double void_radius_for(double spacing, double h) {
  if (spacing <= kSparseSpacing * h) return 0.0;
  return spacing > kVerySparseSpacing * h ? kVoidRadiusInVerySparse : kVoidRadius;
}

/// What is to be grown over.
struct Gaps {
  std::vector<Vec3> left_out;
  double noise = 0.0;  ///< model units
  bool is_noisy = false;
};

Gaps gaps_of(const TriangleMesh& mesh, std::span<const Vec3> points, const PointGrid& grid,
             const RegrowOptions& options) {
  const double h = options.pixel_size;
  Gaps gaps{.noise = noise_of(points, grid, h)};
  if (gaps.noise > kMostNoise * h) return gaps;
  gaps.is_noisy = gaps.noise > kHardlyNoise * h;
  const double distance = left_out_by(gaps.noise, h);
  const bool is_known = options.left_out != nullptr && distance == kLeftOut * h;
  gaps.left_out = is_known ? *options.left_out : left_out_points(points, mesh, distance);
  if (gaps.is_noisy) {
    smooth(gaps.left_out, grid, h);
    gaps.left_out = points_off(gaps.left_out, mesh, distance);
  }
  return gaps;
}

/// Grows the border of the mesh over what it leaves out. @return faces that came
std::size_t grow_border(TriangleMesh& mesh, const SeenPoints& seen, const PointGrid& grid,
                        const Gaps& gaps, GrowOverOptions fronts, const RegrowOptions& options,
                        const Progress& progress) {
  const double h = options.pixel_size;
  const PointGrid places(gaps.left_out, widened(bounds_of(mesh), kPart * h), 0.5 * kPlace * h);
  std::vector<Vec3> near = points_near(seen.points, places, kPlace * h);
  if (gaps.is_noisy) smooth(near, grid, h);
  drop_inside_out(mesh, seen, places, h);
  clear_way(mesh, points_off(near, mesh, fronts.off_mesh), places, grid, options);
  drop_shreds(mesh, seen.votes.empty() ? kMinPiece : kMinPieceOfBodies);
  FacePart part = part_near(mesh, places, kPart * h);
  progress.check_stop();
  if (part.mesh.empty()) return 0;  // they lie apart, and are of no body
  OutwardGrowth outwards(mesh, part, near, seen, fronts, progress);
  std::size_t count = options.only_outwards ? outwards.run(options.is_body)
                                            : grow_over(part.mesh, near, fronts, progress);
  if (fronts.void_radius == kVoidRadius)
    count += restart_fronts(part.mesh, near, places, fronts, progress);
  put_back(std::move(part), mesh);
  clean_topology(mesh);
  return count;
}

}  // namespace

GrowthReport regrow(TriangleMesh& mesh, const SeenPoints& seen, const PointGrid& grid,
                    const RegrowOptions& options, const Progress& progress) {
  const double h = options.pixel_size;
  if (mesh.empty()) return {};
  Gaps gaps = gaps_of(mesh, seen.points, grid, options);
  if (gaps.left_out.size() < kFewLeftOut) return {};
  progress.check_stop();
  const GrowOverOptions fronts{
      .pixel_size = h,
      .off_mesh = std::max(kOffMesh * h, kOffMeshPerNoise * gaps.noise),
      .void_radius = void_radius_for(spacing_of(gaps.left_out, grid, h), h)};
  GrowthReport report;
  if (options.is_body && !seen.votes.empty()) {
    report = grow_bodies(mesh, gaps.left_out, seen, fronts, progress);
    if (report.bodies > 0)
      gaps.left_out = points_off(gaps.left_out, mesh, left_out_by(gaps.noise, h));
    if (gaps.left_out.size() < kFewLeftOut) return report;
  }
  report.faces += grow_border(mesh, seen, grid, gaps, fronts, options, progress);
  return report;
}

}  // namespace rangezip

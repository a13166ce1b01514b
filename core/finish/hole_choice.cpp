#include "core/finish/hole_choice.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <utility>

#include "core/finish/left_out_faces.h"
#include "core/finish/loop_disc.h"
#include "core/finish/other_wall.h"
#include "core/finish/unsupported_faces.h"

namespace rangezip {
namespace {

/// In h: wider holes without points inside are closed flat; a smooth fill of them would bulge.
constexpr double kSmoothPerimeter = 30.0;
/// The cost of judging a loop grows with the square of its edges.
constexpr std::size_t kMaxEdges = 6000;
constexpr std::size_t kMaxWallEdges = 300;  ///< longer loops are borders
/// Mean cosine between the surface beside the loop and the plane across it: below, the surface ends
/// there. 0 at the end of a tube, -1 at the outline of a terrain, 1 in a plane.
constexpr double kLeadsInto = 0.25;
/// Below this a fill would fold back over the surface; only asked of loops longer than in h the
/// second figure: short ones are too ragged to tell.
constexpr double kFoldsBack = -0.3;
constexpr double kMinOutline = 30.0;
/// In h: a shorter loop is none of a component with so many times the area that it encloses.
constexpr double kSureOutline = 60.0;
constexpr double kDeepestSheet = 10.0;
/// Times the area that a loop encloses: of a component with less it is the outline.
constexpr double kFlat = 1.5;
/// Area over squared perimeter, 1 for a circle: of a loop below, a crack or a ribbon, only a fill
/// tells whether it folds back.
constexpr double kSlit = 0.15;
/// In h: where points tell nothing, a hole longer than this is large.
constexpr double kLargePerimeter = 60.0;
/// A long hole counts as large if it is also wider than this share of the largest perimeter; a
/// round one is wider than 0.3 of its perimeter.
constexpr double kLargeWidth = 0.25;
/// Area over squared perimeter, 1 for a circle: below, the plane across a loop means little.
/// A loop that has been zipped is as round as it gets; one that has not may have cracks.
constexpr double kRound = 0.6;
constexpr double kRoundOnceZipped = 0.4;
/// In h: a shorter loop is too ragged to be told from the end of a tube.
constexpr double kMinRim = 20.0;
/// In h: inside of a fill is what lies farther from the loop than this, the reach of what was
/// scanned beside it; evidence is a point nearer to it than kEvidenceRadius.
constexpr double kInsideMargin = 1.5;
constexpr double kEvidenceRadius = 1.0;
constexpr double kEvidenceShare = 0.3;
constexpr int kMinEvidenceSamples = 3;
/// Mean cosine, of the faces beside a loop toward its axis: they are the wall of a hole.
constexpr double kLooksInwards = 0.5;
/// A border may be a pixel beyond the points; of a loop that strays farther the fill tells nothing.
constexpr SupportReach kLoopSupport{1.25, 2.0};
constexpr double kShownLoop = 0.9;  // of the vertices of a loop

constexpr double kFourPi = 12.566370614359172954;

struct LoopGeometry {
  std::vector<Vec3> points;
  double perimeter = 0.0;
  Vec3 across{0.0};  ///< area vector of the loop
  Vec3 beside{0.0};  ///< mean unit normal of the faces along the loop
};

LoopGeometry geometry_of(const std::vector<Vec3>& positions, const CornerTable& table,
                         const BoundaryLoop& loop) {
  LoopGeometry geometry;
  for (const std::uint32_t v : vertices_of(loop, table))
    geometry.points.push_back(positions[v]);
  const std::size_t n = geometry.points.size();
  for (std::size_t i = 0; i < n; ++i) {
    const Vec3& p = geometry.points[i];
    const Vec3& q = geometry.points[(i + 1) % n];
    const double side = glm::length(q - p);
    geometry.perimeter += side;
    geometry.across += 0.5 * area_vector(geometry.points[0], p, q);
    geometry.beside += side * unit_normal(positions, table.triangle(loop.corners[i] / 3));
  }
  geometry.beside /= geometry.perimeter;
  return geometry;
}

/// Area over squared perimeter, 1 for a circle.
double roundness_of(const LoopGeometry& loop) {
  return kFourPi * glm::length(loop.across) / (loop.perimeter * loop.perimeter);
}

/// Short loops are too ragged to tell; one that is not long is a hole of something much larger.
bool may_be_outline(double perimeter, double sheet_area, const HoleChoiceOptions& options) {
  if (perimeter <= kMinOutline * options.pixel_size) return false;
  return options.has_narrow_gaps || perimeter > kSureOutline * options.pixel_size ||
         kFourPi * sheet_area <= kDeepestSheet * perimeter * perimeter;
}

/// Short or not, the outline of something that an open sheet shows from one side.
bool is_outline_of_flat(const LoopGeometry& loop, double sheet_area,
                        const HoleChoiceOptions& options) {
  return options.open_sheet && sheet_area <= kFlat * glm::length(loop.across);
}

/// The outline of a sheet: a fill would fold back over the sheet, and every point of that would
/// look as if it were evidence for the fill.
bool is_outline(const LoopGeometry& geometry, const std::vector<Vec3>& positions,
                const CornerTable& table, const BoundaryLoop& loop,
                const HoleChoiceOptions& options) {
  if (roundness_of(geometry) < kSlit) {
    const HoleFill fill =
        fill_loop(positions, table, loop, FillShape::coarse, 0.0, {}, options.memo);
    return continuation_of(positions, table, loop.corners, fill.triangles) < 0.0;
  }
  return glm::dot(geometry.across, geometry.beside) < kFoldsBack * glm::length(geometry.across);
}

/// A round loop at which the surface ends.
bool is_rim(const LoopGeometry& loop, bool is_zipped, double pixel_size) {
  if (loop.perimeter < kMinRim * pixel_size) return false;
  if (roundness_of(loop) < (is_zipped ? kRoundOnceZipped : kRound)) return false;
  return glm::dot(loop.across, loop.beside) < kLeadsInto * glm::length(loop.across);
}

/// What the new points of a fill tell about a hole.
struct FillInside {
  double width = 0.0;  ///< of the widest place, model units
  Inside shown = Inside::unknown;
};

/// The narrow fill of a slit, if no side of it is longer than the diagonal between the sides of a
/// crack.
HoleFill fill_of_crack(const std::vector<Vec3>& positions, const CornerTable& table,
                       const BoundaryLoop& loop, const LoopGeometry& geometry,
                       const CloudEvidence& evidence, const HoleChoiceOptions& options) {
  if (roundness_of(geometry) >= kSlit) return {};
  HoleFill fill = fill_loop(positions, table, loop, FillShape::narrow, 0.0, evidence, options.memo);
  const std::size_t n = geometry.points.size();
  double along = 0.0;
  for (std::size_t i = 0; i < n; ++i)
    along = std::max(along, glm::length(geometry.points[(i + 1) % n] - geometry.points[i]));
  const double widest = std::hypot(along, options.narrow_width * options.pixel_size);
  for (const Triangle& t : fill.triangles) {
    for (std::size_t i = 0; i < 3; ++i) {
      if (glm::length(positions[t[(i + 1) % 3]] - positions[t[i]]) > widest) return {};
    }
  }
  return fill;
}

double distance_to(const std::vector<Vec3>& points, const Vec3& p) {
  double least = std::numeric_limits<double>::infinity();
  for (const Vec3& q : points)
    least = std::min(least, glm::dot(q - p, q - p));
  return std::sqrt(least);
}

FillInside look_inside(const LoopGeometry& loop, const HoleFill& fill, const PointGrid& cloud,
                       double pixel_size) {
  const double radius = kEvidenceRadius * pixel_size;
  FillInside inside;
  int samples = 0;
  int supported = 0;
  for (const Vec3& p : fill.new_positions) {
    const double distance = distance_to(loop.points, p);
    inside.width = std::max(inside.width, 2.0 * distance);
    if (distance < kInsideMargin * pixel_size) continue;
    ++samples;
    supported += cloud.has_point_within(p, radius) ? 1 : 0;
  }
  if (samples >= kMinEvidenceSamples)
    inside.shown = supported > kEvidenceShare * samples ? Inside::points : Inside::air;
  return inside;
}

/// Whether the faces beside a loop look inwards, to where hardly any points are: the wall of a
/// hole.
bool is_across_hole(const LoopGeometry& geometry, const std::vector<Vec3>& positions,
                    const CornerTable& table, const BoundaryLoop& loop, const PointGrid& cloud) {
  const LoopDisc disc = disc_of_loop(geometry.points);
  double inwards = 0.0;
  const std::size_t n = geometry.points.size();
  for (std::size_t i = 0; i < n; ++i) {
    const Vec3 &p = geometry.points[i], &q = geometry.points[(i + 1) % n];
    const Vec3 normal = unit_normal(positions, table.triangle(loop.corners[i] / 3));
    inwards += glm::length(q - p) * glm::dot(normal, toward_axis(disc, 0.5 * (p + q)));
  }
  return inwards >= kLooksInwards * geometry.perimeter && !is_filled(cloud, geometry.points, disc);
}

/// Whether at some place of a fill the surface was not sampled, as points around it show. A loop
/// that strays from the points itself tells nothing.
/// @param positions of the table's vertices
bool has_left_out(const LoopGeometry& loop, const std::vector<Vec3>& positions,
                  const HoleFill& fill, const PointGrid& cloud, double pixel_size) {
  const auto is_shown = [&](const Vec3& place) {
    return is_supported(cloud, place, pixel_size, kLoopSupport);
  };
  const auto corner = [&](std::uint32_t v) { return corner_of(fill, positions, v); };
  const bool has_gap =
      std::any_of(fill.triangles.begin(), fill.triangles.end(), [&](const Triangle& t) {
        const Vec3 middle = (corner(t[0]) + corner(t[1]) + corner(t[2])) / 3.0;
        return is_left_out(cloud, middle, pixel_size);
      });
  if (!has_gap) return false;
  const auto shown = std::count_if(loop.points.begin(), loop.points.end(), is_shown);
  return static_cast<double>(shown) >= kShownLoop * static_cast<double>(loop.points.size());
}

/// Takes away from a fill what was not sampled. @return whether that was anything
bool open_left_out(const std::vector<Vec3>& positions, HoleFill& fill, const PointGrid& cloud,
                   double pixel_size) {
  const std::size_t before = fill.triangles.size();
  const auto corner = [&](std::uint32_t v) { return corner_of(fill, positions, v); };
  remove_triangles(fill.triangles, left_out_faces(fill.triangles, corner, cloud, pixel_size));
  return fill.triangles.size() < before;
}

bool is_lost_wall(const std::vector<Vec3>& positions, const CornerTable& table,
                  const BoundaryLoop& loop, const FaceTree& faces, const PointGrid& cloud,
                  const HoleChoiceOptions& options) {
  return options.is_sampled && loop.corners.size() <= kMaxWallEdges &&
         is_other_wall(positions, table, loop, faces, cloud, options.noise, options.pixel_size,
                       options.memo);
}

}  // namespace

std::optional<FillChoice> choose_fill(const std::vector<Vec3>& positions, const CornerTable& table,
                                      const BoundaryLoop& loop, const FaceTree& faces,
                                      double sheet_area, bool is_zipped, const PointGrid& cloud,
                                      const HoleChoiceOptions& options) {
  const double h = options.pixel_size;
  if (loop.corners.size() > kMaxEdges) return std::nullopt;
  const LoopGeometry geometry = geometry_of(positions, table, loop);
  if (is_outline_of_flat(geometry, sheet_area, options)) return std::nullopt;
  if (geometry.perimeter <= kSmallPerimeter * h) return FillChoice{.shape = FillShape::smooth};
  if (may_be_outline(geometry.perimeter, sheet_area, options) &&
      is_outline(geometry, positions, table, loop, options)) {
    if (!is_lost_wall(positions, table, loop, faces, cloud, options)) return std::nullopt;
    return FillChoice{.shape = FillShape::smooth, .is_wall = true};
  }
  const CloudEvidence evidence = options.is_sampled ? CloudEvidence{&cloud, h} : CloudEvidence{};
  HoleFill fill = fill_loop(positions, table, loop, FillShape::smooth, h, evidence, options.memo);
  const FillInside inside = look_inside(geometry, fill, cloud, h);
  const auto smooth = [&] {
    return FillChoice{.shape = FillShape::smooth, .fill = std::move(fill)};
  };
  if (inside.shown == Inside::points) {
    const bool is_open =
        options.is_sampled && options.leaves_gaps && open_left_out(positions, fill, cloud, h);
    return FillChoice{.shape = FillShape::smooth, .leaves_gaps = is_open, .fill = std::move(fill)};
  }
  const auto has_gap = [&] { return has_left_out(geometry, positions, fill, cloud, h); };
  if (is_rim(geometry, is_zipped, h) && (!options.is_sampled || has_gap())) return std::nullopt;
  if (inside.width < options.narrow_width * h) return FillChoice{.shape = FillShape::flat};
  if (HoleFill crack = fill_of_crack(positions, table, loop, geometry, evidence, options);
      !crack.triangles.empty())
    return FillChoice{.shape = FillShape::narrow, .fill = std::move(crack)};
  if (!is_zipped) return FillChoice{.shape = FillShape::zipped};
  const bool is_to_close = geometry.perimeter <= options.max_hole_perimeter * h;
  if (!is_to_close && options.is_sampled && has_gap()) return std::nullopt;
  const double limit = std::max(options.max_hole_perimeter, kLargePerimeter) * h;
  if (geometry.perimeter > limit && inside.width > kLargeWidth * limit) return std::nullopt;
  if (geometry.perimeter <= kSmoothPerimeter * h) return smooth();
  return FillChoice{.shape = FillShape::flat};
}

Inside inside_of_fill(const std::vector<Vec3>& positions, const CornerTable& table,
                      const BoundaryLoop& loop, const PointGrid& cloud, double pixel_size) {
  const HoleFill fill = fill_loop(positions, table, loop, FillShape::smooth, pixel_size);
  const LoopGeometry geometry = geometry_of(positions, table, loop);
  const Inside shown = look_inside(geometry, fill, cloud, pixel_size).shown;
  if (shown != Inside::unknown) return shown;
  return is_across_hole(geometry, positions, table, loop, cloud) ? Inside::air : Inside::unknown;
}

}  // namespace rangezip

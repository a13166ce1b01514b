#include "core/finish/grow_bodies.h"

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <iterator>
#include <numbers>
#include <optional>
#include <unordered_map>
#include <utility>
#include <vector>

#include "core/base/cubes.h"
#include "core/base/disjoint_sets.h"
#include "core/base/spread.h"
#include "core/finish/clean_topology.h"
#include "core/finish/face_part.h"
#include "core/finish/facing_inwards.h"
#include "core/finish/left_out_points.h"
#include "core/finish/local_plane.h"
#include "core/finish/places_near.h"
#include "core/finish/votes_near.h"
#include "core/mesh/coverage.h"

namespace rangezip {
namespace {

constexpr double kApart = 1.4;             ///< in h, from the mesh: in the middle of a gap of 3 h
constexpr double kLink = 1.3;              ///< in h, between points of one body
constexpr double kPile = 0.1;              ///< in h: points in cubes of that size hang together
constexpr std::size_t kTriedPlaces = 100;  ///< of a body, for the front to start
/// In h, RMS, of what lies around a place: of a ball 4 h across it is 0.12, of points all over a
/// space 0.3 and more.
constexpr double kThick = 0.25;
constexpr double kStartRadius = 0.4;      ///< in h, of the circle through the first face's corners
constexpr double kShown = 0.75;           ///< of the points of a body, at least
constexpr double kNearlyClosed = 0.3;     ///< area vector over area
constexpr double kOwnPoints = 0.75;       ///< in h: those of a face
constexpr std::size_t kAskedFaces = 500;  ///< of a body, for where its front is

/// Points in groups: those that links hold together. Of each cube with sides of `pile` the first
/// one is linked to others, and all to it.
/// @pre pile is half of link at most
std::vector<std::vector<Vec3>> linked_groups(std::span<const Vec3> points, double link,
                                             double pile) {
  const std::vector<std::uint32_t> first_of = firsts_of_cubes(points, pile);
  std::unordered_map<Cube, std::vector<std::uint32_t>, CubeHash> firsts_in;
  for (std::uint32_t i = 0; i < points.size(); ++i) {
    if (first_of[i] == i) firsts_in[cube_of(points[i], link)].push_back(i);
  }
  DisjointSets sets(points.size());
  for (std::uint32_t i = 0; i < points.size(); ++i) {
    sets.join(i, first_of[i]);
    if (first_of[i] != i) continue;
    for_each_cube_around(cube_of(points[i], link), [&](const Cube& cube) {
      const auto found = firsts_in.find(cube);
      if (found == firsts_in.end()) return;
      for (const std::uint32_t j : found->second) {
        if (j < i && glm::length(points[i] - points[j]) <= link) sets.join(i, j);
      }
    });
  }
  std::vector<std::vector<Vec3>> groups;
  std::vector<std::size_t> group_of(points.size());
  for (std::uint32_t i = 0; i < points.size(); ++i) {
    const std::uint32_t first = sets.find(i);
    if (first == i) {
      group_of[i] = groups.size();
      groups.emplace_back();
    }
    groups[group_of[first]].push_back(points[i]);
  }
  return groups;
}

/// The groups of those that lie apart from the mesh as a whole.
std::vector<std::vector<Vec3>> bodies_apart(std::span<const Vec3> left_out,
                                            const TriangleMesh& mesh, double h) {
  if (points_off(left_out, mesh, kApart * h).size() < kFewLeftOut) return {};
  std::vector<std::vector<Vec3>> groups = linked_groups(left_out, kLink * h, kPile * h);
  std::erase_if(groups, [&](const std::vector<Vec3>& group) {
    return group.size() < kFewLeftOut || points_off(group, mesh, kApart * h).size() < group.size();
  });
  return groups;
}

/// A face in the plane of the points where they are flattest; none if most lie in no plane, as
/// stray points do.
std::optional<TriangleMesh> first_face(const std::vector<Vec3>& points, double h) {
  const PointGrid grid = grid_of(points, 0.5 * kPlaneRadius * h);
  std::vector<LocalPlane> planes;
  for (const std::size_t i : spread_indices(points.size(), kTriedPlaces)) {
    if (const auto plane = plane_at(points[i], grid, kPlaneRadius * h)) planes.push_back(*plane);
  }
  std::stable_sort(planes.begin(), planes.end(), [](const LocalPlane& p, const LocalPlane& q) {
    return p.thickness < q.thickness;
  });
  if (planes.empty() || planes[planes.size() / 2].thickness > kThick * h) return std::nullopt;
  const LocalPlane& flattest = planes.front();
  const double radius = kStartRadius * h;
  const Vec3 along = radius * flattest.tangent;
  const Vec3 aside = 0.5 * std::numbers::sqrt3 * glm::cross(flattest.normal, along);
  const Vec3& middle = flattest.foot;
  return TriangleMesh{
      .positions = {middle + along, middle - 0.5 * along + aside, middle - 0.5 * along - aside},
      .triangles = {{0, 1, 2}}};
}

/// Whether the faces look to all sides, as those around an inside do.
bool is_nearly_closed(const TriangleMesh& mesh) {
  Vec3 across{0.0};
  double area = 0.0;
  for (const auto& [a, b, c] : mesh.triangles) {
    const Vec3 face = 0.5 * area_vector(mesh.positions[a], mesh.positions[b], mesh.positions[c]);
    across += face;
    area += glm::length(face);
  }
  return glm::length(across) <= kNearlyClosed * area;
}

bool is_body(const TriangleMesh& grown, const std::vector<Vec3>& points, double h) {
  const double missing = static_cast<double>(points_off(points, grown, kLeftOut * h).size());
  if (missing > (1.0 - kShown) * static_cast<double>(points.size())) return false;
  return is_nearly_closed(grown);
}

/// Some of the faces from `begin` to `end`.
std::vector<std::uint32_t> faces_to_ask(std::size_t begin, std::size_t end) {
  std::vector<std::uint32_t> faces;
  for (const std::size_t i : spread_indices(end - begin, kAskedFaces))
    faces.push_back(static_cast<std::uint32_t>(begin + i));
  return faces;
}

/// For how many faces their points are seen in front of them, less those with points seen behind.
/// @param told grows by both
std::ptrdiff_t seen_in_front(const TriangleMesh& mesh, const std::vector<std::uint32_t>& faces,
                             const SeenPoints& seen, double h, std::size_t& told) {
  std::vector<Vec3> places;
  places.reserve(faces.size());
  for (const std::uint32_t f : faces)
    places.push_back(centroid_of(mesh.positions, mesh.triangles[f]));
  const VoteGrid votes(seen, places, kOwnPoints * h);
  std::ptrdiff_t more = 0;
  for (std::size_t i = 0; i < faces.size(); ++i) {
    const VotesNear near = votes.around(places[i]);
    const Vec3 normal = unit_normal(mesh.positions, mesh.triangles[faces[i]]);
    const bool is_front = near.look_toward(normal), is_back = near.look_toward(-normal);
    more += (is_front ? 1 : 0) - (is_back ? 1 : 0);
    told += is_front || is_back ? 1 : 0;
  }
  return more;
}

/// Turns the faces from `begin` to `end`, which are a body, if their front is inside.
void turn_outwards(TriangleMesh& mesh, std::size_t begin, std::size_t end, const SeenPoints& seen,
                   double h) {
  const std::vector<std::uint32_t> asked = faces_to_ask(begin, end);
  std::size_t told = 0;
  const std::ptrdiff_t in_front = seen_in_front(mesh, asked, seen, h, told);
  bool is_wrong = in_front < 0;
  if (2 * told <= asked.size()) {
    const std::vector<std::uint8_t> inwards = faces_facing_inwards(mesh, asked);
    is_wrong = 2 * std::count(inwards.begin(), inwards.end(), 1) > std::ssize(asked);
  }
  if (!is_wrong) return;
  for (Triangle& face : std::span(mesh.triangles).subspan(begin, end - begin))
    std::swap(face[1], face[2]);
}

void append(TriangleMesh& mesh, TriangleMesh body) {
  FacePart part{.index = std::vector<std::uint32_t>(mesh.positions.size(), FacePart::kNone)};
  part.mesh = std::move(body);
  put_back(std::move(part), mesh);
}

}  // namespace

GrowthReport grow_bodies(TriangleMesh& mesh, std::span<const Vec3> left_out, const SeenPoints& seen,
                         const GrowOverOptions& options, const Progress& progress) {
  const double h = options.pixel_size;
  std::vector<std::size_t> begins;  // of the bodies' faces
  const std::size_t begin = mesh.triangles.size();
  for (const std::vector<Vec3>& points : bodies_apart(left_out, mesh, h)) {
    progress.check_stop();
    std::optional<TriangleMesh> body = first_face(points, h);
    if (!body) continue;
    grow_over(*body, points, options, progress);
    clean_topology(*body);
    if (!is_body(*body, points, h)) continue;
    begins.push_back(mesh.triangles.size());
    append(mesh, std::move(*body));
  }
  for (std::size_t i = 0; i < begins.size(); ++i) {
    const std::size_t end = i + 1 < begins.size() ? begins[i + 1] : mesh.triangles.size();
    turn_outwards(mesh, begins[i], end, seen, h);
  }
  return {mesh.triangles.size() - begin, begins.size()};
}

}  // namespace rangezip

#include "core/finish/papered_faces.h"

#include <cstddef>
#include <cstdint>
#include <optional>

#include "core/base/parallel.h"
#include "core/finish/clean_topology.h"
#include "core/finish/flagged_pieces.h"
#include "core/finish/places_near.h"
#include "core/finish/unsupported_faces.h"
#include "core/finish/votes_near.h"

namespace rangezip {
namespace {

/// In h: the first step behind a face. What is met there may be its own surface.
constexpr double kFirstStep = 1.0;
constexpr double kStep = 0.5;       ///< in h
constexpr double kReach = 0.75;     ///< in h: points so near to a step are met
constexpr double kLeastArea = 3.0;  ///< in square h
constexpr double kNarrow = 1.0;     ///< in h: the width of cracks that are closed again
constexpr std::size_t kGrain = 256;

/// Where points lie behind a face.
struct Sight {
  std::size_t face = 0;
  Vec3 toward{0.0};  ///< unit normal of the face
  Vec3 place{0.0};
};

/// The first place straight behind a face that has points around it, but for its own surface.
std::optional<Vec3> place_behind(const Vec3& center, const Vec3& normal, const PointGrid& cloud,
                                 const Box& region, double h) {
  for (int step = 0;; ++step) {
    const Vec3 place = center - (kFirstStep + step * kStep) * h * normal;
    if (place != glm::clamp(place, region.lower, region.upper)) return std::nullopt;
    if (!cloud.has_point_within(place, kReach * h)) continue;
    return step > 0 ? std::optional(place) : std::nullopt;
  }
}

/// Whether a hole in place of the piece would be closed again.
bool is_small(const FlaggedPiece& piece, double least_rim, double h) {
  const double width = 2.0 * piece.area / piece.rim;  // of a long one
  return piece.rim <= least_rim || width < kNarrow * h;
}

/// Those of the faces that no point supports.
std::vector<Sight> sights_of(const TriangleMesh& mesh, const PointGrid& cloud, double h) {
  const Box region = widened(bounds_of(mesh), h);
  std::vector<std::optional<Vec3>> places(mesh.triangles.size());
  parallel_for(places.size(), kGrain, [&](std::size_t begin, std::size_t end) {
    for (std::size_t f = begin; f < end; ++f) {
      const Vec3 center = centroid_of(mesh.positions, mesh.triangles[f]);
      const Vec3 normal = unit_normal(mesh.positions, mesh.triangles[f]);
      if (normal == Vec3(0.0) || is_supported(cloud, center, h, kFaceSupport)) continue;
      places[f] = place_behind(center, normal, cloud, region, h);
    }
  });
  std::vector<Sight> sights;
  for (std::size_t f = 0; f < places.size(); ++f) {
    if (places[f])
      sights.push_back({f, unit_normal(mesh.positions, mesh.triangles[f]), *places[f]});
  }
  return sights;
}

}  // namespace

std::vector<std::uint8_t> papered_faces(const TriangleMesh& mesh, const PointGrid& cloud,
                                        const SeenPoints& seen, double pixel_size) {
  if (seen.votes.empty() || mesh.empty()) return {};
  const std::vector<Sight> sights = sights_of(mesh, cloud, pixel_size);
  std::vector<Vec3> places;
  places.reserve(sights.size());
  for (const Sight& sight : sights)
    places.push_back(sight.place);
  const VoteGrid votes(seen, places, kReach * pixel_size);
  std::vector<std::uint8_t> is_papered(mesh.triangles.size(), 0);
  for (const Sight& sight : sights)
    is_papered[sight.face] = votes.around(sight.place).look_toward(sight.toward) ? 1 : 0;
  const double least = kLeastArea * pixel_size * pixel_size;
  keep_pieces(mesh, is_papered, [&](const FlaggedPiece& piece) { return piece.area >= least; });
  return is_papered;
}

std::size_t drop_papered_faces(TriangleMesh& mesh, const PointGrid& cloud, const SeenPoints& seen,
                               double pixel_size, std::optional<double> least_rim) {
  std::vector<std::uint8_t> is_papered = papered_faces(mesh, cloud, seen, pixel_size);
  if (is_papered.empty()) return 0;
  keep_pieces(mesh, is_papered, [&](const FlaggedPiece& piece) {
    return !least_rim || !is_small(piece, *least_rim, pixel_size);
  });
  const std::size_t before = mesh.triangles.size();
  remove_triangles(mesh.triangles, is_papered);
  if (mesh.triangles.size() < before) clean_topology(mesh);
  return before - mesh.triangles.size();
}

}  // namespace rangezip

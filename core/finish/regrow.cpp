#include "core/finish/regrow.h"

#include <cstdint>
#include <utility>
#include <vector>

#include "core/base/parallel.h"
#include "core/finish/clean_topology.h"
#include "core/finish/extend_border.h"
#include "core/finish/face_part.h"
#include "core/finish/left_out_points.h"

namespace rangezip {
namespace {

constexpr std::size_t kMinPoints = 40;
/// In h, around points that are left out: where borders move; and which faces they might meet.
constexpr double kPlace = 4.0;
constexpr double kPart = 8.0;
constexpr std::size_t kGrain = 256;

bool is_near(const PointGrid& places, const Vec3& p, double radius) {
  bool found = false;
  places.for_each_near(p, radius, [&](const Vec3& offset) {
    found = found || glm::dot(offset, offset) <= radius * radius;
  });
  return found;
}

FacePart part_near(const TriangleMesh& mesh, const PointGrid& places, double radius) {
  std::vector<std::uint8_t> is_in(mesh.triangles.size(), 0);
  parallel_for(is_in.size(), kGrain, [&](std::size_t begin, std::size_t end) {
    for (std::size_t f = begin; f < end; ++f)
      is_in[f] = is_near(places, mesh.positions[mesh.triangles[f][0]], radius) ? 1 : 0;
  });
  return face_part(mesh, is_in);
}

}  // namespace

std::size_t regrow(TriangleMesh& mesh, std::span<const Vec3> points, const PointGrid& grid,
                   double pixel_size, const Progress& progress) {
  const double h = pixel_size;
  if (mesh.empty()) return 0;
  const std::vector<Vec3> left_out = left_out_points(points, mesh, h);
  if (left_out.size() < kMinPoints) return 0;
  Box region = bounds_of(mesh);
  region.lower -= Vec3(kPart * h);
  region.upper += Vec3(kPart * h);
  const PointGrid places(left_out, region, 0.5 * kPlace * h);
  FacePart part = part_near(mesh, places, kPart * h);
  if (part.mesh.empty()) return 0;  // they are of another body, inside of this one
  const ExtendBorderOptions options{
      .pixel_size = h, .may_reach = [&](const Vec3& p) { return is_near(places, p, kPlace * h); }};
  const ExtendBorderReport extended = extend_border(part.mesh, grid, options, progress);
  put_back(std::move(part), mesh);
  clean_topology(mesh);
  remove_unused_vertices(mesh);
  return extended.steps;
}

}  // namespace rangezip

#include "core/finish/regrow.h"

#include <algorithm>
#include <cstdint>
#include <vector>

#include "core/base/parallel.h"
#include "core/finish/clean_topology.h"
#include "core/finish/extend_border.h"
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

/// Faces of a mesh as a mesh of their own.
struct Part {
  TriangleMesh mesh;
  std::vector<std::uint32_t> vertex_in_whole;
};

/// Takes the faces near the places out of the whole.
Part take_part(TriangleMesh& whole, const PointGrid& places, double radius) {
  std::vector<std::uint8_t> is_taken(whole.triangles.size(), 0);
  parallel_for(is_taken.size(), kGrain, [&](std::size_t begin, std::size_t end) {
    for (std::size_t f = begin; f < end; ++f)
      is_taken[f] = is_near(places, whole.positions[whole.triangles[f][0]], radius) ? 1 : 0;
  });
  constexpr std::uint32_t kNone = 0xFFFFFFFFU;
  std::vector<std::uint32_t> number(whole.positions.size(), kNone);
  Part part;
  for (std::size_t f = 0; f < is_taken.size(); ++f) {
    if (is_taken[f] == 0) continue;
    Triangle face = whole.triangles[f];
    for (std::uint32_t& v : face) {
      if (number[v] == kNone) {
        number[v] = static_cast<std::uint32_t>(part.vertex_in_whole.size());
        part.vertex_in_whole.push_back(v);
        part.mesh.positions.push_back(whole.positions[v]);
      }
      v = number[v];
    }
    part.mesh.triangles.push_back(face);
  }
  remove_triangles(whole.triangles, is_taken);
  return part;
}

/// Puts it back; vertices past those that were taken are new.
void put_back(TriangleMesh& whole, Part part) {
  for (std::size_t v = 0; v < part.mesh.positions.size(); ++v) {
    if (v < part.vertex_in_whole.size()) {
      whole.positions[part.vertex_in_whole[v]] = part.mesh.positions[v];
      continue;
    }
    part.vertex_in_whole.push_back(static_cast<std::uint32_t>(whole.positions.size()));
    whole.positions.push_back(part.mesh.positions[v]);
    if (!whole.sources.empty()) whole.sources.emplace_back();
  }
  for (const auto& [a, b, c] : part.mesh.triangles) {
    whole.triangles.push_back(
        {part.vertex_in_whole[a], part.vertex_in_whole[b], part.vertex_in_whole[c]});
  }
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
  Part part = take_part(mesh, places, kPart * h);
  if (part.mesh.empty()) return 0;  // they are of another body, inside of this one
  const ExtendBorderOptions options{
      .pixel_size = h, .may_reach = [&](const Vec3& p) { return is_near(places, p, kPlace * h); }};
  const ExtendBorderReport extended = extend_border(part.mesh, grid, options, progress);
  put_back(mesh, std::move(part));
  clean_topology(mesh);
  remove_unused_vertices(mesh);
  return extended.steps;
}

}  // namespace rangezip

#include "core/finish/hidden_layers.h"

#include <algorithm>
#include <cstddef>

#include "core/base/parallel.h"
#include "core/finish/corner_table.h"
#include "core/finish/face_grid.h"
#include "core/finish/point_grid.h"

namespace rangezip {
namespace {

// In h.
constexpr double kReach = 4.0;
constexpr double kBehind = 0.3;
constexpr double kSupport = 0.75;  // of a place of the mesh: so near samples are seen
constexpr double kCell = 0.5;
constexpr std::size_t kPerBlock = 1024;

}  // namespace

void drop_hidden_layers(std::vector<Vec3>& samples, const std::vector<std::uint8_t>& is_unseen,
                        const TriangleMesh& mesh, double pixel_size) {
  if (mesh.empty() || std::find(is_unseen.begin(), is_unseen.end(), 1) == is_unseen.end()) return;
  std::vector<Vec3> seen;
  for (std::size_t i = 0; i < samples.size(); ++i) {
    if (is_unseen[i] == 0) seen.push_back(samples[i]);
  }
  Box region = bounds_of(mesh);  // which may end a little inside of a flat face
  region.lower -= Vec3(pixel_size);
  region.upper += Vec3(pixel_size);
  const PointGrid evidence(seen, region, kCell * pixel_size);
  const FaceGrid faces(mesh, pixel_size);
  const auto is_hidden = [&](const Vec3& sample) {
    const std::uint32_t face = faces.nearest_face(sample, kReach * pixel_size);
    if (face == CornerTable::kNone) return false;
    const Triangle& t = mesh.triangles[face];
    const Vec3 normal = unit_normal(mesh.positions, t);
    const double height = glm::dot(normal, sample - mesh.positions[t[0]]);
    return height < -kBehind * pixel_size &&
           evidence.has_point_within(sample - height * normal, kSupport * pixel_size);
  };
  std::vector<std::uint8_t> is_dropped(samples.size(), 0);
  parallel_for(samples.size(), kPerBlock, [&](std::size_t begin, std::size_t end) {
    for (std::size_t i = begin; i < end; ++i)
      is_dropped[i] = is_unseen[i] != 0 && is_hidden(samples[i]) ? 1 : 0;
  });
  std::size_t kept = 0;
  for (std::size_t i = 0; i < samples.size(); ++i) {
    if (is_dropped[i] == 0) samples[kept++] = samples[i];
  }
  samples.resize(kept);
}

}  // namespace rangezip

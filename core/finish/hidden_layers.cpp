#include "core/finish/hidden_layers.h"

#include <algorithm>
#include <cstddef>
#include <span>

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

/// Tells what lies behind a mesh, near samples that are seen.
class Behind {
 public:
  Behind(const TriangleMesh& mesh, std::span<const Vec3> seen, double pixel_size)
      : mesh_(mesh),
        h_(pixel_size),
        table_(mesh.triangles, mesh.positions.size()),
        faces_(mesh, pixel_size),
        // The mesh may end a little inside of a flat face.
        evidence_(seen, widened(bounds_of(mesh), pixel_size), kCell * pixel_size) {}

  /// Whether the place lies behind the nearest face, or one beside it: next to a seam between two
  /// walls that go through each other each goes on behind the other, in the plane of its own faces.
  [[nodiscard]] bool holds(const Vec3& place) const {
    const std::uint32_t face = faces_.nearest_face(place, kReach * h_);
    if (face == CornerTable::kNone) return false;
    bool is_behind = is_behind_face(place, face);
    for (const std::uint32_t v : mesh_.triangles[face]) {
      table_.for_each_corner(v, [&](std::uint32_t corner) {
        is_behind = is_behind || is_behind_face(place, corner / 3);
      });
    }
    return is_behind;
  }

 private:
  [[nodiscard]] bool is_behind_face(const Vec3& place, std::uint32_t face) const {
    const Triangle& t = mesh_.triangles[face];
    const Vec3 normal = unit_normal(mesh_.positions, t);
    const double height = glm::dot(normal, place - mesh_.positions[t[0]]);
    return height < -kBehind * h_ &&
           evidence_.has_point_within(place - height * normal, kSupport * h_);
  }

  const TriangleMesh& mesh_;
  double h_;
  CornerTable table_;
  FaceGrid faces_;
  PointGrid evidence_;
};

}  // namespace

void drop_hidden_layers(std::vector<Vec3>& samples, const std::vector<std::uint8_t>& is_unseen,
                        const TriangleMesh& mesh, double pixel_size) {
  if (mesh.empty() || std::find(is_unseen.begin(), is_unseen.end(), 1) == is_unseen.end()) return;
  std::vector<Vec3> seen;
  for (std::size_t i = 0; i < samples.size(); ++i) {
    if (is_unseen[i] == 0) seen.push_back(samples[i]);
  }
  const Behind behind(mesh, seen, pixel_size);
  std::vector<std::uint8_t> is_dropped(samples.size(), 0);
  parallel_for(samples.size(), kPerBlock, [&](std::size_t begin, std::size_t end) {
    for (std::size_t i = begin; i < end; ++i)
      is_dropped[i] = is_unseen[i] != 0 && behind.holds(samples[i]) ? 1 : 0;
  });
  std::size_t kept = 0;
  for (std::size_t i = 0; i < samples.size(); ++i) {
    if (is_dropped[i] == 0) samples[kept++] = samples[i];
  }
  samples.resize(kept);
}

}  // namespace rangezip

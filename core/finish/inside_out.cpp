#include "core/finish/inside_out.h"

#include "core/finish/votes_near.h"

namespace rangezip {

std::vector<std::uint8_t> inside_out_faces(const TriangleMesh& mesh,
                                           std::span<const std::uint32_t> faces,
                                           const SeenPoints& seen, double radius) {
  std::vector<std::uint8_t> flags(mesh.triangles.size(), 0);
  if (seen.votes.empty()) return flags;
  std::vector<Vec3> places;
  places.reserve(faces.size());
  for (const std::uint32_t f : faces)
    places.push_back(centroid_of(mesh.positions, mesh.triangles[f]));
  const VoteGrid votes(seen, places, radius);
  for (const std::uint32_t f : faces)
    flags[f] = votes.look_out_of_back(mesh.positions, mesh.triangles[f]) ? 1 : 0;
  return flags;
}

}  // namespace rangezip

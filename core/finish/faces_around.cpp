#include "core/finish/faces_around.h"

#include <cstddef>
#include <cstdint>

#include "core/finish/box_tree.h"
#include "core/mesh/triangle_overlap.h"

namespace rangezip {
namespace {

constexpr double kMargin = 2.0;     ///< in h
constexpr double kGuardCube = 1.5;  ///< in h

Box box_around(const TriangleMesh& mesh, const std::vector<std::uint32_t>& vertices,
               double margin) {
  Box box;
  for (const std::uint32_t v : vertices)
    box.add(mesh.positions[v]);
  return widened(box, margin);
}

/// The faces that come near a loop.
FacePart part_around(const TriangleMesh& mesh, const std::vector<std::vector<std::uint32_t>>& loops,
                     double margin) {
  std::vector<Box> boxes;
  boxes.reserve(loops.size());
  for (const std::vector<std::uint32_t>& loop : loops)
    boxes.push_back(box_around(mesh, loop, margin));
  const BoxTree tree(boxes);
  std::vector<std::uint8_t> is_in(mesh.triangles.size(), 0);
  for (std::size_t f = 0; f < is_in.size(); ++f)
    is_in[f] = tree.meets(box_of(mesh, mesh.triangles[f])) ? 1 : 0;
  return face_part(mesh, is_in);
}

}  // namespace

FacesAround::FacesAround(const TriangleMesh& mesh,
                         const std::vector<std::vector<std::uint32_t>>& loops, double pixel_size)
    : part_(part_around(mesh, loops, kMargin * pixel_size)),
      guard_(part_.mesh, kGuardCube * pixel_size) {}

bool FacesAround::can_take(const Triangle& face) const {
  const Triangle local = local_of(face);
  return !is_degenerate(part_.mesh, local) && !guard_.would_cross(local);
}

void FacesAround::take(const Triangle& face) {
  part_.mesh.triangles.push_back(local_of(face));
  guard_.add(static_cast<std::uint32_t>(part_.mesh.triangles.size() - 1));
}

Triangle FacesAround::local_of(Triangle face) const {
  for (std::uint32_t& v : face)
    v = part_.index[v];
  return face;
}

}  // namespace rangezip

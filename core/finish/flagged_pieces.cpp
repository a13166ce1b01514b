#include "core/finish/flagged_pieces.h"

#include <cstddef>

#include "core/finish/components.h"
#include "core/finish/corner_table.h"

namespace rangezip {

void keep_pieces(const TriangleMesh& mesh, std::vector<std::uint8_t>& flags,
                 const std::function<bool(const FlaggedPiece&)>& is_kept) {
  std::vector<std::size_t> faces;
  std::vector<Triangle> triangles;
  for (std::size_t f = 0; f < flags.size(); ++f) {
    if (flags[f] == 0) continue;
    faces.push_back(f);
    triangles.push_back(mesh.triangles[f]);
  }
  const CornerTable table(triangles, mesh.positions.size());
  const std::vector<std::uint32_t> piece = components_of(table);
  std::vector<FlaggedPiece> pieces(faces.size());
  for (std::size_t i = 0; i < faces.size(); ++i) {
    pieces[piece[i]].area += area_of_face(mesh.positions, triangles[i]);
    for (auto c = static_cast<std::uint32_t>(3 * i); c < 3 * i + 3; ++c) {
      if (table.across(c) != CornerTable::kNone) continue;
      pieces[piece[i]].rim +=
          glm::length(mesh.positions[table.head(c)] - mesh.positions[table.vertex(c)]);
    }
  }
  for (std::size_t i = 0; i < faces.size(); ++i)
    flags[faces[i]] = is_kept(pieces[piece[i]]) ? 1 : 0;
}

}  // namespace rangezip

#include "core/finish/air_bridges.h"

#include <cstdint>
#include <vector>

#include "core/finish/clean_topology.h"
#include "core/finish/components.h"
#include "core/finish/corner_table.h"
#include "core/finish/places_near.h"
#include "core/finish/unsupported_faces.h"

namespace rangezip {
namespace {

/// In square h: of a piece that leads over more, the cloud has not shown what lies there.
constexpr double kMostArea = 20.0;

/// Flags of faces that belong to no body.
std::vector<std::uint8_t> faces_between(const std::vector<std::uint32_t>& body,
                                        const std::vector<std::uint8_t>& bare,
                                        std::size_t min_body) {
  std::vector<std::size_t> faces(body.size(), 0);
  for (const std::uint32_t b : body)
    ++faces[b];
  return flags_of(body.size(),
                  [&](std::size_t f) { return bare[f] != 0 || faces[body[f]] < min_body; });
}

/// What lies between bodies and hangs together.
struct Piece {
  double bare_area = 0.0;
  std::uint32_t body = CornerTable::kNone;  ///< one that it is beside
  bool is_bridge = false;                   ///< it is beside another, too
};

}  // namespace

std::size_t drop_air_bridges(TriangleMesh& mesh, const PointGrid& cloud, double pixel_size,
                             std::size_t min_body) {
  if (cloud.empty()) return 0;
  const double h = pixel_size;
  const CornerTable table(mesh.triangles, mesh.positions.size());
  const std::vector<std::uint8_t> bare = flags_of(mesh.triangles.size(), [&](std::size_t f) {
    return !is_supported(cloud, mesh, mesh.triangles[f], h, kCloseSupport);
  });
  const std::vector<std::uint32_t> body = components_of(
      table, [&](std::uint32_t c) { return (bare[c / 3] | bare[table.across(c) / 3]) == 0; });
  const std::vector<std::uint8_t> between = faces_between(body, bare, min_body);
  const std::vector<std::uint32_t> piece = components_of(
      table, [&](std::uint32_t c) { return (between[c / 3] & between[table.across(c) / 3]) != 0; });

  std::vector<Piece> pieces(piece.size());
  for (std::uint32_t f = 0; f < piece.size(); ++f) {
    if (between[f] == 0) continue;
    Piece& here = pieces[piece[f]];
    if (bare[f] != 0) here.bare_area += area_of_face(mesh.positions, mesh.triangles[f]);
    for (std::uint32_t c = 3 * f; c < 3 * f + 3; ++c) {
      const std::uint32_t other = table.across(c);
      if (other == CornerTable::kNone || between[other / 3] != 0) continue;
      here.is_bridge =
          here.is_bridge || (here.body != CornerTable::kNone && here.body != body[other / 3]);
      here.body = body[other / 3];
    }
  }
  const std::vector<std::uint8_t> goes = flags_of(piece.size(), [&](std::size_t f) {
    const Piece& here = pieces[piece[f]];
    return bare[f] != 0 && here.is_bridge && here.bare_area <= kMostArea * h * h;
  });
  remove_triangles(mesh.triangles, goes);
  if (mesh.triangles.size() < goes.size()) clean_topology(mesh);
  return goes.size() - mesh.triangles.size();
}

}  // namespace rangezip

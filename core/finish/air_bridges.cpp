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

/// What each face is.
struct Labels {
  std::vector<std::uint8_t> bare;     ///< 1: no point is near
  std::vector<std::uint32_t> body;    ///< what bare faces part
  std::vector<std::uint8_t> between;  ///< 1: bare, or of what is too small for a body
  std::vector<std::uint32_t> piece;   ///< of faces in between that hang together
};

Labels labels_of(const TriangleMesh& mesh, const CornerTable& table, const PointGrid& cloud,
                 double h, std::size_t min_body) {
  Labels labels;
  labels.bare = flags_of(mesh.triangles.size(), [&](std::size_t f) {
    return !is_supported(cloud, mesh, mesh.triangles[f], h, kCloseSupport);
  });
  const auto joins = [&](const std::vector<std::uint8_t>& flags, std::uint8_t flag) {
    return [&flags, &table, flag](std::uint32_t c) {
      return flags[c / 3] == flag && flags[table.across(c) / 3] == flag;
    };
  };
  labels.body = components_of(table, joins(labels.bare, 0));
  const std::vector<std::size_t> sizes = component_sizes(labels.body);
  labels.between = flags_of(labels.body.size(), [&](std::size_t f) {
    return labels.bare[f] != 0 || sizes[labels.body[f]] < min_body;
  });
  labels.piece = components_of(table, joins(labels.between, 1));
  return labels;
}

/// What lies between bodies and hangs together.
struct Piece {
  double bare_area = 0.0;
  std::uint32_t body = CornerTable::kNone;  ///< one that it is beside
  bool is_bridge = false;                   ///< it is beside another, too
};

std::vector<Piece> pieces_between(const TriangleMesh& mesh, const CornerTable& table,
                                  const Labels& labels) {
  std::vector<Piece> pieces(labels.piece.size());
  for (std::uint32_t f = 0; f < labels.piece.size(); ++f) {
    if (labels.between[f] == 0) continue;
    Piece& piece = pieces[labels.piece[f]];
    if (labels.bare[f] != 0) piece.bare_area += area_of_face(mesh.positions, mesh.triangles[f]);
    for (std::uint32_t c = 3 * f; c < 3 * f + 3; ++c) {
      const std::uint32_t other = table.across(c);
      if (other == CornerTable::kNone || labels.between[other / 3] != 0) continue;
      const std::uint32_t body = labels.body[other / 3];
      if (piece.body != CornerTable::kNone && piece.body != body) piece.is_bridge = true;
      piece.body = body;
    }
  }
  return pieces;
}

}  // namespace

std::size_t drop_air_bridges(TriangleMesh& mesh, const PointGrid& cloud, double pixel_size,
                             std::size_t min_body) {
  if (cloud.empty()) return 0;
  const CornerTable table(mesh.triangles, mesh.positions.size());
  const Labels labels = labels_of(mesh, table, cloud, pixel_size, min_body);
  const std::vector<Piece> pieces = pieces_between(mesh, table, labels);
  const double most = kMostArea * pixel_size * pixel_size;
  const std::vector<std::uint8_t> goes = flags_of(labels.bare.size(), [&](std::size_t f) {
    const Piece& piece = pieces[labels.piece[f]];
    return labels.bare[f] != 0 && piece.is_bridge && piece.bare_area <= most;
  });
  remove_triangles(mesh.triangles, goes);
  if (mesh.triangles.size() < goes.size()) clean_topology(mesh);
  return goes.size() - mesh.triangles.size();
}

}  // namespace rangezip

#include "core/finish/boundary_loops.h"

namespace rangezip {
namespace {

/// The boundary half-edge that ends where this one starts.
std::uint32_t boundary_before(const CornerTable& table, std::uint32_t corner) {
  std::uint32_t c = CornerTable::previous(corner);
  while (table.across(c) != CornerTable::kNone)
    c = CornerTable::previous(table.across(c));
  return c;
}

}  // namespace

std::vector<BoundaryLoop> boundary_loops(const CornerTable& table) {
  std::vector<BoundaryLoop> loops;
  std::vector<std::uint8_t> seen(table.corner_count(), 0);
  for (std::uint32_t first = 0; first < table.corner_count(); ++first) {
    if (table.is_deleted(first / 3) || table.across(first) != CornerTable::kNone) continue;
    if (seen[first] != 0) continue;
    BoundaryLoop loop;
    for (std::uint32_t c = first; seen[c] == 0; c = boundary_before(table, c)) {
      seen[c] = 1;
      loop.corners.push_back(c);
    }
    loops.push_back(std::move(loop));
  }
  return loops;
}

std::vector<std::uint32_t> vertices_of(const BoundaryLoop& loop, const CornerTable& table) {
  std::vector<std::uint32_t> vertices;
  vertices.reserve(loop.corners.size());
  for (const std::uint32_t c : loop.corners)
    vertices.push_back(table.head(c));
  return vertices;
}

double perimeter_of(const BoundaryLoop& loop, const CornerTable& table,
                    const std::vector<Vec3>& positions) {
  double sum = 0.0;
  for (const std::uint32_t c : loop.corners) {
    sum += glm::length(positions[table.head(c)] - positions[table.vertex(c)]);
  }
  return sum;
}

}  // namespace rangezip

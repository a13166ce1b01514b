#include "core/stitch/insert_segments.h"

#include <deque>
#include <optional>

namespace rangezip {

namespace {

using VertexHandle = SheetMesh::VertexHandle;
using HalfedgeHandle = SheetMesh::HalfedgeHandle;
using EdgeHandle = HalfedgeMesh::EdgeHandle;

/// Turns of one edge through the queue before the segment is given up: each round flips one at
/// least unless a flip would make an edge twice, which a folded surface can do.
constexpr std::size_t kMaxTurns = 2000;

class SegmentInserter {
 public:
  SegmentInserter(SheetMesh& sheet, VertexHandle start, VertexHandle end)
      : sheet_(sheet), start_(start), end_(end) {}

  /// False if the segment cannot be an edge.
  bool insert();
  [[nodiscard]] std::size_t flips() const { return flips_; }

 private:
  [[nodiscard]] std::int64_t side(VertexHandle v) const {
    return orientation(sheet_.point(start_), sheet_.point(end_), sheet_.point(v));
  }
  [[nodiscard]] VertexHandle apex(HalfedgeHandle e) const {
    return sheet_.mesh.to_vertex_handle(sheet_.mesh.next_halfedge_handle(e));
  }
  [[nodiscard]] bool looks_at_viewer(HalfedgeHandle e) const {
    return !sheet_.mesh.is_boundary(e) && sheet_.area(sheet_.mesh.face_handle(e)) > 0;
  }

  [[nodiscard]] HalfedgeHandle first_crossed() const;
  [[nodiscard]] std::optional<std::deque<EdgeHandle>> crossed_edges() const;
  [[nodiscard]] bool can_flip(EdgeHandle edge) const;
  [[nodiscard]] bool is_crossed(EdgeHandle edge) const;

  SheetMesh& sheet_;
  VertexHandle start_, end_;
  std::size_t flips_ = 0;
};

/// The edge opposite to the start in the face through which the segment leaves it; invalid if
/// there is none.
HalfedgeHandle SegmentInserter::first_crossed() const {
  for (const HalfedgeHandle e : sheet_.mesh.voh_range(start_)) {
    if (!looks_at_viewer(e)) continue;
    if (side(sheet_.mesh.to_vertex_handle(e)) < 0 && side(apex(e)) > 0) {
      return sheet_.mesh.next_halfedge_handle(e);
    }
  }
  return HalfedgeHandle();
}

/// The edges that the segment crosses, in order; nothing if it leaves the sheet or meets a vertex
/// before its end.
std::optional<std::deque<EdgeHandle>> SegmentInserter::crossed_edges() const {
  std::deque<EdgeHandle> crossed;
  HalfedgeHandle e = first_crossed();
  if (!e.is_valid()) return std::nullopt;
  for (;;) {
    crossed.push_back(sheet_.mesh.edge_handle(e));
    const HalfedgeHandle across = sheet_.mesh.opposite_halfedge_handle(e);
    if (!looks_at_viewer(across)) return std::nullopt;
    const VertexHandle ahead = apex(across);
    if (ahead == end_) return crossed;
    const std::int64_t where = side(ahead);
    if (where == 0 || crossed.size() > kMaxTurns) return std::nullopt;
    e = sheet_.mesh.next_halfedge_handle(across);
    if (where < 0) e = sheet_.mesh.next_halfedge_handle(e);
  }
}

/// Whether the two faces are a strictly convex quadrilateral in the image and a flip is legal.
bool SegmentInserter::can_flip(EdgeHandle edge) const {
  const HalfedgeHandle e = sheet_.mesh.halfedge_handle(edge, 0);
  const HalfedgeHandle f = sheet_.mesh.halfedge_handle(edge, 1);
  const GridPoint& from = sheet_.point(sheet_.mesh.from_vertex_handle(e));
  const GridPoint& to = sheet_.point(sheet_.mesh.to_vertex_handle(e));
  const GridPoint& left = sheet_.point(apex(e));
  const GridPoint& right = sheet_.point(apex(f));
  return orientation(left, from, right) > 0 && orientation(right, to, left) > 0 &&
         sheet_.mesh.is_flip_ok(edge);
}

bool SegmentInserter::is_crossed(EdgeHandle edge) const {
  const HalfedgeHandle e = sheet_.mesh.halfedge_handle(edge, 0);
  const VertexHandle a = sheet_.mesh.from_vertex_handle(e);
  const VertexHandle b = sheet_.mesh.to_vertex_handle(e);
  if (a == start_ || a == end_ || b == start_ || b == end_) return false;
  return (side(a) > 0) != (side(b) > 0);
}

bool SegmentInserter::insert() {
  if (sheet_.mesh.find_halfedge(start_, end_).is_valid()) return true;
  std::optional<std::deque<EdgeHandle>> queue = crossed_edges();
  if (!queue) return false;
  for (std::size_t turn = 0; !queue->empty(); ++turn) {
    if (turn > kMaxTurns) return false;
    const EdgeHandle edge = queue->front();
    queue->pop_front();
    if (!can_flip(edge)) {
      queue->push_back(edge);
      continue;
    }
    sheet_.mesh.flip(edge);
    ++flips_;
    if (is_crossed(edge)) queue->push_back(edge);
  }
  return sheet_.mesh.find_halfedge(start_, end_).is_valid();
}

}  // namespace

InsertedSegments insert_boundary_segments(SheetMesh& sheet,
                                          std::span<const std::array<VertexHandle, 2>> segments) {
  InsertedSegments result;
  for (const auto& [start, end] : segments) {
    SegmentInserter inserter(sheet, start, end);
    ++(inserter.insert() ? result.inserted : result.skipped);
    result.flips += inserter.flips();
  }
  return result;
}

}  // namespace rangezip

#include "core/stitch/insert_segments.h"

#include <deque>

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

  /// The edges that a segment crosses, in order, up to its end or a vertex on its line.
  struct Trace {
    std::deque<EdgeHandle> crossed;
    VertexHandle on_line = VertexHandle();
    bool has_arrived = false;
  };
  [[nodiscard]] HalfedgeHandle first_crossed(Trace& trace) const;
  [[nodiscard]] Trace trace() const;
  bool move_aside(VertexHandle v);
  bool flip_out(std::deque<EdgeHandle> crossed);
  [[nodiscard]] bool can_flip(EdgeHandle edge) const;
  [[nodiscard]] bool is_crossed(EdgeHandle edge) const;

  SheetMesh& sheet_;
  VertexHandle start_, end_;
  std::size_t flips_ = 0;
};

/// The edge opposite to the start in the face through which the segment leaves it; invalid if
/// there is none.
HalfedgeHandle SegmentInserter::first_crossed(Trace& trace) const {
  for (const HalfedgeHandle e : sheet_.mesh.voh_range(start_)) {
    const VertexHandle right = sheet_.mesh.to_vertex_handle(e);
    const bool is_ahead = dot_at(sheet_.point(start_), sheet_.point(right), sheet_.point(end_)) > 0;
    if (side(right) == 0 && is_ahead) trace.on_line = right;
    if (!looks_at_viewer(e)) continue;
    if (side(right) < 0 && side(apex(e)) > 0) return sheet_.mesh.next_halfedge_handle(e);
  }
  return HalfedgeHandle();
}

SegmentInserter::Trace SegmentInserter::trace() const {
  Trace trace;
  HalfedgeHandle e = first_crossed(trace);
  while (e.is_valid() && trace.crossed.size() <= kMaxTurns) {
    trace.crossed.push_back(sheet_.mesh.edge_handle(e));
    const HalfedgeHandle across = sheet_.mesh.opposite_halfedge_handle(e);
    if (!looks_at_viewer(across)) break;
    const VertexHandle ahead = apex(across);
    const std::int64_t where = side(ahead);
    trace.has_arrived = ahead == end_;
    if (where == 0 && !trace.has_arrived) trace.on_line = ahead;
    if (where == 0) break;
    e = sheet_.mesh.next_halfedge_handle(across);
    if (where < 0) e = sheet_.mesh.next_halfedge_handle(e);
  }
  return trace;
}

/// Moves the image of an old vertex by the smallest step to the left of the segment, where the
/// patch is and will cover it; false, and nothing is moved, if a face would turn over.
bool SegmentInserter::move_aside(VertexHandle v) {
  const GridPoint a = sheet_.point(start_);
  const GridPoint b = sheet_.point(end_);
  const auto sign = [](std::int64_t x) { return std::int64_t{x > 0} - std::int64_t{x < 0}; };
  std::vector<std::int64_t> areas;
  for (const auto face : sheet_.mesh.vf_range(v))
    areas.push_back(sheet_.area(face));
  GridPoint& point = sheet_.points[static_cast<std::size_t>(v.idx())];
  const GridPoint before = point;
  point = {point.x - sign(b.y - a.y), point.y + sign(b.x - a.x)};
  std::size_t i = 0;
  for (const auto face : sheet_.mesh.vf_range(v)) {
    if (areas[i++] > 0 && sheet_.area(face) <= 0) {
      point = before;
      return false;
    }
  }
  return true;
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

bool SegmentInserter::flip_out(std::deque<EdgeHandle> crossed) {
  for (std::size_t turn = 0; !crossed.empty(); ++turn) {
    if (turn > kMaxTurns) return false;
    const EdgeHandle edge = crossed.front();
    crossed.pop_front();
    if (!can_flip(edge)) {
      crossed.push_back(edge);
      continue;
    }
    sheet_.mesh.flip(edge);
    ++flips_;
    if (is_crossed(edge)) crossed.push_back(edge);
  }
  return sheet_.mesh.find_halfedge(start_, end_).is_valid();
}

bool SegmentInserter::insert() {
  for (;;) {
    if (sheet_.mesh.find_halfedge(start_, end_).is_valid()) return true;
    Trace found = trace();
    if (found.has_arrived) return flip_out(std::move(found.crossed));
    // Each vertex leaves the line once, so this ends.
    if (!found.on_line.is_valid() || !move_aside(found.on_line)) return false;
  }
}

}  // namespace

InsertedSegments insert_boundary_segments(SheetMesh& sheet,
                                          std::span<const std::array<VertexHandle, 2>> segments) {
  InsertedSegments result;
  for (const auto& [start, end] : segments) {
    SegmentInserter inserter(sheet, start, end);
    const bool is_edge = inserter.insert();
    result.is_edge.push_back(is_edge ? 1 : 0);
    ++(is_edge ? result.inserted : result.skipped);
    result.flips += inserter.flips();
  }
  return result;
}

}  // namespace rangezip

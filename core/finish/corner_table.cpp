#include "core/finish/corner_table.h"

#include <algorithm>
#include <cassert>
#include <cstddef>

#include "core/base/parallel.h"

namespace rangezip {

namespace {

constexpr std::size_t kVerticesPerBlock = 16384;

}  // namespace

CornerTable::CornerTable(const std::vector<Triangle>& triangles, std::size_t vertex_count)
    : corner_of_(vertex_count, kNone) {
  vertices_.reserve(3 * triangles.size());
  for (const Triangle& t : triangles)
    vertices_.insert(vertices_.end(), t.begin(), t.end());
  across_.assign(vertices_.size(), kNone);
  link_half_edges();
  for (std::uint32_t c = 0; c < vertices_.size(); ++c) {
    // A half-edge at the boundary begins its vertex's turn; else any will do.
    if (across_[c] == kNone || corner_of_[vertices_[c]] == kNone) corner_of_[vertices_[c]] = c;
  }
}

/// Calls visit(corner, vertex, head) for every half-edge.
template <class Visit>
void CornerTable::for_each_half_edge(const Visit& visit) const {
  for (std::uint32_t c = 0; c < vertices_.size(); c += 3) {
    const std::uint32_t u = vertices_[c], v = vertices_[c + 1], w = vertices_[c + 2];
    visit(c, u, v);
    visit(c + 1, v, w);
    visit(c + 2, w, u);
  }
}

/// Half-edges sorted by their lower vertex stand close to their opposites.
void CornerTable::link_half_edges() {
  std::vector<std::uint32_t> starts(corner_of_.size() + 1, 0);
  for_each_half_edge([&](std::uint32_t, std::uint32_t from, std::uint32_t to) {
    ++starts[std::min(from, to) + 1];
  });
  for (std::size_t v = 1; v < starts.size(); ++v)
    starts[v] += starts[v - 1];
  std::vector<HalfEdge> sorted(vertices_.size());
  std::vector<std::uint32_t> place(starts.begin(), starts.end() - 1);
  for_each_half_edge([&](std::uint32_t corner, std::uint32_t from, std::uint32_t to) {
    sorted[place[std::min(from, to)]++] = {std::max(from, to), from < to, corner};
  });
  // Half-edges with different lower vertices are never opposite, so blocks do not meet.
  parallel_for(corner_of_.size(), kVerticesPerBlock, [&](std::size_t begin, std::size_t end) {
    for (std::size_t low = begin; low < end; ++low)
      link_opposites(std::span(sorted).subspan(starts[low], starts[low + 1] - starts[low]));
  });
}

/// Links the half-edges of one lower vertex that are opposite.
void CornerTable::link_opposites(std::span<const HalfEdge> edges) {
  for (std::size_t i = 1; i < edges.size(); ++i) {
    for (std::size_t j = 0; j < i; ++j) {
      if (edges[i].high == edges[j].high && edges[i].is_rising != edges[j].is_rising)
        link(edges[i].corner, edges[j].corner);
    }
  }
}

void CornerTable::link(std::uint32_t a, std::uint32_t b) {
  if (a != kNone) across_[a] = b;
  if (b != kNone) across_[b] = a;
}

/// Turns clockwise to where turning counter-clockwise has to begin.
void CornerTable::set_corner_of(std::uint32_t vertex, std::uint32_t some_corner) {
  std::uint32_t c = some_corner;
  while (across_[c] != kNone) {
    c = next(across_[c]);
    if (c == some_corner) break;
  }
  corner_of_[vertex] = c;
}

std::vector<Triangle> CornerTable::triangles() const {
  std::vector<Triangle> kept;
  kept.reserve(face_count());
  for (std::uint32_t f = 0; f < face_count(); ++f) {
    if (!is_deleted(f)) kept.push_back(triangle(f));
  }
  return kept;
}

std::uint32_t CornerTable::half_edge(std::uint32_t from, std::uint32_t to) const {
  std::uint32_t found = kNone;
  for_each_corner(from, [&](std::uint32_t c) { found = head(c) == to ? c : found; });
  return found;
}

bool CornerTable::are_neighbors(std::uint32_t a, std::uint32_t b) const {
  const std::uint32_t first = corner_of_[a];
  for (std::uint32_t c = first; c != kNone;) {
    if (head(c) == b) return true;
    const std::uint32_t arriving = previous(c);
    c = across_[arriving];
    if (c == kNone) return vertex(arriving) == b;
    if (c == first) return false;
  }
  return false;
}

bool CornerTable::is_flip_ok(std::uint32_t corner) const {
  const std::uint32_t other = across_[corner];
  if (other == kNone) return false;
  return apex(corner) != apex(other) && !are_neighbors(apex(corner), apex(other));
}

void CornerTable::flip(std::uint32_t corner) {
  assert(is_flip_ok(corner));
  const std::uint32_t c = corner, cn = next(c), cp = previous(c);      // a->b, b->x, x->a
  const std::uint32_t d = across_[c], dn = next(d), dp = previous(d);  // b->a, a->y, y->b
  const std::uint32_t a = vertices_[c], b = vertices_[d], x = vertices_[cp], y = vertices_[dp];
  const std::uint32_t beyond_bx = across_[cn], beyond_ay = across_[dn];
  vertices_[cn] = y;  // c, cn, cp: a->y, y->x, x->a
  vertices_[dn] = x;  // d, dn, dp: b->x, x->y, y->b
  across_[c] = kNone;
  across_[d] = kNone;
  link(c, beyond_ay);
  link(d, beyond_bx);
  link(cn, dn);
  if (corner_of_[a] == dn) corner_of_[a] = c;
  if (corner_of_[b] == cn) corner_of_[b] = d;
}

bool CornerTable::is_collapse_ok(std::uint32_t corner) const {
  const std::uint32_t u = vertex(corner), w = head(corner);
  if (is_boundary(u)) return false;
  const std::uint32_t x = apex(corner), y = apex(across_[corner]);
  bool ok = true;
  int valence = 0;
  for_each_neighbor(u, [&](std::uint32_t v) {
    ++valence;
    if (v != w && v != x && v != y && ok && are_neighbors(v, w)) ok = false;
  });
  if (!ok || x == y) return false;
  // The third face around a vertex of valence 3 would fall onto the face beyond it.
  if (valence == 3) {
    const std::uint32_t third = next(across_[previous(corner)]);  // x -> y
    const std::uint32_t beyond = across_[third];
    return beyond == kNone || apex(beyond) != w;
  }
  return true;
}

void CornerTable::collapse(std::uint32_t corner) {
  assert(is_collapse_ok(corner));
  const std::uint32_t d = across_[corner];
  const std::uint32_t u = vertex(corner), w = head(corner), x = apex(corner), y = apex(d);
  for_each_corner(u, [&](std::uint32_t c) { vertices_[c] = w; });
  const std::uint32_t beyond_wx = across_[next(corner)], beyond_xu = across_[previous(corner)];
  const std::uint32_t beyond_uy = across_[next(d)], beyond_yw = across_[previous(d)];
  link(beyond_xu, beyond_wx);
  link(beyond_uy, beyond_yw);
  remove(corner / 3);
  remove(d / 3);
  corner_of_[u] = kNone;
  set_corner_of(w, beyond_xu);        // was u -> x
  set_corner_of(x, next(beyond_xu));  // leaves x
  set_corner_of(y, beyond_uy);        // was y -> u
}

bool CornerTable::is_boundary_collapse_ok(std::uint32_t corner) const {
  if (across_[corner] != kNone) return false;
  if (across_[next(corner)] == kNone && across_[previous(corner)] == kNone) return false;
  const std::uint32_t u = vertex(corner), w = head(corner), x = apex(corner);
  bool ok = true;
  for_each_neighbor(u, [&](std::uint32_t v) {
    if (v != w && v != x && ok && are_neighbors(v, w)) ok = false;
  });
  return ok;
}

void CornerTable::collapse_boundary(std::uint32_t corner) {
  assert(is_boundary_collapse_ok(corner));
  const std::uint32_t u = vertex(corner), w = head(corner), x = apex(corner);
  for_each_corner(u, [&](std::uint32_t c) { vertices_[c] = w; });
  const std::uint32_t beyond_wx = across_[next(corner)], beyond_xu = across_[previous(corner)];
  link(beyond_xu, beyond_wx);
  remove(corner / 3);
  corner_of_[u] = kNone;
  set_corner_of(w, beyond_xu != kNone ? beyond_xu : next(beyond_wx));
  set_corner_of(x, beyond_wx != kNone ? beyond_wx : next(beyond_xu));
}

void CornerTable::remove(std::uint32_t face) {
  const auto first = static_cast<std::ptrdiff_t>(face) * 3;
  std::fill_n(vertices_.begin() + first, 3, kNone);
  std::fill_n(across_.begin() + first, 3, kNone);
}

std::uint32_t CornerTable::split(std::uint32_t face) {
  const auto center = static_cast<std::uint32_t>(corner_of_.size());
  const std::uint32_t a = 3 * face, b = a + 1, c = a + 2;
  const auto second = static_cast<std::uint32_t>(vertices_.size());
  const std::uint32_t third = second + 3;
  const std::uint32_t vb = vertices_[b], vc = vertices_[c], va = vertices_[a];
  const std::uint32_t beyond_b = across_[b], beyond_c = across_[c];
  vertices_[c] = center;  // the face becomes (a, b, center)
  vertices_.insert(vertices_.end(), {vb, vc, center, vc, va, center});
  across_.insert(across_.end(), 6, kNone);
  across_[b] = kNone;
  across_[c] = kNone;
  link(second, beyond_b);
  link(third, beyond_c);
  link(b, second + 2);
  link(second + 1, third + 2);
  link(third + 1, c);
  corner_of_.push_back(c);
  if (corner_of_[vb] == b) corner_of_[vb] = second;
  if (corner_of_[vc] == c) corner_of_[vc] = third;
  return center;
}

std::uint32_t CornerTable::split_edge(std::uint32_t corner) {
  assert(across_[corner] != kNone);
  const std::uint32_t other = across_[corner];
  const std::uint32_t middle = split(corner / 3);
  flip(other);  // the edge itself now joins the new vertex to the corner beyond it
  return middle;
}

}  // namespace rangezip

#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "core/mesh/triangle_mesh.h"

namespace rangezip {

/// Who is next to whom in an oriented manifold triangle mesh, in flat arrays: the structure on
/// which the finish works. Corner c = 3 f + i is corner i of face f and names the half-edge that
/// leaves it counter-clockwise along f. Positions stay with the caller; vertices and faces keep
/// their indices, deleted faces only get marked [Rossignac, Safonova, Szymczak 2001].
class CornerTable {
 public:
  static constexpr std::uint32_t kNone = 0xffff'ffffU;

  /// O(faces), by a counting sort.
  /// @pre no face repeats a corner, no directed edge is in two faces (clean_topology()); a vertex
  ///     with several fans is allowed, but turning around it visits only one of them.
  CornerTable(const std::vector<Triangle>& triangles, std::size_t vertex_count);

  [[nodiscard]] static std::uint32_t next(std::uint32_t corner) noexcept {
    return corner % 3 == 2 ? corner - 2 : corner + 1;
  }
  [[nodiscard]] static std::uint32_t previous(std::uint32_t corner) noexcept {
    return corner % 3 == 0 ? corner + 2 : corner - 1;
  }

  [[nodiscard]] std::size_t face_count() const noexcept { return across_.size() / 3; }
  [[nodiscard]] std::size_t corner_count() const noexcept { return across_.size(); }
  [[nodiscard]] std::size_t vertex_count() const noexcept { return corner_of_.size(); }
  [[nodiscard]] std::uint32_t vertex(std::uint32_t corner) const noexcept {
    return vertices_[corner];
  }
  /// Where the half-edge of the corner ends.
  [[nodiscard]] std::uint32_t head(std::uint32_t corner) const noexcept {
    return vertices_[next(corner)];
  }
  /// The third vertex of the half-edge's face.
  [[nodiscard]] std::uint32_t apex(std::uint32_t corner) const noexcept {
    return vertices_[previous(corner)];
  }
  /// The opposite half-edge, or kNone at the boundary.
  [[nodiscard]] std::uint32_t across(std::uint32_t corner) const noexcept {
    return across_[corner];
  }
  /// The corner where turning counter-clockwise around the vertex begins: any if it is inside, the
  /// one after the gap at the boundary; kNone if the vertex has no face.
  [[nodiscard]] std::uint32_t corner_of(std::uint32_t vertex) const noexcept {
    return corner_of_[vertex];
  }
  [[nodiscard]] bool is_boundary(std::uint32_t vertex) const noexcept {
    return corner_of_[vertex] == kNone || across_[corner_of_[vertex]] == kNone;
  }
  /// Whether the half-edge lies inside and has the lower index of the two: true once an inner edge.
  [[nodiscard]] bool names_inner_edge(std::uint32_t corner) const noexcept {
    return across_[corner] != kNone && corner < across_[corner];
  }
  [[nodiscard]] bool is_deleted(std::uint32_t face) const noexcept {
    return vertices_[std::size_t{3} * face] == kNone;
  }
  [[nodiscard]] Triangle triangle(std::uint32_t face) const noexcept {
    const std::size_t c = std::size_t{3} * face;
    return {vertices_[c], vertices_[c + 1], vertices_[c + 2]};
  }
  /// The faces that are not deleted, in order.
  [[nodiscard]] std::vector<Triangle> triangles() const;

  /// Calls visit(corner) for the vertex's corner in each face around it, counter-clockwise.
  template <class Visit>
  void for_each_corner(std::uint32_t vertex, Visit visit) const {
    const std::uint32_t first = corner_of_[vertex];
    for (std::uint32_t c = first; c != kNone;) {
      visit(c);
      c = across_[previous(c)];
      if (c == first) return;
    }
  }
  /// Calls visit(vertex) for each neighbour, counter-clockwise.
  template <class Visit>
  void for_each_neighbor(std::uint32_t vertex, Visit visit) const {
    std::uint32_t last = kNone;
    for_each_corner(vertex, [&](std::uint32_t c) {
      visit(head(c));
      last = previous(c);
    });
    if (last != kNone && across_[last] == kNone) visit(vertices_[last]);
  }
  /// The half-edge from a vertex to a neighbour; kNone if no face has it.
  [[nodiscard]] std::uint32_t half_edge(std::uint32_t from, std::uint32_t to) const;
  [[nodiscard]] bool are_neighbors(std::uint32_t a, std::uint32_t b) const;

  /// Whether the edge of this half-edge may turn: it has two faces, and their outer corners are
  /// not neighbours yet.
  [[nodiscard]] bool is_flip_ok(std::uint32_t corner) const;
  /// Turns the edge: faces (a, b, x) and (b, a, y) become (a, y, x) and (b, x, y).
  /// @pre is_flip_ok(corner)
  void flip(std::uint32_t corner);

  /// Whether the half-edge's vertex may move into its head without changing the topology: it lies
  /// inside, and the two ends have no more common neighbours than the edge's two faces give
  /// [Dey et al. 1999].
  [[nodiscard]] bool is_collapse_ok(std::uint32_t corner) const;
  /// Merges the half-edge's vertex into its head; two faces get deleted.
  /// @pre is_collapse_ok(corner)
  void collapse(std::uint32_t corner);

  /// Whether the half-edge lies on the boundary, and its vertex may move into its head without
  /// changing the topology: the face's third corner is their only common neighbour, and one of the
  /// face's other edges has another face.
  [[nodiscard]] bool is_boundary_collapse_ok(std::uint32_t corner) const;
  /// Merges the half-edge's vertex into its head; one face gets deleted.
  /// @pre is_boundary_collapse_ok(corner)
  void collapse_boundary(std::uint32_t corner);

  /// Splits a face into three at a new vertex, whose index is returned (vertex_count() before).
  std::uint32_t split(std::uint32_t face);
  /// Splits an inner edge at a new vertex, whose index is returned; two faces are added.
  /// @pre the half-edge of the corner is none of the boundary
  std::uint32_t split_edge(std::uint32_t corner);

 private:
  /// What tells opposite half-edges among those with one lower vertex.
  struct HalfEdge {
    std::uint32_t high;  ///< the other vertex
    bool is_rising;      ///< leads to it
    std::uint32_t corner;
  };

  void link_half_edges();
  template <class Visit>
  void for_each_half_edge(const Visit& visit) const;
  void link_opposites(std::span<const HalfEdge> edges);
  void link(std::uint32_t a, std::uint32_t b);
  void set_corner_of(std::uint32_t vertex, std::uint32_t some_corner);
  void remove(std::uint32_t face);

  std::vector<std::uint32_t> vertices_;   // of each corner; kNone in deleted faces
  std::vector<std::uint32_t> across_;     // of each corner
  std::vector<std::uint32_t> corner_of_;  // of each vertex
};

}  // namespace rangezip

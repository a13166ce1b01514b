#pragma once

#include <algorithm>
#include <cstdint>
#include <span>
#include <utility>
#include <vector>

#include "core/finish/angle_mends.h"
#include "core/finish/box_cubes.h"
#include "core/finish/corner_table.h"
#include "core/finish/face_grid.h"
#include "core/finish/point_grid.h"
#include "core/mesh/triangle_mesh.h"

namespace rangezip {

/// In h: points that are less beyond the border do not count, as in extend_border.h.
inline constexpr double kNegligibleBeyond = 1e-3;
/// In h: what is nearer than this to a change tells whether it may be; points within the reach, and
/// faces that may be nearer to them.
inline constexpr double kMendReach = 2.5;

/// Whether one of a face's corners is flagged (1).
[[nodiscard]] inline bool has_flag(const std::vector<std::uint8_t>& flags, const Triangle& t) {
  return (flags[t[0]] | flags[t[1]] | flags[t[2]]) != 0;
}

/// Around faces that mends replace, what tells whether they may.
/// @param h pixel size, model units
[[nodiscard]] Box box_around(const TriangleMesh& mesh, const CornerTable& table,
                             std::span<const std::uint32_t> faces, double h);

/// A few faces as a mesh of their own.
struct Neighborhood {
  TriangleMesh mesh;
  std::vector<std::uint32_t> faces;     // of the whole, rising, one per face
  std::vector<std::uint32_t> vertices;  // of the whole, rising, one per position

  Neighborhood(const TriangleMesh& whole, std::vector<std::uint32_t> some)
      : faces(std::move(some)) {
    for (const std::uint32_t f : faces)
      vertices.insert(vertices.end(), whole.triangles[f].begin(), whole.triangles[f].end());
    std::sort(vertices.begin(), vertices.end());
    vertices.erase(std::unique(vertices.begin(), vertices.end()), vertices.end());
    for (const std::uint32_t v : vertices)
      mesh.positions.push_back(whole.positions[v]);
    for (const std::uint32_t f : faces)
      mesh.triangles.push_back(triangle(whole.triangles[f]));
  }

  [[nodiscard]] std::uint32_t vertex(std::uint32_t of_whole) const {
    return index_in(vertices, of_whole);
  }
  [[nodiscard]] std::uint32_t face(std::uint32_t of_whole) const {
    return index_in(faces, of_whole);
  }
  [[nodiscard]] Triangle triangle(const Triangle& of_whole) const {
    return {vertex(of_whole[0]), vertex(of_whole[1]), vertex(of_whole[2])};
  }

 private:
  static std::uint32_t index_in(const std::vector<std::uint32_t>& all, std::uint32_t of_whole) {
    return static_cast<std::uint32_t>(std::lower_bound(all.begin(), all.end(), of_whole) -
                                      all.begin());
  }
};

/// The surroundings of a face, on which its mends (angle_mends.h) are tried. Cost: those of a mesh
/// of the faces and points within some h.
class MendSpot {
 public:
  /// @param cubes of the faces of the mesh
  /// @param gone the faces that these replace
  /// @param h pixel size, model units
  /// @param beyond the border: how far points may be, model units
  MendSpot(const TriangleMesh& mesh, const CornerTable& table, const BoxCubes& cubes,
           std::span<const std::uint32_t> gone, const PointGrid& cloud, double h, double beyond);

  /// Whether with the mend no faces cross, and no point is farther beyond the border than may be,
  /// or than there is without.
  [[nodiscard]] bool allows(const AngleMend& mend) const;

 private:
  /// A mesh after a mend, and which of its faces are new.
  struct Mended {
    TriangleMesh mesh;
    std::vector<std::uint32_t> changed;
  };

  [[nodiscard]] Mended apply(const AngleMend& mend) const;
  [[nodiscard]] double farthest_beyond(const TriangleMesh& mesh, const CornerTable& table,
                                       const FaceGrid& faces) const;
  [[nodiscard]] std::vector<std::uint32_t> border(const TriangleMesh& mesh,
                                                  const CornerTable& table) const;
  [[nodiscard]] bool was_at_change(const Vec3& point) const;

  Neighborhood part_;
  const PointGrid& cloud_;
  double h_;
  CornerTable table_;
  FaceGrid faces_;
  std::vector<std::uint8_t> is_changed_;  // per position: a face around it may change
  Box near_change_;                       // twice the reach around the faces that may
  bool is_at_border_ = false;
  double beyond_ = 0.0;  // how far points may be
};

}  // namespace rangezip

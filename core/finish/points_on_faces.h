#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

#include "core/finish/corner_table.h"
#include "core/mesh/triangle_mesh.h"

namespace rangezip {

/// Which points of a cloud belong to which face of a mesh: those to which no other is nearer.
class PointsOnFaces {
 public:
  /// Finds the nearest face of every point.
  /// @param table that of the mesh, which has faces
  /// @param reach points farther than this from the mesh belong to no face, model units; positive
  PointsOnFaces(const TriangleMesh& mesh, const CornerTable& table, std::vector<Vec3> points,
                double reach);

  /// The same after vertices have moved a little, or edges have turned: from its last face, each
  /// point walks over edges as long as faces come clearly nearer.
  void follow(const CornerTable& table, const std::vector<Vec3>& positions);

  /// Finds the nearest face again, after some faces have changed or come.
  /// @param is_changed per face: 1 where a corner moved, or is another vertex; all new faces
  /// Cost: what the constructor does, but only for the points to which such a face was or is
  /// nearest; little for the others.
  void find_again(const TriangleMesh& mesh, const CornerTable& table,
                  const std::vector<std::uint8_t>& is_changed);

  /// Indices of the points of a face, in order.
  [[nodiscard]] std::span<const std::uint32_t> of_face(std::uint32_t face) const {
    return std::span(order_).subspan(starts_[face], starts_[face + 1] - starts_[face]);
  }
  [[nodiscard]] const Vec3& point(std::uint32_t index) const { return points_[index]; }

 private:
  void sort(std::size_t faces);

  double reach_;
  std::vector<Vec3> points_;
  std::vector<std::uint32_t> face_of_;  // of each point
  std::vector<std::uint32_t> starts_;   // of each face in order_
  std::vector<std::uint32_t> order_;
};

/// Barycentric coordinates of a point's foot in the plane of a triangle, which has an area.
[[nodiscard]] std::array<double, 3> barycentric(const Vec3& point, const Vec3& a, const Vec3& b,
                                                const Vec3& c);

}  // namespace rangezip

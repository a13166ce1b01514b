#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <vector>

#include "core/finish/corner_table.h"
#include "core/mesh/triangle_mesh.h"

namespace rangezip {

/// The faces of a mesh, all or those near its border, sorted into the cubes of a uniform grid, for
/// asking which is nearest to a place, or whether one is nearer than the border.
class FaceGrid {
 public:
  /// Cost: linear in the faces of the mesh.
  /// @param reach places farther than this from the border will not be asked for, model units;
  ///     positive
  FaceGrid(const TriangleMesh& mesh, const CornerTable& table, double reach);

  /// All faces, in cubes of about the given side.
  FaceGrid(const TriangleMesh& mesh, double cell);

  /// The face nearest to the place, of those no farther than `distance`; CornerTable::kNone if none
  /// is.
  [[nodiscard]] std::uint32_t nearest_face(const Vec3& place, double distance) const;

  /// The same, faster where a face near the place is known.
  [[nodiscard]] std::uint32_t nearest_face(const Vec3& place, double distance,
                                           std::uint32_t guess) const;

  /// Whether a face comes nearer to the place than `distance`, at most the reach.
  [[nodiscard]] bool has_face_within(const Vec3& place, double distance) const;

  /// One that does, CornerTable::kNone if none does; faster if it is the one guessed.
  /// @param guess a face or CornerTable::kNone
  [[nodiscard]] std::uint32_t face_within(const Vec3& place, double distance,
                                          std::uint32_t guess) const;

 private:
  using Cell = std::array<std::size_t, 3>;

  void choose_cells(double cell);
  /// A face that is known, and how near it is.
  struct Nearest {
    std::uint32_t face;
    double squared_distance;
  };
  /// The nearest face, if it comes nearer than the one that is known.
  [[nodiscard]] std::uint32_t nearer_face(const Vec3& place, Nearest known) const;
  [[nodiscard]] double squared_distance(std::uint32_t face, const Vec3& place) const;
  /// Lists the faces of every marked (1) cell.
  void sort_faces(const std::vector<std::uint8_t>& is_asked);
  [[nodiscard]] Cell cell_at(const Vec3& place) const;
  template <class Visit>
  void for_each_cell(const Box& box, Visit visit) const;
  /// The faces that meet a marked (1) cell.
  [[nodiscard]] std::vector<std::uint32_t> faces_in(
      const std::vector<std::uint8_t>& is_asked) const;

  const TriangleMesh& mesh_;
  std::vector<Box> boxes_;  // of the faces
  Vec3 origin_{0.0};
  double cells_per_unit_ = 1.0;
  Cell dims_{1, 1, 1};
  std::vector<std::uint32_t> starts_;  // of each cell in entries_, x fastest
  std::vector<std::uint32_t> entries_;
};

}  // namespace rangezip

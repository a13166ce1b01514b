#include "core/mesh/coverage.h"

#include <algorithm>
#include <array>
#include <cstddef>
#include <cstdint>
#include <vector>

#include "core/base/check_number.h"
#include "core/base/parallel.h"

namespace rangezip {

namespace {

/// A uniform grid that knows, of each cell that one of the points is in, the faces that come within
/// a distance of the cell.
class FaceGrid {
 public:
  FaceGrid(const TriangleMesh& mesh, std::span<const Vec3> points, double distance)
      : mesh_(mesh), distance_(distance) {
    for (const Vec3& p : mesh.positions)
      bounds_.add(p);
    bounds_ = widened(bounds_, distance);
    choose_cells();
    mark_cells(points);
    list_faces();
  }

  /// @param point one of those that the grid was made for
  [[nodiscard]] bool is_near(const Vec3& point) const {
    if (!is_in_bounds(point)) return false;
    const std::size_t cell = index_of(cell_of(point));
    const auto faces = std::span(faces_).subspan(first_[cell], first_[cell + 1] - first_[cell]);
    // Most points have a corner as near; that takes a tenth of the time to see.
    return std::any_of(faces.begin(), faces.end(),
                       [&](std::uint32_t f) { return is_corner_near(f, point); }) ||
           std::any_of(faces.begin(), faces.end(),
                       [&](std::uint32_t f) { return is_face_near(f, point); });
  }

 private:
  /// Each vertex is the first corner of about two faces.
  [[nodiscard]] bool is_corner_near(std::uint32_t face, const Vec3& point) const {
    const Vec3 away = point - mesh_.positions[mesh_.triangles[face][0]];
    return glm::dot(away, away) <= distance_ * distance_;
  }

  [[nodiscard]] bool is_face_near(std::uint32_t face, const Vec3& point) const {
    const auto& [a, b, c] = mesh_.triangles[face];
    return squared_distance_to_triangle(point, mesh_.positions[a], mesh_.positions[b],
                                        mesh_.positions[c]) <= distance_ * distance_;
  }

  using Cell = std::array<int, 3>;

  [[nodiscard]] bool is_in_bounds(const Vec3& point) const {
    for (int axis = 0; axis < 3; ++axis) {
      if (!(point[axis] >= bounds_.lower[axis] && point[axis] <= bounds_.upper[axis])) return false;
    }
    return true;
  }

  void choose_cells() {
    // Four distances a cell keep the lists short; more where the grid would outgrow the mesh.
    constexpr double kDistancesPerCell = 4.0;
    constexpr double kMaxCells = 16e6;
    cell_size_ = kDistancesPerCell * distance_;
    const Vec3 size = bounds_.upper - bounds_.lower;
    while ((size.x / cell_size_ + 1.0) * (size.y / cell_size_ + 1.0) * (size.z / cell_size_ + 1.0) >
           kMaxCells) {
      cell_size_ *= 2.0;
    }
    for (int axis = 0; axis < 3; ++axis) {
      count_[static_cast<std::size_t>(axis)] = static_cast<int>(size[axis] / cell_size_) + 1;
    }
  }

  [[nodiscard]] Cell cell_of(const Vec3& point) const {
    Cell cell{};
    for (std::size_t axis = 0; axis < 3; ++axis) {
      const int a = static_cast<int>(axis);
      const double offset = (point[a] - bounds_.lower[a]) / cell_size_;
      cell[axis] = static_cast<int>(std::clamp(offset, 0.0, count_[axis] - 1.0));
    }
    return cell;
  }

  [[nodiscard]] std::size_t index_of(const Cell& cell) const {
    return (static_cast<std::size_t>(cell[2]) * static_cast<std::size_t>(count_[1]) +
            static_cast<std::size_t>(cell[1])) *
               static_cast<std::size_t>(count_[0]) +
           static_cast<std::size_t>(cell[0]);
  }

  template <class Visit>
  void for_each_cell(const Triangle& triangle, const Visit& visit) const {
    Box box;
    for (const std::uint32_t corner : triangle)
      box.add(mesh_.positions[corner]);
    const Cell lower = cell_of(box.lower - Vec3(distance_));
    const Cell upper = cell_of(box.upper + Vec3(distance_));
    for (int z = lower[2]; z <= upper[2]; ++z) {
      for (int y = lower[1]; y <= upper[1]; ++y) {
        for (int x = lower[0]; x <= upper[0]; ++x)
          visit(index_of({x, y, z}));
      }
    }
  }

  void mark_cells(std::span<const Vec3> points) {
    is_asked_.assign(static_cast<std::size_t>(count_[0]) * static_cast<std::size_t>(count_[1]) *
                         static_cast<std::size_t>(count_[2]),
                     0);
    for (const Vec3& p : points) {
      if (is_in_bounds(p)) is_asked_[index_of(cell_of(p))] = 1;
    }
  }

  void list_faces() {
    first_.assign(is_asked_.size() + 1, 0);
    for (const Triangle& triangle : mesh_.triangles) {
      for_each_cell(triangle, [&](std::size_t cell) { first_[cell + 1] += is_asked_[cell]; });
    }
    for (std::size_t cell = 0; cell < is_asked_.size(); ++cell)
      first_[cell + 1] += first_[cell];
    faces_.resize(first_.back());
    std::vector<std::size_t> next(first_.begin(), first_.end() - 1);
    for (std::size_t face = 0; face < mesh_.triangles.size(); ++face) {
      for_each_cell(mesh_.triangles[face], [&](std::size_t cell) {
        if (is_asked_[cell] != 0) faces_[next[cell]++] = static_cast<std::uint32_t>(face);
      });
    }
  }

  const TriangleMesh& mesh_;
  double distance_;
  Box bounds_;
  double cell_size_ = 1.0;
  std::array<int, 3> count_{1, 1, 1};
  std::vector<std::uint8_t> is_asked_;  ///< of each cell
  std::vector<std::size_t> first_;      ///< where each cell's faces begin in faces_
  std::vector<std::uint32_t> faces_;
};

}  // namespace

std::vector<std::uint8_t> covered_points(std::span<const Vec3> points, const TriangleMesh& mesh,
                                         double distance) {
  check_positive("covered_points: distance", distance);
  std::vector<std::uint8_t> covered(points.size(), 0);
  if (points.empty() || mesh.triangles.empty()) return covered;

  const FaceGrid grid(mesh, points, distance);
  constexpr std::size_t kPointsPerBlock = 16'384;
  parallel_for(points.size(), kPointsPerBlock, [&](std::size_t begin, std::size_t end) {
    for (std::size_t i = begin; i < end; ++i)
      covered[i] = grid.is_near(points[i]) ? 1 : 0;
  });
  return covered;
}

std::vector<Vec3> points_off(std::span<const Vec3> points, const TriangleMesh& mesh,
                             double distance) {
  const std::vector<std::uint8_t> is_covered = covered_points(points, mesh, distance);
  std::vector<Vec3> off;
  for (std::size_t i = 0; i < points.size(); ++i) {
    if (is_covered[i] == 0) off.push_back(points[i]);
  }
  return off;
}

}  // namespace rangezip

#include "core/finish/face_grid.h"

#include <algorithm>
#include <cmath>

#include "core/base/parallel.h"

namespace rangezip {
namespace {

/// Bounds the memory of the grid: cells for each face, and for a start.
constexpr double kCellsPerFace = 8.0;
constexpr double kFreeCells = 4096.0;
/// In cells: where the nearest face is looked for at first, and how much farther then.
constexpr double kFirstReach = 0.25;
constexpr double kReachGrowth = 3.0;
constexpr std::size_t kFacesPerBlock = 8192;

/// The square of how far a place is from a box.
double squared_distance_to_box(const Vec3& place, const Box& box) {
  const Vec3 way = glm::max(glm::max(box.lower - place, place - box.upper), Vec3(0.0));
  return glm::dot(way, way);
}

std::vector<Box> boxes_of(const TriangleMesh& mesh) {
  std::vector<Box> boxes(mesh.triangles.size());
  parallel_for(boxes.size(), kFacesPerBlock, [&](std::size_t begin, std::size_t end) {
    for (std::size_t f = begin; f < end; ++f)
      boxes[f] = box_of(mesh, mesh.triangles[f]);
  });
  return boxes;
}

}  // namespace

FaceGrid::FaceGrid(const TriangleMesh& mesh, const CornerTable& table, double reach)
    : mesh_(mesh), boxes_(boxes_of(mesh)) {
  choose_cells(reach);
  std::vector<std::uint8_t> is_asked(dims_[0] * dims_[1] * dims_[2], 0);
  // A place within reach of the border asks for faces within reach of itself.
  const Vec3 margin(2.0 * reach);
  for (std::uint32_t c = 0; c < table.corner_count(); ++c) {
    if (table.is_deleted(c / 3) || table.across(c) != CornerTable::kNone) continue;
    const Vec3& a = mesh.positions[table.vertex(c)];
    const Vec3& b = mesh.positions[table.head(c)];
    for_each_cell({glm::min(a, b) - margin, glm::max(a, b) + margin},
                  [&](std::size_t at) { is_asked[at] = 1; });
  }
  sort_faces(is_asked);
}

FaceGrid::FaceGrid(const TriangleMesh& mesh, double cell) : mesh_(mesh), boxes_(boxes_of(mesh)) {
  choose_cells(cell);
  sort_faces(std::vector<std::uint8_t>(dims_[0] * dims_[1] * dims_[2], 1));
}

void FaceGrid::choose_cells(double cell) {
  const Box bounds = bounds_of(mesh_);
  origin_ = bounds.lower;
  const Vec3 size = bounds.upper - bounds.lower;
  for (;;) {
    double cells = 1.0;
    for (int axis = 0; axis < 3; ++axis)
      cells *= std::floor(size[axis] / cell) + 1.0;
    if (cells <= kCellsPerFace * static_cast<double>(mesh_.triangles.size()) + kFreeCells) break;
    constexpr double kGrowth = 1.25;
    cell *= kGrowth;
  }
  cells_per_unit_ = 1.0 / cell;
  for (int axis = 0; axis < 3; ++axis) {
    dims_[static_cast<std::size_t>(axis)] =
        static_cast<std::size_t>(size[axis] * cells_per_unit_) + 1;
  }
}

void FaceGrid::sort_faces(const std::vector<std::uint8_t>& is_asked) {
  const std::vector<std::uint32_t> near = faces_in(is_asked);
  starts_.assign(is_asked.size() + 1, 0);
  for (const std::uint32_t f : near)
    for_each_cell(boxes_[f], [&](std::size_t at) { starts_[at + 1] += is_asked[at]; });
  for (std::size_t c = 0; c < is_asked.size(); ++c)
    starts_[c + 1] += starts_[c];
  entries_.resize(starts_.back());
  for (const std::uint32_t f : near) {
    for_each_cell(boxes_[f], [&](std::size_t at) {
      if (is_asked[at] != 0) entries_[starts_[at]++] = f;
    });
  }
  // Filling moved every start to the next one's place.
  std::copy_backward(starts_.begin(), starts_.end() - 1, starts_.end());
  starts_.front() = 0;
}

std::vector<std::uint32_t> FaceGrid::faces_in(const std::vector<std::uint8_t>& is_asked) const {
  std::vector<std::uint8_t> is_in(mesh_.triangles.size(), 0);
  parallel_for(is_in.size(), kFacesPerBlock, [&](std::size_t begin, std::size_t end) {
    for (auto f = static_cast<std::uint32_t>(begin); f < end; ++f)
      for_each_cell(boxes_[f], [&](std::size_t at) { is_in[f] |= is_asked[at]; });
  });
  std::vector<std::uint32_t> faces;
  for (std::uint32_t f = 0; f < is_in.size(); ++f) {
    if (is_in[f] != 0) faces.push_back(f);
  }
  return faces;
}

std::uint32_t FaceGrid::nearest_face(const Vec3& place, double distance) const {
  // Most places have a face much nearer than the farthest that counts.
  double reach = std::min(distance, kFirstReach / cells_per_unit_);
  for (;;) {
    const std::uint32_t nearest = nearer_face(place, {CornerTable::kNone, reach * reach});
    if (nearest != CornerTable::kNone || !(reach < distance)) return nearest;
    reach = std::min(distance, kReachGrowth * reach);
  }
}

std::uint32_t FaceGrid::nearest_face(const Vec3& place, double distance,
                                     std::uint32_t guess) const {
  const double squared = squared_distance(guess, place);
  if (!(squared <= distance * distance)) return nearest_face(place, distance);
  return nearer_face(place, {guess, squared});
}

std::uint32_t FaceGrid::nearer_face(const Vec3& place, Nearest known) const {
  std::uint32_t nearest = known.face;
  double least = known.squared_distance;
  const double reach = std::sqrt(least);
  for_each_cell({place - reach, place + reach}, [&](std::size_t at) {
    for (std::size_t i = starts_[at]; i < starts_[at + 1]; ++i) {
      // Most: that takes a third of the time to see.
      if (squared_distance_to_box(place, boxes_[entries_[i]]) > least) continue;
      const double squared = squared_distance(entries_[i], place);
      if (squared > least || (squared == least && entries_[i] >= nearest)) continue;
      least = squared;
      nearest = entries_[i];
    }
  });
  return nearest;
}

double FaceGrid::squared_distance(std::uint32_t face, const Vec3& place) const {
  const Triangle& t = mesh_.triangles[face];
  return squared_distance_to_triangle(place, mesh_.positions[t[0]], mesh_.positions[t[1]],
                                      mesh_.positions[t[2]]);
}

bool FaceGrid::has_face_within(const Vec3& place, double distance) const {
  return face_within(place, distance, CornerTable::kNone) != CornerTable::kNone;
}

std::uint32_t FaceGrid::face_within(const Vec3& place, double distance, std::uint32_t guess) const {
  const auto is_within = [&](std::uint32_t face) {
    return squared_distance_to_box(place, boxes_[face]) < distance * distance &&
           squared_distance(face, place) < distance * distance;
  };
  if (guess != CornerTable::kNone && is_within(guess)) return guess;
  std::uint32_t found = CornerTable::kNone;
  for_each_cell({place - distance, place + distance}, [&](std::size_t at) {
    for (std::size_t i = starts_[at]; i < starts_[at + 1] && found == CornerTable::kNone; ++i) {
      if (is_within(entries_[i])) found = entries_[i];
    }
  });
  return found;
}

FaceGrid::Cell FaceGrid::cell_at(const Vec3& place) const {
  Cell cell{};
  for (int axis = 0; axis < 3; ++axis) {
    const auto a = static_cast<std::size_t>(axis);
    const double along = (place[axis] - origin_[axis]) * cells_per_unit_;
    cell[a] = along > 0.0
                  ? static_cast<std::size_t>(std::min(along, static_cast<double>(dims_[a] - 1)))
                  : 0;
  }
  return cell;
}

template <class Visit>
void FaceGrid::for_each_cell(const Box& box, Visit visit) const {
  const Cell lower = cell_at(box.lower), upper = cell_at(box.upper);
  for (std::size_t z = lower[2]; z <= upper[2]; ++z) {
    for (std::size_t y = lower[1]; y <= upper[1]; ++y) {
      const std::size_t row = (z * dims_[1] + y) * dims_[0];
      for (std::size_t x = lower[0]; x <= upper[0]; ++x)
        visit(row + x);
    }
  }
}

}  // namespace rangezip

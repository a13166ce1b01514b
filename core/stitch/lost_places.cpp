#include "core/stitch/lost_places.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>

#include "core/mesh/coverage.h"
#include "core/stitch/pixel_box.h"

namespace rangezip {

namespace {

/// Places of the surface that is gone, and where they are in the image.
struct Places {
  std::vector<Vec3> positions;
  std::vector<Pixel> pixels;
};

/// The centroid or, of a face with sides over `spacing`, a lattice finer than that.
void add_inner_places(const SeenMesh& before, const Triangle& face, double spacing,
                      Places& places) {
  constexpr double kMostSteps = 64.0;  // of a huge face: what is left of it shows a pixel
  const double steps = std::ceil(longest_side(before.mesh, face) / spacing);
  const int n = static_cast<int>(std::clamp(steps, 1.0, kMostSteps));
  const auto add = [&](const Vec3& weights) {
    Vec3 position{0.0};
    Vec2 image{0.0};
    for (int k = 0; k < 3; ++k) {
      const std::uint32_t v = face[static_cast<std::size_t>(k)];
      position += weights[k] * before.mesh.positions[v];
      image += weights[k] * in_pixels(before.image.points[v]);
    }
    places.positions.push_back(position);
    places.pixels.push_back(
        {static_cast<int>(std::floor(image.x + 0.5)), static_cast<int>(std::floor(image.y + 0.5))});
  };
  if (n == 1) {
    add(Vec3(1.0 / 3.0));
    return;
  }
  for (int i = 0; i < n; ++i) {
    for (int j = i > 0 ? 0 : 1; j < n && i + j <= n; ++j)  // without the corners
      add(Vec3{i, j, n - i - j} / static_cast<double>(n));
  }
}

Places places_of(const SeenMesh& before, const TriangleMesh& after, const FaceChanges& changes,
                 double spacing) {
  std::vector<std::uint8_t> is_done(before.mesh.positions.size(), 0);
  for (const Triangle& face : after.triangles) {
    for (const std::uint32_t v : face) {
      if (v < is_done.size() && after.positions[v] == before.mesh.positions[v]) is_done[v] = 1;
    }
  }
  Places places;
  for (const std::uint32_t f : changes.gone) {
    const Triangle& face = before.mesh.triangles[f];
    const auto has_image = [&](std::uint32_t v) { return before.image.has_image(v); };
    if (!std::all_of(face.begin(), face.end(), has_image)) continue;
    for (const std::uint32_t v : face) {
      if (is_done[v] != 0) continue;
      is_done[v] = 1;
      places.positions.push_back(before.mesh.positions[v]);
      places.pixels.push_back(nearest_pixel(before.image.points[v]));
    }
    add_inner_places(before, face, spacing, places);
  }
  return places;
}

/// The new vertices by the pixels that they are nearest to, for a first quick answer. Those far
/// outside of the image are not among them.
class NewVertices {
 public:
  /// @param places the pixels that will be asked for
  NewVertices(const SeenMesh& after, const FaceChanges& changes, std::size_t first_new,
              const PixelBox& places)
      : mesh_(after.mesh) {
    std::vector<std::uint32_t> vertices;
    for (const std::uint32_t f : changes.made) {
      for (const std::uint32_t v : after.mesh.triangles[f]) {
        if (v >= first_new && after.image.has_image(v)) vertices.push_back(v);
      }
    }
    if (vertices.empty()) return;
    PixelBox box;
    for (const std::uint32_t v : vertices)
      box.add(nearest_pixel(after.image.points[v]));
    box_ = box.within(places);
    if (box_.is_empty() || is_too_large(box_.extent())) return;
    at_.reset(box_.extent(), kNone);
    for (const std::uint32_t v : vertices) {
      const Pixel local = box_.local(nearest_pixel(after.image.points[v]));
      if (at_.extent().contains(local)) at_[local] = v;
    }
  }

  /// Whether the one at the pixel is within `distance` of the place.
  [[nodiscard]] bool has_near(const Vec3& place, Pixel pixel, double distance) const {
    if (at_.extent().count() == 0) return false;
    const Pixel local = box_.local(pixel);
    if (!at_.extent().contains(local) || at_[local] == kNone) return false;
    const Vec3 away = mesh_.positions[at_[local]] - place;
    return glm::dot(away, away) <= distance * distance;
  }

 private:
  static constexpr std::uint32_t kNone = std::numeric_limits<std::uint32_t>::max();

  /// More pixels than any image has: then there is no quick answer.
  [[nodiscard]] static bool is_too_large(const Extent& extent) {
    constexpr std::int64_t kMostPixels = std::int64_t{1} << 24;
    return std::int64_t{extent.width} * extent.height > kMostPixels;
  }

  const TriangleMesh& mesh_;
  PixelBox box_;
  Grid<std::uint32_t> at_;
};

void forget_those_near(const NewVertices& vertices, double distance, Places& places) {
  std::size_t kept = 0;
  for (std::size_t i = 0; i < places.positions.size(); ++i) {
    if (vertices.has_near(places.positions[i], places.pixels[i], distance)) continue;
    places.positions[kept] = places.positions[i];
    places.pixels[kept++] = places.pixels[i];
  }
  places.positions.resize(kept);
  places.pixels.resize(kept);
}

/// The cells of a coarse grid that come within a distance of one of the places.
class CellsNear {
 public:
  CellsNear(const std::vector<Vec3>& places, double distance) : is_near_(kCells, 0) {
    for (const Vec3& place : places)
      bounds_.add(place);
    bounds_ = widened(bounds_, distance);
    for (const Vec3& place : places) {
      for_each_cell({place - Vec3(distance), place + Vec3(distance)},
                    [&](std::size_t cell) { is_near_[cell] = 1; });
    }
  }

  /// Whether the box may meet one of them; false is certain.
  [[nodiscard]] bool meets(const Box& box) const {
    for (int axis = 0; axis < 3; ++axis) {
      if (box.lower[axis] > bounds_.upper[axis] || bounds_.lower[axis] > box.upper[axis])
        return false;
    }
    bool meets = false;
    for_each_cell(box, [&](std::size_t cell) { meets = meets || is_near_[cell] != 0; });
    return meets;
  }

 private:
  static constexpr std::size_t kSide = 64;
  static constexpr std::size_t kCells = kSide * kSide * kSide;

  [[nodiscard]] std::array<std::size_t, 3> cell_of(const Vec3& point) const {
    std::array<std::size_t, 3> cell{};
    for (std::size_t axis = 0; axis < 3; ++axis) {
      const auto a = static_cast<int>(axis);
      const double share =
          (point[a] - bounds_.lower[a]) / (bounds_.upper[a] - bounds_.lower[a]) * kSide;
      cell[axis] = static_cast<std::size_t>(std::clamp(share, 0.0, kSide - 1.0));
    }
    return cell;
  }

  /// Visits the cells that the box meets.
  template <class Visit>
  void for_each_cell(const Box& box, const Visit& visit) const {
    const auto first = cell_of(box.lower), last = cell_of(box.upper);
    for (std::size_t z = first[2]; z <= last[2]; ++z) {
      for (std::size_t y = first[1]; y <= last[1]; ++y) {
        for (std::size_t x = first[0]; x <= last[0]; ++x) {
          visit((z * kSide + y) * kSide + x);
        }
      }
    }
  }

  Box bounds_;
  std::vector<std::uint8_t> is_near_;
};

/// The faces that may be within `distance` of the places, and more.
TriangleMesh around(const TriangleMesh& mesh, const std::vector<Vec3>& places, double distance) {
  const CellsNear cells(places, distance);
  TriangleMesh part;
  part.positions = mesh.positions;
  for (const Triangle& face : mesh.triangles) {
    Box box;
    for (const std::uint32_t v : face)
      box.add(mesh.positions[v]);
    if (cells.meets(box)) part.triangles.push_back(face);
  }
  remove_unused_vertices(part);
  return part;
}

}  // namespace

std::vector<Pixel> find_lost_places(const SeenMesh& before, const SeenMesh& after,
                                    const FaceChanges& changes, double distance) {
  Places places = places_of(before, after.mesh, changes, distance);
  const NewVertices vertices(after, changes, before.mesh.positions.size(),
                             box_around(places.pixels));
  forget_those_near(vertices, distance, places);
  if (places.positions.empty()) return {};
  const std::vector<std::uint8_t> covered =
      covered_points(places.positions, around(after.mesh, places.positions, distance), distance);
  std::vector<Pixel> lost;
  for (std::size_t i = 0; i < covered.size(); ++i) {
    if (covered[i] == 0) lost.push_back(places.pixels[i]);
  }
  return lost;
}

}  // namespace rangezip

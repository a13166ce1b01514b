#include "core/session/turn_to_scanners.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <numbers>
#include <utility>
#include <vector>

#include "core/base/error.h"
#include "core/finish/components.h"
#include "core/finish/corner_table.h"
#include "core/mesh/drawable.h"
#include "core/view/view.h"

namespace rangezip {
namespace {

constexpr Extent kImage{1024, 1024};
/// Of a component's area: where less is seen, it may be what shows through a hole.
constexpr double kLeastSeen = 0.1;

/// The six ways that a scanner looks.
constexpr std::array<Vec3, 6> kWays{
    {{1, 0, 0}, {-1, 0, 0}, {0, 1, 0}, {0, -1, 0}, {0, 0, 1}, {0, 0, -1}}};

/// What a scanner at `eye` sees one way; nothing if all of the mesh lies behind it.
Framebuffer look(Rasterizer& rasterizer, const DrawableMesh& mesh, const Box& bounds,
                 const Vec3& eye, const Vec3& way) {
  const Vec3 up = way.y == 0.0 ? Vec3{0, 1, 0} : Vec3{1, 0, 0};
  // The target is so far away that adding it to large coordinates loses nothing.
  const double distance = bounds.diagonal() + glm::length(eye - bounds.center());
  const Camera camera =
      look_at(eye, eye + distance * way, up, Perspective{.fov_y = std::numbers::pi / 2});
  const DrawItem item = mesh.item();
  return rasterizer.render(View(fit_depth_planes(camera, bounds), kImage), {&item, 1});
}

/// Marks the faces that a scanner at `eye` sees.
void mark_seen(Rasterizer& rasterizer, const DrawableMesh& mesh, const Box& bounds, const Vec3& eye,
               std::vector<std::uint8_t>& is_seen) {
  for (const Vec3& way : kWays) {
    const Framebuffer seen = look(rasterizer, mesh, bounds, eye, way);
    for (const PrimitiveId face : seen.id.pixels()) {
      if (face != kNoPrimitive) is_seen[face] = 1;
    }
  }
}

/// Areas of a component, square model units, times two.
struct Sides {
  double whole = 0.0;
  double front = 0.0;  ///< that scanners see, once for each of them
  double back = 0.0;

  [[nodiscard]] bool is_wrong() const { return back > front && front + back >= kLeastSeen * whole; }
};

/// Adds what a scanner at `eye` sees of each component.
void add_seen(const TriangleMesh& mesh, const Vec3& eye, const std::vector<std::uint8_t>& is_seen,
              const std::vector<std::uint32_t>& component, std::vector<Sides>& sides) {
  for (std::size_t f = 0; f < is_seen.size(); ++f) {
    if (is_seen[f] == 0) continue;
    const auto& [a, b, c] = mesh.triangles[f];
    const Vec3 area = area_vector(mesh.positions[a], mesh.positions[b], mesh.positions[c]);
    const bool is_front = glm::dot(area, eye - mesh.positions[a]) > 0.0;
    Sides& of = sides[component[f]];
    (is_front ? of.front : of.back) += glm::length(area);
  }
}

/// What scanners see of each component.
std::vector<Sides> sides_of(const TriangleMesh& mesh, Rasterizer& rasterizer,
                            std::span<const Vec3> scanners,
                            const std::vector<std::uint32_t>& component, const Progress& progress) {
  std::vector<Sides> sides(component_sizes(component).size());
  for (std::size_t f = 0; f < component.size(); ++f)
    sides[component[f]].whole += 2.0 * area_of_face(mesh.positions, mesh.triangles[f]);
  const DrawableMesh drawable(mesh);
  const Box bounds = bounds_of(mesh);
  for (const Vec3& eye : scanners) {
    progress.check_stop();
    std::vector<std::uint8_t> is_seen(mesh.triangles.size(), 0);
    mark_seen(rasterizer, drawable, bounds, eye, is_seen);
    add_seen(mesh, eye, is_seen, component, sides);
  }
  return sides;
}

}  // namespace

std::size_t turn_to_scanners(TriangleMesh& mesh, Rasterizer& rasterizer,
                             std::span<const Vec3> scanners, const Progress& progress) {
  for (const Vec3& eye : scanners) {
    if (!std::isfinite(eye.x + eye.y + eye.z))
      throw InvalidArgument("turn_to_scanners: positions must be finite");
  }
  if (mesh.empty()) return 0;
  const std::vector<std::uint32_t> component =
      components_of(CornerTable(mesh.triangles, mesh.positions.size()));
  const std::vector<Sides> sides = sides_of(mesh, rasterizer, scanners, component, progress);
  for (std::size_t f = 0; f < component.size(); ++f) {
    Triangle& face = mesh.triangles[f];
    if (sides[component[f]].is_wrong()) std::swap(face[1], face[2]);
  }
  return static_cast<std::size_t>(
      std::count_if(sides.begin(), sides.end(), [](const Sides& of) { return of.is_wrong(); }));
}

}  // namespace rangezip

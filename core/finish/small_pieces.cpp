#include "core/finish/small_pieces.h"

#include <algorithm>
#include <cmath>
#include <optional>

#include "core/finish/components.h"
#include "core/finish/places_near.h"

namespace rangezip {
namespace {

/// An open component with fewer faces than this part of the largest is a shred.
constexpr std::size_t kShredShare = 200;

/// With so much of the faces of the largest, a component may have pockets, and pieces beside it are
/// of their walls.
constexpr std::size_t kHostShare = 20;

/// Area vector over area: of half a sphere. What is flatter has no inside, nor pockets.
constexpr double kFlatSheet = 0.5;

/// Area vector over area, and volume over area to the power of 1.5 (of a ball 0.094): of what is
/// nearly closed, and closes around its inside.
constexpr double kNearlyClosed = 0.3;
constexpr double kBulges = 0.02;

/// What stands apart by so many h, and has so many faces, as a ball of 2.5 h does, is a body.
constexpr double kApart = 3.0;
constexpr double kApartIfClosed = 1.25;  ///< what is nearer has come off the large one
constexpr std::size_t kLeastBody = 40;

/// Whether a component is a sheet that is seen as a whole from one side.
bool is_flat_sheet(const TriangleMesh& mesh, const std::vector<std::uint32_t>& component,
                   std::uint32_t which) {
  Vec3 across{0.0};
  double area = 0.0;
  for (std::size_t f = 0; f < mesh.triangles.size(); ++f) {
    if (component[f] != which) continue;
    const Triangle& t = mesh.triangles[f];
    across += 0.5 * area_vector(mesh.positions[t[0]], mesh.positions[t[1]], mesh.positions[t[2]]);
    area += area_of_face(mesh.positions, t);
  }
  return glm::length(across) >= kFlatSheet * area;
}

/// Flags the components with an edge at the border.
std::vector<std::uint8_t> open_components(const CornerTable& table,
                                          const std::vector<std::uint32_t>& component,
                                          std::size_t count) {
  std::vector<std::uint8_t> is_open(count, 0);
  for (std::uint32_t c = 0; c < table.corner_count(); ++c) {
    if (table.across(c) == CornerTable::kNone) is_open[component[c / 3]] = 1;
  }
  return is_open;
}

/// Takes the flags from components with a vertex close to one of a large component.
/// @param may_be_apart per component: those that are to be looked at
void keep_apart(const TriangleMesh& mesh, const std::vector<std::uint32_t>& component,
                const std::vector<std::uint8_t>& is_large, double distance,
                std::vector<std::uint8_t>& may_be_apart) {
  std::vector<Vec3> large;
  for (std::size_t f = 0; f < component.size(); ++f) {
    if (is_large[component[f]] == 0) continue;
    for (const std::uint32_t v : mesh.triangles[f])
      large.push_back(mesh.positions[v]);
  }
  const PointGrid near = grid_of(large, distance / 2.0);
  for (std::size_t f = 0; f < component.size(); ++f) {
    if (may_be_apart[component[f]] == 0) continue;
    for (const std::uint32_t v : mesh.triangles[f]) {
      if (near.has_point_within(mesh.positions[v], distance)) may_be_apart[component[f]] = 0;
    }
  }
}

/// What the faces of a component add up to.
struct Extents {
  Vec3 origin{0.0};  ///< one of its vertices
  Vec3 across{0.0};  ///< area vector
  double area = 0.0;
  double volume = 0.0;  ///< between the faces and the origin

  /// Whether hardly anything is missing of the outside of a body; of the wall of a bore the volume
  /// is negative.
  [[nodiscard]] bool are_of_body() const {
    return glm::length(across) <= kNearlyClosed * area && volume >= kBulges * std::pow(area, 1.5);
  }
};

std::vector<Extents> extents_of(const TriangleMesh& mesh,
                                const std::vector<std::uint32_t>& component, std::size_t count) {
  std::vector<Extents> extents(count);
  for (std::size_t f = 0; f < component.size(); ++f) {
    Extents& all = extents[component[f]];
    const Triangle& t = mesh.triangles[f];
    if (all.area == 0.0) all.origin = mesh.positions[t[0]];
    const Vec3 &a = mesh.positions[t[0]], &b = mesh.positions[t[1]], &c = mesh.positions[t[2]];
    const Vec3 across = 0.5 * area_vector(a, b, c);
    all.across += across;
    all.area += glm::length(across);
    all.volume += glm::dot(a - all.origin, across) / 3.0;
  }
  return extents;
}

/// Flags the components that are too small, or shreds by their size, but bodies of their own or
/// sides of one.
std::vector<std::uint8_t> small_bodies(const TriangleMesh& mesh,
                                       const std::vector<std::uint32_t>& component,
                                       const std::vector<std::size_t>& sizes, std::size_t largest,
                                       const SmallPieceOptions& options) {
  std::vector<std::uint8_t> is_large(sizes.size(), 0), is_body(sizes.size(), 0);
  bool any = false;
  for (std::size_t k = 0; k < sizes.size(); ++k) {
    is_large[k] =
        k == largest || (sizes[k] >= options.min_faces && kHostShare * sizes[k] >= sizes[largest])
            ? 1
            : 0;
    is_body[k] = is_large[k] == 0 && sizes[k] >= kLeastBody ? 1 : 0;
    any = any || is_body[k] != 0;
  }
  if (!any) return is_body;
  std::vector<std::uint8_t> is_apart = is_body, is_beside = is_body;
  keep_apart(mesh, component, is_large, kApart * options.pixel_size, is_apart);
  keep_apart(mesh, component, is_large, kApartIfClosed * options.pixel_size, is_beside);
  const std::vector<Extents> extents = extents_of(mesh, component, sizes.size());
  for (std::size_t k = 0; k < sizes.size(); ++k) {
    const bool is_closed =
        is_beside[k] != 0 && sizes[k] >= options.min_faces && extents[k].are_of_body();
    is_body[k] = is_apart[k] != 0 || is_closed ? 1 : 0;
  }
  return is_body;
}

}  // namespace

DroppedComponents drop_small_components(TriangleMesh& mesh, const CornerTable& table,
                                        const std::vector<std::uint32_t>& component,
                                        const SmallPieceOptions& options) {
  DroppedComponents result;
  const std::vector<std::size_t> sizes = component_sizes(component);
  if (sizes.empty() || options.min_faces == 0) return result;
  const auto largest =
      static_cast<std::size_t>(std::max_element(sizes.begin(), sizes.end()) - sizes.begin());
  std::vector<std::uint8_t> may_be_shred = open_components(table, component, sizes.size());
  for (std::size_t k = 0; k < sizes.size(); ++k)
    may_be_shred[k] = may_be_shred[k] != 0 && kShredShare * sizes[k] < sizes[largest] ? 1 : 0;
  const std::vector<std::uint8_t> is_body = small_bodies(mesh, component, sizes, largest, options);
  std::optional<bool> is_scene;  // asked of the largest once there is a shred
  std::vector<std::uint8_t> goes(sizes.size(), 0);
  for (std::size_t k = 0; k < sizes.size(); ++k) {
    if (k == largest || is_body[k] != 0) continue;
    const bool is_small = sizes[k] < options.min_faces;
    if (!is_small && may_be_shred[k] == 0) continue;
    if (!is_small && !is_scene)
      is_scene = is_flat_sheet(mesh, component, static_cast<std::uint32_t>(largest));
    if (!is_small && *is_scene) continue;
    goes[k] = 1;
    ++result.components;
    result.faces += sizes[k];
  }
  if (result.components == 0) return result;
  std::vector<std::uint8_t> dropped(mesh.triangles.size(), 0);
  for (std::size_t f = 0; f < dropped.size(); ++f)
    dropped[f] = goes[component[f]];
  remove_triangles(mesh.triangles, dropped);
  return result;
}

}  // namespace rangezip

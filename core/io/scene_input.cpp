#include <algorithm>
#include <cmath>
#include <iterator>
#include <limits>
#include <memory>
#include <string>
#include <utility>
#include <variant>

#include "core/base/error.h"
#include "core/io/input_file.h"
#include "core/scene/curve_order.h"

namespace rangezip {

namespace {

/// All points lie on a line if none is farther from it than this share of the size of the scene:
/// what is thinner cannot be told from a line in text files of six digits.
constexpr double kLineTolerance = 1e-5;

/// A scene is too far away if doubles at its place have fewer steps across it: its points are
/// rounded to a coarse lattice, and a camera cannot be placed before it.
constexpr double kFewestSteps = 1024.0;

/// Calls visit(position) for world positions of points and corners until it returns true.
template <class Visit>
bool any_position(const Scene& scene, const Visit& visit) {
  for (const DrawItem& item : scene.draw_items()) {
    const auto visit_local = [&](const Mat4& world_from_item, const Vec3f& p) {
      return visit(Vec3(world_from_item * Vec4(Vec3(p), 1.0)));
    };
    if (const auto* points = std::get_if<DrawPoints>(&item)) {
      for (const Vec3f& p : points->positions) {
        if (visit_local(points->world_from_item, p)) return true;
      }
    } else {
      const auto& soup = std::get<DrawTriangles>(item);
      for (const Triangle& triangle : soup.triangles) {
        for (const std::uint32_t corner : triangle) {
          if (visit_local(soup.world_from_item, soup.positions[corner])) return true;
        }
      }
    }
  }
  return false;
}

/// True if the scene is a line or a point. Usually known after a few positions.
bool is_on_a_line(const Scene& scene) {
  const double size = scene.bounds().diagonal();
  Vec3 first{0.0};
  any_position(scene, [&](const Vec3& p) {
    first = p;
    return true;
  });
  // The farthest point is at least half of the longest side of the box away: more than a quarter of
  // its diagonal.
  Vec3 along{0.0};
  any_position(scene, [&](const Vec3& p) {
    along = p - first;
    return glm::length(along) >= 0.25 * size;
  });
  const double limit = kLineTolerance * size * glm::length(along);
  return !any_position(
      scene, [&](const Vec3& p) { return glm::length(glm::cross(along, p - first)) > limit; });
}

/// Between the largest coordinate and the next larger double.
double step_at(const Box& bounds) {
  double largest = 0.0;
  for (int axis = 0; axis < 3; ++axis) {
    largest = std::max({largest, std::abs(bounds.lower[axis]), std::abs(bounds.upper[axis])});
  }
  return std::nextafter(largest, std::numeric_limits<double>::infinity()) - largest;
}

std::string names_of(std::span<const std::filesystem::path> paths) {
  std::string names;
  for (const std::filesystem::path& path : paths) {
    names += (names.empty() ? "" : ", ") + path.string();
  }
  return names;
}

void check_extent(const Scene& scene, std::span<const std::filesystem::path> paths) {
  const std::string names = names_of(paths) + ": whole input: ";
  if (scene.triangle_count() == 0 && scene.point_count() < 3) {
    throw IoError(names + "at least three distinct finite points are needed, but there is only " +
                  std::to_string(scene.point_count()));
  }
  if (scene.bounds().diagonal() == 0.0) {
    throw IoError(names + "at least three distinct finite points are needed, but all are equal");
  }
  if (scene.bounds().diagonal() < kFewestSteps * step_at(scene.bounds())) {
    throw IoError(
        names +
        "it is so far from (0, 0, 0), and so small, that coordinates cannot tell its points "
        "apart: move it nearer");
  }
  if (is_on_a_line(scene)) {
    throw IoError(names + "all points lie on one line (to 1e-5 of its length)");
  }
}

/// The cloud itself, or another in an order that is drawn faster.
std::shared_ptr<const PointCloud> for_scanning(std::shared_ptr<const PointCloud> cloud,
                                               const Progress& progress) {
  if (follow_each_other(cloud->positions)) return cloud;
  return std::make_shared<const PointCloud>(ordered_along_curve(*cloud, progress));
}

}  // namespace

SceneInput read_scene(std::span<const std::filesystem::path> paths, const Progress& progress) {
  if (paths.empty()) throw InvalidArgument("read_scene: paths must not be empty");
  SceneInput input;
  for (std::size_t i = 0; i < paths.size(); ++i) {
    progress.at("read", static_cast<double>(i) / static_cast<double>(paths.size()));
    InputFile file = read_input(paths[i], progress);
    for (InputItem& item : file.items) {
      if (item.cloud) {
        input.scene.add(for_scanning(std::move(item.cloud), progress), item.world_from_item);
      } else {
        input.scene.add(std::move(item.soup), item.world_from_item);
      }
    }
    std::move(file.reports.begin(), file.reports.end(), std::back_inserter(input.reports));
  }
  check_extent(input.scene, paths);
  return input;
}

}  // namespace rangezip

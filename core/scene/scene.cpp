#include "core/scene/scene.h"

#include <algorithm>
#include <atomic>
#include <cmath>
#include <iterator>
#include <string>

#include "core/base/error.h"

namespace rangezip {

namespace {

/// A number no other content of this process has; backends keep uploads under it.
std::uint64_t next_content_key() {
  static std::atomic<std::uint64_t> counter{0};
  return ++counter;
}

void check_placement(const Mat4& m) {
  for (int column = 0; column < 4; ++column) {
    for (int row = 0; row < 4; ++row) {
      if (!std::isfinite(m[column][row])) {
        throw InvalidArgument("Scene::add: world_from_item must be finite");
      }
    }
  }
  if (m[0][3] != 0.0 || m[1][3] != 0.0 || m[2][3] != 0.0 || m[3][3] != 1.0) {
    throw InvalidArgument("Scene::add: world_from_item must be affine");
  }
}

void check_numbers(const PointCloud& cloud) {
  if (cloud.numbers.empty()) return;
  const std::size_t count = cloud.positions.size();
  if (cloud.numbers.size() != count) {
    throw InvalidArgument("Scene::add: " + std::to_string(cloud.numbers.size()) +
                          " numbers were given for " + std::to_string(count) + " points");
  }
  const std::uint32_t largest = *std::max_element(cloud.numbers.begin(), cloud.numbers.end());
  if (largest >= count) {
    throw InvalidArgument("Scene::add: a point's number must be below their count of " +
                          std::to_string(count) + ", got " + std::to_string(largest));
  }
}

bool is_translation(const Mat4& m) {
  return Mat3(m) == Mat3{1.0};
}

Box bounds_of(std::span<const Vec3f> positions, const Mat4& world_from_item) {
  Box bounds;
  if (is_translation(world_from_item)) {
    // Adding rounds in order, so the moved extremes are the extremes of what is moved.
    Box local;
    for (const Vec3f& p : positions)
      local.add(Vec3(p));
    if (local.is_empty()) return bounds;
    bounds.add(Vec3(world_from_item * Vec4(local.lower, 1.0)));
    bounds.add(Vec3(world_from_item * Vec4(local.upper, 1.0)));
    return bounds;
  }
  for (const Vec3f& p : positions)
    bounds.add(Vec3(world_from_item * Vec4(Vec3(p), 1.0)));
  return bounds;
}

}  // namespace

void Scene::append(CloudItem item, std::size_t primitives) {
  const std::size_t before = point_count_ + triangle_count_;
  if (primitives > kNoPrimitive - before) {
    throw InvalidArgument("Scene::add: a scene holds at most 2^32 - 1 primitives");
  }
  item.first_id = static_cast<PrimitiveId>(before);
  item.content_key = next_content_key();
  items_.push_back(std::move(item));
}

void Scene::add(std::shared_ptr<const PointCloud> cloud, const Mat4& world_from_item) {
  if (!cloud) throw InvalidArgument("Scene::add: cloud must not be null");
  check_placement(world_from_item);
  check_numbers(*cloud);
  const std::size_t count = cloud->positions.size();
  const Box bounds = bounds_of(cloud->positions, world_from_item);
  append({.cloud = std::move(cloud), .world_from_item = world_from_item}, count);
  point_count_ += count;
  bounds_.add(bounds);
}

void Scene::add(std::shared_ptr<const TriangleSoup> soup, const Mat4& world_from_item) {
  if (!soup) throw InvalidArgument("Scene::add: soup must not be null");
  check_placement(world_from_item);
  Box bounds;
  for (const Triangle& triangle : soup->triangles) {
    for (const std::uint32_t corner : triangle) {
      if (corner >= soup->positions.size()) {
        throw InvalidArgument("Scene::add: corner index " + std::to_string(corner) +
                              " is out of range; the soup has " +
                              std::to_string(soup->positions.size()) + " positions");
      }
      bounds.add(Vec3(world_from_item * Vec4(Vec3(soup->positions[corner]), 1.0)));
    }
  }
  const std::size_t count = soup->triangles.size();
  append({.soup = std::move(soup), .world_from_item = world_from_item}, count);
  triangle_count_ += count;
  bounds_.add(bounds);
}

std::vector<DrawItem> Scene::draw_items(int point_size, std::span<const std::int8_t> votes) const {
  if (!votes.empty() && votes.size() != point_count_) {
    throw InvalidArgument("Scene::draw_items: " + std::to_string(votes.size()) +
                          " votes were given for " + std::to_string(point_count_) + " points");
  }
  std::vector<DrawItem> drawn;
  drawn.reserve(items_.size());
  std::size_t first_point = 0;
  for (const CloudItem& item : items_) {
    if (item.cloud) {
      const std::size_t count = item.cloud->positions.size();
      drawn.emplace_back(
          DrawPoints{.positions = item.cloud->positions,
                     .world_from_item = item.world_from_item,
                     .first_id = item.first_id,
                     .point_size = point_size,
                     .content_key = item.content_key,
                     .votes = votes.empty() ? votes : votes.subspan(first_point, count)});
      first_point += count;
    } else {
      drawn.emplace_back(DrawTriangles{.positions = item.soup->positions,
                                       .triangles = item.soup->triangles,
                                       .world_from_item = item.world_from_item,
                                       .first_id = item.first_id,
                                       .content_key = item.content_key});
    }
  }
  return drawn;
}

PrimitiveId Scene::number_of(PrimitiveId id) const {
  if (id == kNoPrimitive) return id;
  if (id >= point_count_ + triangle_count_) {
    throw InvalidArgument("Scene::number_of: there is no primitive " + std::to_string(id));
  }
  const auto after = std::upper_bound(
      items_.begin(), items_.end(), id,
      [](PrimitiveId wanted, const CloudItem& item) { return wanted < item.first_id; });
  const CloudItem& item = *std::prev(after);
  if (!item.cloud || item.cloud->numbers.empty()) return id;
  return item.first_id + item.cloud->numbers[id - item.first_id];
}

std::vector<Vec3> Scene::points() const {
  std::vector<Vec3> points;
  points.reserve(point_count_);
  for (const CloudItem& item : items_) {
    if (!item.cloud) continue;
    for (const Vec3f& p : item.cloud->positions) {
      points.emplace_back(item.world_from_item * Vec4(Vec3(p), 1.0));
    }
  }
  return points;
}

}  // namespace rangezip

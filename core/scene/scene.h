#pragma once

#include <cstdint>
#include <memory>
#include <span>
#include <vector>

#include "core/base/geometry.h"
#include "core/raster/draw_item.h"

namespace rangezip {

/// Points about a local origin; immutable once shared. All finite (readers skip and count others).
struct PointCloud {
  std::vector<Vec3f> positions;
  /// The number by which its owner knows each point, in [0, positions.size()); empty: its place
  /// here. For clouds that were put in another order.
  std::vector<std::uint32_t> numbers;
};

/// Triangles about a local origin; no connectivity is assumed. Immutable once shared.
struct TriangleSoup {
  std::vector<Vec3f> positions;
  std::vector<Triangle> triangles;
};

/// What is scanned: clouds and polygons, each placed by `world_from_item` in double, so that
/// large coordinates lose nothing. Cheap to copy: contents are shared.
///
/// Primitives are numbered over the whole scene in order of addition: the points of a cloud or
/// the triangles of a soup take the next free IDs.
class Scene {
 public:
  /// @throws InvalidArgument for a null pointer, a corner index or a point's number out of range,
  ///     another count of numbers than of points, a placement that is not finite and affine, or
  ///     more than 2^32 - 1 primitives in all.
  void add(std::shared_ptr<const PointCloud> cloud, const Mat4& world_from_item = Mat4{1.0});
  void add(std::shared_ptr<const TriangleSoup> soup, const Mat4& world_from_item = Mat4{1.0});

  [[nodiscard]] std::size_t point_count() const noexcept { return point_count_; }
  [[nodiscard]] std::size_t triangle_count() const noexcept { return triangle_count_; }
  [[nodiscard]] bool empty() const noexcept { return point_count_ + triangle_count_ == 0; }

  /// Box around all points and all corners of triangles, world space.
  [[nodiscard]] const Box& bounds() const noexcept { return bounds_; }

  /// The scene as a rasterizer takes it; valid while this scene (or a copy) lives.
  /// @param point_size pixels, for every cloud
  /// @param votes one per point of the scene in order of addition, or empty (see DrawPoints)
  /// @throws InvalidArgument if votes are given for another number of points.
  [[nodiscard]] std::vector<DrawItem> draw_items(int point_size = 1,
                                                 std::span<const std::int8_t> votes = {}) const;

  /// What the owner of the clouds and soups calls the primitive that is drawn as `id`: the same,
  /// but for the points of clouds with numbers; kNoPrimitive stays. O(log items).
  /// @throws InvalidArgument if nothing is drawn as `id`.
  [[nodiscard]] PrimitiveId number_of(PrimitiveId id) const;

  /// World positions of all points in order of addition, appended to nothing else: one loop for
  /// those who need plain points. O(points) memory.
  [[nodiscard]] std::vector<Vec3> points() const;

 private:
  struct CloudItem {
    std::shared_ptr<const PointCloud> cloud;
    std::shared_ptr<const TriangleSoup> soup;  ///< exactly one of the two is set
    Mat4 world_from_item{1.0};
    PrimitiveId first_id = 0;
    std::uint64_t content_key = 0;
  };
  void append(CloudItem item, std::size_t primitives);

  std::vector<CloudItem> items_;
  std::size_t point_count_ = 0;
  std::size_t triangle_count_ = 0;
  Box bounds_;
};

}  // namespace rangezip

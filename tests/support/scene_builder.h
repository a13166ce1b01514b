#pragma once

#include <cstdint>
#include <vector>

#include "tests/support/raster_scenes.h"
#include "tests/support/shapes.h"

/// What the random scenes are made of.
///
/// Random numbers are drawn in braces or in statements of their own: compilers evaluate the
/// arguments of a call in different orders.
namespace rangezip::scenes {

using shapes::Random;

/// In [lower, upper].
[[nodiscard]] int whole(Random& random, int lower, int upper);

/// 1 to 40 pixels each way.
[[nodiscard]] Extent random_extent(Random& random);

/// A depth that often repeats and sometimes lies just outside of the planes.
[[nodiscard]] float random_depth(Random& random);

/// A coordinate in 1/256 px, anywhere around an image of `size` pixels.
[[nodiscard]] float anywhere(Random& random, int size, int margin);

/// NaN or an infinity.
[[nodiscard]] float not_finite(Random& random);

[[nodiscard]] Facing random_facing(Random& random);

[[nodiscard]] std::vector<std::int8_t> random_votes(Random& random, std::size_t count);

/// Collects items under one placement, and gives them ascending IDs.
class SceneBuilder {
 public:
  SceneBuilder(const View& view, const Mat4& placement)
      : placement_(placement), scene_{.view = view} {}

  void set_placement(const Mat4& placement) { placement_ = placement; }

  void add_points(std::vector<Vec3f> positions, int size, std::vector<std::int8_t> votes = {});
  void add_triangles(std::vector<Vec3f> positions, std::vector<Triangle> corners,
                     Facing facing = Facing::both);
  /// Three new corners a triangle.
  void add_soup(std::vector<Vec3f> positions, Facing facing = Facing::both);

  [[nodiscard]] RasterScene take() { return std::move(scene_); }

 private:
  Mat4 placement_;
  RasterScene scene_;
  PrimitiveId next_id_ = 0;
};

/// For a scene given in the integers of the lattice.
[[nodiscard]] SceneBuilder lattice_builder(Extent extent);

}  // namespace rangezip::scenes

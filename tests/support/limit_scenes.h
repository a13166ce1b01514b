#pragma once

#include "tests/support/scene_builder.h"

/// Families of scenes at the limits of what the drawing rules allow (SceneFamily says which).
namespace rangezip::scenes {

[[nodiscard]] RasterScene point_sizes(Random& random);
[[nodiscard]] RasterScene image_shapes(Random& random);
[[nodiscard]] RasterScene guard_range(Random& random);
[[nodiscard]] RasterScene near_the_eye(Random& random);
[[nodiscard]] RasterScene central_lattice(Random& random);
[[nodiscard]] RasterScene denormals(Random& random);

}  // namespace rangezip::scenes

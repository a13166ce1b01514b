#include "compare/views_around.h"

#include <algorithm>

#include "core/base/error.h"
#include "core/plan/directions.h"
#include "core/view/camera.h"

namespace rangezip::compare {

std::vector<View> views_around(const Box& bounds, int count, Extent extent) {
  constexpr double kMargin = 1.02;  // of what is shown
  const double diagonal = bounds.diagonal();
  if (!(diagonal > 0.0)) throw InvalidArgument("views_around: the bounds must not be empty");
  if (extent.width < 1 || extent.height < 1) {
    throw InvalidArgument("views_around: the extent must be at least 1 x 1");
  }
  const double tallness =
      std::max(1.0, static_cast<double>(extent.height) / static_cast<double>(extent.width));
  std::vector<View> views;
  for (const Vec3& toward_viewer : sphere_directions(count)) {
    Camera camera = frame_box(bounds, toward_viewer, diagonal).camera;
    camera.lens = Orthographic{.height = kMargin * diagonal * tallness};
    views.emplace_back(std::move(camera), extent);
  }
  return views;
}

}  // namespace rangezip::compare

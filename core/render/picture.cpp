#include "core/render/picture.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <string>

#include "core/base/error.h"
#include "core/base/parallel.h"
#include "core/mesh/drawable.h"
#include "core/render/lines.h"
#include "core/render/shading.h"
#include "core/view/view.h"

namespace rangezip {

namespace {

constexpr int kMaxSupersampling = 4;
constexpr double kHollowRadius = 0.03;  ///< of the picture's height
constexpr Vec3f kEdgeColor{0.02F, 0.03F, 0.05F};
constexpr Vec3f kBoundaryColor{0.75F, 0.0F, 0.04F};

void check_not_empty(const std::string& function, const PictureContent& content) {
  if (content.mesh.empty() && content.points.empty()) {
    throw InvalidArgument(function + ": the content must not be empty");
  }
}

/// Calls visit for each corner of a face and each point.
template <class Visit>
void visit_positions(const PictureContent& content, const Visit& visit) {
  for (const Triangle& triangle : content.mesh.triangles) {
    for (const std::uint32_t corner : triangle)
      visit(content.mesh.positions[corner]);
  }
  for (const Vec3& point : content.points)
    visit(point);
}

Box bounds_of(const PictureContent& content) {
  Box bounds;
  visit_positions(content, [&](const Vec3& position) { bounds.add(position); });
  return bounds;
}

void check_options(const PictureOptions& options) {
  if (options.supersampling < 1 || options.supersampling > kMaxSupersampling) {
    throw InvalidArgument("draw_picture: supersampling must lie in [1, 4], got " +
                          std::to_string(options.supersampling));
  }
  if (options.extent.width < 1 || options.extent.height < 1) {
    throw InvalidArgument("draw_picture: extent must be at least 1 x 1");
  }
  if (options.point_size < 1 || options.point_size > kMaxPointSize / kMaxSupersampling) {
    throw InvalidArgument("draw_picture: point_size must lie in [1, 63], got " +
                          std::to_string(options.point_size));
  }
}

/// The points about a local origin, as a rasterizer takes them.
struct DrawablePoints {
  explicit DrawablePoints(const std::vector<Vec3>& points) {
    Box bounds;
    for (const Vec3& point : points)
      bounds.add(point);
    const Vec3 origin = bounds.is_empty() ? Vec3{0.0} : bounds.center();
    positions.reserve(points.size());
    for (const Vec3& point : points)
      positions.emplace_back(point - origin);
    world_from_item[3] = Vec4(origin, 1.0);
  }

  std::vector<Vec3f> positions;
  Mat4 world_from_item{1.0};
};

Framebuffer draw(Rasterizer& rasterizer, const View& view, const PictureContent& content,
                 int point_size) {
  const DrawableMesh mesh(content.mesh);
  const DrawablePoints points(content.points);
  std::vector<DrawItem> items;
  if (!content.mesh.empty()) items.emplace_back(mesh.item());
  if (!content.points.empty()) {
    items.emplace_back(
        DrawPoints{.positions = points.positions,
                   .world_from_item = points.world_from_item,
                   .first_id = static_cast<PrimitiveId>(content.mesh.triangles.size()),
                   .point_size = point_size});
  }
  return rasterizer.render(view, items);
}

/// Display value of linear light: the square root is close to the screen's curve.
std::uint8_t display_value(float light) {
  return static_cast<std::uint8_t>(std::lround(255.0F * std::sqrt(std::clamp(light, 0.0F, 1.0F))));
}

/// The mean of each block of factor x factor samples.
Picture downsample(const LightImage& light, int factor) {
  Picture picture({light.extent().width / factor, light.extent().height / factor});
  const float share = 1.0F / static_cast<float>(factor * factor);
  for_each_row(picture.extent().height, [&](int y) {
    for (int x = 0; x < picture.extent().width; ++x) {
      Vec3f sum{0.0F};
      for (int dy = 0; dy < factor; ++dy) {
        for (int dx = 0; dx < factor; ++dx) {
          sum += glm::clamp(light[{factor * x + dx, factor * y + dy}], 0.0F, 1.0F);
        }
      }
      sum *= share;
      picture[{x, y}] = {display_value(sum.x), display_value(sum.y), display_value(sum.z)};
    }
  });
  return picture;
}

}  // namespace

Camera frame_picture(const PictureContent& content, const Vec3& toward_viewer, Extent extent,
                     const std::optional<Vec3>& up) {
  check_not_empty("frame_picture", content);
  if (extent.width < 1 || extent.height < 1) {
    throw InvalidArgument("frame_picture: extent must be at least 1 x 1");
  }
  constexpr double kMargin = 1.06;  // of what is shown
  const Box bounds = bounds_of(content);
  const double probe = std::max(bounds.diagonal(), std::numeric_limits<double>::min());
  Camera camera = frame_box(bounds, toward_viewer, probe, 0, up).camera;
  Box seen;  // in eye space
  visit_positions(content,
                  [&](const Vec3& p) { seen.add(Vec3(camera.eye_from_world * Vec4(p, 1.0))); });
  camera.eye_from_world[3] -= Vec4(seen.center().x, seen.center().y, 0.0, 0.0);
  const Vec3 size = seen.upper - seen.lower;
  const double pixel_size =
      std::max({size.x / extent.width, size.y / extent.height, std::numeric_limits<double>::min()});
  camera.lens = Orthographic{.height = kMargin * pixel_size * extent.height};
  return camera;
}

Picture draw_picture(Rasterizer& rasterizer, const PictureContent& content, const Camera& camera,
                     const PictureOptions& options) {
  check_not_empty("draw_picture", content);
  check_options(options);
  const int factor = options.supersampling;
  const Extent fine{options.extent.width * factor, options.extent.height * factor};
  const View view(fit_depth_planes(camera, bounds_of(content)), fine);
  const Framebuffer drawn = draw(rasterizer, view, content, options.point_size * factor);
  const Grid<double> depths = eye_depths(view, drawn);
  LightImage light = shade(view, drawn, depths, content.mesh,
                           {.flat = options.flat,
                            .hollow_radius = kHollowRadius * fine.height,
                            .point_reach = options.point_size * factor / 2 + 1});
  if (options.edges) {
    paint_lines(light, view, depths, content.mesh, edges_of(content.mesh, false),
                {.color = kEdgeColor, .width = 0.8 * factor, .opacity = 0.55});
  }
  if (options.boundary) {
    paint_lines(light, view, depths, content.mesh, edges_of(content.mesh, true),
                {.color = kBoundaryColor, .width = 3.0 * factor});
  }
  return downsample(light, factor);
}

}  // namespace rangezip

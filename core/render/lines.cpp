#include "core/render/lines.h"

#include <algorithm>
#include <cmath>

namespace rangezip {

namespace {

/// A line in the window: its ends as (x, y, eye depth).
struct Segment {
  Vec3 a;
  Vec3 b;
};

/// Sets the pixels that one line covers.
class LinePainter {
 public:
  LinePainter(const View& view, const Grid<double>& depths, double width, Grid<std::uint8_t>& ink)
      : view_(view), depths_(depths), radius_(0.5 * width), ink_(ink) {}

  void paint(const Segment& line) {
    // Column by column or row by row, whichever gives short runs across the line.
    const bool is_flat = std::abs(line.b.x - line.a.x) >= std::abs(line.b.y - line.a.y);
    const int along = is_flat ? 0 : 1;
    const double low = std::min(line.a[along], line.b[along]) - radius_;
    const double high = std::max(line.a[along], line.b[along]) + radius_;
    const int size = along == 0 ? ink_.extent().width : ink_.extent().height;
    const int first = static_cast<int>(std::clamp(std::floor(low), 0.0, size - 1.0));
    const int last = static_cast<int>(std::clamp(std::floor(high), 0.0, size - 1.0));
    for (int i = first; i <= last; ++i)
      paint_across(line, along, i);
  }

 private:
  void paint_across(const Segment& line, int along, int i) {
    const int across = 1 - along;
    const double length = line.b[along] - line.a[along];
    const double t = length == 0.0 ? 0.0 : std::clamp((i + 0.5 - line.a[along]) / length, 0.0, 1.0);
    const double middle = glm::mix(line.a[across], line.b[across], t);
    const double reach = 1.5 * radius_ + 1.0;  // sqrt(2) of the radius on a diagonal
    const int size = across == 0 ? ink_.extent().width : ink_.extent().height;
    const int first = static_cast<int>(std::clamp(std::floor(middle - reach), 0.0, size - 1.0));
    const int last = static_cast<int>(std::clamp(std::floor(middle + reach), 0.0, size - 1.0));
    for (int j = first; j <= last; ++j)
      paint_pixel(line, along == 0 ? Pixel{i, j} : Pixel{j, i});
  }

  void paint_pixel(const Segment& line, Pixel pixel) {
    const Vec2 center{pixel.x + 0.5, pixel.y + 0.5};
    const Vec2 direction = Vec2(line.b) - Vec2(line.a);
    const double length_squared = glm::dot(direction, direction);
    const double t =
        length_squared > 0.0
            ? std::clamp(glm::dot(center - Vec2(line.a), direction) / length_squared, 0.0, 1.0)
            : 0.0;
    if (glm::length(center - glm::mix(Vec2(line.a), Vec2(line.b), t)) > radius_) return;
    const double depth = glm::mix(line.a.z, line.b.z, t);
    const double tolerance = 4.0 * (radius_ + 0.5) * view_.pixel_size(depth);
    if (depth <= depths_[pixel] + tolerance) ink_[pixel] = 1;
  }

  const View& view_;
  const Grid<double>& depths_;
  double radius_;
  Grid<std::uint8_t>& ink_;
};

bool is_in_front(const View& view, double depth) {
  return !view.is_perspective() || depth >= view.camera().near_depth;
}

bool is_cut_away(const View& view, const Vec3& point) {
  const auto& planes = view.camera().clip_planes;
  return std::any_of(planes.begin(), planes.end(),
                     [&](const Plane& plane) { return plane.value(point) < 0.0; });
}

}  // namespace

std::vector<MeshEdge> edges_of(const TriangleMesh& mesh, bool boundary_only) {
  std::vector<MeshEdge> all;
  all.reserve(3 * mesh.triangles.size());
  for (const auto& [a, b, c] : mesh.triangles) {
    all.push_back({std::min(a, b), std::max(a, b)});
    all.push_back({std::min(b, c), std::max(b, c)});
    all.push_back({std::min(c, a), std::max(c, a)});
  }
  std::sort(all.begin(), all.end());
  std::vector<MeshEdge> edges;
  for (std::size_t i = 0; i < all.size();) {
    std::size_t end = i + 1;
    while (end < all.size() && all[end] == all[i])
      ++end;
    if (!boundary_only || end == i + 1) edges.push_back(all[i]);
    i = end;
  }
  return edges;
}

void paint_lines(LightImage& light, const View& view, const Grid<double>& depths,
                 const TriangleMesh& mesh, const std::vector<MeshEdge>& edges,
                 const LineStyle& style) {
  Grid<std::uint8_t> ink(light.extent());
  LinePainter painter(view, depths, style.width, ink);
  for (const auto& [from, to] : edges) {
    const Vec3& a = mesh.positions[from];
    const Vec3& b = mesh.positions[to];
    const double depth_a = view.depth_of(a);
    const double depth_b = view.depth_of(b);
    if (!is_in_front(view, depth_a) || !is_in_front(view, depth_b)) continue;
    if (is_cut_away(view, a) || is_cut_away(view, b)) continue;
    painter.paint({Vec3(Vec2(view.window_from_world(a)), depth_a),
                   Vec3(Vec2(view.window_from_world(b)), depth_b)});
  }
  const auto opacity = static_cast<float>(style.opacity);
  for (std::size_t i = 0; i < ink.pixels().size(); ++i) {
    if (ink.pixels()[i] == 0) continue;
    light.pixels()[i] = glm::mix(light.pixels()[i], style.color, opacity);
  }
}

}  // namespace rangezip

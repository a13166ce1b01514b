#include "tests/support/textbook_rasterizer.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <stdexcept>
#include <utility>

namespace rangezip {

namespace {

/// Draws one item; the image holds what is drawn so far.
class Painter {
 public:
  Painter(const Mat4& window_from_item, int subpixel_bits, Framebuffer& image)
      : window_from_item_(window_from_item),
        steps_(std::ldexp(1.0, subpixel_bits)),
        image_(image) {}

  void operator()(const DrawPoints& points) {
    for (std::size_t i = 0; i < points.positions.size(); ++i) {
      draw_point(snap(points.positions[i]), points.point_size,
                 points.first_id + static_cast<PrimitiveId>(i));
    }
  }

  void operator()(const DrawTriangles& triangles) {
    for (std::size_t i = 0; i < triangles.triangles.size(); ++i) {
      const auto& [a, b, c] = triangles.triangles[i];
      draw_triangle({snap(triangles.positions[a]), snap(triangles.positions[b]),
                     snap(triangles.positions[c])},
                    triangles.facing, triangles.first_id + static_cast<PrimitiveId>(i));
    }
  }

 private:
  [[nodiscard]] Vec3 snap(const Vec3f& position) const {
    const Vec4 h = window_from_item_ * Vec4(position, 1.0);
    return {std::round(h.x / h.w * steps_) / steps_, std::round(h.y / h.w * steps_) / steps_,
            h.z / h.w};
  }

  void draw_point(const Vec3& p, int size, PrimitiveId id) {
    const double half = 0.5 * size;
    visit_box({p.x - half, p.y - half, 0.0}, {p.x + half, p.y + half, 0.0},
              [&](Pixel pixel, double x, double y) {
                if (std::abs(x - p.x) < half && std::abs(y - p.y) < half) {
                  put(pixel, static_cast<float>(p.z), id);
                }
              });
  }

  void draw_triangle(std::array<Vec3, 3> t, Facing facing, PrimitiveId id) {
    double area = edge(t[0], t[1], t[2].x, t[2].y);
    if (area == 0.0 || (facing == Facing::front && area < 0.0) ||
        (facing == Facing::back && area > 0.0)) {
      return;
    }
    if (area < 0.0) std::swap(t[1], t[2]);
    area = std::abs(area);
    visit_box(glm::min(glm::min(t[0], t[1]), t[2]), glm::max(glm::max(t[0], t[1]), t[2]),
              [&](Pixel pixel, double x, double y) {
                float depth = 0.0F;
                for (std::size_t i = 0; i < t.size(); ++i) {
                  const Vec3& from = t[(i + 1) % t.size()];
                  const Vec3& to = t[(i + 2) % t.size()];
                  const double value = edge(from, to, x, y);
                  if (value < 0.0 || (value == 0.0 && !owns_ties(from, to))) return;
                  depth += static_cast<float>(value / area) * static_cast<float>(t[i].z);
                }
                put(pixel, depth, id);
              });
  }

  static double edge(const Vec3& from, const Vec3& to, double x, double y) {
    return (to.x - from.x) * (y - from.y) - (to.y - from.y) * (x - from.x);
  }
  static bool owns_ties(const Vec3& from, const Vec3& to) {
    return to.y > from.y || (to.y == from.y && to.x < from.x);
  }

  /// visit(pixel, x and y of its centre)
  template <class Visit>
  void visit_box(const Vec3& lower, const Vec3& upper, const Visit& visit) {
    const Extent extent = image_.id.extent();
    const auto pixel_of = [](double place, int size) {
      return static_cast<int>(std::clamp(std::floor(place), -1.0, static_cast<double>(size)));
    };
    for (int y = std::max(0, pixel_of(lower.y, extent.height));
         y <= std::min(extent.height - 1, pixel_of(upper.y, extent.height)); ++y) {
      for (int x = std::max(0, pixel_of(lower.x, extent.width));
           x <= std::min(extent.width - 1, pixel_of(upper.x, extent.width)); ++x) {
        visit(Pixel{x, y}, x + 0.5, y + 0.5);
      }
    }
  }

  void put(Pixel pixel, float z, PrimitiveId id) {
    if (!(z >= 0.0F && z <= 1.0F)) return;
    const auto depth = static_cast<std::uint32_t>(std::lround(static_cast<double>(z) * kMaxDepth));
    if (depth >= image_.depth[pixel]) return;
    image_.depth[pixel] = depth;
    image_.id[pixel] = id;
  }

  Mat4 window_from_item_;
  double steps_;
  Framebuffer& image_;
};

}  // namespace

RasterizerInfo TextbookRasterizer::info() const {
  return {.name = "textbook",
          .max_extent = {kMaxRasterExtent, kMaxRasterExtent},
          .max_point_size = kMaxPointSize,
          .subpixel_bits = subpixel_bits_};
}

DrawReport TextbookRasterizer::do_render(const View& view, std::span<const DrawItem> items,
                                         Framebuffer& out) {
  out = make_framebuffer(view.extent());
  for (const DrawItem& item : items) {
    const Mat4 world_from_item = std::visit([](const auto& i) { return i.world_from_item; }, item);
    Painter painter(view.homogeneous_window_from_world() * world_from_item, subpixel_bits_, out);
    std::visit(painter, item);
  }
  return {};
}

DrawReport TextbookRasterizer::do_render_in_band(const View&, std::span<const DrawItem>,
                                                 const DepthBand&, Framebuffer&) {
  throw std::logic_error("TextbookRasterizer does not draw in bands");
}

DrawReport TextbookRasterizer::do_accumulate(const View&, std::span<const DrawItem>,
                                             const AccumulateWindow&, Grid<PixelMoments>&) {
  throw std::logic_error("TextbookRasterizer does not accumulate");
}

}  // namespace rangezip

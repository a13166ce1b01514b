#include "raster_cpu/triangle_raster.h"

#include <algorithm>
#include <array>
#include <vector>

#include "core/raster/split_triangle.h"
#include "raster_cpu/fixed_point.h"
#include "raster_cpu/triangle_setup.h"

namespace rangezip {

namespace {

void write(const DrawTarget& target, std::size_t pixel, std::int64_t depth, PrimitiveId id) {
  target.keys[pixel] =
      std::min(target.keys[pixel], make_key(static_cast<std::uint32_t>(depth), id));
}

bool is_in_depth_range(std::int64_t depth) {
  return depth >= 0 && depth <= std::int64_t{kMaxDepth};
}

/// Tests every pixel of the box; 32-bit edges, and one division in double a pixel.
template <class Accept>
void draw_small(const TriangleSetup& t, PrimitiveId id, const DrawTarget& target,
                const Accept& accept) {
  const auto edges = edges_of<std::int32_t>(t);
  const std::array<std::int64_t, 3> z{t.a.z - t.z_min, t.b.z - t.z_min, t.c.z - t.z_min};
  // Values at the centre of the box's first pixel and steps to its neighbours; `margin` is how
  // far inside a centre lies, negative outside; `numerator` that of R7.
  std::array<std::int32_t, 3> margin_row{};
  std::array<std::int32_t, 3> step_x{};
  std::array<std::int32_t, 3> step_y{};
  std::int64_t numerator_row = 0;
  std::int64_t numerator_step_x = 0;
  std::int64_t numerator_step_y = 0;
  for (std::size_t i = 0; i < 3; ++i) {
    const std::int32_t e = edges[i].at(pixel_center(t.columns.first), pixel_center(t.rows.first));
    margin_row[i] = e - edges[i].least_inside();
    step_x[i] = edges[i].minus_dy * kSubpixels;
    step_y[i] = edges[i].dx * kSubpixels;
    numerator_row += e * z[i];
    numerator_step_x += step_x[i] * z[i];
    numerator_step_y += step_y[i] * z[i];
  }
  const auto area = static_cast<double>(t.area);
  for (int y = t.rows.first; y <= t.rows.last; ++y) {
    auto [m0, m1, m2] = margin_row;
    std::int64_t numerator = numerator_row;
    const std::size_t row = target.extent.index({0, y});
    for (int x = t.columns.first; x <= t.columns.last; ++x) {
      if ((m0 | m1 | m2) >= 0) {
        // area <= 2^26 and numerator <= 2^52: the rounded quotient cannot reach the next integer.
        const auto quotient = static_cast<std::int64_t>(static_cast<double>(numerator) / area);
        const std::int64_t depth = t.z_min + quotient;
        const std::size_t pixel = row + static_cast<std::size_t>(x);
        if (is_in_depth_range(depth) && accept(pixel, static_cast<std::int32_t>(depth))) {
          write(target, pixel, depth, id);
        }
      }
      m0 += step_x[0];
      m1 += step_x[1];
      m2 += step_x[2];
      numerator += numerator_step_x;
    }
    for (std::size_t i = 0; i < 3; ++i)
      margin_row[i] += step_y[i];
    numerator_row += numerator_step_y;
  }
}

/// The part of `span` where margin + step * (x - span.first) >= 0.
PixelRange inside_edge(PixelRange span, std::int64_t margin, std::int64_t step) {
  if (step == 0) return margin >= 0 ? span : PixelRange{};
  const std::int64_t last = span.last - span.first;
  if (step > 0) {
    const std::int64_t enter = margin >= 0 ? 0 : (-margin + step - 1) / step;
    return {span.first + static_cast<int>(std::min(enter, last + 1)), span.last};
  }
  const std::int64_t leave = margin < 0 ? -1 : margin / -step;
  return {span.first, span.first + static_cast<int>(std::min(leave, last))};
}

/// Finds the covered span of each row by division, then carries R7's quotient and remainder from
/// pixel to pixel: exact, and without a division a pixel.
template <class Accept>
void draw_large(const TriangleSetup& t, PrimitiveId id, const DrawTarget& target,
                const Accept& accept) {
  using Edge = EdgeFunction<std::int64_t>;
  const std::array<Edge, 3> edges = edges_of<std::int64_t>(t);
  const std::array<std::int64_t, 3> z{std::int64_t{t.a.z} - t.z_min, std::int64_t{t.b.z} - t.z_min,
                                      std::int64_t{t.c.z} - t.z_min};
  std::int64_t numerator_step = 0;  // below 3 * 2^31 * 2^26
  for (std::size_t i = 0; i < 3; ++i)
    numerator_step += edges[i].minus_dy * kSubpixels * z[i];
  const auto [depth_step, remainder_step] = divide_down(numerator_step, t.area);

  for (int y = t.rows.first; y <= t.rows.last; ++y) {
    PixelRange span = t.columns;
    for (const Edge& edge : edges) {
      if (span.is_empty()) break;
      const std::int64_t e = edge.at(pixel_center(span.first), pixel_center(y));
      span = inside_edge(span, e - edge.least_inside(), edge.minus_dy * kSubpixels);
    }
    if (span.is_empty()) continue;
    std::array<std::int64_t, 3> e{};
    for (std::size_t i = 0; i < 3; ++i) {
      e[i] = edges[i].at(pixel_center(span.first), pixel_center(y));
    }
    auto [depth, remainder] = divide_depth(e, z, t.area);
    depth += t.z_min;
    const std::size_t row = target.extent.index({0, y});
    for (int x = span.first; x <= span.last; ++x) {
      const std::size_t pixel = row + static_cast<std::size_t>(x);
      if (is_in_depth_range(depth) && accept(pixel, static_cast<std::int32_t>(depth))) {
        write(target, pixel, depth, id);
      }
      depth += depth_step;
      remainder += remainder_step;
      if (remainder >= t.area) {
        remainder -= t.area;
        ++depth;
      }
    }
  }
}

/// Draws the triangles of an item one by one.
class TrianglePainter {
 public:
  TrianglePainter(const DrawTriangles& item, const RowTransform& rows,
                  std::span<const SnappedPosition> snapped, const DrawTarget& target,
                  const SimdKernels* kernels)
      : item_(item), rows_(rows), snapped_(snapped), target_(target), kernels_(kernels) {}

  void draw(std::size_t triangle) {
    const auto& [a, b, c] = item_.triangles[triangle];
    const PrimitiveId id = item_.first_id + static_cast<PrimitiveId>(triangle);
    const SnappedTriangle corners{snapped_[a], snapped_[b], snapped_[c]};
    if (std::none_of(corners.begin(), corners.end(), is_rejected)) {
      draw_snapped(corners, id);
      return;
    }
    pieces_.clear();
    const std::array<Vec3f, 3> positions{item_.positions[a], item_.positions[b],
                                         item_.positions[c]};
    if (!split_triangle(rows_, positions, pieces_)) ++dropped_;
    for (const SnappedTriangle& piece : pieces_)
      draw_snapped(piece, id);
  }

  [[nodiscard]] std::size_t dropped() const { return dropped_; }

 private:
  void draw_snapped(const SnappedTriangle& corners, PrimitiveId id) {
    TriangleSetup setup;
    if (!set_up(corners, item_.facing, target_.extent, setup)) return;
    if (kernels_ != nullptr && target_.band == nullptr && setup.is_in_depth_range()) {
      const bool is_box = setup.is_small() && setup.fits_double();
      (is_box ? kernels_->fill_box : kernels_->fill_spans)(setup, id, target_);
      return;
    }
    with_acceptance(target_, [&](const auto& accept) {
      setup.is_small() ? draw_small(setup, id, target_, accept)
                       : draw_large(setup, id, target_, accept);
    });
  }

  const DrawTriangles& item_;
  const RowTransform& rows_;
  std::span<const SnappedPosition> snapped_;
  const DrawTarget& target_;
  const SimdKernels* kernels_;
  std::vector<SnappedTriangle> pieces_;
  std::size_t dropped_ = 0;
};

}  // namespace

std::size_t draw_triangles(const DrawTriangles& item, const RowTransform& rows,
                           std::span<const SnappedPosition> snapped, std::size_t begin,
                           std::size_t end, const DrawTarget& target, const SimdKernels* kernels) {
  TrianglePainter painter(item, rows, snapped, target, kernels);
  // Gathering takes 32-bit places of coordinates.
  constexpr std::size_t kMostGathered = (std::size_t{1} << 31U) / 3;
  constexpr std::size_t kBlock = 1024;
  if (kernels != nullptr && snapped.size() < kMostGathered) {
    std::vector<std::size_t> left;
    for (std::size_t done = 1; done != 0; begin += done) {
      const std::size_t block = std::min(kBlock, end - begin);
      done = kernels->draw_tiny_triangles(item, snapped, begin, begin + block, target, left);
      for (const std::size_t triangle : left)
        painter.draw(triangle);
    }
  }
  for (; begin < end; ++begin)
    painter.draw(begin);
  return painter.dropped();
}

}  // namespace rangezip

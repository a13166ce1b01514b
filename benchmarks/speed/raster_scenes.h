#pragma once

#include <cstddef>
#include <vector>

#include "benchmarks/speed/measure.h"
#include "core/base/geometry.h"
#include "core/raster/draw_item.h"
#include "core/raster/framebuffer.h"
#include "core/view/view.h"

namespace rangezip::benchmark {

/// How the points of a cloud follow one another: anywhere, row after row as a scanner takes them,
/// or along a Z-shaped curve, where the next point is near in x and y.
enum class Order { random, scan, curve };
[[nodiscard]] const char* name_of(Order order);

/// Points in the unit cube, as dense everywhere; the depth is random in every order.
struct Cloud {
  Order order = Order::random;
  std::vector<Vec3f> positions;
};
[[nodiscard]] Cloud make_cloud(std::size_t count, Order order);

/// A height field over the unit square: triangles that do not overlap, with random depths.
struct Field {
  std::vector<Vec3f> positions;
  std::vector<Triangle> triangles;
};
/// @param pixels what a triangle covers on average in an image of size x size
[[nodiscard]] Field make_field(double pixels, int size);

/// Shows the unit cube, placed by placement(), in the whole of a square image.
[[nodiscard]] View make_view(int size, bool is_central);
[[nodiscard]] Mat4 placement(bool is_central);

[[nodiscard]] DrawPoints draw(const Cloud& cloud, int point_size, bool is_central);
[[nodiscard]] DrawTriangles draw(const Field& field);

/// What the bytes are that drawing has to read.
[[nodiscard]] std::vector<Bytes> bytes_of(const Cloud& cloud);
[[nodiscard]] std::vector<Bytes> bytes_of(const Field& field);

/// The whole depth range and its middle: every point in the view takes part.
[[nodiscard]] AccumulateWindow make_open_window(int size);

/// Pixels in which something was drawn: the fragments of a scene without overlaps.
[[nodiscard]] std::size_t covered_pixels(const Grid<PrimitiveId>& ids);

}  // namespace rangezip::benchmark

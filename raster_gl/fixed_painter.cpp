#include "raster_gl/fixed_painter.h"

#include <algorithm>
#include <variant>
#include <vector>

#include "core/base/error.h"
#include "raster_gl/gathered_triangles.h"
#include "raster_gl/shader_text.h"

namespace rangezip {

namespace {

void require(const GlDevice& device, const char* name, double value, double least) {
  if (value >= least) return;
  throw BackendError("OpenGL (" + device.renderer() + "): fixed functions need " + name + " " +
                     std::to_string(static_cast<int>(least)) + ", the driver has " +
                     std::to_string(static_cast<int>(value)));
}

GLint integer(const GlDevice& device, GLenum limit) {
  GLint values[2] = {0, 0};  // some limits are pairs; the first is asked for
  device.gl().GetIntegerv(limit, values);
  return values[0];
}

void check_limits(const GlDevice& device) {
  constexpr int kSubpixelBits = 8;
  constexpr int kBlocks = 2;
  GLfloat sizes[2] = {0.0F, 0.0F};
  device.gl().GetFloatv(GL_POINT_SIZE_RANGE, sizes);
  require(device, "points of size", sizes[1], kMaxPointSize);
  require(device, "GL_SUBPIXEL_BITS", integer(device, GL_SUBPIXEL_BITS), kSubpixelBits);
  require(device, "GL_MAX_VIEWPORT_DIMS", integer(device, GL_MAX_VIEWPORT_DIMS), kViewportSize);
  require(device, "GL_MAX_VERTEX_SHADER_STORAGE_BLOCKS",
          integer(device, GL_MAX_VERTEX_SHADER_STORAGE_BLOCKS), kBlocks);
  require(device, "GL_MAX_FRAGMENT_SHADER_STORAGE_BLOCKS",
          integer(device, GL_MAX_FRAGMENT_SHADER_STORAGE_BLOCKS), kBlocks);
}

/// The tools for drawing what the hardware leaves out.
ComputeTools for_outside(ComputeTools tools) {
  tools.setup.outside_only = true;
  return tools;
}

std::vector<DrawItem> triangles_of(std::span<const DrawItem> items) {
  std::vector<DrawItem> triangles;
  std::copy_if(items.begin(), items.end(), std::back_inserter(triangles),
               [](const DrawItem& item) { return std::holds_alternative<DrawTriangles>(item); });
  return triangles;
}

}  // namespace

FixedPainter::FixedPainter(const ComputeTools& tools)
    : tools_(tools),
      target_(tools.device, tools.kernels),
      outside_tools_(for_outside(tools)),
      outside_(outside_tools_),
      rows_(tools.device),
      counters_(tools.device),
      snapped_(tools.device) {
  check_limits(tools.device);
}

DrawReport FixedPainter::draw(const View& view, std::span<const DrawItem> items,
                              const DepthBand* band, Framebuffer& out) {
  set_extent(out, view.extent());
  has_band_ = band != nullptr;
  DrawReport report;
  bool has_outside = false;
  const std::size_t most_pixels = tools_.setup.block_bytes / sizeof(std::uint32_t);
  for (const ImagePart& part : parts_of(view.extent(), most_pixels)) {
    target_.begin(part, band, Projection::fixed);
    for (const DrawItem& item : items) {
      rows_.upload(std::visit(
          [&](const auto& i) { return make_row_transform(view, i.world_from_item); }, item));
      if (const auto* points = std::get_if<DrawPoints>(&item)) {
        report.dropped_points += draw_points(*points, part.first_row == 0);
      } else {
        has_outside |= draw_triangles(std::get<DrawTriangles>(item));
      }
    }
    target_.read(out);
    target_.end();
  }
  if (has_outside) {
    Framebuffer rest;
    report.dropped_triangles =
        outside_.draw(view, triangles_of(items), band, rest).dropped_triangles;
    composite(out, rest);
  }
  return report;
}

/// @return points that R3 or R4 rejects; 0 unless they are counted
std::size_t FixedPainter::draw_points(const DrawPoints& points, bool is_counting) {
  counters_.restart(tools_.kernels);
  const std::size_t chunk = tools_.chunk_of(sizeof(PlacedPosition));
  for (std::size_t begin = 0; begin < points.positions.size(); begin += chunk) {
    const std::size_t count = std::min(chunk, points.positions.size() - begin);
    rows_.snap(tools_, points.positions.subspan(begin, count),
               {.content_key = points.content_key, .first = begin, .count = count}, snapped_,
               is_counting);
    const GlProgram& drawing = program(true);
    drawing.set("first_id", points.first_id + static_cast<PrimitiveId>(begin));
    drawing.set("point_size", points.point_size);
    target_.draw(drawing, GL_POINTS, count);
  }
  return is_counting ? counters_.read()[static_cast<std::size_t>(Counter::rejected_points)] : 0;
}

/// @return whether there are triangles that kernels must draw
bool FixedPainter::draw_triangles(const DrawTriangles& item) {
  if (item.triangles.empty()) return false;
  const GlFunctions& gl = tools_.device.gl();
  item.facing == Facing::both ? gl.Disable(GL_CULL_FACE) : gl.Enable(GL_CULL_FACE);
  gl.CullFace(item.facing == Facing::front ? GL_BACK : GL_FRONT);
  const bool is_gathered = item.positions.size() > tools_.chunk_of(sizeof(PlacedPosition));
  const std::size_t chunk =
      tools_.chunk_of(is_gathered ? 3 * sizeof(PlacedPosition) : sizeof(Triangle));
  bool has_outside = !is_gathered && snap_corners(item.positions, item.content_key);
  for (std::size_t begin = 0; begin < item.triangles.size(); begin += chunk) {
    const std::size_t count = std::min(chunk, item.triangles.size() - begin);
    if (is_gathered) {
      const GatheredTriangles part = gather(item, begin, begin + count);
      has_outside |= snap_corners(part.positions, 0);
      draw_chunk(item, tools_.uploads.get({}, std::span<const Triangle>(part.triangles)), begin,
                 count);
    } else {
      const UploadKey key{
          .content_key = item.content_key, .is_corners = true, .first = begin, .count = count};
      draw_chunk(item, tools_.uploads.get(key, item.triangles.subspan(begin, count)), begin, count);
    }
  }
  gl.Disable(GL_CULL_FACE);
  return has_outside;
}

/// @return whether one of them lies outside of the viewport
bool FixedPainter::snap_corners(std::span<const Vec3f> positions, std::uint64_t content_key) {
  counters_.restart(tools_.kernels);
  rows_.snap(tools_, positions, {.content_key = content_key, .count = positions.size()}, snapped_,
             true);
  return counters_.read()[static_cast<std::size_t>(Counter::outside_positions)] > 0;
}

void FixedPainter::draw_chunk(const DrawTriangles& item, const GlBuffer& corners, std::size_t begin,
                              std::size_t count) {
  tools_.kernels.bind(Binding::snapped, snapped_);
  tools_.kernels.bind(Binding::corners, corners);
  const GlProgram& drawing = program(false);
  drawing.set("first_id", item.first_id + static_cast<PrimitiveId>(begin));
  target_.draw(drawing, GL_TRIANGLES, 3 * count);
}

const GlProgram& FixedPainter::program(bool of_points) {
  const std::pair key(of_points, has_band_);
  const auto found = programs_.find(key);
  if (found != programs_.end()) return found->second;
  const ShaderVariant variant{.has_band = has_band_};
  GlProgram made =
      of_points ? GlProgram(tools_.device, "points by fixed functions",
                            {{GL_VERTEX_SHADER, shader_text::fixed_point_vertex()},
                             {GL_FRAGMENT_SHADER, shader_text::fixed_point_fragment(variant)}})
                : GlProgram(tools_.device, "triangles by fixed functions",
                            {{GL_VERTEX_SHADER, shader_text::fixed_triangle_vertex()},
                             {GL_FRAGMENT_SHADER, shader_text::fixed_triangle_fragment(variant)}});
  return programs_.emplace(key, std::move(made)).first->second;
}

}  // namespace rangezip

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
  constexpr int kBlocks = 4;
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
  out.depth.reset(view.extent());
  out.id.reset(view.extent());
  has_band_ = band != nullptr;
  DrawReport report;
  std::size_t outside = 0;
  const std::size_t most_pixels = tools_.setup.block_bytes / sizeof(std::uint32_t);
  for (const ImagePart& part : parts_of(view.extent(), most_pixels)) {
    target_.begin(part, band, Projection::fixed);
    for (const DrawItem& item : items) {
      rows_.upload(std::visit(
          [&](const auto& i) { return make_row_transform(view, i.world_from_item); }, item));
      if (const auto* points = std::get_if<DrawPoints>(&item)) {
        report.dropped_points += draw_points(*points, part.first_row == 0);
      } else {
        outside += draw_triangles(std::get<DrawTriangles>(item));
      }
    }
    target_.read(out);
    target_.end();
  }
  if (outside > 0) {
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
  const std::size_t chunk = tools_.chunk_of(sizeof(Vec3f));
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

/// @return triangles that kernels must draw
std::size_t FixedPainter::draw_triangles(const DrawTriangles& item) {
  if (item.triangles.empty()) return 0;
  const GlFunctions& gl = tools_.device.gl();
  item.facing == Facing::both ? gl.Disable(GL_CULL_FACE) : gl.Enable(GL_CULL_FACE);
  gl.CullFace(item.facing == Facing::front ? GL_BACK : GL_FRONT);
  const bool is_gathered = item.positions.size() > tools_.chunk_of(sizeof(Vec3f));
  const std::size_t chunk = tools_.chunk_of((is_gathered ? 3 : 1) * sizeof(Triangle));
  if (!is_gathered) {
    rows_.snap(tools_, item.positions,
               {.content_key = item.content_key, .count = item.positions.size()}, snapped_);
  }
  std::size_t outside = 0;
  for (std::size_t begin = 0; begin < item.triangles.size(); begin += chunk) {
    const std::size_t count = std::min(chunk, item.triangles.size() - begin);
    if (is_gathered) {
      const GatheredTriangles part = gather(item, begin, begin + count);
      rows_.snap(tools_, part.positions, {}, snapped_);
      const GlBuffer& corners = tools_.uploads.get({}, std::span<const Triangle>(part.triangles));
      outside += draw_chunk(item, corners, begin, count);
    } else {
      const GlBuffer& corners = tools_.uploads.get(
          {.content_key = item.content_key, .is_corners = true, .first = begin, .count = count},
          item.triangles.subspan(begin, count));
      outside += draw_chunk(item, corners, begin, count);
    }
  }
  gl.Disable(GL_CULL_FACE);
  return outside;
}

std::size_t FixedPainter::draw_chunk(const DrawTriangles& item, const GlBuffer& corners,
                                     std::size_t begin, std::size_t count) {
  counters_.restart(tools_.kernels);
  tools_.kernels.bind(Binding::snapped, snapped_);
  tools_.kernels.bind(Binding::corners, corners);
  const GlProgram& counting = tools_.kernels.get(Kernel::count_outside, {});
  counting.set("count", static_cast<unsigned>(count));
  tools_.kernels.dispatch(counting, groups_of(count, kTriangleGroup));
  const std::size_t outside =
      counters_.read()[static_cast<std::size_t>(Counter::outside_triangles)];
  const GlProgram& drawing = program(false);
  drawing.set("first_id", item.first_id + static_cast<PrimitiveId>(begin));
  drawing.set("all_inside", outside == 0 ? 1U : 0U);
  target_.draw(drawing, GL_TRIANGLES, 3 * count);
  return outside;
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

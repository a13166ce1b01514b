#include "raster_gl/native_painter.h"

#include <algorithm>
#include <variant>

#include "core/base/error.h"
#include "raster_gl/gathered_triangles.h"
#include "raster_gl/shader_text.h"

namespace rangezip {

namespace {

constexpr std::size_t kMostClipPlanes = 8;

/// The view's map to the window, in OpenGL's clip coordinates: -w .. w in x, y and z.
glm::mat4 clip_from_item(const View& view, const Mat4& world_from_item) {
  Mat4 clip_from_window{1.0};
  clip_from_window[0][0] = 2.0 / view.extent().width;
  clip_from_window[1][1] = 2.0 / view.extent().height;
  clip_from_window[2][2] = 2.0;
  clip_from_window[3] = {-1.0, -1.0, -1.0, 1.0};
  return glm::mat4(clip_from_window * view.homogeneous_window_from_world() * world_from_item);
}

}  // namespace

NativePainter::NativePainter(const ComputeTools& tools)
    : tools_(tools),
      target_(tools.device, tools.kernels),
      planes_(tools.device),
      positions_(tools.device),
      corners_(tools.device) {
  planes_.reserve(sizeof(Row), "clip planes");
  corners_.reserve(sizeof(Triangle), "corners");
}

DrawReport NativePainter::draw(const View& view, std::span<const DrawItem> items,
                               const DepthBand* band, Framebuffer& out) {
  set_extent(out, view.extent());
  has_band_ = band != nullptr;
  clip_planes_ = view.camera().clip_planes.size();
  if (clip_planes_ > kMostClipPlanes) {
    throw BackendError("native OpenGL has 8 clip planes, the view " + std::to_string(clip_planes_));
  }
  const GlFunctions& gl = tools_.device.gl();
  for (std::size_t plane = 0; plane < kMostClipPlanes; ++plane) {
    const GLenum number = GL_CLIP_DISTANCE0 + static_cast<GLenum>(plane);
    plane < clip_planes_ ? gl.Enable(number) : gl.Disable(number);
  }
  const std::size_t most_pixels = tools_.setup.block_bytes / sizeof(std::uint32_t);
  for (const ImagePart& part : parts_of(view.extent(), most_pixels)) {
    target_.begin(part, band, Projection::native);
    for (const DrawItem& item : items) {
      const Mat4& placement =
          std::visit([](const auto& i) -> const Mat4& { return i.world_from_item; }, item);
      const RowTransform rows = make_row_transform(view, placement);
      planes_.upload(std::span<const Row>(rows.clip), "clip planes");
      if (const auto* points = std::get_if<DrawPoints>(&item)) {
        draw_points(*points, clip_from_item(view, placement));
      } else {
        draw_triangles(std::get<DrawTriangles>(item), clip_from_item(view, placement));
      }
    }
    target_.read(out);
    target_.end();
  }
  return {};
}

void NativePainter::draw_points(const DrawPoints& points, const glm::mat4& matrix) {
  const GlProgram& drawing = program(true, matrix);
  drawing.set("point_size", points.point_size);
  const std::size_t chunk = tools_.chunk_of(sizeof(Vec3f));
  for (std::size_t begin = 0; begin < points.positions.size(); begin += chunk) {
    const std::size_t count = std::min(chunk, points.positions.size() - begin);
    tools_.kernels.bind(
        Binding::positions,
        tools_.uploads.get({.content_key = points.content_key, .first = begin, .count = count},
                           points.positions.subspan(begin, count)));
    drawing.set("first_id", points.first_id + static_cast<PrimitiveId>(begin));
    target_.draw(drawing, GL_POINTS, count);
  }
}

void NativePainter::draw_triangles(const DrawTriangles& item, const glm::mat4& matrix) {
  const GlProgram& drawing = program(false, matrix);
  const GlFunctions& gl = tools_.device.gl();
  item.facing == Facing::both ? gl.Disable(GL_CULL_FACE) : gl.Enable(GL_CULL_FACE);
  gl.CullFace(item.facing == Facing::front ? GL_BACK : GL_FRONT);
  const bool is_whole = item.positions.size() <= tools_.chunk_of(sizeof(Vec3f));
  const std::size_t chunk = tools_.chunk_of((is_whole ? 1 : 3) * sizeof(Triangle));
  for (std::size_t begin = 0; begin < item.triangles.size(); begin += chunk) {
    const std::size_t count = std::min(chunk, item.triangles.size() - begin);
    if (is_whole && count == item.triangles.size()) {
      load(item);
    } else {
      const GatheredTriangles part = gather(item, begin, begin + count);
      loaded_key_ = 0;
      positions_.upload(std::span<const Vec3f>(part.positions), "positions");
      corners_.upload(std::span<const Triangle>(part.triangles), "corners");
    }
    tools_.kernels.bind(Binding::positions, positions_);
    drawing.set("first_id", item.first_id + static_cast<PrimitiveId>(begin));
    target_.draw(drawing, GL_TRIANGLES, 3 * count, &corners_);
  }
  gl.Disable(GL_CULL_FACE);
}

/// Both buffers are needed at a time: that of a last drawing is kept apart from the cache, in which
/// one upload may push out the other.
void NativePainter::load(const DrawTriangles& item) {
  if (item.content_key != 0 && item.content_key == loaded_key_) return;
  positions_.upload(item.positions, "positions");
  corners_.upload(item.triangles, "corners");
  loaded_key_ = item.content_key;
}

const GlProgram& NativePainter::program(bool of_points, const glm::mat4& matrix) {
  const ShaderVariant variant{.has_band = has_band_, .has_clip_planes = clip_planes_ > 0};
  const std::pair key(of_points, variant);
  auto found = programs_.find(key);
  if (found == programs_.end()) {
    GlProgram made(tools_.device, "native OpenGL",
                   {{GL_VERTEX_SHADER, shader_text::native_vertex(variant)},
                    {GL_FRAGMENT_SHADER, shader_text::native_fragment(variant, of_points)}});
    found = programs_.emplace(key, std::move(made)).first;
  }
  const GlProgram& drawing = found->second;
  drawing.set("clip_from_item", matrix);
  drawing.set("clip_planes", static_cast<unsigned>(clip_planes_));
  tools_.kernels.bind(Binding::clip_rows, planes_);
  tools_.kernels.bind(Binding::corners, corners_);
  return drawing;
}

}  // namespace rangezip

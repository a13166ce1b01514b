#include "benchmarks/speed/native_gl.h"

#include <cstdlib>
#include <optional>
#include <span>
#include <variant>

#include "benchmarks/speed/raster_scenes.h"
#include "core/base/error.h"
#include "core/base/grid.h"
#include "raster_gl/gl_functions.h"
#include "raster_gl/gl_objects.h"
#include "raster_gl/native_painter.h"
#include "raster_gl/osmesa_context.h"

namespace rangezip::benchmark {

namespace {

constexpr const char* kVertexShader = R"(#version 450 core
layout(location = 0) in vec3 position;
layout(location = 0) uniform mat4 clip_from_item;
layout(location = 0) flat out uint number;
void main() {
  number = uint(gl_VertexID);
  gl_Position = clip_from_item * vec4(position, 1.0);
}
)";

constexpr const char* kPointShader = R"(#version 450 core
layout(location = 0) flat in uint number;
layout(location = 0) out uint id;
void main() { id = number; }
)";

constexpr const char* kTriangleShader = R"(#version 450 core
layout(location = 0) out uint id;
void main() { id = uint(gl_PrimitiveID); }
)";

/// On the calling thread, so that processor time is that of one core. Mesa asks when it starts.
std::unique_ptr<GlContext> make_context_without_threads() {
  setenv("LP_NUM_THREADS", "0", 1);
  return make_osmesa_context();
}

template <class T>
GLsizeiptr size_in_bytes(std::span<const T> values) {
  return static_cast<GLsizeiptr>(values.size_bytes());
}

// What raster_gl does not use.
#define RANGEZIP_NATIVE_FUNCTIONS(X)                             \
  X(PFNGLCLEARNAMEDFRAMEBUFFERFVPROC, ClearNamedFramebufferfv)   \
  X(PFNGLCREATEBUFFERSPROC, CreateBuffers)                       \
  X(PFNGLDELETEBUFFERSPROC, DeleteBuffers)                       \
  X(PFNGLDEPTHFUNCPROC, DepthFunc)                               \
  X(PFNGLDRAWELEMENTSPROC, DrawElements)                         \
  X(PFNGLENABLEPROC, Enable)                                     \
  X(PFNGLENABLEVERTEXARRAYATTRIBPROC, EnableVertexArrayAttrib)   \
  X(PFNGLFINISHPROC, Finish)                                     \
  X(PFNGLNAMEDBUFFERSTORAGEPROC, NamedBufferStorage)             \
  X(PFNGLPOINTSIZEPROC, PointSize)                               \
  X(PFNGLPROGRAMUNIFORMMATRIX4FVPROC, ProgramUniformMatrix4fv)   \
  X(PFNGLVERTEXARRAYATTRIBFORMATPROC, VertexArrayAttribFormat)   \
  X(PFNGLVERTEXARRAYELEMENTBUFFERPROC, VertexArrayElementBuffer) \
  X(PFNGLVERTEXARRAYVERTEXBUFFERPROC, VertexArrayVertexBuffer)

struct Functions : GlFunctions {
  explicit Functions(const CurrentContext& current) : GlFunctions(current) {
#define RANGEZIP_NATIVE_LOAD(Type, name) \
  name = reinterpret_cast<Type>(current.context().function("gl" #name));
    RANGEZIP_NATIVE_FUNCTIONS(RANGEZIP_NATIVE_LOAD)
#undef RANGEZIP_NATIVE_LOAD
  }

#define RANGEZIP_NATIVE_MEMBER(Type, name) Type name = nullptr;
  RANGEZIP_NATIVE_FUNCTIONS(RANGEZIP_NATIVE_MEMBER)
#undef RANGEZIP_NATIVE_MEMBER
};

/// The objects of one item.
struct Scene {
  explicit Scene(const Functions& gl, Extent size)
      : extent(size),
        ids(make_object(gl.CreateRenderbuffers, gl.DeleteRenderbuffers)),
        depths(make_object(gl.CreateRenderbuffers, gl.DeleteRenderbuffers)),
        target(make_object(gl.CreateFramebuffers, gl.DeleteFramebuffers)),
        positions(make_object(gl.CreateBuffers, gl.DeleteBuffers)),
        corners(make_object(gl.CreateBuffers, gl.DeleteBuffers)),
        vertices(make_object(gl.CreateVertexArrays, gl.DeleteVertexArrays)),
        program(gl.CreateProgram(), gl.DeleteProgram) {}

  Extent extent;
  GlObject ids;
  GlObject depths;
  GlObject target;
  GlObject positions;
  GlObject corners;  ///< empty for points
  GlObject vertices;
  GlObject program;
  GLsizei vertex_count = 0;
  bool has_corners = false;
};

}  // namespace

struct NativeGl::State {
  std::unique_ptr<GlContext> context = make_context_without_threads();
  CurrentContext current{*context};
  Functions gl{current};
  std::optional<Scene> scene;

  void make_target() const;
  void make_vertices(std::span<const Vec3f> positions) const;
  void attach(GLenum stage, const char* source) const;
  void make_program(const char* fragment_shader, const glm::mat4& matrix) const;
  void check() const;

  void upload(const View& view, const DrawPoints& points);
  void upload(const View& view, const DrawTriangles& item);
};

void NativeGl::State::make_target() const {
  const auto [width, height] = scene->extent;
  const GLuint target = scene->target.name();
  gl.NamedRenderbufferStorage(scene->ids.name(), GL_R32UI, width, height);
  gl.NamedRenderbufferStorage(scene->depths.name(), GL_DEPTH_COMPONENT24, width, height);
  gl.NamedFramebufferRenderbuffer(target, GL_COLOR_ATTACHMENT0, GL_RENDERBUFFER, scene->ids.name());
  gl.NamedFramebufferRenderbuffer(target, GL_DEPTH_ATTACHMENT, GL_RENDERBUFFER,
                                  scene->depths.name());
  if (gl.CheckNamedFramebufferStatus(target, GL_FRAMEBUFFER) != GL_FRAMEBUFFER_COMPLETE) {
    throw BackendError("NativeGl: a framebuffer of IDs and depths is not complete");
  }
  gl.BindFramebuffer(GL_FRAMEBUFFER, target);
  gl.Viewport(0, 0, width, height);
  gl.Enable(GL_DEPTH_TEST);
  gl.DepthFunc(GL_LESS);
}

void NativeGl::State::make_vertices(std::span<const Vec3f> positions) const {
  const GLuint vertices = scene->vertices.name();
  gl.NamedBufferStorage(scene->positions.name(), size_in_bytes(positions), positions.data(), 0);
  gl.VertexArrayVertexBuffer(vertices, 0, scene->positions.name(), 0, sizeof(Vec3f));
  gl.VertexArrayAttribFormat(vertices, 0, 3, GL_FLOAT, GL_FALSE, 0);
  gl.EnableVertexArrayAttrib(vertices, 0);
  gl.BindVertexArray(vertices);
}

void NativeGl::State::attach(GLenum stage, const char* source) const {
  const GlObject shader(gl.CreateShader(stage), gl.DeleteShader);
  gl.ShaderSource(shader.name(), 1, &source, nullptr);
  gl.CompileShader(shader.name());
  gl.AttachShader(scene->program.name(), shader.name());
}

void NativeGl::State::make_program(const char* fragment_shader, const glm::mat4& matrix) const {
  const GLuint program = scene->program.name();
  attach(GL_VERTEX_SHADER, kVertexShader);
  attach(GL_FRAGMENT_SHADER, fragment_shader);
  gl.LinkProgram(program);
  GLint linked = GL_FALSE;
  gl.GetProgramiv(program, GL_LINK_STATUS, &linked);
  if (linked != GL_TRUE) throw BackendError("NativeGl: the shaders do not link");
  gl.ProgramUniformMatrix4fv(program, 0, 1, GL_FALSE, &matrix[0][0]);
  gl.UseProgram(program);
}

void NativeGl::State::check() const {
  if (const GLenum error = gl.GetError(); error != GL_NO_ERROR) {
    throw BackendError("NativeGl: OpenGL reports error " + std::to_string(error));
  }
}

void NativeGl::State::upload(const View& view, const DrawPoints& points) {
  make_vertices(points.positions);
  make_program(kPointShader, clip_from_item(view, points.world_from_item));
  gl.PointSize(static_cast<float>(points.point_size));
  scene->vertex_count = static_cast<GLsizei>(points.positions.size());
}

void NativeGl::State::upload(const View& view, const DrawTriangles& item) {
  make_vertices(item.positions);
  gl.NamedBufferStorage(scene->corners.name(), size_in_bytes(item.triangles), item.triangles.data(),
                        0);
  gl.VertexArrayElementBuffer(scene->vertices.name(), scene->corners.name());
  make_program(kTriangleShader, clip_from_item(view, item.world_from_item));
  scene->vertex_count = static_cast<GLsizei>(3 * item.triangles.size());
  scene->has_corners = true;
}

NativeGl::NativeGl() : state_(std::make_unique<State>()) {}
NativeGl::~NativeGl() = default;

std::string NativeGl::renderer() const {
  const GLubyte* const text = state_->gl.GetString(GL_RENDERER);
  return text == nullptr ? std::string() : reinterpret_cast<const char*>(text);
}

void NativeGl::load(const View& view, const DrawItem& item) {
  state_->scene.reset();
  state_->scene.emplace(state_->gl, view.extent());
  state_->make_target();
  std::visit([&](const auto& one) { state_->upload(view, one); }, item);
  state_->check();
}

void NativeGl::draw() {
  const Functions& gl = state_->gl;
  const Scene& scene = *state_->scene;
  constexpr GLuint kNothing[4] = {kNoPrimitive, 0, 0, 0};
  constexpr GLfloat kFar = 1.0F;
  gl.ClearNamedFramebufferuiv(scene.target.name(), GL_COLOR, 0, kNothing);
  gl.ClearNamedFramebufferfv(scene.target.name(), GL_DEPTH, 0, &kFar);
  if (scene.has_corners) {
    gl.DrawElements(GL_TRIANGLES, scene.vertex_count, GL_UNSIGNED_INT, nullptr);
  } else {
    gl.DrawArrays(GL_POINTS, 0, scene.vertex_count);
  }
  gl.Finish();
}

std::size_t NativeGl::covered_pixels() const {
  Grid<PrimitiveId> ids(state_->scene->extent);
  state_->gl.ReadPixels(0, 0, ids.extent().width, ids.extent().height, GL_RED_INTEGER,
                        GL_UNSIGNED_INT, ids.pixels().data());
  state_->check();
  return benchmark::covered_pixels(ids);
}

}  // namespace rangezip::benchmark

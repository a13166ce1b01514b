#pragma once

#include <functional>
#include <memory>
#include <string>

#include "raster_gl/gl_context.h"

namespace rangezip {

/// How an application makes contexts current: two functions of its window library, which must not
/// throw. A context is whatever pointer that library knows it by.
struct ContextSwitch {
  std::function<void*()> current;           ///< the one current on the calling thread; null: none
  std::function<void(void*)> make_current;  ///< on the calling thread; null: none
};

/// A context that belongs to an application: its window's, or one made beside that.
struct BorrowedContext {
  std::string name = "window";  ///< for info() and messages
  void* context = nullptr;
  ContextSwitch contexts;
  /// The entry point of an OpenGL function, called while the context is current; or null.
  std::function<GlContext::Function(const char*)> function;
};

/// Lends a context to a GlRasterizer, which it must outlive. With GLFW:
///
///   borrow_context({.context = window,
///                   .contexts = {.current = glfwGetCurrentContext,
///                                .make_current = [](void* context) {
///                                  glfwMakeContextCurrent(static_cast<GLFWwindow*>(context));
///                                }},
///                   .function = glfwGetProcAddress});
///
/// During a call the context is current; after it what the application had current before is so
/// again: this context, another, or none. It is released and made current anew in any case, since
/// some drivers let contexts of other kinds (OSMesa's) take its place unnoticed.
///
/// Drawing changes OpenGL's state (program, framebuffer, vertex array, viewport, storage buffers,
/// debug callback), which an application that draws in the same context sets for itself again. The
/// strategy `compute` relies on no state but how pixels are unpacked (glPixelStore: no skips, no
/// swapped bytes); the others draw rightly only where what they do not set is as in a new context.
/// A context made for the rasterizer alone has neither worry.
/// @throws InvalidArgument if the context or a function is missing. Drawing throws BackendError if
///     the context cannot be made current, as while it is current on another thread.
[[nodiscard]] std::unique_ptr<GlContext> borrow_context(BorrowedContext borrowed);

/// A context of another kind, such as OSMesa's, for threads on which the application may have one
/// of its own current: that is set aside during a call, and current again after it. Without this
/// the application has to release its own before it draws with such a context.
/// @throws InvalidArgument if the context or a function is missing.
[[nodiscard]] std::unique_ptr<GlContext> beside_application(std::unique_ptr<GlContext> context,
                                                            ContextSwitch contexts);

}  // namespace rangezip

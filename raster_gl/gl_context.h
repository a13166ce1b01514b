#pragma once

#include <string>

namespace rangezip {

/// An OpenGL context, wherever it comes from: Mesa's software renderer, a GPU without a display,
/// a window of the viewer. Used through a CurrentContext only.
class GlContext {
 public:
  using Function = void (*)();

  virtual ~GlContext() = default;
  GlContext(const GlContext&) = delete;
  GlContext& operator=(const GlContext&) = delete;

  /// Kind of the context, as users choose it: "osmesa".
  [[nodiscard]] virtual std::string name() const = 0;

  /// The entry point of an OpenGL function, or null. Some drivers give an address for any name:
  /// the version decides what may be called.
  [[nodiscard]] virtual Function function(const char* name) const = 0;

 protected:
  GlContext() = default;

 private:
  friend class CurrentContext;
  virtual void make_current() = 0;
  virtual void release() noexcept = 0;
};

/// Makes a context current on this thread for the life of this object, and then none. Contexts of
/// two kinds in one process may share what "current" means, and then the one that was left current
/// draws for the other without an error; so none is ever left current, but for what an application
/// had current itself (borrowed_context.h).
class CurrentContext {
 public:
  /// @throws BackendError if the context cannot be made current.
  explicit CurrentContext(GlContext& context) : context_(context) { context_.make_current(); }
  ~CurrentContext() { context_.release(); }
  CurrentContext(const CurrentContext&) = delete;
  CurrentContext& operator=(const CurrentContext&) = delete;

  [[nodiscard]] const GlContext& context() const noexcept { return context_; }

 private:
  GlContext& context_;
};

}  // namespace rangezip

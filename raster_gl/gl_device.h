#pragma once

#include <cstddef>
#include <memory>
#include <string>

#include "raster_gl/gl_functions.h"

namespace rangezip {

/// One OpenGL context with its functions and what its driver can do. Used while the context is
/// current; must be destroyed while it is, too.
class GlDevice {
 public:
  /// @throws BackendError if the driver lacks something that every strategy needs; the text names
  ///     it. docs/determinism.md lists what that is.
  explicit GlDevice(const CurrentContext& current);
  ~GlDevice();
  GlDevice(const GlDevice&) = delete;
  GlDevice& operator=(const GlDevice&) = delete;

  [[nodiscard]] const GlFunctions& gl() const noexcept { return gl_; }
  [[nodiscard]] const std::string& renderer() const noexcept { return renderer_; }
  [[nodiscard]] const std::string& version() const noexcept { return version_; }

  /// Bytes that a shader sees of one buffer at most.
  [[nodiscard]] std::size_t block_bytes() const noexcept { return block_bytes_; }
  /// Whether atomics on 64-bit integers are there: one pass a drawing instead of two.
  [[nodiscard]] bool has_atomic_int64() const noexcept { return has_atomic_int64_; }

  /// @param stage what was done last, for the text of the error: "drawing points"
  /// @throws BackendError if OpenGL reports an error, ran out of memory or lost the context. Says
  ///     what the driver's debug output told last.
  void check(const char* stage) const;

 private:
  struct DebugLog;

  GlFunctions gl_;
  std::unique_ptr<DebugLog> log_;
  std::string renderer_;
  std::string version_;
  std::size_t block_bytes_ = 0;
  bool has_atomic_int64_ = false;
};

}  // namespace rangezip

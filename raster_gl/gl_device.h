#pragma once

#include <cstddef>
#include <memory>
#include <span>
#include <string>

#include "raster_gl/gl_functions.h"
#include "raster_gl/gl_phase.h"
#include "raster_gl/read_back.h"

namespace rangezip {

/// One OpenGL context with its functions and what its driver can do. Used while the context is
/// current; must be destroyed while it is, too.
class GlDevice {
 public:
  /// @param observer of the phases; may be empty
  /// @throws BackendError if the driver lacks something that every strategy needs; the text names
  ///     it. docs/determinism.md lists what that is.
  GlDevice(const CurrentContext& current, GlPhaseObserver observer);
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

  /// Copies from `offset` bytes of a buffer on into `bytes`. Waits for the device.
  /// @throws BackendError as check()
  void read(GLuint buffer, std::size_t offset, std::span<std::byte> bytes) const;

  /// Tells the observer, if there is one, that a phase begins, once the one before is finished.
  /// @return the one before
  GlPhase enter(GlPhase phase) const;

 private:
  struct DebugLog;

  GlFunctions gl_;
  std::unique_ptr<DebugLog> log_;
  std::unique_ptr<ReadBack> read_back_;
  GlPhaseObserver observer_;
  mutable GlPhase phase_ = GlPhase::draw;  ///< of those that the observer was told
  std::string renderer_;
  std::string version_;
  std::size_t block_bytes_ = 0;
  bool has_atomic_int64_ = false;
};

/// A phase within another: until the end of this object.
class PhaseScope {
 public:
  PhaseScope(const GlDevice& device, GlPhase phase)
      : device_(device), before_(device.enter(phase)) {}
  ~PhaseScope() { device_.enter(before_); }
  PhaseScope(const PhaseScope&) = delete;
  PhaseScope& operator=(const PhaseScope&) = delete;

 private:
  const GlDevice& device_;
  GlPhase before_;
};

}  // namespace rangezip

#pragma once

#include <span>

#include "core/raster/framebuffer.h"
#include "raster_gl/compute_tools.h"
#include "raster_gl/image_part.h"

namespace rangezip {

/// The part of an image that kernels draw into: depths and IDs, or keys of both where 64-bit
/// atomics are there, and a band of depths (R12).
class ComputeTarget {
 public:
  explicit ComputeTarget(const ComputeTools& tools);

  /// Pixels that one part may have.
  [[nodiscard]] std::size_t most_pixels() const noexcept;

  /// Empties the part and makes it the one that is drawn.
  /// @param band of the whole image; null: all depths count
  void begin(const ImagePart& part, const DepthBand* band);

  /// What a fragment goes through: one pass, or two.
  [[nodiscard]] std::span<const DrawPass> passes() const noexcept;

  /// A kernel that draws here, with what it needs of the target.
  /// @param variant what else it is made for
  [[nodiscard]] const GlProgram& kernel(Kernel kernel, ShaderVariant variant) const;

  /// Copies the part into the image. @pre `out` has the image's extent
  void read(Framebuffer& out);

 private:
  void split_keys();

  const ComputeTools& tools_;
  ImagePart part_;
  bool has_band_ = false;
  GlBuffer depths_;
  GlBuffer winners_;
  GlBuffer lower_;
  GlBuffer upper_;
};

}  // namespace rangezip

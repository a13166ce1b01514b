#pragma once

#include <vector>

#include "core/raster/framebuffer.h"
#include "raster_gl/compute_tools.h"
#include "raster_gl/image_part.h"

namespace rangezip {

/// Where the corner (0, 0) of the image lies in the window, and what depths mean there.
enum class Projection : std::uint8_t {
  fixed,   ///< the viewport of shader_text.h, depths from 0 to 1
  native,  ///< OpenGL's defaults: the viewport is the image, depths from -1 to 1
};

/// A framebuffer object for the part of an image that the hardware draws: 32-bit integers for IDs,
/// 32-bit floats for depths, in which d / 2^24 is exact. Of equal depths the first drawn stays
/// (R9).
class HardwareTarget {
 public:
  HardwareTarget(const GlDevice& device, const Kernels& kernels);

  /// Empties the part and lets OpenGL draw there, until end().
  /// @param band of the whole image; null: all depths count
  void begin(const ImagePart& part, const DepthBand* band, Projection projection);
  void end() const;

  /// Draws with `program`: GL_POINTS or GL_TRIANGLES.
  /// @param indices of the vertices; null: they are counted from 0 on
  void draw(const GlProgram& program, GLenum primitives, std::size_t vertices,
            const GlBuffer* indices = nullptr) const;

  /// Copies the part into the image. @pre `out` has the image's extent
  void read(Framebuffer& out);

 private:
  void resize(const ImagePart& part);

  const GlDevice& device_;
  const Kernels& kernels_;
  ImagePart part_;
  Extent allocated_;
  GlObject ids_;
  GlObject depths_;
  GlObject target_;
  GlObject vertices_;  ///< without attributes
  GlBuffer lower_;
  GlBuffer upper_;
  std::vector<float> read_depths_;
};

}  // namespace rangezip

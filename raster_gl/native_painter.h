#pragma once

#include <cstdint>
#include <map>
#include <span>
#include <utility>

#include "core/raster/rasterizer.h"
#include "raster_gl/compute_tools.h"
#include "raster_gl/hardware_target.h"

namespace rangezip {

/// Draws scenes as any program of OpenGL would: a matrix in floats, OpenGL's own clipping, coverage
/// and depths. Close to the rules, not equal to them, and not the same on every driver: for
/// comparisons only. What is dropped is not counted.
class NativePainter {
 public:
  explicit NativePainter(const ComputeTools& tools);

  /// @param band null: all depths count
  /// @throws BackendError if the device fails, or for more than the 8 clip planes of OpenGL
  DrawReport draw(const View& view, std::span<const DrawItem> items, const DepthBand* band,
                  Framebuffer& out);

 private:
  void draw_points(const DrawPoints& points, const glm::mat4& clip_from_item);
  void draw_triangles(const DrawTriangles& item, const glm::mat4& clip_from_item);
  void load(const DrawTriangles& item);
  const GlProgram& program(bool of_points, const glm::mat4& clip_from_item);

  const ComputeTools& tools_;
  HardwareTarget target_;
  GlBuffer planes_;
  GlBuffer positions_;
  GlBuffer corners_;
  std::uint64_t loaded_key_ = 0;  ///< of the item whose positions and corners those are, or 0
  std::size_t clip_planes_ = 0;
  bool has_band_ = false;
  std::map<std::pair<bool, ShaderVariant>, GlProgram> programs_;  ///< of points, of triangles
};

}  // namespace rangezip

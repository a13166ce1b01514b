#pragma once

#include <array>
#include <cstdint>
#include <span>
#include <vector>

#include "core/raster/draw_item.h"
#include "core/raster/split_triangle.h"
#include "raster_gl/compute_target.h"
#include "raster_gl/compute_tools.h"

namespace rangezip {

/// Draws triangles by kernels (R6-R8). Corners are snapped once; small triangles take one
/// invocation each, large ones are listed tile by tile first. Triangles with a rejected corner come
/// back to the host, which cuts them by split_triangle(), and their pieces are drawn with the
/// others.
class ComputeTriangles {
 public:
  ComputeTriangles(const ComputeTools& tools, ComputeTarget& target);

  /// Draws an item, the highest IDs first (ComputePainter says why).
  /// @return triangles that were dropped: with a corner that is not finite
  /// @throws BackendError if the device fails
  std::size_t draw(const DrawTriangles& item, const RowTransform& rows);

 private:
  /// Triangles whose corners are snapped, ready to be drawn.
  struct Batch {
    const GlBuffer& snapped;
    const GlBuffer& corners;
    const GlBuffer* ids;  ///< null: they count from first_id
    GlBuffer& tiles;
    Facing facing = Facing::both;
    std::size_t first = 0;  ///< in `corners`
    std::size_t count = 0;
    PrimitiveId first_id = 0;
    std::size_t tile_count = 0;
  };
  /// Triangles on the host, and their corners on the device.
  struct Source {
    const DrawTriangles& item;
    const RowTransform& rows;
    const GlBuffer& corners;
    std::size_t first = 0;  ///< of the item's triangles in `corners`
  };

  std::size_t draw_gathered(const DrawTriangles& item, const RowTransform& rows);
  std::size_t draw_range(const Source& source, std::size_t begin, std::size_t end);
  [[nodiscard]] std::size_t cut(const Source& source, std::size_t begin, std::size_t rejected);
  [[nodiscard]] bool list_tiles(Batch& batch, std::size_t& rejected);
  void bind(const GlProgram& program, const Batch& batch) const;
  void plot(const Batch& batch, DrawPass pass) const;

  const ComputeTools& tools_;
  ComputeTarget& target_;
  SnapRows rows_;
  KernelCounters counters_;
  GlBuffer snapped_;
  GlBuffer rejected_;
  GlBuffer tiles_;
  GlBuffer piece_snapped_;
  GlBuffer piece_corners_;
  GlBuffer piece_ids_;
  GlBuffer piece_tiles_;
  std::vector<SnappedTriangle> pieces_;
  std::vector<PrimitiveId> ids_of_pieces_;
};

}  // namespace rangezip

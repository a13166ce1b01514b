#include "core/mask/correspondence.h"

#include <algorithm>
#include <utility>

#include "core/base/check_number.h"
#include "core/base/error.h"
#include "core/base/parallel.h"
#include "core/image/depth_units.h"
#include "core/mask/nearest_faces.h"
#include "core/mesh/drawable.h"

namespace rangezip {

namespace {

/// The band of `half_width` pixel sides, stretched on slopes, around the samples.
DepthBand band_around(const RangeImage& image, const SlopeImage& slopes, double half_width) {
  DepthBand band = empty_band(image.extent());
  for_each_row(image.extent().height, [&](int y) {
    for (Pixel p{0, y}; p.x < image.extent().width; ++p.x) {
      if (!image.has_sample(p)) continue;
      const double steepest = std::min(1.0, kMaxSlope / glm::length(slopes[p]));
      const double half = half_width * image.pixel_size(p) * stretch_of(slopes[p] * steepest);
      const DepthInterval interval = depth_interval(image.view(), image[p] - half, image[p] + half);
      band.lower[p] = interval.lower;
      band.upper[p] = interval.upper;
    }
  });
  return band;
}

Grid<PrimitiveId> faces_in_band(Rasterizer& rasterizer, const RangeImage& image,
                                const DrawTriangles& mesh, const DepthBand& band) {
  const DrawItem item = mesh;
  Framebuffer drawn;
  rasterizer.render_in_band(image.view(), {&item, 1}, band, drawn);
  return std::move(drawn.id);
}

Correspondence by_depth_band(Rasterizer& rasterizer, const RangeImage& image,
                             const SlopeImage& slopes, const TriangleMesh& mesh,
                             const CorrespondenceOptions& options, bool any_face) {
  const DrawableMesh drawable(mesh);
  Correspondence result;
  result.face = faces_in_band(rasterizer, image, drawable.item(Facing::front),
                              band_around(image, slopes, options.band));
  if (!any_face) result.face = search_nearest_faces(result.face, image, mesh, kNoSample);
  result.from_behind = Mask(image.extent(), 0);
  if (options.back_band > 0.0) {
    const Grid<PrimitiveId> back = faces_in_band(rasterizer, image, drawable.item(Facing::back),
                                                 band_around(image, slopes, options.back_band));
    std::transform(back.pixels().begin(), back.pixels().end(), result.from_behind.pixels().begin(),
                   [](PrimitiveId id) { return static_cast<std::uint8_t>(id != kNoPrimitive); });
  }
  return result;
}

Correspondence by_id_buffer(Rasterizer& rasterizer, const RangeImage& image,
                            const TriangleMesh& mesh, const CorrespondenceOptions& options) {
  const DrawableMesh drawable(mesh);
  const DrawItem item = drawable.item();
  Correspondence result{.face = rasterizer.render(image.view(), {&item, 1}).id,
                        .from_behind = Mask(image.extent(), 0)};
  result.face = search_nearest_faces(result.face, image, mesh, options.band);
  return result;
}

}  // namespace

Correspondence find_correspondence(Rasterizer& rasterizer, const RangeImage& image,
                                   const SlopeImage& slopes, const TriangleMesh& mesh,
                                   const CorrespondenceOptions& options, bool any_face) {
  if (slopes.extent() != image.extent()) {
    throw InvalidArgument("find_correspondence: image and slopes must have the same extent");
  }
  check_positive("find_correspondence: band", options.band);
  check_not_negative("find_correspondence: back_band", options.back_band);
  if (mesh.empty()) {
    return {.face = Grid<PrimitiveId>(image.extent(), kNoPrimitive),
            .from_behind = Mask(image.extent(), 0)};
  }
  if (options.method == CorrespondenceMethod::id_buffer) {
    return by_id_buffer(rasterizer, image, mesh, options);
  }
  return by_depth_band(rasterizer, image, slopes, mesh, options, any_face);
}

}  // namespace rangezip

#include "core/scan/scan.h"

#include <algorithm>
#include <utility>

#include "core/image/grid_cells.h"

namespace rangezip {

namespace {

std::size_t count_of(const Mask& mask) {
  return static_cast<std::size_t>(
      std::count_if(mask.pixels().begin(), mask.pixels().end(), [](auto m) { return m != 0; }));
}

/// Deactivates the pixels where `other` is not `value`.
void restrict_to(Mask& mask, const Mask& other, bool value) {
  for (std::size_t i = 0; i < mask.pixels().size(); ++i) {
    if ((other.pixels()[i] != 0) != value) mask.pixels()[i] = 0;
  }
}

/// Samples seen through gaps of the front and onto the back of the object go
/// [Kobbelt, Botsch 2000, 4.2].
void remove_wrong_samples(Scan& scan, const ScanRequest& request) {
  if (request.back_side) {
    BackSideResult front = remove_back_side(std::move(scan.image), *request.back_side);
    scan.image = std::move(front.image);
    scan.report.back_side = front.removed;
  }
  if (request.see_through) {
    SeeThroughResult front = remove_see_through(std::move(scan.image), *request.see_through);
    scan.image = std::move(front.image);
    scan.report.see_through = front.removed;
  }
}

/// The nearest samples become samples of the surface.
void improve_samples(Scan& scan, Rasterizer& rasterizer, std::span<const DrawItem> items,
                     const ScanRequest& request) {
  scan.slopes = estimate_slopes(scan.image);
  if (!request.plane_fit) return;
  PlaneFitResult fitted =
      fit_planes(rasterizer, items, scan.scene_buffer, scan.image, scan.slopes, *request.plane_fit);
  scan.image = std::move(fitted.image);
  scan.slopes = std::move(fitted.slopes);
  scan.report.inside = fitted.inside;
}

void fill_pixel_holes(Scan& scan, const ScanRequest& request) {
  scan.filled = Mask(scan.image.extent(), 0);
  if (!request.fill_holes) return;
  FillHolesResult filled = fill_holes(scan.image, *request.fill_holes);
  scan.image = std::move(filled.image);
  scan.filled = std::move(filled.filled);
  scan.report.filled = count_of(scan.filled);
  for (int y = 0; y < scan.image.extent().height; ++y) {
    for (Pixel p{0, y}; p.x < scan.image.extent().width; ++p.x) {
      if (scan.filled[p] != 0) scan.slopes[p] = estimate_slope(scan.image, p);
    }
  }
}

/// Pixels whose sample may become part of the mesh: in the region of interest, not steep, not the
/// inside of a known sheet.
Mask selectable_samples(const Scan& scan, const ScanRequest& request, ScanReport& report) {
  Mask selectable = sample_mask(scan.image);
  if (request.steep_cells) {
    const Mask steep = mark_steep_cells(scan.image, *request.steep_cells);
    report.steep = count_of(steep);
    restrict_to(selectable, steep, false);
  }
  if (!request.region.empty()) {
    restrict_to(selectable, mask_from_lasso(request.extent, request.region), true);
  }
  if (!request.places.empty()) {
    restrict_to(selectable, mask_of_places(scan.image, request.places), true);
  }
  restrict_to(selectable, scan.correspondence.from_behind, false);
  return selectable;
}

/// The paper's masking phase [Kobbelt, Botsch 2000, 4.3].
Mask choose_active_samples(const Scan& scan, const TriangleMesh& mesh, const ScanRequest& request,
                           ScanReport& report) {
  Mask limit = selectable_samples(scan, request, report);
  const Grid<double> quality =
      sample_quality(scan.image, scan.slopes, limit, request.smooth_quality,
                     grid_cell_options(request.triangulate));
  // A sample without a triangle cannot be taken, and must not keep the mask's border open.
  for (std::size_t i = 0; i < limit.pixels().size(); ++i) {
    if (quality.pixels()[i] == kNoSample) limit.pixels()[i] = 0;
  }
  Mask active = limit;
  if (request.unmatched_only) {
    active = keep_unmatched_samples(active, scan.correspondence);
  } else if (request.quality) {
    active = keep_better_samples(quality, scan.slopes, active, mesh, scan.correspondence,
                                 *request.quality);
  }
  return clean_mask(std::move(active), limit, request.clean_mask);
}

void smooth_samples(Scan& scan, const ScanRequest& request) {
  if (!request.median) return;
  scan.image = median_filter(scan.image, *request.median);
  if (!request.plane_fit) scan.slopes = estimate_slopes(scan.image);  // planes know theirs better
}

/// Each vertex keeps the number of the primitive that won its pixel.
void record_sources(const Scene& scene, Scan& scan) {
  scan.patch.mesh.sources.reserve(scan.patch.pixels.size());
  for (const Pixel p : scan.patch.pixels) {
    scan.patch.mesh.sources.push_back(
        {.primitive =
             scan.filled[p] != 0 ? kNoPrimitive : scene.number_of(scan.scene_buffer.id[p])});
  }
}

/// The faces of a decimated patch will be larger than what they stand for.
void record_sampling(Scan& scan, const ScanRequest& request) {
  const Grid<double> quality =
      sample_quality(scan.image, scan.slopes, scan.active, request.smooth_quality,
                     grid_cell_options(request.triangulate));
  for (std::size_t v = 0; v < scan.patch.pixels.size(); ++v)
    scan.patch.mesh.sources[v].sampling = static_cast<float>(quality[scan.patch.pixels[v]]);
}

}  // namespace

Scan scan(Rasterizer& rasterizer, const Scene& scene, const TriangleMesh& mesh,
          const ScanRequest& request, std::span<const std::int8_t> votes,
          const Progress& progress) {
  progress.at("scan", 0.0);
  const View view(request.camera, request.extent);
  const std::vector<DrawItem> items = scene.draw_items(request.point_size, votes);

  Scan result{.image = RangeImage(view)};
  rasterizer.render(view, items, result.scene_buffer);
  result.image = make_range_image(view, result.scene_buffer, items);
  remove_wrong_samples(result, request);
  improve_samples(result, rasterizer, items, request);
  progress.at("scan", 0.5);
  fill_pixel_holes(result, request);
  smooth_samples(result, request);

  result.correspondence = find_correspondence(rasterizer, result.image, result.slopes, mesh,
                                              request.correspondence, request.unmatched_only);
  progress.at("scan", 0.8);
  result.active = choose_active_samples(result, mesh, request, result.report);
  result.patch = triangulate(result.image, result.active, request.triangulate);
  record_sources(scene, result);
  if (request.decimate) {
    record_sampling(result, request);
    result.decimate = request.decimate;
    result.whole_patch = result.patch;
    result.patch = decimate(result.image, std::move(result.patch), *request.decimate);
  }

  result.report.samples = count_of(sample_mask(result.image));
  result.report.matched = static_cast<std::size_t>(std::count_if(
      result.correspondence.face.pixels().begin(), result.correspondence.face.pixels().end(),
      [](PrimitiveId face) { return face != kNoPrimitive; }));
  result.report.active = count_of(result.active);
  result.report.patch_faces = result.patch.mesh.triangles.size();
  progress.at("scan", 1.0);
  return result;
}

}  // namespace rangezip

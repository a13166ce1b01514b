#include "core/finish/grow_over.h"

#include <vector>

#include "core/finish/advance_front.h"
#include "core/mesh/coverage.h"

namespace rangezip {
namespace {

constexpr double kApartAgain = 0.3;  ///< in h, of points where the front has stopped

}  // namespace

std::size_t grow_over(TriangleMesh& mesh, std::span<const Vec3> points,
                      const GrowOverOptions& options, const Progress& progress) {
  const double h = options.pixel_size;
  std::vector<AdvanceFrontOptions> passes{{.pixel_size = h},
                                          {.pixel_size = h, .apart = kApartAgain}};
  if (options.start) {
    passes.insert(
        passes.begin(),
        {.pixel_size = h, .apart = options.start->apart, .max_radius = options.start->max_radius});
  }
  std::vector<Vec3> missing(points.begin(), points.end());
  std::size_t count = 0;
  for (const AdvanceFrontOptions& pass : passes) {
    missing = points_off(missing, mesh, options.off_mesh);
    count += advance_front(mesh, missing, pass, progress);
  }
  if (options.void_radius > 0.0)
    count +=
        close_fronts(mesh, points, {.pixel_size = h, .max_radius = options.void_radius}, progress);
  return count;
}

}  // namespace rangezip

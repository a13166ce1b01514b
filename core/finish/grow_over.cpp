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
  const AdvanceFrontOptions common{.pixel_size = h, .votes = options.votes};
  std::vector<AdvanceFrontOptions> passes(2, common);
  passes[1].apart = kApartAgain;
  if (options.start) {
    passes.insert(passes.begin(), common);
    passes[0].apart = options.start->apart;
    passes[0].max_radius = options.start->max_radius;
  }
  std::vector<Vec3> missing(points.begin(), points.end());
  std::size_t count = 0;
  for (const AdvanceFrontOptions& pass : passes) {
    missing = points_off(missing, mesh, options.off_mesh);
    count += advance_front(mesh, missing, pass, progress);
  }
  if (options.void_radius > 0.0) {
    AdvanceFrontOptions closing = common;
    closing.max_radius = options.void_radius;
    count += close_fronts(mesh, points, closing, progress);
  }
  return count;
}

}  // namespace rangezip

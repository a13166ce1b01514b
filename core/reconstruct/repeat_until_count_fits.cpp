#include "core/reconstruct/repeat_until_count_fits.h"

#include <cmath>
#include <limits>
#include <utility>
#include <vector>

#include "core/base/progress_part.h"
#include "core/reconstruct/excess_search.h"

namespace rangezip {
namespace {

constexpr double kTolerance = 0.025;  ///< of the triangles asked for
constexpr int kRounds = 8;

}  // namespace

ReconstructResult repeat_until_count_fits(const RunForExcess& run, std::size_t triangles,
                                          const Progress& progress) {
  ReconstructResult nearest;
  double least_off = std::numeric_limits<double>::infinity();
  std::vector<StageTime> stages;
  ExcessSearch search;
  double pixel_size = 0.0;  // of the round before
  double begin = 0.0;
  for (int round = 1; round <= kRounds && least_off > kTolerance; ++round) {
    const double end = round == kRounds ? 1.0 : 0.5 * (1.0 + begin);
    const Progress part = part_of(progress, begin, end);
    begin = end;
    ReconstructResult result = run(search.excess(), part);
    stages.insert(stages.end(), result.report.stages.begin(), result.report.stages.end());
    const double ratio =
        static_cast<double>(result.mesh.triangles.size()) / static_cast<double>(triangles);
    const bool is_last = ratio == 0.0 || result.report.pixel_size == pixel_size;
    pixel_size = result.report.pixel_size;
    if (std::abs(ratio - 1.0) < least_off) {
      least_off = std::abs(ratio - 1.0);
      nearest = std::move(result);
    }
    if (is_last) break;
    search.go_on_from(ratio);
  }
  nearest.report.stages = std::move(stages);
  return nearest;
}

}  // namespace rangezip

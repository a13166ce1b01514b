#include "core/finish/separate.h"

#include "core/finish/repair.h"
#include "core/finish/untangle.h"

namespace rangezip {

std::vector<std::uint32_t> faces_of_pairs(
    const std::vector<std::pair<std::uint32_t, std::uint32_t>>& pairs) {
  std::vector<std::uint32_t> faces;
  for (const auto& [i, j] : pairs) {
    faces.push_back(i);
    faces.push_back(j);
  }
  return faces;
}

bool separate(TriangleMesh& mesh, std::span<const std::uint32_t> changed, const PointGrid& cloud,
              const FinishOptions& options, FinishReport& report, const Progress& progress) {
  const UntangleReport untangled = untangle(mesh, changed, progress);
  report.untangled_pairs += untangled.crossed;
  if (untangled.left.empty()) return false;
  repair(mesh, untangled.left, SettledLoops(mesh), cloud, options, report, progress);
  return true;
}

}  // namespace rangezip

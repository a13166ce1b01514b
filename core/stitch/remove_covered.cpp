#include "core/stitch/remove_covered.h"

#include <algorithm>
#include <array>
#include <cmath>

namespace rangezip {

namespace {

/// Places in a face by the weights of its corners: the centroid, then just inside of the corners
/// and of the middles of the sides. A face beyond the patch's boundary has none of them under the
/// patch if that boundary was inserted.
constexpr std::array<std::array<double, 3>, 7> kPlaces{{{1.0 / 3.0, 1.0 / 3.0, 1.0 / 3.0},
                                                        {0.98, 0.01, 0.01},
                                                        {0.01, 0.98, 0.01},
                                                        {0.01, 0.01, 0.98},
                                                        {0.50, 0.49, 0.01},
                                                        {0.01, 0.50, 0.49},
                                                        {0.49, 0.01, 0.50}}};

/// Old and new surface may differ by this much more than the band: both have errors.
constexpr double kDepthShare = 1.5;

bool is_covered(const SheetMesh& sheet, SheetMesh::FaceHandle face, const PatchSheet& patch,
                double band) {
  const auto corners = sheet.corners(face);
  return std::any_of(kPlaces.begin(), kPlaces.end(), [&](const std::array<double, 3>& weights) {
    Vec2 place{0.0, 0.0};
    double depth = 0.0;
    for (std::size_t k = 0; k < 3; ++k) {
      place += weights[k] * in_pixels(sheet.point(corners[k]));
      depth += weights[k] * sheet.depth(corners[k]);
    }
    const Pixel cell{static_cast<int>(std::floor(place.x)), static_cast<int>(std::floor(place.y))};
    return patch.covers(place) && patch.is_in_band(cell, depth, kDepthShare * band);
  });
}

}  // namespace

std::size_t remove_covered_faces(SheetMesh& sheet, const PatchSheet& patch, double band) {
  std::vector<SheetMesh::FaceHandle> covered;
  for (const auto face : sheet.mesh.faces()) {
    if (sheet.area(face) > 0 && is_covered(sheet, face, patch, band)) covered.push_back(face);
  }
  for (const auto face : covered) {
    constexpr bool kDeleteLonelyVertices = false;  // the whole mesh drops unused ones
    sheet.mesh.delete_face(face, kDeleteLonelyVertices);
  }
  return covered.size();
}

}  // namespace rangezip

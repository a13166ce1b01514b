#include "core/finish/flagged_pieces.h"

#include <algorithm>
#include <catch2/catch.hpp>
#include <cmath>
#include <cstdint>
#include <vector>

#include "tests/support/shapes.h"

namespace rangezip {
namespace {

TEST_CASE("pieces of flagged faces have the area and the rim of what hangs together", "[finish]") {
  const TriangleMesh sheet = shapes::square_sheet(12);
  const Vec3 small(-4.0, 0.0, 0.0), large(3.0, 0.0, 0.0);
  std::vector<std::uint8_t> flags;
  for (const Triangle& t : sheet.triangles) {
    const Vec3 center = centroid_of(sheet.positions, t);
    const auto within = [&](const Vec3& middle, double half) {
      const Vec3 offset = glm::abs(center - middle);
      return std::max(offset.x, offset.y) < half;
    };
    flags.push_back(within(small, 1.0) || within(large, 2.0) ? 1 : 0);
  }
  std::vector<FlaggedPiece> seen;
  keep_pieces(sheet, flags, [&](const FlaggedPiece& piece) {
    seen.push_back(piece);
    return piece.rim > 10.0;
  });
  for (const FlaggedPiece& piece : seen)  // squares: asked of each face
    CHECK(piece.rim == Approx(4.0 * std::sqrt(piece.area)));
  double area = 0.0;
  for (std::size_t f = 0; f < flags.size(); ++f) {
    if (flags[f] == 0) continue;
    area += area_of_face(sheet.positions, sheet.triangles[f]);
    CHECK(centroid_of(sheet.positions, sheet.triangles[f]).x > 0.0);
  }
  CHECK(area == Approx(16.0));
}

}  // namespace
}  // namespace rangezip

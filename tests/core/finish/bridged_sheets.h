#pragma once

#include <cstdint>
#include <random>
#include <utility>
#include <vector>

#include "core/mesh/triangle_mesh.h"
#include "tests/core/finish/shapes.h"
#include "tests/support/shapes.h"

namespace rangezip::testing {

struct BridgedSheets {
  TriangleMesh mesh;         ///< the last two faces are the bridge
  std::vector<Vec3> points;  ///< of the sheets, at random
};

/// Two sheets of 10 x 10 squares with a side of 1 that face each other, and a bridge of two faces
/// from an edge of the lower one's border to the same one above.
/// @param density points a square
inline BridgedSheets bridged_sheets(double gap, int density, std::mt19937_64& engine) {
  constexpr std::uint32_t kSquares = 10;
  BridgedSheets sheets;
  for (const double z : {0.0, gap}) {
    TriangleMesh sheet = shapes::square_sheet(kSquares);
    for (Vec3& p : sheet.positions)
      p.z = z;
    if (z > 0.0) {
      for (Triangle& t : sheet.triangles)
        std::swap(t[1], t[2]);
    }
    append(sheets.mesh, sheet);
    for (int i = 0; i < static_cast<int>(kSquares * kSquares) * density; ++i)
      sheets.points.push_back({uniform(engine, -5.0, 5.0), uniform(engine, -5.0, 5.0), z});
  }
  constexpr std::uint32_t a = 5, b = 6, above = (kSquares + 1) * (kSquares + 1);
  sheets.mesh.triangles.push_back({a, b, b + above});
  sheets.mesh.triangles.push_back({a, b + above, a + above});
  return sheets;
}

}  // namespace rangezip::testing

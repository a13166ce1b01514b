#include "core/stitch/face_changes.h"

#include <algorithm>

#include "core/mesh/edge_map.h"

namespace rangezip {

namespace {

/// The face from its lowest corner on.
Triangle from_lowest(const Triangle& face) {
  Triangle result = face;
  std::rotate(result.begin(), std::min_element(result.begin(), result.end()), result.end());
  return result;
}

}  // namespace

FaceChanges find_face_changes(const TriangleMesh& before, const TriangleMesh& after) {
  // A directed edge has one face, so the one from the lowest corner names it.
  EdgeMap faces(before.triangles.size());
  for (std::uint32_t f = 0; f < before.triangles.size(); ++f) {
    const Triangle face = from_lowest(before.triangles[f]);
    faces.insert(face[0], face[1], f);
  }
  const auto stayed = [&](std::uint32_t v) {
    return v < before.positions.size() && before.positions[v] == after.positions[v];
  };
  FaceChanges changes;
  std::vector<std::uint8_t> is_left(before.triangles.size(), 0);
  for (std::uint32_t f = 0; f < after.triangles.size(); ++f) {
    const Triangle face = from_lowest(after.triangles[f]);
    const std::uint32_t old = faces.find(face[0], face[1]);
    const bool is_same = old != EdgeMap::kNone && from_lowest(before.triangles[old]) == face &&
                         std::all_of(face.begin(), face.end(), stayed);
    if (is_same) {
      is_left[old] = 1;
    } else {
      changes.made.push_back(f);
    }
  }
  for (std::uint32_t f = 0; f < is_left.size(); ++f) {
    if (is_left[f] == 0) changes.gone.push_back(f);
  }
  return changes;
}

}  // namespace rangezip

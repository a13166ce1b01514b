#include "core/finish/gap_memo.h"

#include <algorithm>

#include "core/mesh/cell_grid.h"
#include "core/mesh/face_changes.h"

namespace rangezip {
namespace {

/// In reaches: a point that counts is one from its edge at most, and a face that is in its way less
/// than one from it.
constexpr double kFarthest = 2.0;

std::vector<Box> boxes_of(const TriangleMesh& mesh, const std::vector<std::uint32_t>& faces,
                          double margin) {
  std::vector<Box> boxes;
  for (const std::uint32_t f : faces) {
    const Box box = box_of(mesh, mesh.triangles[f]);
    boxes.push_back({box.lower - margin, box.upper + margin});
  }
  return boxes;
}

/// The cubes around changed faces.
class ChangedRegion {
 public:
  ChangedRegion(const TriangleMesh& before, const TriangleMesh& mesh, double reach)
      : changes_(find_face_changes(before, mesh)),
        gone_(boxes_of(before, changes_.gone, kFarthest * reach)),
        made_(boxes_of(mesh, changes_.made, kFarthest * reach)),
        grid_(bounds(mesh), kFarthest * reach, kCellsPerFace * mesh.triangles.size()),
        is_changed_(grid_.cell_count(), 0) {
    for (const auto* boxes : {&gone_, &made_}) {
      for (const Box& box : *boxes) {
        grid_.for_each_cell(grid_.range_of(box), 0, grid_.layers() - 1,
                            [&](std::size_t cell) { is_changed_[cell] = 1; });
      }
    }
  }

  [[nodiscard]] bool may_meet(const Box& box) const {
    std::uint8_t found = 0;
    grid_.for_each_cell(grid_.range_of(box), 0, grid_.layers() - 1,
                        [&](std::size_t cell) { found |= is_changed_[cell]; });
    return found != 0;
  }

 private:
  static constexpr std::size_t kCellsPerFace = 8;

  [[nodiscard]] Box bounds(const TriangleMesh& mesh) const {
    Box bounds = bounds_of(mesh);
    for (const Box& box : gone_)
      bounds.add(box);
    for (const Box& box : made_)
      bounds.add(box);
    return bounds;
  }

  FaceChanges changes_;
  std::vector<Box> gone_, made_;
  CellGrid grid_;
  std::vector<std::uint8_t> is_changed_;
};

}  // namespace

std::vector<BorderGap> GapMemo::find(const TriangleMesh& mesh, const CornerTable& table,
                                     const FaceGrid& faces) {
  const ChangedRegion changed(before_, mesh, options_.reach);
  known_.resize(mesh.positions.size());
  std::vector<BorderGap> gaps;
  std::vector<std::uint32_t> asked;
  for (std::uint32_t c = 0; c < table.corner_count(); ++c) {
    if (table.is_deleted(c / 3) || table.across(c) != CornerTable::kNone) continue;
    const Vec3& a = mesh.positions[table.vertex(c)];
    const Vec3& b = mesh.positions[table.head(c)];
    Known& known = known_[table.vertex(c)];
    if (known.head != table.head(c) || changed.may_meet({glm::min(a, b), glm::max(a, b)})) {
      known = {table.head(c), std::nullopt};
      asked.push_back(c);
    } else if (known.gap) {
      known.gap->corner = c;  // faces may have got new numbers
      gaps.push_back(*known.gap);
    }
  }
  looked_at_ = asked.size();
  for (const BorderGap& gap : find_border_gaps(mesh, table, faces, cloud_, asked, options_)) {
    known_[table.vertex(gap.corner)].gap = gap;
    gaps.push_back(gap);
  }
  std::sort(gaps.begin(), gaps.end(),
            [](const BorderGap& p, const BorderGap& q) { return p.corner < q.corner; });
  before_ = geometry_of(mesh);
  return gaps;
}

}  // namespace rangezip

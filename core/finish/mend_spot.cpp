#include "core/finish/mend_spot.h"

#include <algorithm>

#include "core/finish/border_gaps.h"
#include "core/mesh/self_intersection.h"

namespace rangezip {
namespace {

constexpr double kReach = 1.0;  ///< in h, of points beyond the border, as in extend_border.h
constexpr std::uint32_t kNone = CornerTable::kNone;

}  // namespace

Box box_around(const TriangleMesh& mesh, const CornerTable& table,
               std::span<const std::uint32_t> faces, double h) {
  Box box;
  for (const std::uint32_t f : faces) {
    for (const std::uint32_t v : mesh.triangles[f])
      table.for_each_neighbor(v, [&](std::uint32_t w) { box.add(mesh.positions[w]); });
  }
  return widened(box, kMendReach * h);
}

MendSpot::MendSpot(const TriangleMesh& mesh, const CornerTable& table, const BoxCubes& cubes,
                   std::span<const std::uint32_t> gone, const PointGrid& cloud, double h,
                   double beyond)
    : part_(mesh, cubes.near(box_around(mesh, table, gone, h))),
      cloud_(cloud),
      h_(h),
      table_(part_.mesh.triangles, part_.mesh.positions.size()),
      faces_(part_.mesh, table_, kReach * h),
      is_changed_(part_.mesh.positions.size(), 0) {
  for (const std::uint32_t f : gone) {
    for (const std::uint32_t v : mesh.triangles[f])
      is_changed_[part_.vertex(v)] = 1;
  }
  for (const Triangle& t : part_.mesh.triangles) {
    if (has_flag(is_changed_, t)) near_change_.add(box_of(part_.mesh, t));
  }
  near_change_ = widened(near_change_, 2.0 * kReach * h);
  for (std::uint32_t v = 0; v < is_changed_.size(); ++v)
    is_at_border_ = is_at_border_ || (is_changed_[v] != 0 && table_.is_boundary(v));
  beyond_ = is_at_border_ ? std::max(beyond, farthest_beyond(part_.mesh, table_, faces_)) : 0.0;
}

bool MendSpot::allows(const AngleMend& mend) const {
  const Mended mended = apply(mend);
  if (!self_intersections(mended.mesh, mended.changed).empty()) return false;
  if (!is_at_border_) return true;
  const CornerTable table(mended.mesh.triangles, mended.mesh.positions.size());
  const FaceGrid faces(mended.mesh, table, kReach * h_);
  return farthest_beyond(mended.mesh, table, faces) <= beyond_;
}

MendSpot::Mended MendSpot::apply(const AngleMend& mend) const {
  Mended mended{part_.mesh, {}};
  std::vector<std::uint8_t> goes(part_.faces.size(), 0);
  for (const std::uint32_t f : mend.gone)
    goes[part_.face(f)] = 1;
  auto& triangles = mended.mesh.triangles;
  remove_triangles(triangles, goes);
  for (const Triangle& t : mend.faces) {
    mended.changed.push_back(static_cast<std::uint32_t>(triangles.size()));
    triangles.push_back(part_.triangle(t));
  }
  if (mend.vertex != kNone) mended.mesh.positions[part_.vertex(mend.vertex)] = mend.place;
  return mended;
}

/// Of points beyond border edges at what changes, or that lay there before.
double MendSpot::farthest_beyond(const TriangleMesh& mesh, const CornerTable& table,
                                 const FaceGrid& faces) const {
  double farthest = 0.0;
  for (const BorderGap& gap : find_border_gaps(mesh, table, faces, cloud_, border(mesh, table),
                                               {kReach * h_, kNegligibleBeyond * h_})) {
    if (has_flag(is_changed_, table.triangle(gap.corner / 3)) || was_at_change(gap.point))
      farthest = std::max(farthest, gap.beyond);
  }
  return farthest;
}

/// The border edges beyond which such points may be: most of the others are where the
/// surroundings were cut out.
std::vector<std::uint32_t> MendSpot::border(const TriangleMesh& mesh,
                                            const CornerTable& table) const {
  std::vector<std::uint32_t> corners;
  for (std::uint32_t c = 0; c < table.corner_count(); ++c) {
    if (table.across(c) != kNone) continue;
    const Triangle face = table.triangle(c / 3);
    if (has_flag(is_changed_, face) || boxes_meet(near_change_, box_of(mesh, face)))
      corners.push_back(c);
  }
  return corners;
}

bool MendSpot::was_at_change(const Vec3& point) const {
  const std::uint32_t face = faces_.nearest_face(point, kReach * h_);
  return face != kNone && has_flag(is_changed_, table_.triangle(face));
}

}  // namespace rangezip

#include "core/finish/orient_pieces.h"

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <map>
#include <numeric>
#include <queue>
#include <span>
#include <utility>
#include <vector>

#include "core/finish/boundary_loops.h"
#include "core/finish/clean_topology.h"
#include "core/finish/components.h"
#include "core/finish/corner_table.h"
#include "core/finish/loop_neighbors.h"
#include "core/finish/places_near.h"
#include "core/finish/point_grid.h"
#include "core/finish/vertex_geometry.h"

namespace rangezip {
namespace {

/// In h: how far apart boundaries are compared.
constexpr double kMaxGap = 3.0;
/// Cosines: of two faces that lie in one surface, or of the ways in which two boundaries end.
constexpr double kAlike = 0.5;
/// Between two faces: what hangs together by such edges only are two pieces. The one may be the
/// inside of what the other is the outside of, where a seam has caught an edge of it.
constexpr double kFold = -0.5;
/// Faces: fewer between folds are a crumpled place, and fewer by themselves a scrap, which stays.
constexpr std::size_t kMinPiece = 50;
/// Edges on each side of a place of a boundary that tell its directions.
constexpr std::size_t kBeside = 4;
/// In h: so much of what is turned goes where it continues the other: no seam has joined the two,
/// and noise lets them lie over each other.
constexpr double kOverlap = 1.0;
/// One in so many places of its boundary tells of a component; in fewer it may only touch others.
constexpr std::size_t kLeastMet = 8;
/// How far the way across may rise over the plane of a face: of its length, and in h.
constexpr double kMaxSlope = 0.5;
constexpr double kRoughness = 0.25;

/// A face at the boundary.
struct Rim {
  Vec3 place;
  Vec3 normal;
  Vec3 outward;  ///< in the plane of the face, across the boundary
};

/// At how many places a component comes near others.
struct Votes {
  std::size_t all = 0;
  std::size_t same = 0;      ///< it continues them, facing the same way
  std::size_t opposite = 0;  ///< it continues them, facing opposite ways

  /// A third is enough: boundaries are ragged, but hardly any place of one that needs no turn
  /// tells so.
  [[nodiscard]] bool tell_to_turn() const {
    return opposite > 0 && 3 * opposite >= all && opposite > 3 * same;
  }
  void add(const Votes& votes, bool is_turned) {
    all += votes.all;
    same += is_turned ? votes.opposite : votes.same;
    opposite += is_turned ? votes.same : votes.opposite;
  }
};

struct Meeting {
  std::uint32_t other = 0;  ///< component
  Votes votes;
};

/// A place where the boundaries of two components come near each other.
struct Contact {
  std::uint32_t component_a, component_b;
  Rim a, b;
  bool is_joint = false;  ///< one continues the other, whichever way their faces look
};

/// A mesh of which no two pieces share a vertex, where folds part pieces.
struct PartedMesh {
  TriangleMesh mesh;                     ///< faces, and so corners, keep their places
  std::vector<std::uint8_t> is_at_fold;  ///< of corners: whether their edge is a boundary by that
};

/// The large piece that each piece belongs to: large ones to themselves, small ones to the largest
/// that they lead to over the fewest others; kNone if to none.
std::vector<std::uint32_t> wholes_of(
    const std::vector<std::size_t>& sizes,
    const std::vector<std::pair<std::uint32_t, std::uint32_t>>& beside) {
  std::vector<std::uint32_t> whole(sizes.size(), CornerTable::kNone);
  for (std::uint32_t p = 0; p < whole.size(); ++p) {
    if (sizes[p] >= kMinPiece) whole[p] = p;
  }
  for (bool any = true; any;) {
    any = false;
    std::vector<std::uint32_t> next = whole;
    for (const auto& [p, q] : beside) {
      if (whole[p] != CornerTable::kNone || whole[q] == CornerTable::kNone) continue;
      if (next[p] == CornerTable::kNone || sizes[whole[q]] > sizes[next[p]]) next[p] = whole[q];
      any = true;
    }
    whole = std::move(next);
  }
  return whole;
}

/// The number of the piece of each face, parted by folds. Small ones belong to the largest that
/// they lead to.
std::vector<std::uint32_t> pieces_between_folds(const CornerTable& table,
                                                const std::vector<Vec3>& positions) {
  std::vector<std::uint32_t> piece = components_of(table, [&](std::uint32_t corner) {
    return has_cosine(face_area_vector(table, positions, corner / 3),
                      face_area_vector(table, positions, table.across(corner) / 3), kFold);
  });
  std::vector<std::pair<std::uint32_t, std::uint32_t>> beside;
  for (std::uint32_t c = 0; c < table.corner_count(); ++c) {
    const std::uint32_t across = table.across(c);
    if (across != CornerTable::kNone && piece[c / 3] != piece[across / 3])
      beside.emplace_back(piece[c / 3], piece[across / 3]);
  }
  const std::vector<std::uint32_t> whole = wholes_of(component_sizes(piece), beside);
  for (std::uint32_t& p : piece) {
    if (whole[p] != CornerTable::kNone) p = whole[p];
  }
  return piece;
}

PartedMesh parted_at_folds(const TriangleMesh& mesh) {
  const CornerTable table(mesh.triangles, mesh.positions.size());
  const std::vector<std::uint32_t> piece = pieces_between_folds(table, mesh.positions);
  PartedMesh result{{mesh.positions, mesh.triangles, {}}, {}};
  result.is_at_fold.assign(table.corner_count(), 0);
  for (std::uint32_t c = 0; c < table.corner_count(); ++c) {
    const std::uint32_t across = table.across(c);
    if (across != CornerTable::kNone && piece[c / 3] != piece[across / 3]) result.is_at_fold[c] = 1;
  }
  TriangleMesh& parted = result.mesh;
  std::vector<std::uint32_t> piece_of(mesh.positions.size(), CornerTable::kNone);
  std::map<std::pair<std::uint32_t, std::uint32_t>, std::uint32_t> copies;  // of a vertex, a piece
  for (std::size_t f = 0; f < piece.size(); ++f) {
    for (std::uint32_t& v : parted.triangles[f]) {
      if (piece_of[v] == CornerTable::kNone) piece_of[v] = piece[f];
      if (piece_of[v] == piece[f]) continue;
      const auto next = static_cast<std::uint32_t>(parted.positions.size());
      const auto [copy, is_new] = copies.try_emplace({v, piece[f]}, next);
      if (is_new) parted.positions.push_back(mesh.positions[v]);
      v = copy->second;
    }
  }
  return result;
}

class Orienter {
 public:
  Orienter(const PartedMesh& parted, double pixel_size)
      : positions_(parted.mesh.positions),
        is_at_fold_(parted.is_at_fold),
        h_(pixel_size),
        table_(parted.mesh.triangles, parted.mesh.positions.size()),
        loops_(boundary_loops(table_)),
        component_(components_of(table_)),
        sizes_(component_sizes(component_)) {
    if (sizes_.size() > 1) contacts_ = find_contacts();
  }

  /// Of each component, whether it is to be turned: from the largest on always the one that meets
  /// those that are decided at most places.
  [[nodiscard]] std::vector<std::uint8_t> turned() const {
    std::vector<std::uint8_t> is_turned(sizes_.size(), 0);
    if (sizes_.size() < 2) return is_turned;
    const std::vector<std::size_t> borders = border_lengths();
    const std::vector<std::vector<Meeting>> meetings = find_meetings();
    std::vector<std::uint8_t> is_decided(sizes_.size(), 0);
    std::vector<Votes> votes(sizes_.size());
    for (const std::uint32_t root : by_size()) {
      std::priority_queue<std::pair<std::size_t, std::uint32_t>> next;
      next.emplace(0, root);
      while (!next.empty()) {
        const std::uint32_t c = next.top().second;
        next.pop();
        if (is_decided[c] != 0) continue;
        is_decided[c] = 1;
        const bool is_told = sizes_[c] >= kMinPiece && kLeastMet * votes[c].all >= borders[c];
        is_turned[c] = is_told && votes[c].tell_to_turn() ? 1 : 0;
        for (const Meeting& meeting : meetings[c]) {
          const std::uint32_t other = meeting.other;
          if (is_decided[other] != 0) continue;
          votes[other].add(meeting.votes, is_turned[c] != 0);
          if (2 * votes[other].all >= borders[other]) next.emplace(votes[other].all, other);
        }
      }
    }
    return is_turned;
  }

  [[nodiscard]] std::uint32_t component_of(std::size_t face) const { return component_[face]; }

  /// The places on the boundaries of what stays at which something turned goes on from there.
  [[nodiscard]] std::vector<Vec3> joints(const std::vector<std::uint8_t>& is_turned) const {
    std::vector<Vec3> places;
    for (const Contact& contact : contacts_) {
      const bool is_a = is_turned[contact.component_a] != 0;
      if (contact.is_joint && is_a != (is_turned[contact.component_b] != 0))
        places.push_back(is_a ? contact.b.place : contact.a.place);
    }
    return places;
  }

 private:
  [[nodiscard]] std::uint32_t component_at(std::uint32_t loop) const {
    return component_[loops_[loop].corners[0] / 3];
  }
  [[nodiscard]] std::vector<std::uint32_t> by_size() const {
    std::vector<std::uint32_t> order(sizes_.size());
    std::iota(order.begin(), order.end(), 0U);
    std::stable_sort(order.begin(), order.end(),
                     [&](std::uint32_t a, std::uint32_t b) { return sizes_[a] > sizes_[b]; });
    return order;
  }
  [[nodiscard]] std::vector<std::size_t> border_lengths() const {
    std::vector<std::size_t> lengths(sizes_.size(), 0);
    for (std::uint32_t l = 0; l < loops_.size(); ++l) {
      const auto& corners = loops_[l].corners;
      lengths[component_at(l)] += static_cast<std::size_t>(std::count_if(
          corners.begin(), corners.end(), [&](std::uint32_t c) { return is_at_fold_[c] == 0; }));
    }
    return lengths;
  }
  /// At a fold the two sides always end the same way, or look as if they crossed.
  [[nodiscard]] bool is_at_fold(std::uint32_t loop, std::uint32_t place) const {
    return is_at_fold_[loops_[loop].corners[place]] != 0;
  }

  /// With the directions of some faces on both sides: a boundary has steps, as pixels have.
  [[nodiscard]] Rim rim_at(std::uint32_t loop, std::uint32_t place) const {
    const auto& corners = loops_[loop].corners;
    const std::size_t n = corners.size();
    Rim rim{positions_[table_.head(corners[place])], Vec3(0.0), Vec3(0.0)};
    for (std::size_t i = n * kBeside + place - kBeside; i < n * kBeside + place + kBeside; ++i) {
      const std::uint32_t corner = corners[i % n];
      const Vec3 &from = positions_[table_.vertex(corner)], &to = positions_[table_.head(corner)];
      const Vec3 area = area_vector(from, to, positions_[table_.apex(corner)]);
      rim.normal += area;
      rim.outward += glm::cross(to - from, unit_or_z(area));
    }
    rim.normal = unit_or_z(rim.normal);
    rim.outward = unit_or_z(rim.outward);
    return rim;
  }

  /// Whether one surface goes on from one to the other, whichever way their faces look.
  [[nodiscard]] bool do_continue(const Rim& a, const Rim& b) const {
    const Vec3 way = b.place - a.place;
    const double rise = kMaxSlope * glm::length(way) + kRoughness * h_;
    return glm::dot(a.outward, b.outward) <= -kAlike &&
           std::abs(glm::dot(a.normal, b.normal)) >= kAlike &&
           std::abs(glm::dot(way, a.normal)) <= rise && std::abs(glm::dot(way, b.normal)) <= rise;
  }

  [[nodiscard]] std::vector<Contact> find_contacts() const {
    std::vector<Contact> contacts;
    const auto are_wanted = [&](std::uint32_t a, std::uint32_t b) {
      return component_at(a) != component_at(b);
    };
    for (const LoopNeighbors& n :
         loop_neighbors(loops_, table_, positions_, kMaxGap * h_, are_wanted)) {
      if (is_at_fold(n.loop_a, n.place_a) || is_at_fold(n.loop_b, n.place_b)) continue;
      const Rim a = rim_at(n.loop_a, n.place_a), b = rim_at(n.loop_b, n.place_b);
      contacts.push_back({component_at(n.loop_a), component_at(n.loop_b), a, b, do_continue(a, b)});
    }
    return contacts;
  }
  /// Of each component with others.
  [[nodiscard]] std::vector<std::vector<Meeting>> find_meetings() const {
    std::map<std::pair<std::uint32_t, std::uint32_t>, Votes> pairs;
    for (const Contact& contact : contacts_) {
      Votes& votes = pairs[std::minmax(contact.component_a, contact.component_b)];
      ++votes.all;
      if (contact.is_joint)
        ++(glm::dot(contact.a.normal, contact.b.normal) > 0.0 ? votes.same : votes.opposite);
    }
    std::vector<std::vector<Meeting>> meetings(sizes_.size());
    for (const auto& [pair, votes] : pairs) {
      meetings[pair.first].push_back({pair.second, votes});
      meetings[pair.second].push_back({pair.first, votes});
    }
    return meetings;
  }

  const std::vector<Vec3>& positions_;
  const std::vector<std::uint8_t>& is_at_fold_;
  double h_;
  CornerTable table_;
  std::vector<BoundaryLoop> loops_;
  std::vector<std::uint32_t> component_;  ///< of each face
  std::vector<std::size_t> sizes_;        ///< faces of each component
  std::vector<Contact> contacts_;
};

/// Turns faces around. @param is_turned of faces
void turn(std::vector<Triangle>& triangles, const std::vector<std::uint8_t>& is_turned) {
  for (std::size_t f = 0; f < triangles.size(); ++f) {
    if (is_turned[f] != 0) std::swap(triangles[f][1], triangles[f][2]);
  }
}

/// Parts turned faces from what they continue, by a gap that fills close.
void open_joints(TriangleMesh& mesh, const std::vector<std::uint8_t>& is_turned,
                 std::span<const Vec3> joints, double pixel_size) {
  const double reach = kOverlap * pixel_size;
  Box box;
  for (const Vec3& p : joints)
    box.add(p);
  const PointGrid grid(joints, box, reach);
  remove_triangles(mesh.triangles, flags_of(mesh.triangles.size(), [&](std::size_t f) {
                     const Triangle& t = mesh.triangles[f];
                     return is_turned[f] != 0 && std::any_of(t.begin(), t.end(), [&](auto v) {
                              return grid.has_point_within(mesh.positions[v], reach);
                            });
                   }));
}

}  // namespace

std::size_t orient_pieces(TriangleMesh& mesh, double pixel_size) {
  const PartedMesh parted = parted_at_folds(mesh);
  const Orienter orienter(parted, pixel_size);
  const std::vector<std::uint8_t> is_turned = orienter.turned();
  const auto count = static_cast<std::size_t>(std::count(is_turned.begin(), is_turned.end(), 1));
  if (count == 0) return 0;
  const std::vector<std::uint8_t> is_turned_face =
      flags_of(mesh.triangles.size(),
               [&](std::size_t f) { return is_turned[orienter.component_of(f)] != 0; });
  turn(mesh.triangles, is_turned_face);
  open_joints(mesh, is_turned_face, orienter.joints(is_turned), pixel_size);
  clean_topology(mesh);  // at the folds by which turned pieces hung
  return count;
}

}  // namespace rangezip

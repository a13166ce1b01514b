#include "core/finish/clean_topology.h"

#include <algorithm>
#include <cstdint>
#include <vector>

#include "core/finish/corner_table.h"

namespace rangezip {
namespace {

bool repeats_corner(const Triangle& t) {
  return t[0] == t[1] || t[1] == t[2] || t[2] == t[0];
}

/// Marks faces with a directed edge that an earlier kept face has.
void mark_reused_edges(const TriangleMesh& mesh, std::vector<std::uint8_t>& dropped) {
  std::vector<std::uint32_t> starts(mesh.positions.size() + 1, 0);
  for (const Triangle& t : mesh.triangles) {
    for (const std::uint32_t v : t)
      ++starts[v + 1];
  }
  for (std::size_t v = 1; v < starts.size(); ++v)
    starts[v] += starts[v - 1];
  std::vector<std::uint32_t> heads(starts.back());  // of the edges that leave each vertex
  std::vector<std::uint32_t> ends(starts.begin(), starts.end() - 1);
  for (std::size_t f = 0; f < mesh.triangles.size(); ++f) {
    const Triangle& t = mesh.triangles[f];
    for (std::size_t i = 0; i < 3 && dropped[f] == 0; ++i) {
      const auto first = heads.begin() + starts[t[i]];
      const auto last = heads.begin() + ends[t[i]];
      if (std::find(first, last, t[(i + 1) % 3]) != last) dropped[f] = 1;
    }
    for (std::size_t i = 0; i < 3 && dropped[f] == 0; ++i)
      heads[ends[t[i]]++] = t[(i + 1) % 3];
  }
}

/// The faces around each vertex, as corners sorted by vertex.
class CornersOfVertices {
 public:
  explicit CornersOfVertices(const CornerTable& table) : starts_(table.vertex_count() + 1, 0) {
    const auto corners = static_cast<std::uint32_t>(table.corner_count());
    for (std::uint32_t c = 0; c < corners; ++c)
      ++starts_[table.vertex(c) + 1];
    for (std::size_t v = 1; v < starts_.size(); ++v)
      starts_[v] += starts_[v - 1];
    corners_.resize(corners);
    std::vector<std::uint32_t> place(starts_.begin(), starts_.end() - 1);
    for (std::uint32_t c = 0; c < corners; ++c)
      corners_[place[table.vertex(c)]++] = c;
  }
  [[nodiscard]] std::size_t count(std::uint32_t v) const { return starts_[v + 1] - starts_[v]; }
  [[nodiscard]] const std::uint32_t* begin(std::uint32_t v) const {
    return corners_.data() + starts_[v];
  }
  [[nodiscard]] const std::uint32_t* end(std::uint32_t v) const {
    return corners_.data() + starts_[v + 1];
  }

 private:
  std::vector<std::uint32_t> starts_;
  std::vector<std::uint32_t> corners_;
};

/// The corners of one fan, starting anywhere in it.
std::vector<std::uint32_t> fan_of(const CornerTable& table, std::uint32_t corner) {
  std::vector<std::uint32_t> fan{corner};
  std::uint32_t c = table.across(CornerTable::previous(corner));
  for (; c != CornerTable::kNone && c != corner; c = table.across(CornerTable::previous(c))) {
    fan.push_back(c);
  }
  if (c == corner) return fan;
  for (c = table.across(corner); c != CornerTable::kNone; c = table.across(c)) {
    c = CornerTable::next(c);
    fan.push_back(c);
  }
  return fan;
}

/// Marks all fans of a vertex but the largest.
void mark_smaller_fans(const CornerTable& table, const CornersOfVertices& around, std::uint32_t v,
                       std::vector<std::uint8_t>& dropped) {
  std::vector<std::uint32_t> seen, best;
  for (const std::uint32_t* c = around.begin(v); c != around.end(v); ++c) {
    if (std::find(seen.begin(), seen.end(), *c) != seen.end()) continue;
    const std::vector<std::uint32_t> fan = fan_of(table, *c);
    seen.insert(seen.end(), fan.begin(), fan.end());
    if (fan.size() > best.size()) best = fan;
  }
  for (const std::uint32_t c : seen) {
    if (std::find(best.begin(), best.end(), c) == best.end()) dropped[c / 3] = 1;
  }
}

/// @return whether any face was marked
bool mark_extra_fans(const TriangleMesh& mesh, std::vector<std::uint8_t>& dropped) {
  const CornerTable table(mesh.triangles, mesh.positions.size());
  std::vector<std::uint32_t> in_fan(mesh.positions.size(), 0), in_all(mesh.positions.size(), 0);
  for (std::uint32_t v = 0; v < mesh.positions.size(); ++v) {
    table.for_each_corner(v, [&](std::uint32_t) { ++in_fan[v]; });
  }
  for (const Triangle& t : mesh.triangles) {
    for (const std::uint32_t v : t)
      ++in_all[v];
  }
  if (in_fan == in_all) return false;
  const CornersOfVertices around(table);
  for (std::uint32_t v = 0; v < mesh.positions.size(); ++v) {
    if (in_fan[v] != in_all[v]) mark_smaller_fans(table, around, v, dropped);
  }
  return true;
}

}  // namespace

std::size_t clean_topology(TriangleMesh& mesh) {
  const std::size_t before = mesh.triangles.size();
  std::erase_if(mesh.triangles, repeats_corner);
  std::vector<std::uint8_t> dropped(mesh.triangles.size(), 0);
  mark_reused_edges(mesh, dropped);
  remove_triangles(mesh.triangles, dropped);
  // A dropped fan may cut another vertex's fan in two; each round drops faces, so this ends.
  for (;;) {
    dropped.assign(mesh.triangles.size(), 0);
    if (!mark_extra_fans(mesh, dropped)) break;
    remove_triangles(mesh.triangles, dropped);
  }
  return before - mesh.triangles.size();
}

}  // namespace rangezip

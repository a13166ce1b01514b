#include "core/mesh/self_intersection.h"

#include <algorithm>
#include <array>
#include <cstddef>
#include <limits>
#include <numeric>
#include <utility>

#include "core/base/parallel.h"
#include "core/mesh/cell_grid.h"
#include "core/mesh/crowded_triangles.h"
#include "core/mesh/triangle_overlap.h"

namespace rangezip {
namespace {

using Pair = std::pair<std::uint32_t, std::uint32_t>;

/// Cells measure this many mean sides: fewer, fuller cells repeat less, smaller ones compare less.
constexpr double kSidesPerCell = 1.5;
/// Bounds the memory of the grid where a few small triangles lie in a large box.
constexpr std::size_t kCellsPerTriangle = 16;
/// A triangle over more cells than this is compared with all others instead of being entered.
constexpr std::size_t kLargeTriangleCells = 4096;
/// More large ones than this are a crowd (crowded_triangles.h), and so are the triangles of a cell
/// that has more than that: comparing all with all would take longer than telling them apart.
constexpr std::size_t kMostLarge = 512;
constexpr std::size_t kMostInCell = 1024;
/// Where triangles are in more cells than this on average, as slivers across the axes are, cells
/// grow: that bounds the memory of the lists.
constexpr std::size_t kMostEntriesPerTriangle = 64;
constexpr std::size_t kCellsPerBlock = 4096;
constexpr std::size_t kTrianglesPerBlock = 16384;
/// Of one cell, between two looks at the stop token: bad meshes have all triangles in one.
constexpr std::size_t kEntriesPerLook = 256;

/// Of their first sides.
double mean_side(const TriangleMesh& mesh, std::span<const std::uint32_t> triangles) {
  double total = 0.0;
  for (const std::uint32_t i : triangles) {
    const Triangle& t = mesh.triangles[i];
    total += glm::length(mesh.positions[t[1]] - mesh.positions[t[0]]);
  }
  return total / static_cast<double>(std::max<std::size_t>(1, triangles.size()));
}

/// Box, state and mean side of the triangles that take part, by their rank among these.
class Triangles {
 public:
  /// @param numbers in the mesh, ascending
  Triangles(const TriangleMesh& mesh, std::vector<std::uint32_t> numbers)
      : mesh_(mesh),
        numbers_(std::move(numbers)),
        boxes_(numbers_.size()),
        degenerate_(numbers_.size()) {
    parallel_for(numbers_.size(), kTrianglesPerBlock, [&](std::size_t begin, std::size_t end) {
      for (std::size_t i = begin; i < end; ++i) {
        const Triangle& triangle = mesh.triangles[numbers_[i]];
        boxes_[i] = box_of(mesh, triangle);
        degenerate_[i] = is_degenerate(mesh, triangle) ? 1 : 0;
      }
    });
    for (const Box& box : boxes_)
      bounds_.add(box);
  }

  [[nodiscard]] std::size_t size() const { return boxes_.size(); }
  [[nodiscard]] std::uint32_t number(std::size_t i) const { return numbers_[i]; }
  [[nodiscard]] const Box& box(std::size_t i) const { return boxes_[i]; }
  [[nodiscard]] const Box& bounds() const { return bounds_; }
  [[nodiscard]] bool is_degenerate_at(std::size_t i) const { return degenerate_[i] != 0; }
  [[nodiscard]] bool meet(std::uint32_t i, std::uint32_t j) const {
    return overlap(mesh_, mesh_.triangles[numbers_[i]], mesh_.triangles[numbers_[j]]);
  }
  [[nodiscard]] std::array<Vec3, 3> corners(std::size_t i) const {
    const Triangle& t = mesh_.triangles[numbers_[i]];
    return {mesh_.positions[t[0]], mesh_.positions[t[1]], mesh_.positions[t[2]]};
  }
  [[nodiscard]] double mean_side() const { return rangezip::mean_side(mesh_, numbers_); }

 private:
  const TriangleMesh& mesh_;
  std::vector<std::uint32_t> numbers_;
  std::vector<Box> boxes_;
  std::vector<std::uint8_t> degenerate_;
  Box bounds_;
};

/// Triangles by cell: those of cell c are entries[starts[c]] up to entries[starts[c + 1]].
struct CellLists {
  std::vector<std::uint32_t> starts;
  std::vector<std::uint32_t> entries;
  std::vector<std::uint32_t> large;  ///< not entered

  [[nodiscard]] std::size_t count(std::size_t cell) const {
    return starts[cell + 1] - starts[cell];
  }
  [[nodiscard]] bool is_crowded(std::size_t cell) const { return count(cell) > kMostInCell; }
  [[nodiscard]] std::span<const std::uint32_t> of(std::size_t cell) const {
    return {entries.data() + starts[cell], count(cell)};
  }
};

/// The cells that each triangle's box meets.
std::vector<CellRange> ranges_of(const Triangles& triangles, const CellGrid& grid) {
  std::vector<CellRange> ranges(triangles.size());
  parallel_for(ranges.size(), kTrianglesPerBlock, [&](std::size_t begin, std::size_t end) {
    for (std::size_t i = begin; i < end; ++i)
      ranges[i] = grid.range_of(triangles.box(i));
  });
  return ranges;
}

/// A grid, and the cells that each triangle's box meets.
struct Layout {
  CellGrid grid;
  std::vector<CellRange> ranges;

  /// How many entries the triangles will have in the cells.
  [[nodiscard]] std::size_t entry_count() const {
    std::size_t sum = 0;
    for (const CellRange& range : ranges) {
      const std::size_t count = range.count();
      sum += count > kLargeTriangleCells ? 0 : count;
    }
    return sum;
  }
};

Layout layout_of(const Triangles& triangles) {
  const std::size_t most = std::min<std::size_t>(kMostEntriesPerTriangle * triangles.size(),
                                                 std::numeric_limits<std::uint32_t>::max());
  double cell = kSidesPerCell * triangles.mean_side();
  for (;;) {
    const CellGrid grid(triangles.bounds(), cell, kCellsPerTriangle * triangles.size());
    Layout layout{grid, ranges_of(triangles, grid)};
    if (grid.cell_count() == 1 || layout.entry_count() <= most) return layout;
    cell = 2.0 * grid.cell();
  }
}

/// Calls body(lower, upper) for slabs of layers of cells, in parallel: what it writes to cells of
/// its own slab only, it writes in the order of its loops.
template <class Body>
void for_each_slab(const CellGrid& grid, std::size_t triangles, const Body& body) {
  constexpr int kSlabs = 8;  // more share the work better, but look at more triangles in vain
  const int slabs = triangles < kTrianglesPerBlock ? 1 : kSlabs;
  const int layers = grid.layers();
  parallel_for(static_cast<std::size_t>(slabs), 1, [&](std::size_t begin, std::size_t end) {
    for (auto slab = static_cast<int>(begin); slab < static_cast<int>(end); ++slab)
      body(slab * layers / slabs, (slab + 1) * layers / slabs - 1);
  });
}

// What is asked about a triangle.
constexpr std::uint8_t kSame = 0;     ///< only whether a changed one meets it
constexpr std::uint8_t kChanged = 1;  ///< whether any meets it
constexpr std::uint8_t kApart = 2;    ///< whether any meets it that is not apart as well

/// @param changed empty: all are
bool is_asked(std::span<const std::uint8_t> changed, std::uint32_t i, std::uint32_t j) {
  return changed.empty() || changed[i] != changed[j] || changed[i] == kChanged;
}

/// Marks the cells with a pair to compare: with a changed triangle, or with one that is apart from
/// others and one that has stayed.
std::vector<std::uint8_t> cells_asked(const Triangles& triangles,
                                      const std::vector<CellRange>& ranges, const CellGrid& grid,
                                      std::span<const std::uint8_t> changed) {
  std::vector<std::uint8_t> kinds(grid.cell_count(), 0);  // in a cell, as bits
  const auto bit_of = [](std::uint8_t kind) { return static_cast<std::uint8_t>(1U << kind); };
  for_each_slab(grid, triangles.size(), [&](int lowest, int highest) {
    for (std::size_t i = 0; i < changed.size(); ++i) {
      if (changed[i] == kSame) continue;
      grid.for_each_cell(ranges[i], lowest, highest,
                         [&](std::size_t cell) { kinds[cell] |= bit_of(changed[i]); });
    }
    for (std::size_t i = 0; i < changed.size(); ++i) {
      if (changed[i] != kSame) continue;
      grid.for_each_cell(ranges[i], lowest, highest, [&](std::size_t cell) {
        if (kinds[cell] != 0) kinds[cell] |= bit_of(kSame);
      });
    }
  });
  for (std::uint8_t& cell : kinds) {
    const bool has_changed = (cell & bit_of(kChanged)) != 0;
    const bool has_both = (cell & bit_of(kApart)) != 0 && (cell & bit_of(kSame)) != 0;
    cell = has_changed || has_both ? 1 : 0;
  }
  return kinds;
}

/// Enters every triangle into its cells by a counting sort; with `wanted` only into marked cells.
CellLists sort_into_cells(const Triangles& triangles, const std::vector<CellRange>& ranges,
                          const CellGrid& grid, std::span<const std::uint8_t> wanted) {
  CellLists lists;
  lists.starts.assign(grid.cell_count() + 1, 0);
  std::vector<std::uint8_t> is_entered(triangles.size(), 0);
  for (std::uint32_t i = 0; i < triangles.size(); ++i) {
    if (triangles.is_degenerate_at(i)) continue;
    const bool is_large = ranges[i].count() > kLargeTriangleCells;
    if (is_large) lists.large.push_back(i);
    is_entered[i] = is_large ? 0 : 1;
  }
  const auto for_each_entry = [&](const auto& visit) {
    for_each_slab(grid, triangles.size(), [&](int lowest, int highest) {
      for (std::uint32_t i = 0; i < triangles.size(); ++i) {
        if (is_entered[i] == 0) continue;
        grid.for_each_cell(ranges[i], lowest, highest, [&](std::size_t cell) {
          if (wanted.empty() || wanted[cell] != 0) visit(cell, i);
        });
      }
    });
  };
  for_each_entry([&](std::size_t cell, std::uint32_t) { ++lists.starts[cell + 1]; });
  for (std::size_t c = 1; c < lists.starts.size(); ++c)
    lists.starts[c] += lists.starts[c - 1];
  lists.entries.resize(lists.starts.back());
  std::vector<std::uint32_t> next(lists.starts.begin(), lists.starts.end() - 1);
  for_each_entry([&](std::size_t cell, std::uint32_t i) { lists.entries[next[cell]++] = i; });
  return lists;
}

/// Pairs of one cell; a pair that shares several cells is compared in the one that holds the
/// lower corner of their common box.
void collect_cell(const Triangles& triangles, const CellGrid& grid,
                  std::span<const std::uint32_t> entries, std::size_t cell,
                  std::span<const std::uint8_t> changed, std::vector<Pair>& pairs,
                  const Progress& progress) {
  for (std::size_t k = 1; k < entries.size(); ++k) {
    if (k % kEntriesPerLook == 0) progress.check_stop();
    const std::uint32_t j = entries[k];
    const Box& second = triangles.box(j);
    for (std::size_t m = 0; m < k; ++m) {
      const std::uint32_t i = entries[m];  // < j: entries rise within a cell
      const Box& first = triangles.box(i);
      if (!is_asked(changed, i, j) || !boxes_meet(first, second)) continue;
      if (grid.index_of(glm::max(first.lower, second.lower)) != cell) continue;
      if (triangles.meet(i, j)) pairs.emplace_back(i, j);
    }
  }
}

void append_blocks(std::vector<std::vector<Pair>>& blocks, std::vector<Pair>& pairs) {
  for (const std::vector<Pair>& block : blocks)
    pairs.insert(pairs.end(), block.begin(), block.end());
}

void collect_cells(const Triangles& triangles, const CellGrid& grid, const CellLists& lists,
                   std::span<const std::uint8_t> changed, std::vector<Pair>& pairs,
                   const Progress& progress) {
  std::vector<std::vector<Pair>> blocks((grid.cell_count() + kCellsPerBlock - 1) / kCellsPerBlock);
  parallel_for(grid.cell_count(), kCellsPerBlock, [&](std::size_t begin, std::size_t end) {
    progress.check_stop();
    for (std::size_t cell = begin; cell < end; ++cell) {
      if (lists.count(cell) < 2 || lists.is_crowded(cell)) continue;
      collect_cell(triangles, grid, lists.of(cell), cell, changed, blocks[begin / kCellsPerBlock],
                   progress);
    }
  });
  append_blocks(blocks, pairs);
}

/// Pairs of one large triangle; of two large ones the lower collects their pair.
void collect_all_of(const Triangles& triangles, std::uint32_t i,
                    std::span<const std::uint8_t> is_large, std::span<const std::uint8_t> changed,
                    std::vector<Pair>& pairs) {
  for (std::uint32_t j = 0; j < triangles.size(); ++j) {
    if (j == i || triangles.is_degenerate_at(j) || (is_large[j] != 0 && j < i)) continue;
    if (!boxes_meet(triangles.box(i), triangles.box(j))) continue;
    if (!is_asked(changed, i, j)) continue;
    if (triangles.meet(i, j)) pairs.emplace_back(std::min(i, j), std::max(i, j));
  }
}

void collect_large(const Triangles& triangles, std::span<const std::uint32_t> large,
                   std::span<const std::uint8_t> changed, std::vector<Pair>& pairs,
                   const Progress& progress) {
  if (large.empty() || large.size() > kMostLarge) return;
  std::vector<std::uint8_t> is_large(triangles.size(), 0);
  for (const std::uint32_t i : large)
    is_large[i] = 1;
  std::vector<std::vector<Pair>> blocks(large.size());
  parallel_for(large.size(), 1, [&](std::size_t begin, std::size_t end) {
    for (std::size_t k = begin; k < end; ++k) {
      progress.check_stop();
      collect_all_of(triangles, large[k], is_large, changed, blocks[k]);
    }
  });
  append_blocks(blocks, pairs);
}

/// What a triangle has to do with a crowd.
enum class Part : std::uint8_t { none, other, in_cell, large };

/// Those of crowded cells and, if they are many, the large ones, which are compared with all.
std::vector<Part> parts_in_crowd(const Triangles& triangles, const CellLists& lists) {
  const bool has_large = lists.large.size() > kMostLarge;
  std::vector<Part> parts(triangles.size(), has_large ? Part::other : Part::none);
  for (std::size_t cell = 0; cell + 1 < lists.starts.size(); ++cell) {
    if (!lists.is_crowded(cell)) continue;
    for (const std::uint32_t i : lists.of(cell))
      parts[i] = Part::in_cell;
  }
  for (const std::uint32_t i : lists.large)
    parts[i] = has_large ? Part::large : Part::none;
  for (std::size_t i = 0; i < triangles.size(); ++i) {
    if (triangles.is_degenerate_at(i)) parts[i] = Part::none;
  }
  return parts;
}

/// Pairs of crowded cells and of large triangles, if these are many.
void collect_crowd(const Triangles& triangles, const CellGrid& grid, const CellLists& lists,
                   std::span<const std::uint8_t> changed, std::vector<Pair>& pairs,
                   const Progress& progress) {
  const std::vector<Part> parts = parts_in_crowd(triangles, lists);
  std::vector<std::uint32_t> members;  // by rank, the asking ones first
  const auto add = [&](const auto& is_added) {
    for (std::uint32_t i = 0; i < parts.size(); ++i) {
      if (is_added(parts[i])) members.push_back(i);
    }
    return members.size();
  };
  const std::size_t asking =
      add([](Part part) { return part == Part::in_cell || part == Part::large; });
  if (asking == 0) return;
  add([](Part part) { return part == Part::other; });
  std::vector<std::array<Vec3, 3>> corners;
  corners.reserve(members.size());
  for (const std::uint32_t i : members)
    corners.push_back(triangles.corners(i));
  const auto is_pair = [&](std::uint32_t a, std::uint32_t b) {
    const std::uint32_t i = members[a], j = members[b];
    const Box &first = triangles.box(i), &second = triangles.box(j);
    progress.check_stop();  // there is no telling how many are asked for
    if (!is_asked(changed, i, j) || !boxes_meet(first, second)) return false;
    if (parts[i] != Part::large && parts[j] != Part::large &&
        !lists.is_crowded(grid.index_of(glm::max(first.lower, second.lower)))) {
      return false;  // collect_cell finds it
    }
    return triangles.meet(i, j);
  };
  for (const auto& [a, b] : pairs_in_crowd(corners, asking, is_pair))
    pairs.push_back(std::minmax(members[a], members[b]));
}

std::vector<std::uint32_t> all_of(const TriangleMesh& mesh) {
  std::vector<std::uint32_t> numbers(mesh.triangles.size());
  std::iota(numbers.begin(), numbers.end(), 0U);
  return numbers;
}

/// Whether a cell is marked that the part of a box in the bounds meets; of large boxes, yes.
bool meets_marked(const CellGrid& grid, std::span<const std::uint8_t> marked, const Box& bounds,
                  const Box& box) {
  const CellRange range =
      grid.range_of({glm::max(bounds.lower, box.lower), glm::min(bounds.upper, box.upper)});
  if (range.count() > kLargeTriangleCells) return true;
  std::uint8_t found = 0;
  grid.for_each_cell(range, 0, grid.layers() - 1, [&](std::size_t cell) { found |= marked[cell]; });
  return found != 0;
}

/// Those that come near one of the changed ones.
std::vector<std::uint32_t> around(const TriangleMesh& mesh,
                                  std::span<const std::uint32_t> changed) {
  Box bounds;
  for (const std::uint32_t i : changed)
    bounds.add(box_of(mesh, mesh.triangles[i]));
  const CellGrid grid(bounds, kSidesPerCell * mean_side(mesh, changed), mesh.triangles.size());
  std::vector<std::uint8_t> marked(grid.cell_count(), 0);
  for (const std::uint32_t i : changed) {
    grid.for_each_cell(grid.range_of(box_of(mesh, mesh.triangles[i])), 0, grid.layers() - 1,
                       [&](std::size_t cell) { marked[cell] = 1; });
  }
  std::vector<std::uint8_t> is_near(mesh.triangles.size());
  parallel_for(is_near.size(), kTrianglesPerBlock, [&](std::size_t begin, std::size_t end) {
    for (std::size_t i = begin; i < end; ++i) {
      const Box box = box_of(mesh, mesh.triangles[i]);
      is_near[i] = boxes_meet(bounds, box) && meets_marked(grid, marked, bounds, box) ? 1 : 0;
    }
  });
  std::vector<std::uint32_t> numbers;
  for (std::uint32_t i = 0; i < is_near.size(); ++i) {
    if (is_near[i] != 0) numbers.push_back(i);
  }
  return numbers;
}

/// `changed` says of triangles by rank what is asked, or is empty: all.
std::vector<Pair> find_pairs(const Triangles& triangles, std::span<const std::uint8_t> changed,
                             const Progress& progress) {
  std::vector<Pair> pairs;
  if (triangles.size() == 0) return pairs;
  progress.check_stop();
  const auto [grid, ranges] = layout_of(triangles);
  progress.check_stop();
  std::vector<std::uint8_t> wanted;
  if (!changed.empty()) wanted = cells_asked(triangles, ranges, grid, changed);
  const CellLists lists = sort_into_cells(triangles, ranges, grid, wanted);
  collect_cells(triangles, grid, lists, changed, pairs, progress);
  collect_large(triangles, lists.large, changed, pairs, progress);
  collect_crowd(triangles, grid, lists, changed, pairs, progress);
  for (std::uint32_t i = 0; i < triangles.size(); ++i) {
    const bool asked = changed.empty() || changed[i] != kSame;
    if (asked && triangles.is_degenerate_at(i)) pairs.emplace_back(i, i);
  }
  for (auto& [first, second] : pairs) {
    first = triangles.number(first);
    second = triangles.number(second);
  }
  std::sort(pairs.begin(), pairs.end());
  return pairs;
}

}  // namespace

std::vector<Pair> self_intersections(const TriangleMesh& mesh, const Progress& progress) {
  return find_pairs(Triangles(mesh, all_of(mesh)), {}, progress);
}

std::vector<Pair> self_intersections(const TriangleMesh& mesh,
                                     std::span<const std::uint32_t> changed,
                                     std::span<const std::uint32_t> apart,
                                     const Progress& progress) {
  if (changed.empty()) return {};
  const Triangles triangles(mesh, around(mesh, changed));
  std::vector<std::uint8_t> is_changed(mesh.triangles.size(), kSame);
  for (const std::uint32_t i : changed)
    is_changed[i] = kChanged;
  for (const std::uint32_t i : apart)
    is_changed[i] = kApart;
  std::vector<std::uint8_t> flags(triangles.size());
  for (std::size_t rank = 0; rank < flags.size(); ++rank)
    flags[rank] = is_changed[triangles.number(rank)];
  return find_pairs(triangles, flags, progress);
}

}  // namespace rangezip

#include "core/mesh/crowded_triangles.h"

#include <algorithm>
#include <cmath>
#include <limits>

#include "core/base/parallel.h"
#include "core/base/symmetric_eigen.h"

namespace rangezip {
namespace {

using Corners = std::array<Vec3, 3>;
using Pair = std::pair<std::uint32_t, std::uint32_t>;
constexpr std::size_t kDirections = 6;
/// What a triangle of a box costs to prepare, in comparisons of two.
constexpr double kPieceCost = 15.0;
/// Boxes are cut only where that leaves at most this share of the cost: thus cutting ends, and does
/// not prepare in vain for long.
constexpr double kWorthwhile = 0.9;
constexpr std::size_t kPiecesPerBlock = 1024;

/// Part of a triangle in a box: how far it extends along every direction.
struct Piece {
  std::array<double, kDirections> lower{};
  std::array<double, kDirections> upper{};
  std::uint32_t number = 0;
};

bool pieces_meet(const Piece& a, const Piece& b) {
  for (std::size_t k = 0; k < kDirections; ++k) {
    if (a.lower[k] > b.upper[k] || b.lower[k] > a.upper[k]) return false;
  }
  return true;
}

/// A convex polygon of few corners: a triangle cut by the planes of a box.
struct Polygon {
  std::array<Vec3, 9> corners{};
  std::size_t count = 0;

  void add(const Vec3& corner) { corners[count++] = corner; }
};

/// Keeps what lies below the limit along an axis or, with side -1, above it.
void cut(Polygon& polygon, int axis, double limit, double side) {
  const Polygon whole = polygon;
  polygon.count = 0;
  for (std::size_t i = 0; i < whole.count; ++i) {
    const Vec3& from = whole.corners[i];
    const Vec3& to = whole.corners[i + 1 == whole.count ? 0 : i + 1];
    const bool is_inside = side * from[axis] <= side * limit;
    if (is_inside) polygon.add(from);
    if (is_inside == (side * to[axis] <= side * limit)) continue;
    polygon.add(from + (limit - from[axis]) / (to[axis] - from[axis]) * (to - from));
  }
}

Polygon part_in(const Box& box, const Corners& triangle) {
  Polygon part;
  for (const Vec3& corner : triangle)
    part.add(corner);
  for (int axis = 0; axis < 3; ++axis) {
    const auto [least, greatest] =
        std::minmax({triangle[0][axis], triangle[1][axis], triangle[2][axis]});
    if (least < box.lower[axis]) cut(part, axis, box.lower[axis], -1.0);
    if (greatest > box.upper[axis]) cut(part, axis, box.upper[axis], 1.0);
  }
  return part;
}

Vec3 longest_side(const Corners& triangle) {
  Vec3 longest{0.0};
  for (std::size_t i = 0; i < 3; ++i) {
    const Vec3 side = triangle[(i + 1) % 3] - triangle[i];
    if (glm::dot(side, side) > glm::dot(longest, longest)) longest = side;
  }
  return unit_or_z(longest);
}

/// The triangles of a box, ready to be swept.
struct Crowd {
  Box box;
  std::vector<Piece> asking;  ///< both rise along the axis
  std::vector<Piece> others;
  std::size_t axis = 0;  ///< of the six
  double comparisons = 0.0;

  [[nodiscard]] double preparation() const {
    return kPieceCost * static_cast<double>(asking.size() + others.size());
  }
  [[nodiscard]] double cost() const { return comparisons + preparation(); }
};

/// Mean extent over standard deviation along a direction: the lower, the fewer pieces overlap.
double crowdedness(const Crowd& crowd, std::size_t k) {
  double extent = 0.0, sum = 0.0, squares = 0.0;
  const auto add = [&](const std::vector<Piece>& pieces) {
    for (const Piece& piece : pieces) {
      // From the first one on: digits that all places have in common would hide the deviation.
      const double place = piece.lower[k] - crowd.asking[0].lower[k];
      extent += piece.upper[k] - piece.lower[k];
      sum += place;
      squares += place * place;
    }
  };
  add(crowd.asking);
  add(crowd.others);
  const auto count = static_cast<double>(crowd.asking.size() + crowd.others.size());
  return extent / std::sqrt(std::max(squares * count - sum * sum, 0.0));
}

void sort_along(std::vector<Piece>& pieces, std::size_t axis) {
  std::sort(pieces.begin(), pieces.end(), [axis](const Piece& a, const Piece& b) {
    return a.lower[axis] != b.lower[axis] ? a.lower[axis] < b.lower[axis] : a.number < b.number;
  });
}

using PieceRange = std::span<const Piece>;

/// Those that begin inside a piece, with its upper end and, if so wanted, with its lower one.
PieceRange starting_inside(const std::vector<Piece>& pieces, const Piece& piece, std::size_t axis,
                           bool with_lower) {
  const double lower = piece.lower[axis];
  const auto begin = std::partition_point(pieces.begin(), pieces.end(), [&](const Piece& other) {
    return with_lower ? other.lower[axis] < lower : other.lower[axis] <= lower;
  });
  const auto end = std::partition_point(begin, pieces.end(), [&](const Piece& other) {
    return other.lower[axis] <= piece.upper[axis];
  });
  return {begin, end};
}

/// Those of the same list that begin inside the i-th and come after it.
PieceRange following(const std::vector<Piece>& pieces, std::size_t i, std::size_t axis) {
  const auto begin = pieces.begin() + static_cast<std::ptrdiff_t>(i) + 1;
  const auto end = std::partition_point(begin, pieces.end(), [&](const Piece& other) {
    return other.lower[axis] <= pieces[i].upper[axis];
  });
  return {begin, end};
}

/// Calls visit(piece, range) so that every two pieces that overlap along the axis, at least one of
/// them asking, are met once. Of the pieces from `begin` to `end`, the asking ones counted first.
template <class Visit>
void for_each_overlap(const Crowd& crowd, std::size_t begin, std::size_t end, const Visit& visit) {
  for (std::size_t i = begin; i < end; ++i) {
    if (i < crowd.asking.size()) {
      const Piece& piece = crowd.asking[i];
      visit(piece, following(crowd.asking, i, crowd.axis));
      visit(piece, starting_inside(crowd.others, piece, crowd.axis, true));
    } else {
      const Piece& piece = crowd.others[i - crowd.asking.size()];
      visit(piece, starting_inside(crowd.asking, piece, crowd.axis, false));
    }
  }
}

void append_blocks(std::vector<std::vector<Pair>>& blocks, std::vector<Pair>& pairs) {
  for (const std::vector<Pair>& block : blocks)
    pairs.insert(pairs.end(), block.begin(), block.end());
}

class CrowdSearch {
 public:
  CrowdSearch(std::span<const Corners> triangles, std::size_t asking,
              const std::function<bool(std::uint32_t, std::uint32_t)>& is_pair)
      : triangles_(triangles), asking_(asking), is_pair_(is_pair) {
    sides_.reserve(triangles.size());
    for (const Corners& triangle : triangles) {
      for (const Vec3& corner : triangle)
        bounds_.add(corner);
      sides_.push_back(longest_side(triangle));
    }
    const Vec3 farthest = glm::max(glm::abs(bounds_.lower), glm::abs(bounds_.upper));
    // Corners of parts and places along directions are wrong by some roundings of a coordinate:
    // by less than a tenth of this.
    constexpr double kRoundings = 1e-13;
    margin_ = kRoundings * std::max({farthest.x, farthest.y, farthest.z}) +
              std::numeric_limits<double>::min();
  }

  [[nodiscard]] std::vector<Pair> run() const {
    std::vector<std::uint32_t> numbers(triangles_.size());
    for (std::uint32_t i = 0; i < numbers.size(); ++i)
      numbers[i] = i;
    std::vector<Pair> pairs;
    search(crowd_of(bounds_, numbers), pairs);
    std::sort(pairs.begin(), pairs.end());
    pairs.erase(std::unique(pairs.begin(), pairs.end()), pairs.end());
    return pairs;
  }

 private:
  /// Along the sides of these triangles, and across.
  [[nodiscard]] Mat3 frame_of(std::span<const std::uint32_t> numbers) const {
    Mat3 sum{0.0};
    for (const std::uint32_t i : numbers) {
      for (int column = 0; column < 3; ++column)
        sum[column] += sides_[i] * sides_[i][column];
    }
    return eigen_of_symmetric(sum).vectors;
  }

  [[nodiscard]] Piece piece_of(const Polygon& part, const Mat3& frame, std::uint32_t number) const {
    Box along_axes, along_frame;
    for (std::size_t i = 0; i < part.count; ++i) {
      along_axes.add(part.corners[i]);
      along_frame.add(part.corners[i] * frame);
    }
    Piece piece;
    piece.number = number;
    for (int k = 0; k < 3; ++k) {
      const auto axis = static_cast<std::size_t>(k);
      piece.lower[axis] = along_axes.lower[k] - margin_;
      piece.upper[axis] = along_axes.upper[k] + margin_;
      piece.lower[axis + 3] = along_frame.lower[k] - margin_;
      piece.upper[axis + 3] = along_frame.upper[k] + margin_;
    }
    return piece;
  }

  /// Of those of the numbers that have a part in the box.
  [[nodiscard]] Crowd crowd_of(const Box& box, std::span<const std::uint32_t> numbers) const {
    Crowd crowd;
    crowd.box = box;
    const Box wide{box.lower - margin_, box.upper + margin_};
    const Mat3 frame = frame_of(numbers);
    for (const std::uint32_t i : numbers) {
      const Polygon part = part_in(wide, triangles_[i]);
      if (part.count == 0) continue;
      (i < asking_ ? crowd.asking : crowd.others).push_back(piece_of(part, frame, i));
    }
    if (crowd.asking.empty()) return {};
    double least = crowdedness(crowd, 0);
    for (std::size_t k = 1; k < kDirections; ++k) {
      const double value = crowdedness(crowd, k);
      if (!(value < least)) continue;
      least = value;
      crowd.axis = k;
    }
    sort_along(crowd.asking, crowd.axis);
    sort_along(crowd.others, crowd.axis);
    for_each_overlap(crowd, 0, crowd.asking.size() + crowd.others.size(),
                     [&](const Piece&, PieceRange range) {
                       crowd.comparisons += static_cast<double>(range.size());
                     });
    return crowd;
  }

  /// Cuts the box across its long axes.
  [[nodiscard]] std::vector<Crowd> parts_of(const Crowd& crowd) const {
    std::vector<std::uint32_t> numbers;
    for (const auto* pieces : {&crowd.asking, &crowd.others}) {
      for (const Piece& piece : *pieces)
        numbers.push_back(piece.number);
    }
    const Vec3 size = crowd.box.upper - crowd.box.lower;
    const double longest = std::max({size.x, size.y, size.z});
    std::vector<Box> boxes{crowd.box};
    for (int axis = 0; axis < 3; ++axis) {
      if (size[axis] < 0.5 * longest) continue;
      const double middle = crowd.box.center()[axis];
      const std::size_t count = boxes.size();
      for (std::size_t i = 0; i < count; ++i) {
        boxes.push_back(boxes[i]);
        boxes[i].upper[axis] = middle;
        boxes.back().lower[axis] = middle;
      }
    }
    std::vector<Crowd> parts(boxes.size());
    parallel_for(parts.size(), 1, [&](std::size_t begin, std::size_t end) {
      for (std::size_t i = begin; i < end; ++i)
        parts[i] = crowd_of(boxes[i], numbers);
    });
    return parts;
  }

  void search(Crowd crowd, std::vector<Pair>& pairs) const {
    // Parts cost at least what preparing them costs.
    if (2.0 * crowd.preparation() < kWorthwhile * crowd.cost()) {
      std::vector<Crowd> parts = parts_of(crowd);
      double cost = 0.0;
      for (const Crowd& part : parts)
        cost += part.cost();
      if (cost <= kWorthwhile * crowd.cost()) {
        crowd = {};  // its memory is not needed below
        std::vector<std::vector<Pair>> found(parts.size());
        parallel_for(parts.size(), 1, [&](std::size_t begin, std::size_t end) {
          for (std::size_t i = begin; i < end; ++i)
            search(std::move(parts[i]), found[i]);
        });
        append_blocks(found, pairs);
        return;
      }
    }
    sweep(crowd, pairs);
  }

  void sweep(const Crowd& crowd, std::vector<Pair>& pairs) const {
    const std::size_t count = crowd.asking.size() + crowd.others.size();
    std::vector<std::vector<Pair>> blocks((count + kPiecesPerBlock - 1) / kPiecesPerBlock);
    parallel_for(count, kPiecesPerBlock, [&](std::size_t begin, std::size_t end) {
      std::vector<Pair>& found = blocks[begin / kPiecesPerBlock];
      for_each_overlap(crowd, begin, end, [&](const Piece& piece, PieceRange range) {
        for (const Piece& other : range) {
          if (!pieces_meet(piece, other)) continue;
          const auto [i, j] = std::minmax(piece.number, other.number);
          if (is_pair_(i, j)) found.emplace_back(i, j);
        }
      });
    });
    append_blocks(blocks, pairs);
  }

  std::span<const Corners> triangles_;
  std::size_t asking_;
  const std::function<bool(std::uint32_t, std::uint32_t)>& is_pair_;
  std::vector<Vec3> sides_;  ///< directions of the longest ones
  Box bounds_;
  double margin_ = 0.0;
};

}  // namespace

std::vector<Pair> pairs_in_crowd(std::span<const Corners> triangles, std::size_t asking,
                                 const std::function<bool(std::uint32_t, std::uint32_t)>& is_pair) {
  if (asking == 0) return {};
  return CrowdSearch(triangles, asking, is_pair).run();
}

}  // namespace rangezip

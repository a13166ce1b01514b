#include <algorithm>
#include <cmath>

#include "core/finish/corner_table.h"
#include "core/finish/fill_patch.h"

namespace rangezip {
namespace {

constexpr std::size_t kMaxDirectUnknowns = 400;

/// Neighbours of every point of the patch; those along the loop belong to the surroundings.
std::vector<std::vector<std::uint32_t>> inner_neighbors(const FillPatch& patch) {
  const CornerTable table(patch.triangles, patch.positions.size());
  std::vector<std::vector<std::uint32_t>> neighbors(patch.positions.size());
  const auto n = static_cast<std::uint32_t>(patch.loop_size);
  for (std::uint32_t v = 0; v < patch.positions.size(); ++v) {
    table.for_each_neighbor(v, [&](std::uint32_t w) {
      const bool along_loop = v < n && w < n && ((v + 1) % n == w || (w + 1) % n == v);
      if (!along_loop) neighbors[v].push_back(w);
    });
  }
  return neighbors;
}

/// A row of the linear system for one point: weights of the unknowns, and a sum of known points.
class System {
 public:
  System(const FillPatch& patch, std::size_t unknowns)
      : patch_(patch), size_(unknowns), matrix_(unknowns * unknowns, 0.0), right_(unknowns) {}

  /// Adds weight * point to row `row`.
  void add(std::size_t row, std::uint32_t point, double weight) {
    if (point < patch_.loop_size) {
      right_[row] -= weight * patch_.positions[point];
    } else {
      matrix_[row * size_ + (point - patch_.loop_size)] += weight;
    }
  }
  void add_known(std::size_t row, const Vec3& value) { right_[row] -= value; }

  /// Gaussian elimination with row pivoting. @return false if the matrix is singular
  bool solve() {
    for (std::size_t k = 0; k < size_; ++k) {
      std::size_t pivot = k;
      for (std::size_t i = k + 1; i < size_; ++i) {
        if (std::abs(at(i, k)) > std::abs(at(pivot, k))) pivot = i;
      }
      constexpr double kSingular = 1e-12;  // rows sum to weights of order 1
      if (!(std::abs(at(pivot, k)) > kSingular)) return false;
      if (pivot != k) swap_rows(pivot, k);
      for (std::size_t i = k + 1; i < size_; ++i)
        eliminate(i, k);
    }
    for (std::size_t k = size_; k-- > 0;) {
      for (std::size_t j = k + 1; j < size_; ++j)
        right_[k] -= at(k, j) * right_[j];
      right_[k] /= at(k, k);
    }
    return true;
  }
  [[nodiscard]] const std::vector<Vec3>& solution() const { return right_; }

 private:
  double& at(std::size_t i, std::size_t j) { return matrix_[i * size_ + j]; }
  void swap_rows(std::size_t i, std::size_t k) {
    std::swap_ranges(&at(i, 0), &at(i, 0) + size_, &at(k, 0));
    std::swap(right_[i], right_[k]);
  }
  void eliminate(std::size_t i, std::size_t k) {
    const double factor = at(i, k) / at(k, k);
    if (factor == 0.0) return;
    for (std::size_t j = k; j < size_; ++j)
      at(i, j) -= factor * at(k, j);
    right_[i] -= factor * right_[k];
  }

  const FillPatch& patch_;
  std::size_t size_;
  std::vector<double> matrix_;
  std::vector<Vec3> right_;
};

/// Adds weight * (mean of the neighbours of v - v) to a row.
void add_umbrella(System& system, std::size_t row, std::uint32_t v, double weight,
                  const std::vector<std::vector<std::uint32_t>>& neighbors,
                  const LoopSurroundings& around) {
  double count = static_cast<double>(neighbors[v].size());
  const bool on_loop = v < around.neighbor_count.size();
  if (on_loop) count += around.neighbor_count[v];
  for (const std::uint32_t w : neighbors[v])
    system.add(row, w, weight / count);
  if (on_loop) system.add_known(row, (weight / count) * around.neighbor_sum[v]);
  system.add(row, v, -weight);
}

}  // namespace

void flatten_patch(FillPatch& patch) {
  const auto neighbors = inner_neighbors(patch);
  constexpr int kSweeps = 200;  // settles patches of a few hundred points; larger ones start flat
  for (int sweep = 0; sweep < kSweeps; ++sweep) {
    for (std::size_t v = patch.loop_size; v < patch.positions.size(); ++v) {
      Vec3 sum{0.0};
      for (const std::uint32_t w : neighbors[v])
        sum += patch.positions[w];
      patch.positions[v] = sum / static_cast<double>(neighbors[v].size());
    }
  }
}

bool fair_patch(FillPatch& patch, const LoopSurroundings& surroundings) {
  const std::size_t unknowns = patch.positions.size() - patch.loop_size;
  if (unknowns == 0 || unknowns > kMaxDirectUnknowns) return false;
  const auto neighbors = inner_neighbors(patch);
  System system(patch, unknowns);
  for (std::size_t row = 0; row < unknowns; ++row) {
    const auto v = static_cast<std::uint32_t>(patch.loop_size + row);
    const double share = 1.0 / static_cast<double>(neighbors[v].size());
    for (const std::uint32_t w : neighbors[v]) {
      add_umbrella(system, row, w, share, neighbors, surroundings);
    }
    add_umbrella(system, row, v, -1.0, neighbors, surroundings);
  }
  if (!system.solve()) return false;
  std::copy(system.solution().begin(), system.solution().end(),
            patch.positions.begin() + static_cast<std::ptrdiff_t>(patch.loop_size));
  return true;
}

}  // namespace rangezip

#include "core/finish/fit_radii.h"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <limits>
#include <span>
#include <utility>

#include "core/base/parallel.h"
#include "core/finish/corner_table.h"
#include "core/finish/vertex_geometry.h"

namespace rangezip {
namespace {

/// Of the window's radius.
constexpr std::array kShares{0.5, 0.63, 0.8, 1.0, 1.25, 1.6, 2.0};
constexpr std::size_t kCount = kShares.size();
using Shares = std::array<double, kCount>;
constexpr double kNarrowest = 1.3, kWidest = 8.0;  // in h
constexpr double kCube = 3.5;       // in h: the side; averages reach over three of them
constexpr double kTold = 0.7;       // of a fit's squared bias, by its distance from the narrowest
constexpr double kTolerance = 1.1;  // of the least error, for the sake of smooth normals
constexpr double kMinProbes = 8.0;  // with fewer the choice is by chance
constexpr std::uint32_t kStride = 4;
constexpr std::size_t kPerBlock = 64;
constexpr int kSteps = 2;  // onto the surface, before anything is measured

/// Sums over fits of each radius.
struct Errors {
  std::array<double, kCount> apart2{};    ///< squared distances from the narrowest fit
  std::array<double, kCount> expected{};  ///< of these, what noise alone makes
  std::array<double, kCount> variance{};
  double count = 0.0;

  void add(const Errors& other) {
    for (std::size_t k = 0; k < kCount; ++k) {
      apart2[k] += other.apart2[k];
      expected[k] += other.expected[k];
      variance[k] += other.variance[k];
    }
    count += other.count;
  }
};

Shares shares_within(double radius, double pixel_size) {
  Shares shares = kShares;
  for (double& share : shares) {
    share = std::clamp(share, std::min(1.0, kNarrowest * pixel_size / radius),
                       std::max(1.0, kWidest * pixel_size / radius));
  }
  return shares;
}

/// What the fits at a place tell; a count of 0 if one is not found.
class Probing {
 public:
  Probing(const PointGrid& cloud, const SurfaceWindow& window, const Shares& shares)
      : cloud_(cloud), window_(window), shares_(shares) {
    window_.widest = 0.0;
  }

  [[nodiscard]] Errors errors_at(Vec3 place, Vec3 normal) const {
    for (int step = 0; step < kSteps; ++step) {
      const SurfaceFit fit = fit_surface(cloud_, place, normal, window_);
      if (!fit.is_found) return {};
      place = fit.foot;
      normal = fit.normal;
    }
    Errors errors;
    MeasuredFit narrowest;
    for (std::size_t k = 0; k < kCount; ++k) {
      SurfaceWindow window = window_;
      window.radius *= shares_[k];
      const MeasuredFit measured = measure_surface(cloud_, place, normal, window);
      if (!measured.fit.is_found) return {};
      if (k == 0) narrowest = measured;
      const double apart = measured.fit.height - narrowest.fit.height;
      const double noise2 = window_.noise * window_.noise;
      errors.apart2[k] = apart * apart;
      const double share2 = measured.scatter.share2;
      errors.expected[k] = noise2 * (narrowest.scatter.share2 + share2 -
                                     2.0 * fit_covariance(shares_[0], shares_[k]) * share2);
      errors.variance[k] = noise2 * share2;
    }
    errors.count = 1.0;
    return errors;
  }

 private:
  const PointGrid& cloud_;
  SurfaceWindow window_;
  const Shares& shares_;
};

/// The share at which the error is least, or a larger one at which it is hardly more.
double best_share(const Errors& errors, const Shares& shares) {
  double best = 1.0;
  double least = std::numeric_limits<double>::infinity();
  for (std::size_t k = 0; k < kCount; ++k) {
    const double bias2 = std::max(0.0, errors.apart2[k] - errors.expected[k]) / kTold;
    const double error = bias2 + errors.variance[k];
    if (error <= kTolerance * kTolerance * least) best = shares[k];
    least = std::min(least, error);
  }
  return best;
}

/// What was found at places, summed up by cubes.
struct ErrorsOfCubes {
  std::vector<Cube> cubes;  ///< sorted
  std::vector<Errors> errors;
};

ErrorsOfCubes sum_by_cubes(std::span<const Vec3> places, std::span<const Errors> found,
                           double side) {
  ErrorsOfCubes sums;
  for (std::size_t i = 0; i < places.size(); ++i) {
    if (found[i].count > 0.0) sums.cubes.push_back(cube_of(places[i], side));
  }
  sort_cubes(sums.cubes);
  sums.errors.resize(sums.cubes.size());
  for (std::size_t i = 0; i < places.size(); ++i) {
    if (found[i].count > 0.0)
      sums.errors[find_cube(sums.cubes, cube_of(places[i], side))].add(found[i]);
  }
  return sums;
}

/// For each cube what is best there and in those around it.
std::vector<double> best_shares(const ErrorsOfCubes& sums, const Shares& shares) {
  std::vector<double> best(sums.cubes.size(), 1.0);
  for (std::size_t c = 0; c < best.size(); ++c) {
    Errors around;
    for_each_cube_around(sums.cubes, sums.cubes[c],
                         [&](std::size_t other) { around.add(sums.errors[other]); });
    if (around.count >= kMinProbes) best[c] = best_share(around, shares);
  }
  return best;
}

/// Means over the cubes around, by how much was found there.
std::vector<double> smoothed_shares(const ErrorsOfCubes& sums, const std::vector<double>& shares) {
  std::vector<double> smooth(shares.size());
  for (std::size_t c = 0; c < shares.size(); ++c) {
    double sum = 0.0, weight = 0.0;
    for_each_cube_around(sums.cubes, sums.cubes[c], [&](std::size_t other) {
      sum += sums.errors[other].count * shares[other];
      weight += sums.errors[other].count;
    });
    smooth[c] = sum / weight;
  }
  return smooth;
}

}  // namespace

ShareField local_fit_radii(const TriangleMesh& mesh, const PointGrid& cloud,
                           const SurfaceWindow& window, double pixel_size) {
  const CornerTable table(mesh.triangles, mesh.positions.size());
  std::vector<Vec3> places, normals;
  for (std::uint32_t v = 0; v < mesh.positions.size(); v += kStride) {
    if (table.is_boundary(v)) continue;
    places.push_back(mesh.positions[v]);
    normals.push_back(vertex_normal(table, mesh.positions, v));
  }
  const Shares shares = shares_within(window.radius, pixel_size);
  const Probing probing(cloud, window, shares);
  std::vector<Errors> found(places.size());
  parallel_for(places.size(), kPerBlock, [&](std::size_t begin, std::size_t end) {
    for (std::size_t i = begin; i < end; ++i)
      found[i] = probing.errors_at(places[i], normals[i]);
  });
  ErrorsOfCubes sums = sum_by_cubes(places, found, kCube * pixel_size);
  std::vector<double> smooth = smoothed_shares(sums, best_shares(sums, shares));
  return {kCube * pixel_size, std::move(sums.cubes), std::move(smooth)};
}

}  // namespace rangezip

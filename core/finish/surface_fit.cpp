#include "core/finish/surface_fit.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <span>
#include <utility>

namespace rangezip {
namespace {

constexpr std::size_t kTerms = 6;  // 1, u, v, u u, u v, v v
constexpr std::size_t kPlaneTerms = 3;
constexpr int kMinQuadricPoints = 12;
constexpr int kMinPlanePoints = 6;
constexpr double kMeanWeight = 4.0 / 7.0;  // of squared weights per weight, over a disk
constexpr double kAllBelieved = 0.99;
constexpr double kDoubt = 2.0;      // of what noise makes: more flattens what bends a little
constexpr double kMinPivot = 1e-4;  // of the diagonal: below, the points do not tell the term
constexpr double kSurePivot = 0.1;  // above, they tell it as well as points all around do
constexpr double kWiden = 1.25;

using Terms = std::array<double, kTerms>;
using TermMatrix = std::array<Terms, kTerms>;  ///< symmetric: the lower triangle counts

/// Axes across a unit normal.
struct Frame {
  Vec3 u, v, normal;

  explicit Frame(const Vec3& n) : normal(n) {
    const Vec3 axis = std::abs(n.x) < 0.6 ? Vec3(1, 0, 0) : Vec3(0, 1, 0);
    u = glm::normalize(glm::cross(axis, n));
    v = glm::cross(n, u);
  }
};

/// A point in the frame, with its weight; lengths in radii keep the equations balanced.
struct Sample {
  double u, v, z, weight;
};

Terms terms_at(const Sample& s) {
  return {1.0, s.u, s.v, s.u * s.u, s.u * s.v, s.v * s.v};
}

/// Without loops: GCC makes pairs of their steps, which then wait for terms that have just been
/// stored one by one, for most of the time of a fit.
template <std::size_t... I>
void add_scaled(Terms& sum, const Terms& terms, double weight, std::index_sequence<I...>) {
  ((sum[I] += weight * terms[I]), ...);
}

template <std::size_t... I>
void add_rows(TermMatrix& matrix, const Terms& terms, double weight, std::index_sequence<I...>) {
  (add_scaled(matrix[I], terms, weight * terms[I], std::make_index_sequence<I + 1>{}), ...);
}

void add_product(TermMatrix& matrix, const Terms& terms, double weight) {
  add_rows(matrix, terms, weight, std::make_index_sequence<kTerms>{});
}

struct NormalEquations {
  TermMatrix matrix{};
  Terms right{};
  int count = 0;

  void add(const Sample& s) {
    const Terms terms = terms_at(s);
    add_product(matrix, terms, s.weight);
    add_scaled(right, terms, s.weight * s.z, std::make_index_sequence<kTerms>{});
    ++count;
  }
};

/// What the scatter needs besides.
struct ScatterSums {
  TermMatrix squared{};  ///< of squared weights
  double heights2 = 0.0;
  double weight = 0.0;

  void add(const Sample& s) {
    add_product(squared, terms_at(s), s.weight * s.weight);
    heights2 += s.weight * s.z * s.z;
    weight += s.weight;
  }
  [[nodiscard]] double at(std::size_t i, std::size_t j) const {
    return i >= j ? squared[i][j] : squared[j][i];
  }
};

struct MeasuredSums {
  NormalEquations equations;
  ScatterSums scatter;

  void add(const Sample& s) {
    equations.add(s);
    scatter.add(s);
  }
};

/// Cholesky's decomposition of the first `size` terms, in place; false where a term cannot be told.
bool decompose(TermMatrix& a, std::size_t size) {
  for (std::size_t i = 0; i < size; ++i) {
    const double diagonal = a[i][i];
    for (std::size_t j = 0; j <= i; ++j) {
      double sum = a[i][j];
      for (std::size_t k = 0; k < j; ++k)
        sum -= a[i][k] * a[j][k];
      if (i != j) {
        a[i][j] = sum / a[j][j];
      } else {
        if (!(sum > kMinPivot * diagonal)) return false;
        a[i][i] = std::sqrt(sum);
      }
    }
  }
  return true;
}

Terms solve(const TermMatrix& factor, Terms b, std::size_t size) {
  for (std::size_t i = 0; i < size; ++i) {
    for (std::size_t k = 0; k < i; ++k)
      b[i] -= factor[i][k] * b[k];
    b[i] /= factor[i][i];
  }
  for (std::size_t i = size; i-- > 0;) {
    for (std::size_t k = i + 1; k < size; ++k)
      b[i] -= factor[k][i] * b[k];
    b[i] /= factor[i][i];
  }
  return b;
}

/// A solved system; `size` 0 if the points tell no surface.
struct Solution {
  std::size_t size = 0;
  TermMatrix factor{};
  Terms terms{};  ///< those past `size` are 0
};

Solution solve(const NormalEquations& equations) {
  for (const std::size_t size : {kTerms, kPlaneTerms}) {
    if (equations.count < (size == kTerms ? kMinQuadricPoints : kMinPlanePoints)) continue;
    Solution solution{size, equations.matrix, {}};
    if (!decompose(solution.factor, size)) continue;
    Terms right{};
    std::copy_n(equations.right.begin(), size, right.begin());
    solution.terms = solve(solution.factor, right, size);
    return solution;
  }
  return {};
}

/// Whether the points lie far enough around to tell how the surface bends, every way.
bool tells_bending(const Solution& solution, const NormalEquations& equations) {
  if (solution.size != kTerms) return false;
  for (std::size_t i = kPlaneTerms; i < kTerms; ++i) {
    const double pivot = solution.factor[i][i];
    if (pivot * pivot < kSurePivot * equations.matrix[i][i]) return false;
  }
  return true;
}

/// The share of the bending that is not to be put down to noise: 0 where noise alone would give as
/// much, towards 1 where it is far more [James, Stein 1961].
double believed_bending(const Solution& solution, double noise) {
  const TermMatrix& l = solution.factor;
  double square = 0.0;
  for (std::size_t i = kPlaneTerms; i < kTerms; ++i) {
    double sum = 0.0;
    for (std::size_t k = i; k < kTerms; ++k)
      sum += l[k][i] * solution.terms[k];
    square += sum * sum;
  }
  const double expected = kMeanWeight * noise * noise;
  return square > kDoubt * expected ? 1.0 - kDoubt * expected / square : 0.0;
}

/// Between the quadric and the plane of least squares: that of least squares for the bending.
void shrink_bending(Solution& solution, const NormalEquations& equations, double noise) {
  if (solution.size != kTerms || !(noise > 0.0)) return;
  const double share = believed_bending(solution, noise);
  if (share > kAllBelieved) return;
  Terms right{};
  std::copy_n(equations.right.begin(), kPlaneTerms, right.begin());
  const Terms plane = solve(solution.factor, right, kPlaneTerms);
  for (std::size_t i = 0; i < kTerms; ++i)
    solution.terms[i] = share * solution.terms[i] + (1.0 - share) * plane[i];
}

SurfaceFit fit_from(const Solution& solution, int count, const Vec3& place, const Frame& frame,
                    double radius) {
  SurfaceFit fit;
  if (solution.size == 0) return fit;
  fit.is_found = true;
  fit.count = count;
  const Terms& t = solution.terms;
  fit.height = t[0] * radius;
  fit.foot = place + fit.height * frame.normal;
  const Vec3 steep = frame.normal - t[1] * frame.u - t[2] * frame.v;
  const double length = glm::length(steep);
  fit.normal = steep / length;
  const Mat3 mixed = glm::outerProduct(frame.u, frame.v) + glm::outerProduct(frame.v, frame.u);
  fit.bending = (2.0 * t[3] * glm::outerProduct(frame.u, frame.u) + t[4] * mixed +
                 2.0 * t[5] * glm::outerProduct(frame.v, frame.v)) /
                (radius * length);
  return fit;
}

SurfaceScatter scatter_from(const Solution& solution, const NormalEquations& equations,
                            const ScatterSums& sums, double radius) {
  SurfaceScatter scatter;
  if (solution.size == 0) return scatter;
  // The height is the sum of w_i (row . terms_i) z_i, `row` the first row of the inverse.
  const Terms row = solve(solution.factor, Terms{1.0}, solution.size);
  double residual = sums.heights2;
  // Of noise of variance 1 the residual is expected to be the trace of w (1 - hat matrix).
  double freedom = sums.weight;
  for (std::size_t i = 0; i < solution.size; ++i) {
    residual -= solution.terms[i] * equations.right[i];
    Terms unit{};
    unit[i] = 1.0;
    const Terms column = solve(solution.factor, unit, solution.size);
    for (std::size_t j = 0; j < solution.size; ++j) {
      scatter.share2 += row[i] * row[j] * sums.at(i, j);
      freedom -= column[j] * sums.at(i, j);
    }
  }
  if (freedom > 0.0) scatter.noise2 = std::max(0.0, residual) / freedom * radius * radius;
  return scatter;
}

/// A point that may count.
struct Candidate {
  Vec3 offset;  ///< from the place, model units
  double z;     ///< along the normal
  double nearness;
  double count;
};

/// Adds points that count. On its own and with copies: within the loop that chooses the points,
/// sums stay in no register.
template <class Sums>
[[gnu::noinline]] void add_chosen(std::span<const Candidate> chosen, const Frame& axes,
                                  double per_radius, Sums& sums) {
  const Frame frame = axes;
  Sums local = sums;
  for (const auto& [d, z, nearness, count] : chosen) {
    local.add(Sample{glm::dot(d, frame.u) * per_radius, glm::dot(d, frame.v) * per_radius,
                     z * per_radius, count * nearness * nearness * nearness});
  }
  sums = local;
}

/// Adds every point that counts. They are chosen in batches, without a branch: most points near a
/// place do not count, in no order that a processor could foresee.
template <class Sums>
void add_samples(const PointGrid& cloud, const Vec3& place, const Frame& frame,
                 const SurfaceWindow& window, Sums& sums) {
  constexpr std::size_t kBatch = 64;
  std::array<Candidate, kBatch> batch;
  std::size_t chosen = 0;
  const double per_radius = 1.0 / window.radius;
  const double height = window.height;
  const Vec3 normal = frame.normal;
  cloud.for_each_counted_near(place, window.radius, normal, [&](const Vec3& d, double count) {
    const double z = glm::dot(d, normal);
    const double nearness = 1.0 - (glm::dot(d, d) - z * z) * per_radius * per_radius;
    batch[chosen] = {d, z, nearness, count};
    const bool is_beside = nearness <= 0.0, is_off = std::abs(z) > height;
    chosen += static_cast<std::size_t>(!is_beside) & static_cast<std::size_t>(!is_off);
    if (chosen < kBatch) return;
    add_chosen(std::span<const Candidate>(batch), frame, per_radius, sums);
    chosen = 0;
  });
  add_chosen(std::span<const Candidate>(batch).first(chosen), frame, per_radius, sums);
}

}  // namespace

SurfaceFit fit_surface(const PointGrid& cloud, const Vec3& place, const Vec3& normal,
                       const SurfaceWindow& window) {
  const Frame frame(normal);
  SurfaceFit fit;
  SurfaceWindow tried = window;
  for (;;) {
    NormalEquations equations;
    add_samples(cloud, place, frame, tried, equations);
    Solution solution = solve(equations);
    const bool is_sure = tells_bending(solution, equations);
    shrink_bending(solution, equations, tried.noise / tried.radius);
    if (solution.size > 0) fit = fit_from(solution, equations.count, place, frame, tried.radius);
    tried.radius *= kWiden;
    if (is_sure || tried.radius > window.widest) return fit;
  }
}

Vec3 projected_onto(const SurfaceFit& fit, const Vec3& place) {
  const Vec3 way = place - fit.foot;
  const double off = glm::dot(way, fit.normal);
  const Vec3 along = way - off * fit.normal;
  return place + (0.5 * glm::dot(along, fit.bending * along) - off) * fit.normal;
}

double fit_covariance(double narrow_radius, double wide_radius) {
  // Of even points a fit takes the height with the weights (1 - t)^3 (10 - 30 t), t the squared
  // distance in radii; this is the integral of the product of two such, over that of the square.
  const double q = narrow_radius / wide_radius * narrow_radius / wide_radius;
  return 1.4 - q * q * (0.8 - q * (0.5 - 0.1 * q));
}

MeasuredFit measure_surface(const PointGrid& cloud, const Vec3& place, const Vec3& normal,
                            const SurfaceWindow& window) {
  const Frame frame(normal);
  MeasuredSums sums;
  add_samples(cloud, place, frame, window, sums);
  const Solution solution = solve(sums.equations);
  return {fit_from(solution, sums.equations.count, place, frame, window.radius),
          scatter_from(solution, sums.equations, sums.scatter, window.radius)};
}

}  // namespace rangezip

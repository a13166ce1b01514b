#include "core/plan/spacing.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <numbers>
#include <string>

#include "core/base/error.h"
#include "core/base/symmetric_eigen.h"
#include "core/plan/spread.h"

namespace rangezip {

namespace {

constexpr std::size_t kQueries = 300;
constexpr std::size_t kNeighbours = 16;

constexpr double kPixelsPerNoise = 4.0;  // a step of one pixel is then rarely noise

/// Points looked at before all others, so that the search radius is small from then on.
constexpr std::size_t kFirstLook = 20'000;

double squared_distance(const Vec3& a, const Vec3& b) {
  const Vec3 d = a - b;
  return glm::dot(d, d);
}

/// The nearest distinct places around one point, nearest first.
class Neighbourhood {
 public:
  explicit Neighbourhood(const Vec3& center) : center_(center) {}

  [[nodiscard]] const Vec3& center() const { return center_; }
  [[nodiscard]] std::span<const Vec3> places() const { return {places_.data(), count_}; }
  [[nodiscard]] double radius() const { return std::sqrt(reach_); }
  [[nodiscard]] double farthest() const {
    return count_ == 0 ? 0.0 : std::sqrt(distances_[count_ - 1]);
  }

  void offer(const Vec3& place) {
    const double distance = squared_distance(place, center_);
    if (distance >= reach_ || distance == 0.0) return;
    std::size_t slot = count_;
    while (slot > 0 && distances_[slot - 1] > distance)
      --slot;
    for (std::size_t same = slot; same > 0 && distances_[same - 1] == distance; --same) {
      if (places_[same - 1] == place) return;
    }
    count_ = std::min(count_ + 1, kNeighbours);
    for (std::size_t i = count_ - 1; i > slot; --i) {
      distances_[i] = distances_[i - 1];
      places_[i] = places_[i - 1];
    }
    distances_[slot] = distance;
    places_[slot] = place;
    if (count_ == kNeighbours) reach_ = distances_.back();
  }

 private:
  Vec3 center_;
  double reach_ = std::numeric_limits<double>::infinity();  ///< squared
  std::size_t count_ = 0;
  std::array<double, kNeighbours> distances_{};  ///< squared
  std::array<Vec3, kNeighbours> places_{};
};

void require_three_distinct(std::span<const Vec3> points) {
  std::size_t distinct = points.empty() ? 0 : 1;
  std::size_t second = 0;
  for (std::size_t i = 1; i < points.size() && distinct < 3; ++i) {
    if (points[i] == points[0]) continue;
    if (distinct == 1) {
      second = i;
      distinct = 2;
    } else if (points[i] != points[second]) {
      distinct = 3;
    }
  }
  if (distinct < 3) {
    throw InvalidArgument("estimate_spacing: at least three distinct points are needed, got " +
                          std::to_string(distinct));
  }
}

/// Neighbourhoods, still empty, of distinct points spread over the cloud. A place that many points
/// share (scanners write what they did not see as the origin) is asked about once.
std::vector<Neighbourhood> choose_queries(std::span<const Vec3> points) {
  std::vector<Vec3> centers;
  for (const std::size_t index : spread_indices(points.size(), kQueries)) {
    centers.push_back(points[index]);
  }
  std::sort(centers.begin(), centers.end(), [](const Vec3& a, const Vec3& b) {
    return std::array{a.x, a.y, a.z} < std::array{b.x, b.y, b.z};
  });
  centers.erase(std::unique(centers.begin(), centers.end()), centers.end());
  return {centers.begin(), centers.end()};
}

/// For slabs across the x axis, the queries whose neighbours may lie in each. The slabs share the
/// middle of the queries evenly; the first and last one reach to infinity.
class SlabIndex {
 public:
  /// @pre `queries` are sorted by x, as choose_queries() leaves them
  explicit SlabIndex(std::span<const Neighbourhood> queries) {
    const std::size_t margin = queries.size() / 32;
    lower_ = queries[margin].center().x;
    const double width = queries[queries.size() - 1 - margin].center().x - lower_;
    slabs_per_unit_ = width > 0.0 ? kSlabs / width : 0.0;
    if (!std::isfinite(slabs_per_unit_)) slabs_per_unit_ = 0.0;

    for (std::uint32_t q = 0; q < queries.size(); ++q) {
      const double x = queries[q].center().x;
      const double radius = queries[q].radius();
      for (std::size_t s = slab_of(x - radius); s <= slab_of(x + radius); ++s) {
        queries_of_slab_[s].push_back(q);
      }
    }
  }

  [[nodiscard]] std::span<const std::uint32_t> queries_near(double x) const {
    return queries_of_slab_[slab_of(x)];
  }

 private:
  static constexpr int kSlabs = 1024;

  [[nodiscard]] std::size_t slab_of(double x) const {
    const double slab = (x - lower_) * slabs_per_unit_;
    return slab > 0.0 ? static_cast<std::size_t>(std::min(slab, kSlabs - 1.0)) : 0;
  }

  double lower_ = 0.0;
  double slabs_per_unit_ = 0.0;
  std::array<std::vector<std::uint32_t>, kSlabs> queries_of_slab_;
};

/// Fills the neighbourhoods: a first look at few points bounds their radii, then each of all
/// points is offered only to those that it may be near to.
void find_neighbours(std::span<const Vec3> points, std::vector<Neighbourhood>& queries) {
  for (const std::size_t index : spread_indices(points.size(), kFirstLook)) {
    for (Neighbourhood& query : queries)
      query.offer(points[index]);
  }
  const SlabIndex slabs(queries);
  for (const Vec3& point : points) {
    for (const std::uint32_t q : slabs.queries_near(point.x))
      queries[q].offer(point);
  }
}

/// RMS distance of a neighbourhood's places and centre from their best plane, in an unbiased
/// estimate (the plane takes up three degrees of freedom); 0 where that says nothing.
double distance_from_plane(const Neighbourhood& neighbourhood) {
  const std::size_t count = neighbourhood.places().size() + 1;
  if (count <= 3) return 0.0;
  Vec3 mean{0.0};  // of the offsets from the centre, which keep their digits far from the origin
  for (const Vec3& place : neighbourhood.places())
    mean += place - neighbourhood.center();
  mean /= static_cast<double>(count);
  Mat3 scatter = glm::outerProduct(mean, mean);  // the centre's own share
  for (const Vec3& place : neighbourhood.places()) {
    const Vec3 offset = place - neighbourhood.center() - mean;
    scatter += glm::outerProduct(offset, offset);
  }
  const double squares = std::max(0.0, eigen_of_symmetric(scatter).values[0]);
  return std::sqrt(squares / static_cast<double>(count - 3));
}

double quantile(std::vector<double> values, double share) {
  const auto at = static_cast<std::ptrdiff_t>(share * static_cast<double>(values.size() - 1));
  std::nth_element(values.begin(), values.begin() + at, values.end());
  return values[static_cast<std::size_t>(at)];
}

}  // namespace

Spacing estimate_spacing(std::span<const Vec3> points) {
  require_three_distinct(points);
  std::vector<Neighbourhood> queries = choose_queries(points);
  find_neighbours(points, queries);

  std::vector<double> spacings;
  std::vector<double> noises;
  for (const Neighbourhood& query : queries) {
    const auto neighbours = static_cast<double>(query.places().size());
    spacings.push_back(query.farthest() * std::sqrt(std::numbers::pi / neighbours));
    noises.push_back(distance_from_plane(query));
  }
  return {.median = quantile(spacings, 0.5),
          .quantile75 = quantile(spacings, 0.75),
          .noise = quantile(noises, 0.5),
          .diagonal = robust_bounds(points).diagonal()};
}

double closed_sheet_pixel_size(const Spacing& spacing) {
  constexpr double kPixelsPerSpacing = 2.2;  // about five points in a pixel
  return std::max(kPixelsPerSpacing * 0.5 * (spacing.median + spacing.quantile75),
                  kPixelsPerNoise * spacing.noise);
}

double pixel_size_from_spacing(const Spacing& spacing) {
  constexpr double kFewestPerSpacing = 1.3;  // one pixel in five stays empty, and is filled
  constexpr double kPixelsAcross = 250.0;
  const double finest = std::max(kFewestPerSpacing * 0.5 * (spacing.median + spacing.quantile75),
                                 kPixelsPerNoise * spacing.noise);
  return std::min(closed_sheet_pixel_size(spacing),
                  std::max(finest, spacing.diagonal / kPixelsAcross));
}

}  // namespace rangezip

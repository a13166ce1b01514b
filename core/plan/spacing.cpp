#include "core/plan/spacing.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <numbers>
#include <optional>
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

/// Neighbours that lie on one line if a cloud is made of contours.
constexpr std::size_t kOnLine = 5;
/// Of their spread along the line: the spread across it that still is a line. Neighbours in a disc
/// have 1, those of one in fifty points of a random cloud less than this.
constexpr double kLineWidth = 0.2;
/// Points among which those of other contours are looked for.
constexpr std::size_t kGapPoints = 200'000;
/// A gap more than so many times as wide as that on the other side is not one that the contours
/// usually have: a border, or a cap that they do not cross.
constexpr double kUsualGaps = 2.0;

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

/// The sum of the outer products of some places and their centre, about their mean.
Mat3 scatter_of(const Vec3& center, std::span<const Vec3> places) {
  const auto count = static_cast<double>(places.size() + 1);
  Vec3 mean{0.0};  // of the offsets from the centre, which keep their digits far from the origin
  for (const Vec3& place : places)
    mean += place - center;
  mean /= count;
  Mat3 scatter = glm::outerProduct(mean, mean);  // the centre's own share
  for (const Vec3& place : places) {
    const Vec3 offset = place - center - mean;
    scatter += glm::outerProduct(offset, offset);
  }
  return scatter;
}

/// RMS distance of a neighbourhood's places and centre from their best plane, in an unbiased
/// estimate (the plane takes up three degrees of freedom); 0 where that says nothing.
double distance_from_plane(const Neighbourhood& neighbourhood) {
  const std::size_t count = neighbourhood.places().size() + 1;
  if (count <= 3) return 0.0;
  const Mat3 scatter = scatter_of(neighbourhood.center(), neighbourhood.places());
  const double squares = std::max(0.0, eigen_of_symmetric(scatter).values[0]);
  return std::sqrt(squares / static_cast<double>(count - 3));
}

/// A place on a contour, as its nearest neighbours show it.
struct ContourPlace {
  Vec3 center{0.0};
  Vec3 along{0.0};    ///< unit
  double step = 0.0;  ///< between points of the contour
};

/// The places whose nearest neighbours lie on a line.
std::vector<ContourPlace> places_on_contours(std::span<const Neighbourhood> queries) {
  std::vector<ContourPlace> found;
  for (const Neighbourhood& query : queries) {
    if (query.places().size() < kNeighbours) continue;
    const std::span<const Vec3> nearest = query.places().first(kOnLine);
    const SymmetricEigen eigen = eigen_of_symmetric(scatter_of(query.center(), nearest));
    if (eigen.values[1] > kLineWidth * kLineWidth * eigen.values[2]) continue;
    const double reach = std::sqrt(squared_distance(nearest.back(), query.center()));
    found.push_back({query.center(), eigen.vectors[2], 2.0 * reach / kOnLine});
  }
  return found;
}

/// The offset to the nearest point off the contour's line for which `is_candidate(offset)`;
/// zero if there is none.
template <class Candidate>
Vec3 nearest_off_line(const ContourPlace& place, std::span<const Vec3> points,
                      const Candidate& is_candidate) {
  Vec3 nearest{0.0};
  double least = std::numeric_limits<double>::infinity();
  for (const Vec3& point : points) {
    const Vec3 offset = point - place.center;
    const double squared = glm::dot(offset, offset);
    if (squared >= least) continue;
    const double along = glm::dot(offset, place.along);
    if (2.0 * along * along >= squared || !is_candidate(offset)) continue;  // within 45 degrees
    least = squared;
    nearest = offset;
  }
  return nearest;
}

/// The wider one of the gaps to the contours on both sides; 0 if all points are on one line.
double gap_at(const ContourPlace& place, std::span<const Vec3> points) {
  const Vec3 side = nearest_off_line(place, points, [](const Vec3&) { return true; });
  const double gap = glm::length(side);
  const Vec3 other = nearest_off_line(place, points, [&](const Vec3& offset) {
    return glm::dot(offset, side) < -0.5 * gap * glm::length(offset);  // over 120 degrees apart
  });
  return std::clamp(glm::length(other), gap, kUsualGaps * gap);
}

double quantile(std::vector<double> values, double share) {
  const auto at = static_cast<std::ptrdiff_t>(share * static_cast<double>(values.size() - 1));
  std::nth_element(values.begin(), values.begin() + at, values.end());
  return values[static_cast<std::size_t>(at)];
}

/// Where most of the queries lie on contours, the spacing of those.
std::optional<Spacing> contour_spacing(std::span<const Vec3> points,
                                       std::span<const Neighbourhood> queries) {
  const std::vector<ContourPlace> places = places_on_contours(queries);
  if (2 * places.size() <= queries.size()) return std::nullopt;
  std::vector<Vec3> searched;
  for (const std::size_t index : spread_indices(points.size(), kGapPoints))
    searched.push_back(points[index]);
  std::vector<double> gaps;
  std::vector<double> spacings;
  for (const ContourPlace& place : places) {
    const double gap = gap_at(place, searched);
    if (gap == 0.0) continue;
    gaps.push_back(gap);
    spacings.push_back(std::sqrt(gap * place.step));
  }
  if (gaps.empty()) return std::nullopt;
  return Spacing{.median = quantile(spacings, 0.5),
                 .quantile75 = quantile(spacings, 0.75),
                 .gap = 0.5 * (quantile(gaps, 0.5) + quantile(gaps, 0.75))};
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
  Spacing spacing{.median = quantile(spacings, 0.5), .quantile75 = quantile(spacings, 0.75)};
  if (const auto contours = contour_spacing(points, queries)) spacing = *contours;
  spacing.noise = quantile(noises, 0.5);
  spacing.diagonal = robust_bounds(points).diagonal();
  return spacing;
}

double closed_sheet_pixel_size(const Spacing& spacing) {
  constexpr double kPixelsPerSpacing = 2.2;  // about five points in a pixel
  constexpr double kPixelsPerGap = 1.5;      // where gaps are wider than usual, too
  return std::max({kPixelsPerSpacing * 0.5 * (spacing.median + spacing.quantile75),
                   kPixelsPerNoise * spacing.noise, kPixelsPerGap * spacing.gap});
}

double pixel_size_from_spacing(const Spacing& spacing) {
  constexpr double kFewestPerSpacing = 1.3;  // one pixel in five stays empty, and is filled
  constexpr double kPixelsAcross = 250.0;
  const double finest = std::max({kFewestPerSpacing * 0.5 * (spacing.median + spacing.quantile75),
                                  kPixelsPerNoise * spacing.noise, spacing.gap});
  return std::min(closed_sheet_pixel_size(spacing),
                  std::max(finest, spacing.diagonal / kPixelsAcross));
}

}  // namespace rangezip

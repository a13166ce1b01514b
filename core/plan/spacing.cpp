#include "core/plan/spacing.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <numbers>
#include <optional>
#include <string>

#include "core/base/error.h"
#include "core/base/spread.h"
#include "core/base/symmetric_eigen.h"

namespace rangezip {

namespace {

constexpr std::size_t kQueries = 300;
constexpr std::size_t kNeighbours = 16;

constexpr double kPixelsPerNoise = 4.0;  // a step of one pixel is then rarely noise

/// Heights over a plane are those of two sheets if the gap between them is so many times as wide
/// as their spread on either side of it. Of noise fewer than one neighbourhood in a hundred has
/// such a gap.
constexpr double kSheetGap = 4.0;

/// Times the median: wider spacings may be of outliers.
constexpr double kUsual = 1.5;
/// Of the spacing: an outlier's distance from its neighbours' plane is half of it.
constexpr double kOnPlane = 0.25;

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

/// A neighbourhood's centre and its nearest places, as offsets from the centre: these keep their
/// digits far from the origin.
std::vector<Vec3> offsets_of(const Neighbourhood& neighbourhood, std::size_t nearest) {
  std::vector<Vec3> offsets{Vec3(0.0)};
  for (const Vec3& place : neighbourhood.places().first(nearest))
    offsets.push_back(place - neighbourhood.center());
  return offsets;
}

/// The sum of the outer products of some places, about their mean.
Mat3 scatter_of(std::span<const Vec3> places) {
  Vec3 mean{0.0};
  for (const Vec3& place : places)
    mean += place;
  mean /= static_cast<double>(places.size());
  Mat3 scatter{0.0};
  for (const Vec3& place : places)
    scatter += glm::outerProduct(place - mean, place - mean);
  return scatter;
}

/// The spacing that a neighbourhood shows, if its places fill a disc around the centre.
double spacing_of(const Neighbourhood& neighbourhood) {
  const auto count = static_cast<double>(neighbourhood.places().size());
  return neighbourhood.farthest() * std::sqrt(std::numbers::pi / count);
}

/// Places in the order of their heights along a normal, parted at the widest gap.
struct TwoSheets {
  Vec3 normal{0.0};
  std::vector<Vec3> places;
  std::size_t cut = 1;  ///< the first one past the gap

  [[nodiscard]] double height(std::size_t i) const { return glm::dot(places[i], normal); }
  [[nodiscard]] double gap_before(std::size_t i) const { return height(i) - height(i - 1); }
  [[nodiscard]] std::span<const Vec3> lower() const { return std::span(places).first(cut); }
  [[nodiscard]] std::span<const Vec3> upper() const { return std::span(places).subspan(cut); }
};

TwoSheets part_along(const Vec3& normal, std::span<const Vec3> places) {
  TwoSheets parted{normal, {places.begin(), places.end()}};
  std::sort(parted.places.begin(), parted.places.end(), [&](const Vec3& a, const Vec3& b) {
    return glm::dot(a, normal) < glm::dot(b, normal);
  });
  for (std::size_t i = 2; i < parted.places.size(); ++i) {
    if (parted.gap_before(i) > parted.gap_before(parted.cut)) parted.cut = i;
  }
  return parted;
}

/// The places that lie on the centre's side of a wall: all, or those on this side of a gap along
/// the normal that is at least a spacing wide, and so wide that neither noise nor a bend leaves it.
/// @param places as offsets_of() gives them
std::vector<Vec3> own_sheet(std::span<const Vec3> places, double spacing) {
  constexpr std::size_t kNearest = 7;  // the centre and its first ring: of one sheet, mostly
  constexpr int kRounds = 4;           // both sheets tell the normal, better each time
  const auto copy_of = [](std::span<const Vec3> part) {
    return std::vector<Vec3>(part.begin(), part.end());
  };
  if (places.size() <= kNearest) return copy_of(places);
  Mat3 scatter = scatter_of(places.first(kNearest));
  TwoSheets parted;
  for (int round = 0; round < kRounds; ++round) {
    parted = part_along(eigen_of_symmetric(scatter).vectors[0], places);
    scatter = scatter_of(parted.lower()) + scatter_of(parted.upper());
  }
  const double squares = glm::dot(parted.normal, scatter * parted.normal);
  const double spread = std::sqrt(std::max(0.0, squares) / static_cast<double>(places.size()));
  if (parted.gap_before(parted.cut) < std::max(spacing, kSheetGap * spread)) return copy_of(places);
  const bool is_center_below = parted.height(parted.cut) > 0.0;
  return copy_of(is_center_below ? parted.lower() : parted.upper());
}

/// RMS distance of a neighbourhood's places and centre from their best plane, in an unbiased
/// estimate (the plane takes up three degrees of freedom), without those on the other side of a
/// wall; 0 where that says nothing.
double distance_from_plane(const Neighbourhood& neighbourhood) {
  if (neighbourhood.places().empty()) return 0.0;
  const std::vector<Vec3> sheet = own_sheet(
      offsets_of(neighbourhood, neighbourhood.places().size()), spacing_of(neighbourhood));
  if (sheet.size() <= 3) return 0.0;
  const double squares = std::max(0.0, eigen_of_symmetric(scatter_of(sheet)).values[0]);
  return std::sqrt(squares / static_cast<double>(sheet.size() - 3));
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
    const SymmetricEigen eigen = eigen_of_symmetric(scatter_of(offsets_of(query, kOnLine)));
    if (eigen.values[1] > kLineWidth * kLineWidth * eigen.values[2]) continue;
    const double reach = std::sqrt(squared_distance(query.places()[kOnLine - 1], query.center()));
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

/// The spacing that so large a share of the surface does not exceed.
double quantile_of_surface(const std::vector<double>& spacings, const std::vector<double>& noises,
                           double median, double share) {
  std::vector<double> on_surface;
  double area = 0.0;
  for (std::size_t i = 0; i < spacings.size(); ++i) {
    const bool is_outlier = spacings[i] > kUsual * median && noises[i] > kOnPlane * spacings[i];
    if (is_outlier) continue;
    on_surface.push_back(spacings[i]);
    area += spacings[i] * spacings[i];
  }
  std::sort(on_surface.begin(), on_surface.end());
  double sum = 0.0;
  for (const double spacing : on_surface) {
    sum += spacing * spacing;
    if (sum >= share * area) return spacing;
  }
  return median;
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
    spacings.push_back(spacing_of(query));
    noises.push_back(distance_from_plane(query));
  }
  Spacing spacing{.median = quantile(spacings, 0.5), .quantile75 = quantile(spacings, 0.75)};
  spacing.sparse = quantile_of_surface(spacings, noises, spacing.median, 0.75);
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

bool is_uneven(const Spacing& spacing) {
  constexpr double kUneven = 2.0;
  return spacing.sparse >= kUneven * spacing.median;
}

double pixel_size_from_spacing(const Spacing& spacing) {
  constexpr double kFewestPerSpacing = 1.3;  // one pixel in five stays empty, and is filled
  constexpr double kPixelsAcross = 250.0;
  constexpr double kCoarsest = 4.0;  // local_sizes() are down to a quarter
  const double closed = closed_sheet_pixel_size(spacing);
  const double finest = std::max({kFewestPerSpacing * 0.5 * (spacing.median + spacing.quantile75),
                                  kPixelsPerNoise * spacing.noise, spacing.gap});
  const double usual = std::min(closed, std::max(finest, spacing.diagonal / kPixelsAcross));
  if (!is_uneven(spacing)) return usual;
  return std::clamp(kFewestPerSpacing * spacing.sparse, usual, kCoarsest * usual);
}

}  // namespace rangezip

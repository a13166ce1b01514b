#include "core/plan/spacing.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <numbers>
#include <optional>
#include <string>

#include "core/base/error.h"
#include "core/base/quantile.h"
#include "core/base/spread.h"
#include "core/base/symmetric_eigen.h"
#include "core/plan/cloud_noise.h"
#include "core/plan/line_gap.h"
#include "core/plan/own_sheet.h"
#include "core/plan/places_over_surface.h"
#include "core/plan/slab_index.h"

namespace rangezip {

namespace {

constexpr std::size_t kQueries = 300;
constexpr std::size_t kNeighbours = 16;

constexpr double kPixelsPerNearNoise = 4.0;  // a step of one pixel is then rarely noise
/// However many points a pixel has: they fill it across the surface, too.
constexpr double kPixelsPerNoise = 2.5;

/// Times the median: wider spacings may be of outliers.
constexpr double kUsual = 1.5;
/// Of the spacing: an outlier's distance from its neighbours' plane is half of it.
constexpr double kOnPlane = 0.25;
/// The same where places are spread over the surface, and an outlier stands for no more of it than
/// others: a sparse scan may be noisy. Points all over a space have 0.7.
constexpr double kOnNoisyPlane = 0.45;
/// Of the places that are sparser than usual: where fewer lie on a plane they all are of outliers
/// that fill a space, as the points that a depth camera sees between an object's outline and what
/// is behind it; of those one in twelve does by chance, of a sparse scan nearly all.
constexpr double kShareOnPlane = 0.2;
/// Of those places: more would be outliers that look like surface, where one in twenty points is
/// one.
constexpr double kShareOfPlaces = 0.75;
/// Of the distance to the farthest neighbour: so far is the middle of an outlier's, where those are
/// a spot of the surface that it lies off. At the corner of a square sheet it is 0.6.
constexpr double kAside = 0.75;
/// The sparsest one in so many tells nothing: it may be an outlier that looks like surface (one in
/// 25 does), and would stand for as much of it as a few hundred others.
constexpr std::size_t kOneIn = 100;

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
  /// To the nearest place number `rank`, from 1; 0 if there are fewer.
  [[nodiscard]] double distance(std::size_t rank) const {
    return rank <= count_ ? std::sqrt(distances_[rank - 1]) : 0.0;
  }
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

/// The same of places spread over the surface: of a scan that is far sparser than another one
/// beside it a share of all points has hardly any.
std::vector<Neighbourhood> choose_places(std::span<const Vec3> points, const Box& box) {
  const std::vector<Vec3> places = places_over_surface(points, box, kQueries);
  return {places.begin(), places.end()};
}

/// Fills the neighbourhoods: a first look at few points bounds their radii, then each of all
/// points is offered only to those that it may be near to.
void find_neighbours(std::span<const Vec3> points, std::vector<Neighbourhood>& queries) {
  for (const std::size_t index : spread_indices(points.size(), kFirstLook)) {
    for (Neighbourhood& query : queries)
      query.offer(points[index]);
  }
  std::vector<SlabIndex::Ball> balls;
  balls.reserve(queries.size());
  for (const Neighbourhood& query : queries)
    balls.push_back({query.center(), query.radius()});
  const SlabIndex slabs(balls);
  for (const Vec3& point : points) {
    for (const std::uint32_t q : slabs.balls_near(point.x))
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

/// The spacing that a neighbourhood shows, if its places fill a disc around the centre.
double spacing_of(const Neighbourhood& neighbourhood) {
  const auto count = static_cast<double>(neighbourhood.places().size());
  return neighbourhood.farthest() * std::sqrt(std::numbers::pi / count);
}

/// What a neighbourhood's places tell of the noise; nothing if there are none.
NoisePlace noise_place(const Neighbourhood& neighbourhood) {
  NoisePlace place{.center = neighbourhood.center(), .radius = neighbourhood.farthest()};
  if (neighbourhood.places().empty()) return place;
  place.wall = spacing_of(neighbourhood);
  const std::vector<Vec3> offsets = offsets_of(neighbourhood, neighbourhood.places().size());
  place.noise = distance_from_plane(offsets, place.wall);
  return place;
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

/// Whether all of the neighbours lie on the same side of the centre.
bool is_aside(const Neighbourhood& neighbourhood) {
  Vec3 sum{0.0};
  for (const Vec3& place : neighbourhood.places())
    sum += place - neighbourhood.center();
  const auto count = static_cast<double>(neighbourhood.places().size());
  return glm::length(sum) > kAside * count * neighbourhood.farthest();
}

/// Whether the neighbours are far from any plane; all of them, where too few to tell are on the
/// centre's side of a gap: what lies far beyond it is no wall.
bool is_off_plane(const Neighbourhood& neighbourhood, double noise) {
  const double most = kOnPlane * spacing_of(neighbourhood);
  if (noise > 0.0) return noise > most;
  constexpr double kNoWall = std::numeric_limits<double>::infinity();
  const auto offsets = offsets_of(neighbourhood, neighbourhood.places().size());
  return distance_from_plane(offsets, kNoWall) > most;
}

/// The spacing that most of the places spread over the surface do not exceed; `median` if none of
/// them is on it.
double spacing_of_most(std::span<const Neighbourhood> places, double median) {
  constexpr double kNoWall = std::numeric_limits<double>::infinity();
  std::vector<double> usual, sparse;
  std::size_t unusual = 0;
  for (const Neighbourhood& place : places) {
    const double spacing = spacing_of(place);
    if (spacing <= kUsual * median) {
      usual.push_back(spacing);
      continue;
    }
    if (is_aside(place)) continue;
    ++unusual;
    const auto offsets = offsets_of(place, place.places().size());
    if (distance_from_plane(offsets, kNoWall) <= kOnNoisyPlane * spacing) sparse.push_back(spacing);
  }
  if (static_cast<double>(sparse.size()) >= kShareOnPlane * static_cast<double>(unusual))
    usual.insert(usual.end(), sparse.begin(), sparse.end());
  return usual.empty() ? median : quantile(std::move(usual), kShareOfPlaces);
}

/// Whether a point lies off the surface, where usual spacings are about the median.
bool is_outlier(const Neighbourhood& neighbourhood, double noise, double median) {
  return spacing_of(neighbourhood) > kUsual * median &&
         (is_off_plane(neighbourhood, noise) || is_aside(neighbourhood));
}

/// The spacing that so large a share of the surface does not exceed.
double quantile_of_surface(std::span<const Neighbourhood> queries,
                           const std::vector<double>& noises, double median, double share) {
  std::vector<double> on_surface;
  for (std::size_t i = 0; i < queries.size(); ++i) {
    if (!is_outlier(queries[i], noises[i], median)) on_surface.push_back(spacing_of(queries[i]));
  }
  std::sort(on_surface.begin(), on_surface.end());
  on_surface.resize(on_surface.size() - std::min(on_surface.size(), queries.size() / kOneIn));
  double area = 0.0, sum = 0.0;
  for (const double spacing : on_surface)
    area += spacing * spacing;
  for (const double spacing : on_surface) {
    sum += spacing * spacing;
    if (sum >= share * area) return spacing;
  }
  return median;
}

std::vector<LinePlace> line_places(std::span<const Neighbourhood> queries) {
  std::vector<LinePlace> places;
  for (const Neighbourhood& query : queries)
    places.push_back({query.center(), query.distance(4), query.distance(16)});
  return places;
}

std::vector<double> noises_of(std::span<const NoisePlace> places) {
  std::vector<double> noises;
  for (const NoisePlace& place : places)
    noises.push_back(place.noise);
  return noises;
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

double size_for_noise(const Spacing& spacing) {
  return std::max(kPixelsPerNearNoise * spacing.near_noise, kPixelsPerNoise * spacing.noise);
}

}  // namespace

Spacing estimate_spacing(std::span<const Vec3> points) {
  require_three_distinct(points);
  const Box box = robust_bounds(points);
  std::vector<Neighbourhood> asked = choose_queries(points);
  const std::size_t count = asked.size();
  const std::vector<Neighbourhood> chosen = choose_places(points, box);
  asked.insert(asked.end(), chosen.begin(), chosen.end());
  find_neighbours(points, asked);
  const auto queries = std::span(asked).first(count),
             over_surface = std::span(asked).subspan(count);

  std::vector<double> spacings;
  std::vector<NoisePlace> places;
  for (const Neighbourhood& query : queries) {
    spacings.push_back(spacing_of(query));
    places.push_back(noise_place(query));
  }
  const std::vector<double> noises = noises_of(places);
  Spacing spacing{.median = quantile(spacings, 0.5), .quantile75 = quantile(spacings, 0.75)};
  spacing.sparse = std::max(quantile_of_surface(queries, noises, spacing.median, 0.9),
                            spacing_of_most(over_surface, spacing.median));
  if (const auto contours = contour_spacing(points, queries)) {
    spacing = *contours;
  } else {
    spacing.line_gap = line_gap(points, line_places(queries));
  }
  spacing.near_noise = quantile(noises, 0.5);
  widen_over_noise(points, places);
  spacing.noise = quantile(noises_of(places), 0.5);
  spacing.diagonal = box.diagonal();
  return spacing;
}

double closed_sheet_pixel_size(const Spacing& spacing) {
  constexpr double kPixelsPerSpacing = 2.2;  // about five points in a pixel
  constexpr double kPixelsPerGap = 1.5;      // where gaps are wider than usual, too
  return std::max({kPixelsPerSpacing * 0.5 * (spacing.median + spacing.quantile75),
                   size_for_noise(spacing), kPixelsPerGap * spacing.gap});
}

bool is_uneven(const Spacing& spacing) {
  constexpr double kUneven = 1.4;
  return spacing.sparse >= kUneven * spacing.median;
}

double pixel_size_from_spacing(const Spacing& spacing) {
  constexpr double kFewestPerSpacing = 1.3;  // one pixel in five stays empty, and is filled
  constexpr double kPixelsAcross = 250.0;
  constexpr double kEven = 1.25;  // sparse by median: even clouds have so much by chance
  constexpr double kPerSparse = 1.45;
  constexpr double kPerLineGap = 0.9;
  constexpr double kCoarsest = 4.0;  // local_sizes() are down to a quarter
  const double closed = closed_sheet_pixel_size(spacing);
  const double fewest = kFewestPerSpacing * 0.5 * (spacing.median + spacing.quantile75);
  const double finest = std::max({fewest, size_for_noise(spacing), spacing.gap});
  const double usual = std::min(closed, std::max(finest, spacing.diagonal / kPixelsAcross));
  const double excess = std::max(spacing.sparse - kEven * spacing.median, 0.0);
  const double of_lines = kPerLineGap * spacing.line_gap;
  return std::clamp(std::max(fewest + kPerSparse * excess, of_lines), usual, kCoarsest * usual);
}

}  // namespace rangezip

#include "core/finish/fit_window.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <limits>
#include <optional>
#include <vector>

#include "core/base/parallel.h"
#include "core/finish/corner_table.h"
#include "core/finish/vertex_geometry.h"

namespace rangezip {
namespace {

// Lengths are in h.
constexpr std::array kRadii{1.3, 1.5, 1.75, 2.0, 2.3, 2.65, 3.05, 3.5, 4.0, 4.6};
constexpr double kLeastHeight = 1.0;     // points of another sheet are farther than this
constexpr double kFirstHeight = 1.5;     // before the noise is known
constexpr double kHeightPerNoise = 3.5;  // keeps all but a few points of the sheet
constexpr double kTolerance = 1.2;       // of the least error, for the sake of smooth normals
constexpr std::size_t kAsked = 2000;
constexpr std::size_t kMinAnswers = 20;
constexpr std::size_t kOneInLeftOut = 500;  // of the answers, the largest
constexpr std::size_t kPerBlock = 64;
constexpr int kSteps = 2;  // onto the surface, before anything is measured

/// A place of the surface and the narrowest fit there.
struct Probe {
  Vec3 place;
  Vec3 normal;
  MeasuredFit narrowest;
};

/// Estimated mean squares of fits in a window.
struct FitErrors {
  double all = 0.0;       ///< below 0 where neighbouring points err alike, as those of one scan do
  double variance = 0.0;  ///< the part that noise makes, never negative
};

double median(std::vector<double> values) {
  const auto middle = values.begin() + static_cast<std::ptrdiff_t>(values.size() / 2);
  std::nth_element(values.begin(), middle, values.end());
  return *middle;
}

std::vector<std::uint32_t> asked_vertices(const CornerTable& table) {
  std::vector<std::uint32_t> asked;
  const std::size_t step = std::max<std::size_t>(1, table.vertex_count() / kAsked);
  for (std::size_t v = 0; v < table.vertex_count(); v += step) {
    const auto vertex = static_cast<std::uint32_t>(v);
    if (!table.is_boundary(vertex)) asked.push_back(vertex);
  }
  return asked;
}

std::vector<Probe> make_probes(const TriangleMesh& mesh, const PointGrid& cloud,
                               const SurfaceWindow& window) {
  const CornerTable table(mesh.triangles, mesh.positions.size());
  const std::vector<std::uint32_t> asked = asked_vertices(table);
  std::vector<Probe> probes(asked.size());
  parallel_for(asked.size(), kPerBlock, [&](std::size_t begin, std::size_t end) {
    for (std::size_t i = begin; i < end; ++i) {
      Probe& probe = probes[i];
      probe.place = mesh.positions[asked[i]];
      probe.normal = vertex_normal(table, mesh.positions, asked[i]);
      for (int step = 0; step <= kSteps; ++step) {
        probe.narrowest = measure_surface(cloud, probe.place, probe.normal, window);
        if (!probe.narrowest.fit.is_found || step == kSteps) break;
        probe.place = probe.narrowest.fit.foot;
        probe.normal = probe.narrowest.fit.normal;
      }
    }
  });
  std::erase_if(probes, [](const Probe& probe) { return !probe.narrowest.fit.is_found; });
  return probes;
}

/// The mean without the largest few, of which one alone may be more than all others: a place where
/// a narrow fit and a wide one are on different sheets.
double mean_of_most(const std::vector<double>& values) {
  std::vector<double> sorted = values;
  const std::size_t most = sorted.size() - 1 - sorted.size() / kOneInLeftOut;
  std::nth_element(sorted.begin(), sorted.begin() + static_cast<std::ptrdiff_t>(most),
                   sorted.end());
  const double largest = sorted[most];
  double sum = 0.0;
  std::size_t count = 0;
  for (const double value : values) {
    if (value > largest) continue;
    sum += value;
    ++count;
  }
  return sum / static_cast<double>(count);
}

/// Nothing if too few fits are found.
std::optional<FitErrors> errors_of(const std::vector<Probe>& probes, const PointGrid& cloud,
                                   const SurfaceWindow& window, double noise2, double pixel_size) {
  std::vector<MeasuredFit> fits(probes.size());
  parallel_for(probes.size(), kPerBlock, [&](std::size_t begin, std::size_t end) {
    for (std::size_t i = begin; i < end; ++i)
      fits[i] = measure_surface(cloud, probes[i].place, probes[i].normal, window);
  });
  const double covariance = fit_covariance(kRadii.front() * pixel_size, window.radius);
  std::vector<double> errors, variances;
  errors.reserve(fits.size());
  variances.reserve(fits.size());
  for (std::size_t i = 0; i < fits.size(); ++i) {
    if (!fits[i].fit.is_found) continue;
    const MeasuredFit& narrowest = probes[i].narrowest;
    const double apart = fits[i].fit.height - narrowest.fit.height;
    // What their difference has beyond its own variance is bias; to it comes the wider fit's
    // variance.
    errors.push_back(apart * apart + noise2 * (2.0 * covariance * fits[i].scatter.share2 -
                                               narrowest.scatter.share2));
    variances.push_back(noise2 * fits[i].scatter.share2);
  }
  if (errors.size() < kMinAnswers) return std::nullopt;
  return FitErrors{mean_of_most(errors), mean_of_most(variances)};
}

}  // namespace

SurfaceWindow FitWindow::at(const Vec3& place, double times) const {
  SurfaceWindow here = window;
  here.radius *= times * radii.at(place);
  return here;
}

FitWindow choose_fit_window(const TriangleMesh& mesh, const PointGrid& cloud, double pixel_size) {
  FitWindow chosen{{kRadii.front() * pixel_size, kFirstHeight * pixel_size, 0.0}, 0.0, {}};
  std::vector<Probe> probes = make_probes(mesh, cloud, chosen.window);
  if (probes.size() < kMinAnswers) return chosen;
  std::vector<double> squares;
  squares.reserve(probes.size());
  for (const Probe& probe : probes)
    squares.push_back(probe.narrowest.scatter.noise2);
  const double noise2 = median(std::move(squares));
  chosen.noise = std::sqrt(noise2);
  chosen.window.height = std::max(kLeastHeight * pixel_size, kHeightPerNoise * chosen.noise);

  for (Probe& probe : probes)  // as high as the wider ones
    probe.narrowest = measure_surface(cloud, probe.place, probe.normal, chosen.window);
  std::erase_if(probes, [](const Probe& probe) { return !probe.narrowest.fit.is_found; });

  double least = std::numeric_limits<double>::infinity();
  double tolerated = least;
  for (const double radius : kRadii) {
    const SurfaceWindow window{radius * pixel_size, chosen.window.height, 0.0};
    const auto errors = errors_of(probes, cloud, window, noise2, pixel_size);
    if (!errors) continue;
    if (errors->all <= tolerated) chosen.window.radius = window.radius;
    if (errors->all >= least) continue;
    least = errors->all;
    const double true_least = std::max(least, errors->variance);
    tolerated = least + (kTolerance * kTolerance - 1.0) * true_least;
  }
  chosen.window.noise = chosen.noise;
  return chosen;
}

}  // namespace rangezip

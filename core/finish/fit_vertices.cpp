#include "core/finish/fit_vertices.h"

#include <array>
#include <cstddef>
#include <cstdint>
#include <vector>

#include "core/base/parallel.h"
#include "core/finish/corner_table.h"
#include "core/finish/triangle_shape.h"
#include "core/finish/vertex_geometry.h"

namespace rangezip {
namespace {

constexpr double kMinCosine = 0.6;  // between the fitted surface and the mesh
constexpr int kSteps = 3;           // of solving; more bring no change that can be measured
constexpr std::size_t kPerBlock = 512;

/// Of the way to the mean of the neighbours' shifts: what is rough in the least squares of the
/// distance tilts faces more than it brings them nearer.
constexpr double kSmoothing = 0.6;

/// One value a corner.
using CornerValues = std::array<double, 3>;
using Barycentric = std::array<double, 3>;

constexpr Barycentric kMiddle{1.0 / 3.0, 1.0 / 3.0, 1.0 / 3.0};

/// A quadrature of the second degree, of equal weights.
constexpr double kNear = 2.0 / 3.0, kFar = 1.0 / 6.0;
constexpr std::array<Barycentric, 3> kSamples{
    {{kNear, kFar, kFar}, {kFar, kNear, kFar}, {kFar, kFar, kNear}}};

class Fitter {
 public:
  Fitter(TriangleMesh& mesh, const PointGrid& surface, const FitWindow& fit)
      : mesh_(mesh),
        surface_(surface),
        fit_(fit),
        table_(mesh.triangles, mesh.positions.size()),
        normals_(mesh.positions.size()),
        areas_(mesh.triangles.size()) {
    parallel_for(normals_.size(), kPerBlock, [&](std::size_t begin, std::size_t end) {
      for (auto v = static_cast<std::uint32_t>(begin); v < end; ++v)
        normals_[v] = vertex_normal(table_, mesh.positions, v);
    });
    parallel_for(areas_.size(), kPerBlock, [&](std::size_t begin, std::size_t end) {
      for (auto f = static_cast<std::uint32_t>(begin); f < end; ++f)
        areas_[f] = 0.5 * glm::length(face_area_vector(table_, mesh.positions, f));
    });
  }

  void run() {
    const std::vector<CornerValues> gaps = integrate_gaps();
    std::vector<double> right(normals_.size(), 0.0), lumped(normals_.size(), 0.0);
    for (std::size_t f = 0; f < gaps.size(); ++f) {
      for (std::size_t k = 0; k < 3; ++k) {
        right[mesh_.triangles[f][k]] += gaps[f][k];
        lumped[mesh_.triangles[f][k]] += areas_[f] / 3.0;
      }
    }
    std::vector<double> shift(normals_.size(), 0.0);
    for (int step = 0; step < kSteps; ++step) {
      const std::vector<double> product = mass_times(shift);
      for (std::size_t v = 0; v < shift.size(); ++v) {
        if (lumped[v] > 0.0) shift[v] += (right[v] - product[v]) / lumped[v];
      }
    }
    move(smoothed(table_, shift, kSmoothing));
  }

 private:
  /// For each face the integral of (height of the surface over it) times each corner's hat
  /// function.
  [[nodiscard]] std::vector<CornerValues> integrate_gaps() const {
    std::vector<CornerValues> gaps(mesh_.triangles.size());
    parallel_for(gaps.size(), kPerBlock, [&](std::size_t begin, std::size_t end) {
      for (std::size_t f = begin; f < end; ++f)
        gaps[f] = gap_integrals(f);
    });
    return gaps;
  }

  [[nodiscard]] CornerValues gap_integrals(std::size_t face) const {
    CornerValues sums{};
    const Triangle& t = mesh_.triangles[face];
    const auto place_at = [&](const Barycentric& w) {
      return w[0] * mesh_.positions[t[0]] + w[1] * mesh_.positions[t[1]] +
             w[2] * mesh_.positions[t[2]];
    };
    const Vec3 normal = unit_or_z(normals_[t[0]] + normals_[t[1]] + normals_[t[2]]);
    const Vec3 middle = place_at(kMiddle);
    const SurfaceFit fit = fit_surface(surface_, middle, normal, fit_.at(middle));
    if (!fit.is_found || glm::dot(fit.normal, normal) < kMinCosine) return sums;
    for (const Barycentric& w : kSamples) {
      const Vec3 place = place_at(w);
      const double height = glm::dot(projected_onto(fit, place) - place, fit.normal);
      for (std::size_t k = 0; k < 3; ++k)
        sums[k] += areas_[face] / 3.0 * w[k] * height;
    }
    return sums;
  }

  [[nodiscard]] std::vector<double> mass_times(const std::vector<double>& values) const {
    constexpr double kOffDiagonal = 1.0 / 12.0;  // of the area; the diagonal has twice as much
    std::vector<double> product(values.size(), 0.0);
    for (std::size_t f = 0; f < mesh_.triangles.size(); ++f) {
      const Triangle& t = mesh_.triangles[f];
      const double sum = values[t[0]] + values[t[1]] + values[t[2]];
      for (const std::uint32_t v : t)
        product[v] += kOffDiagonal * areas_[f] * (sum + values[v]);
    }
    return product;
  }

  void move(const std::vector<double>& shift) {
    for (std::uint32_t v = 0; v < shift.size(); ++v) {
      if (table_.is_boundary(v)) continue;
      const Vec3 target = mesh_.positions[v] + shift[v] * normals_[v];
      if (turns_no_face(table_, mesh_.positions, v, target)) mesh_.positions[v] = target;
    }
  }

  TriangleMesh& mesh_;
  const PointGrid& surface_;
  const FitWindow& fit_;
  CornerTable table_;
  std::vector<Vec3> normals_;
  std::vector<double> areas_;  ///< of the faces
};

}  // namespace

void fit_vertices(TriangleMesh& mesh, const PointGrid& surface, const FitWindow& fit,
                  const Progress& progress) {
  if (surface.empty()) return;
  progress.check_stop();
  Fitter(mesh, surface, fit).run();
}

}  // namespace rangezip

#include <algorithm>
#include <cmath>

#include "core/finish/corner_table.h"
#include "core/finish/edge_changes.h"
#include "core/finish/fill_patch.h"

namespace rangezip {
namespace {

/// Density of the new points [Liepa 2003, 4]: sqrt(2) gives triangles as large as those around.
constexpr double kDensity = 1.41421356237309504880;
/// Each round may halve the edges; more than a few means that the scale is off.
constexpr int kMaxRounds = 12;
constexpr int kMaxFlipPasses = 20;

class Refiner {
 public:
  Refiner(FillPatch& patch, std::vector<double> scale,
          const std::function<bool(std::uint32_t, std::uint32_t)>& is_forbidden)
      : patch_(patch),
        scale_(std::move(scale)),
        is_forbidden_(is_forbidden),
        table_(patch.triangles, patch.positions.size()) {}

  void run() {
    turn_edges();
    for (int round = 0; round < kMaxRounds && split_faces(); ++round)
      turn_edges();
    patch_.triangles = table_.triangles();
  }

 private:
  bool split_faces() {
    bool any = false;
    const auto count = static_cast<std::uint32_t>(table_.face_count());
    for (std::uint32_t face = 0; face < count; ++face) {
      const Triangle t = table_.triangle(face);
      Vec3 center{0.0};
      double scale = 0.0;
      for (const std::uint32_t v : t) {
        center += patch_.positions[v] / 3.0;
        scale += scale_[v] / 3.0;
      }
      const bool is_wide = std::all_of(t.begin(), t.end(), [&](std::uint32_t v) {
        const double distance = kDensity * glm::length(center - patch_.positions[v]);
        return distance > scale && distance > scale_[v];
      });
      if (!is_wide) continue;
      table_.split(face);
      patch_.positions.push_back(center);
      scale_.push_back(scale);
      any = true;
    }
    return any;
  }

  void turn_edges() {
    for (int pass = 0; pass < kMaxFlipPasses; ++pass) {
      bool any = false;
      for (std::uint32_t c = 0; c < table_.corner_count(); ++c) {
        if (!table_.names_inner_edge(c) || !is_improvement(c)) continue;
        table_.flip(c);
        any = true;
      }
      if (!any) break;
    }
  }

  /// The angles opposite to the edge add up to more than half a turn, and turning it leaves no
  /// fold.
  [[nodiscard]] bool is_improvement(std::uint32_t c) const {
    const Diamond d(table_, c);
    const std::vector<Vec3>& p = patch_.positions;
    constexpr double kWorthIt = 1e-9;  // of a cotangent: cocircular points must not turn for ever
    if (!(cotangent(p[d.x], p[d.a], p[d.b]) + cotangent(p[d.y], p[d.a], p[d.b]) < -kWorthIt))
      return false;
    const DiamondAreas areas(p, d);
    if (!(glm::dot(areas.new_a, areas.new_b) > 0.0)) return false;
    if (d.x < patch_.loop_size && d.y < patch_.loop_size && is_forbidden_(d.x, d.y)) return false;
    return table_.is_flip_ok(c);
  }

  static double cotangent(const Vec3& at, const Vec3& a, const Vec3& b) {
    const double sine = glm::length(area_vector(at, a, b));
    const double cosine = glm::dot(a - at, b - at);
    constexpr double kFlat = 1e18;  // stands for an infinite cotangent
    return sine > 0.0 ? cosine / sine : (cosine < 0.0 ? -kFlat : kFlat);
  }

  FillPatch& patch_;
  std::vector<double> scale_;
  const std::function<bool(std::uint32_t, std::uint32_t)>& is_forbidden_;
  CornerTable table_;
};

}  // namespace

void refine_patch(FillPatch& patch, std::vector<double> scale,
                  const std::function<bool(std::uint32_t, std::uint32_t)>& is_forbidden) {
  Refiner(patch, std::move(scale), is_forbidden).run();
}

}  // namespace rangezip

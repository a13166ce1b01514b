#include "core/finish/remesh.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <utility>
#include <vector>

#include "core/base/parallel.h"
#include "core/finish/corner_table.h"
#include "core/finish/edge_changes.h"
#include "core/finish/edge_flips.h"
#include "core/finish/edge_lengths.h"
#include "core/finish/spikes.h"
#include "core/finish/triangle_shape.h"
#include "core/finish/vertex_geometry.h"

namespace rangezip {
namespace {

// Lengths are in the wanted edge length, angles as cosines, and smallest angles as sines.
constexpr double kLongEdge = 4.0 / 3.0;
constexpr double kShortEdge = 4.0 / 5.0;
constexpr double kLongestEdge = 1.8;   // that may arise where a small angle goes
constexpr double kCollapseTurn = 0.7;  // 45 degrees: a collapse may tilt a face so much
constexpr double kMinAngleAfterCollapse = 0.15;
constexpr double kSmallAngle = 0.5;    // 30 degrees
constexpr double kLowNoise = 0.05;     // in h
constexpr double kFarMove = 0.25;      // of the usual radius: shorter moves may go anywhere
constexpr double kNearPoints = 0.4;    // of the same: so near to a surface there are points
constexpr double kFitMinCosine = 0.6;  // between the fitted surface and the mesh
constexpr int kRoundsAfterCoarse = 5;  // that make the wanted size again
constexpr double kFirstScale = 1.6;    // coarser triangles at first leave nothing of the pixel grid
constexpr double kMostScaling = 1.1;   // of the wanted length, in a round
constexpr double kEvenLength = 0.99;   // of the edge of as many equilateral triangles
constexpr std::array kProjections{1.5, 1.0};  // before the first round, with windows of
                                              // so many radii: the stitched mesh is rough
constexpr int kValencePasses = 2;             // an edge that has turned makes others worth it
constexpr int kClosingRounds = 2;
constexpr int kAligningRounds = 2;
constexpr int kSizingRounds = 5;  // later ones keep the relative lengths
constexpr int kAnewRounds = 2;    // in later ones, and not at the end, vertices hardly move:
constexpr double kReuse = 0.25;   // within so much of a window the fit of before is as good
constexpr std::size_t kPerBlock = 512;

class Remesher {
 public:
  Remesher(TriangleMesh& mesh, const PointGrid& cloud, const PointGrid& surface,
           const RemeshOptions& options)
      : positions_(mesh.positions),
        sources_(mesh.sources),
        cloud_(cloud),
        surface_(surface),
        options_(options),
        table_(mesh.triangles, mesh.positions.size()),
        faces_(mesh.triangles.size()),
        wanted_faces_(options.triangles > 0 ? options.triangles : faces_),
        lengths_(mesh.positions.size(), 1.0),
        fits_(mesh.positions.size()) {
    choose_scale();
  }

  void run(RemeshReport& report, const Progress& progress) {
    for (const double radii : kProjections)
      project_vertices(radii);
    for (int round = 0; round < options_.rounds; ++round) {
      progress.check_stop();
      if (round + kClosingRounds < options_.rounds) {
        if (round < kSizingRounds) choose_lengths();
        if (is_coarse(round)) scale_ *= kFirstScale;
        report.split_edges += split_long_edges();
        report.collapsed_edges += collapse_short_edges();
        for (int pass = 0; pass < kValencePasses; ++pass)
          report.flipped_edges += flip_for_valence(table_, positions_);
        if (is_coarse(round)) {
          scale_ /= kFirstScale;
        } else {
          adjust_scale();
        }
      } else {
        report.flipped_edges += flip_for_angles(table_, positions_);
      }
      report.flattened_spikes += flatten_spikes(positions_, table_, cloud_, options_.pixel_size);
      relax_vertices(round < kAnewRounds ? Fits::anew : Fits::again);
    }
    report.edge = scale_;
    report.flipped_edges += flip_for_angles(table_, positions_);
    report.collapsed_edges += collapse_small_angles();
    for (int round = 0; round < kAligningRounds; ++round) {
      if (round > 0) relax_vertices(Fits::anew);
      report.flipped_edges += flip_for_normals(table_, positions_, surface_normals());
    }
  }
  [[nodiscard]] std::vector<Triangle> triangles() const { return table_.triangles(); }

 private:
  enum class Fits : std::uint8_t { anew, again };

  [[nodiscard]] const Vec3& at(std::uint32_t vertex) const { return positions_[vertex]; }
  [[nodiscard]] bool is_coarse(int round) const {
    return round == 0 && options_.rounds > kRoundsAfterCoarse;
  }
  [[nodiscard]] double relative_length(std::uint32_t a, std::uint32_t b) const {
    return glm::length(at(b) - at(a)) / (0.5 * scale_ * (lengths_[a] + lengths_[b]));
  }

  /// As many triangles as are asked for; else as many as there are where sizes are plain, and
  /// smaller ones elsewhere.
  void choose_scale() {
    double area = 0.0;  // in that of plain triangles
    double plain_area = 0.0;
    std::size_t plain = 0;
    for (std::uint32_t f = 0; f < table_.face_count(); ++f) {
      const double size = 0.5 * glm::length(face_area_vector(table_, positions_, f));
      const double share = options_.sizes.at(at(table_.triangle(f)[0]));
      area += size / (share * share);
      if (share < 1.0) continue;
      plain_area += size;
      ++plain;
    }
    if (options_.triangles == 0 && plain < faces_ && plain_area > 0.0)
      wanted_faces_ = static_cast<std::size_t>(static_cast<double>(plain) * area / plain_area);
    scale_ =
        kEvenLength * std::sqrt(area / static_cast<double>(wanted_faces_) * 4.0 / std::sqrt(3.0));
  }

  void choose_lengths() {
    lengths_ = relative_edge_lengths(table_, positions_, fits_, scale_);
    if (options_.sizes.is_one()) return;
    std::vector<double> sizes(lengths_.size());
    for (std::size_t v = 0; v < sizes.size(); ++v)
      sizes[v] = options_.sizes.at(positions_[v]);
    const double plain = triangles_of(sizes);
    for (std::size_t v = 0; v < sizes.size(); ++v)
      lengths_[v] *= sizes[v];
    // The mean over bending was that of all places alike, but most triangles are where they are
    // small.
    const double times = std::sqrt(triangles_of(lengths_) / plain);
    for (double& length : lengths_)
      length *= times;
  }

  /// In proportion to how many there are if edges have these lengths.
  [[nodiscard]] double triangles_of(const std::vector<double>& lengths) const {
    double sum = 0.0;
    for (std::uint32_t f = 0; f < table_.face_count(); ++f) {
      if (table_.is_deleted(f)) continue;
      const double size = glm::length(face_area_vector(table_, positions_, f));
      for (const std::uint32_t v : table_.triangle(f))
        sum += size / (lengths[v] * lengths[v]);
    }
    return sum;
  }

  /// Edges that may neither be split nor be collapsed yet keep the number of triangles from what
  /// their length promises.
  void adjust_scale() {
    const double ratio =
        std::sqrt(static_cast<double>(faces_) / static_cast<double>(wanted_faces_));
    scale_ *= std::clamp(ratio, 1.0 / kMostScaling, kMostScaling);
  }

  std::size_t split_long_edges() {
    std::size_t count = 0;
    const auto corners = static_cast<std::uint32_t>(table_.corner_count());
    for (std::uint32_t c = 0; c < corners; ++c) {
      if (!table_.names_inner_edge(c)) continue;
      const std::uint32_t a = table_.vertex(c), b = table_.head(c);
      if (relative_length(a, b) <= kLongEdge) continue;
      table_.split_edge(c);
      positions_.push_back(0.5 * (at(a) + at(b)));
      lengths_.push_back(0.5 * (lengths_[a] + lengths_[b]));
      fits_.emplace_back(fits_[a]);
      if (!sources_.empty()) sources_.emplace_back(sources_[a]);
      faces_ += 2;
      ++count;
    }
    return count;
  }

  std::size_t collapse_short_edges() {
    std::size_t count = 0;
    for (std::uint32_t c = 0; c < table_.corner_count(); ++c) {
      if (!table_.names_inner_edge(c)) continue;
      if (relative_length(table_.vertex(c), table_.head(c)) > kShortEdge) continue;
      count += collapse_edge(c, kMinAngleAfterCollapse, kLongEdge) ? 1 : 0;
    }
    return count;
  }

  /// Removes the shortest edge of faces with a small angle where that leaves none.
  std::size_t collapse_small_angles() {
    std::size_t count = 0;
    for (std::uint32_t f = 0; f < table_.face_count(); ++f) {
      if (table_.is_deleted(f)) continue;
      const Triangle t = table_.triangle(f);
      if (sine_of_smallest_angle(at(t[0]), at(t[1]), at(t[2])) >= kSmallAngle) continue;
      std::uint32_t shortest = 3 * f;
      for (const std::uint32_t c : {3 * f + 1, 3 * f + 2}) {
        if (length_of(c) < length_of(shortest)) shortest = c;
      }
      if (table_.across(shortest) == CornerTable::kNone) continue;
      count += collapse_edge(shortest, kSmallAngle, kLongestEdge) ? 1 : 0;
    }
    return count;
  }
  [[nodiscard]] double length_of(std::uint32_t corner) const {
    return glm::length(at(table_.head(corner)) - at(table_.vertex(corner)));
  }

  /// In either direction; false where neither can be.
  bool collapse_edge(std::uint32_t corner, double min_angle, double longest) {
    for (const std::uint32_t side : {corner, table_.across(corner)}) {
      if (!table_.is_collapse_ok(side) || !keeps_shape(side, min_angle, longest)) continue;
      table_.collapse(side);
      faces_ -= 2;
      return true;
    }
    return false;
  }

  /// Moving the half-edge's vertex into its head neither turns a face nor makes a small angle or
  /// a long edge.
  [[nodiscard]] bool keeps_shape(std::uint32_t corner, double min_angle, double longest) const {
    const std::uint32_t vertex = table_.vertex(corner), target = table_.head(corner);
    bool ok = true;
    for_each_face_after_collapse(table_, corner, [&](std::uint32_t p, std::uint32_t q) {
      if (!ok) return;
      const Vec3 before = area_vector(at(vertex), at(p), at(q));
      const Vec3 after = area_vector(at(target), at(p), at(q));
      ok = has_cosine(before, after, kCollapseTurn) &&
           sine_of_smallest_angle(at(target), at(p), at(q)) >= min_angle &&
           relative_length(target, p) <= longest && relative_length(target, q) <= longest;
    });
    return ok;
  }

  /// Onto the surface of the cloud.
  void project_vertices(double radii) {
    move_vertices([&](std::uint32_t v) {
      return projected(v, at(v), vertex_normal(table_, positions_, v), radii);
    });
  }

  /// To the middle of the faces around, then onto the surface of the cloud.
  void relax_vertices(Fits fits) {
    move_vertices([&](std::uint32_t v) {
      const Vec3 normal = vertex_normal(table_, positions_, v);
      const Vec3 middle = middle_around(v, normal);
      return fits == Fits::again && is_fit_near(v, middle) ? projected_onto(fits_[v], middle)
                                                           : projected(v, middle, normal, 1.0);
    });
  }
  [[nodiscard]] bool is_fit_near(std::uint32_t v, const Vec3& p) const {
    return fits_[v].is_found &&
           glm::distance(p, fits_[v].foot) <= kReuse * options_.fit.at(p).radius;
  }

  /// Inner vertices to place_of(vertex), all at once, where that turns no face.
  template <class PlaceOf>
  void move_vertices(const PlaceOf& place_of) {
    std::vector<Vec3> moved(positions_);
    parallel_for(positions_.size(), kPerBlock, [&](std::size_t begin, std::size_t end) {
      for (std::size_t i = begin; i < end; ++i) {
        const auto v = static_cast<std::uint32_t>(i);
        if (!table_.is_boundary(v)) moved[v] = place_of(v);
      }
    });
    for (std::uint32_t v = 0; v < positions_.size(); ++v) {
      if (moved[v] != at(v) && turns_no_face(table_, positions_, v, moved[v]))
        positions_[v] = moved[v];
    }
  }

  /// Of the faces, on the tangent plane; larger ones count as much where they should be large.
  [[nodiscard]] Vec3 middle_around(std::uint32_t v, const Vec3& normal) const {
    const Vec3& p = at(v);
    Vec3 sum{0.0};
    double weight = 0.0;
    table_.for_each_corner(v, [&](std::uint32_t c) {
      const Triangle t = table_.triangle(c / 3);
      const double length = lengths_[t[0]] + lengths_[t[1]] + lengths_[t[2]];
      const double w = glm::length(face_area_vector(table_, positions_, c / 3)) / (length * length);
      sum += w / 3.0 * (at(t[0]) + at(t[1]) + at(t[2]));
      weight += w;
    });
    if (!(weight > 0.0)) return p;
    const Vec3 shift = sum / weight - p;
    return p + shift - glm::dot(shift, normal) * normal;
  }

  [[nodiscard]] Vec3 projected(std::uint32_t v, const Vec3& p, const Vec3& normal, double radii) {
    SurfaceFit& fit = fits_[v];
    fit = fit_surface(surface_, p, normal, options_.fit.at(p, radii));
    if (fit.is_found && (glm::dot(fit.normal, normal) < kFitMinCosine || is_in_air(fit)))
      fit.is_found = false;
    return fit.is_found ? fit.foot : p;
  }

  /// Whether a fit leads far, to where there are no points: across an edge a quadric may rise over
  /// them. Fits to noisy clouds hardly bend by chance, and those that widen reach over gaps.
  [[nodiscard]] bool is_in_air(const SurfaceFit& fit) const {
    const SurfaceWindow window = options_.fit.at(fit.foot);
    const bool may_tell =
        options_.fit.noise <= kLowNoise * options_.pixel_size && window.widest <= window.radius;
    return may_tell && std::abs(fit.height) > kFarMove * window.radius &&
           !surface_.has_point_within(fit.foot, kNearPoints * window.radius);
  }

  [[nodiscard]] std::vector<Vec3> surface_normals() const {
    std::vector<Vec3> normals(fits_.size(), Vec3{0.0});
    for (std::size_t v = 0; v < fits_.size(); ++v) {
      if (fits_[v].is_found) normals[v] = fits_[v].normal;
    }
    return normals;
  }

  std::vector<Vec3>& positions_;
  std::vector<VertexSource>& sources_;
  const PointGrid& cloud_;
  const PointGrid& surface_;
  RemeshOptions options_;
  CornerTable table_;
  std::size_t faces_;
  std::size_t wanted_faces_;
  double scale_ = 0.0;            ///< wanted edge length where the relative one is 1
  std::vector<double> lengths_;   ///< relative, one a vertex
  std::vector<SurfaceFit> fits_;  ///< the last one of each vertex
};

}  // namespace

RemeshReport remesh(TriangleMesh& mesh, const PointGrid& cloud, const PointGrid& surface,
                    const RemeshOptions& options, const Progress& progress) {
  RemeshReport report;
  if (mesh.triangles.empty()) return report;
  Remesher remesher(mesh, cloud, surface, options);
  remesher.run(report, progress);
  mesh.triangles = remesher.triangles();
  return report;
}

}  // namespace rangezip
